// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Common/TableVersion.h"
#include "Filters/Common/Statistics.h"
#include "Rendering/Backends/RayCastMembrane.h"
#include "Rendering/Backends/VolumeIllumination.h"
#include "Rendering/Input/VolumeComponents.h"
#include "Rendering/Input/VolumeGradients.h"
#include "Rendering/Input/VolumeInput.h"
#include "Rendering/Property/VolumePreIntegration.h"
#include "Rendering/Property/VolumePropertyTables.h"

#include <cstdint>
#include <vector>

namespace meniscus
{

struct RayCastFrame;

/** Tables that a frame may read. */
enum class RayCastTable
{
  Cells,
  Boundary,
  BoundaryTree,
  Vertices,
  CellScalars,
  VertexGradients,
  CellGradients,
  Components,
  Illumination,
  Functions,
  PreIntegration,
  RefractedRays,
  NumberOfTables
};

/** A table and the versions of its owner's data that it stands for. */
struct RayCastTableState
{
  RayCastTable Table;
  TableVersions Versions;

  bool operator==(const RayCastTableState& other) const
  {
    return this->Table == other.Table && this->Versions == other.Versions;
  }
};

/** A mapper's input as tables, which every backend draws from. Each is kept by its owner. */
struct RayCastTables
{
  VolumeInput Input;
  VolumeComponents Components;
  VolumePropertyTables Property;
  VolumePreIntegration PreIntegration;
  VolumeGradients VertexGradients{ FieldAssociation::Points };
  VolumeGradients CellGradients{ FieldAssociation::Cells };
  VolumeIllumination Illumination;
  RayCastMembrane Membrane;

  /** Lists the tables that a frame reads. */
  std::vector<RayCastTableState> ListWanted(const RayCastFrame& frame) const;
  /** Bytes of all tables. */
  std::int64_t GetBytes() const;
  /** Statistics of the tables that every owner has. */
  static const std::vector<Statistic<RayCastTables>>& ListStatistics();
};

}
