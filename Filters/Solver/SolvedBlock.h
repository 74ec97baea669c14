// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Filters/Membrane/RefractionScene.h"
#include "Filters/Object/ViewSelection.h"
#include "Filters/Output/ImagePolyData.h"
#include "Filters/Output/KeptOutput.h"
#include "Filters/Output/StackArrays.h"
#include "Refraction/StackImages/StackImages.h"

#include "vtkPolyData.h"
#include "vtkWeakPointer.h"

#include "Common/RangeLoop.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace meniscus
{

/** Virtual vertices of one block of geometry, with the values from which they were computed. */
struct SolvedBlock
{
  /**
   * Reads the points again if the source has been modified. Images stay valid if no value differs.
   */
  void UpdatePoints();
  /** Reads the cells again if the source has been modified. */
  void UpdateTopology();

  /** Prepares one image of each point: `Order` for one interface, `Stack` for several. */
  void PrepareFirst(const RefractionScene& scene);
  /** Replaces `Images` by all images of the points, which have to be solved; without flat facets.
   */
  void MakeImages(RefractionScene& scene);
  /** Prepares the mapping of cells on all threads, if a point has no image or several. */
  void PrepareCells(RefractionScene& scene) const;
  /** `Images` of several interfaces. */
  const StackImages& GetStackImages() const;
  /** True if a chunk of CellImages::Chunk points in the order of solving has selected points. */
  bool IsSelected(std::size_t chunk) const;

  vtkWeakPointer<vtkPolyData> Source;
  vtkMTimeType SourceTime = 0;
  std::vector<double> Points;
  vtkTypeInt64 Rays = -1; ///< number of the rays for which the points are solved
  bool All = false;       ///< true: all images; false: the first image only
  std::vector<VirtualVertex> Vertices;
  std::vector<bool> SolvedChunks; ///< chunks of points in the order of solving

  /**
   * FindCoherentOrder() of the points, determined when the first images are solved. The images of
   * several interfaces are solved in the given order.
   */
  std::vector<std::uint32_t> Order;
  bool OrderReady = false;

  /** Cells and points in view, and the view for which they were determined. */
  ViewSelection Selection;
  vtkTypeInt64 ViewChange = -1;

  /** Used with all images, or with a view. */
  vtkMTimeType TopologyTime = 0;
  ObjectTopology Topology;

  /** Used with all images only. */
  double Tolerance = 0.0;
  bool ClosesSeams = false;
  bool CellsReady = false;
  ObjectTopology Selected; ///< the cells in view
  std::unique_ptr<CellImages> Images;
  AllImages Cells;
  ImageAssembly Assembly; ///< of `Images` and `Cells`

  StackDetails Stack; ///< used with several interfaces and one image per point

  KeptOutput Kept;

private:
  std::unique_ptr<CellImages> MakeImages(
    CurvedMembraneSolver& solver, const ParallelPlanes* plane) const;
};

}
