// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Filters_Solver_SolvedBlock_h
#define meniscus_Filters_Solver_SolvedBlock_h

#include "Filters/Object/ViewSelection.h"
#include "Filters/Output/ImagePolyData.h"
#include "Refraction/Images/ObjectImages.h"

#include "vtkPolyData.h"
#include "vtkWeakPointer.h"

#include <memory>
#include <vector>

namespace meniscus
{

/** The virtual vertices of one block of geometry, and what they were computed from. */
struct SolvedBlock
{
  /** Takes the points in again if the source has been modified; images hold if no value differs. */
  void UpdatePoints();
  /** The same for the cells. */
  void UpdateTopology();

  vtkWeakPointer<vtkPolyData> Source;
  vtkMTimeType SourceTime = 0;
  std::vector<double> Points;
  vtkTypeInt64 EyeUpdate = -1; ///< for which the points are solved
  bool All = false;            ///< all images, or the first
  std::vector<VirtualVertex> Vertices;
  std::vector<bool> SolvedChunks; ///< of `vertices`

  /** What is in view, and what that was found for. */
  ViewSelection Selection;
  vtkTypeInt64 ViewChange = -1;

  /** All images, or a view. */
  vtkMTimeType TopologyTime = 0;
  ObjectTopology Topology;

  /** All images only. */
  double Tolerance = 0.0;
  bool ClosesSeams = false;
  bool CellsReady = false;
  ObjectTopology Selected; ///< the cells in view
  std::unique_ptr<ObjectImages> Images;
  AllImages Cells;
};

}

#endif
