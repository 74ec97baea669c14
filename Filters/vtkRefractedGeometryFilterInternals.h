// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkRefractedGeometryFilter.h"

#include "Common/RangeLoop.h"
#include "Filters/Common/Statistics.h"
#include "Filters/Membrane/RefractionScene.h"
#include "Filters/Object/ObjectSurface.h"
#include "Filters/Object/ViewSelection.h"
#include "Filters/Output/JoinedBlocks.h"
#include "Filters/Output/OutputArrays.h"
#include "Filters/Solver/SolvedBlock.h"

#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkTable.h"

#include <list>
#include <string>
#include <vector>

/** Scenes, solved blocks and counters of a filter. */
class vtkRefractedGeometryFilter::vtkInternals
{
public:
  static const std::vector<meniscus::Statistic<vtkRefractedGeometryFilter>>& List();

  /** Filled when it is asked for. */
  vtkNew<vtkTable> StatisticsTable;

  meniscus::SolvedBlock& GetBlock(vtkPolyData* input);
  void UpdateView(vtkRefractedGeometryFilter* self);
  void Select(vtkPolyData* input, meniscus::SolvedBlock& block);
  bool SolveFirst(vtkRefractedGeometryFilter* self, meniscus::SolvedBlock& block);
  bool AreCellsReady(vtkRefractedGeometryFilter* self, meniscus::SolvedBlock& block) const;
  bool SolveAll(vtkRefractedGeometryFilter* self, vtkPolyData* input, meniscus::SolvedBlock& block);
  bool SolveAllPoints(vtkRefractedGeometryFilter* self, meniscus::SolvedBlock& block, bool isReady);
  bool Run(vtkRefractedGeometryFilter* self, double from, double to, vtkIdType count,
    vtkIdType grain, const meniscus::RangeBody& body);
  void Count(meniscus::ImageState state);
  meniscus::CameraEye FindEye(vtkRefractedGeometryFilter* self) const;
  std::string DescribeNoImage(vtkRefractedGeometryFilter* self) const;
  meniscus::OutputOptions GetOptions(vtkRefractedGeometryFilter* self) const;
  /** Number of the rays of the current run. */
  vtkTypeInt64 GetRays() const { return this->Scene.GetVersion().Rays; }
  /** Number of the current shapes. */
  vtkTypeInt64 GetShapes() const { return this->Scene.GetVersion().Shape; }

  meniscus::ObjectSurfaces Surfaces;
  meniscus::RefractionScene Scene;
  /** Index behind each interface that the last run refracted at, by the index in front of all. */
  std::vector<double> RelativeIndices;
  std::list<meniscus::SolvedBlock> Blocks;
  meniscus::JoinedBlocks Joined;

  vtkTypeInt64 SolvedVertices = 0;
  vtkTypeInt64 FailedSolves = 0;
  vtkTypeInt64 VerticesWithoutImage = 0;
  vtkTypeInt64 SkippedCells = 0;
  vtkTypeInt64 CulledVertices = 0;
  vtkTypeInt64 CulledCells = 0;
  bool IsViewActive = false; ///< at least one facet is out of view
  vtkMTimeType ViewTime = 0;
  vtkTypeInt64 ViewEye = -1;
  vtkTypeInt64 FailedInRun = 0;
  // Shapes of the last warning of each kind.
  vtkTypeInt64 WarnedOfNoImage = -1;
  vtkTypeInt64 WarnedOfUndecided = -1;
  vtkTypeInt64 WarnedOfCoarse = -1;
  bool WarnedOfModes = false;
  bool WarnedOfNoNormals = false;
};
