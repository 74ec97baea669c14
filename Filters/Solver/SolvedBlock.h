// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Filters_Solver_SolvedBlock_h
#define meniscus_Filters_Solver_SolvedBlock_h

#include "Filters/Object/ViewSelection.h"
#include "Filters/Output/ImagePolyData.h"
#include "Filters/Output/KeptOutput.h"
#include "Filters/Output/StackArrays.h"
#include "Refraction/Images/ObjectImages.h"
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

  /** Determines `Order`, if the points are new. */
  void UpdateOrder(const RangeLoop& loop);
  /** True if a chunk of ObjectImages::Chunk points in the order of solving has selected points. */
  bool IsSelected(std::size_t chunk) const;

  /** Discards images of all kinds. */
  void ForgetImages();

  vtkWeakPointer<vtkPolyData> Source;
  vtkMTimeType SourceTime = 0;
  std::vector<double> Points;
  vtkTypeInt64 EyeUpdate = -1; ///< number of the eye update for which the points are solved
  bool All = false;            ///< true: all images; false: the first image only
  std::vector<VirtualVertex> Vertices;
  std::vector<bool> SolvedChunks; ///< chunks of points in the order of solving

  /** FindCoherentOrder() of the points, determined when the first images are solved. */
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
  std::unique_ptr<ObjectImages> Images;
  AllImages Cells;
  ImageAssembly Assembly; ///< of `Images` and `Cells`

  /** Used with several interfaces only; with one image per point, `Vertices` has the images. */
  vtkTypeInt64 StackUpdate = -1; ///< number of the eye update for which the points are solved
  StackDetails Stack;
  std::unique_ptr<StackImages> ImagesOfStack; ///< null with one image per point

  KeptOutput Kept;
};

}

#endif
