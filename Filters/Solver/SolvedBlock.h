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

/// The virtual vertices of one block of geometry, and what they were computed from.
struct SolvedBlock
{
  /// Takes the points in again if the source has been modified; images hold if no value differs.
  void UpdatePoints();
  /// The same for the cells.
  void UpdateTopology();

  vtkWeakPointer<vtkPolyData> source;
  vtkMTimeType sourceTime = 0;
  std::vector<double> points;
  vtkTypeInt64 eyeUpdate = -1; ///< for which the points are solved
  bool all = false;            ///< all images, or the first
  std::vector<VirtualVertex> vertices;
  std::vector<bool> solvedChunks; ///< of `vertices`

  /// What is in view, and what that was found for.
  ViewSelection selection;
  vtkTypeInt64 viewChange = -1;

  /// All images, or a view.
  vtkMTimeType topologyTime = 0;
  ObjectTopology topology;

  /// All images only.
  double tolerance = 0.0;
  bool closesSeams = false;
  bool cellsReady = false;
  ObjectTopology selected; ///< the cells in view
  std::unique_ptr<ObjectImages> images;
  AllImages cells;
};

}

#endif
