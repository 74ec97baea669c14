// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rendering/Backends/RayCastTables.h"

#include "Rendering/Backends/RayCastFrame.h"

#include <cstddef>

namespace meniscus
{

//------------------------------------------------------------------------------
std::vector<RayCastTableState> RayCastTables::ListWanted(const RayCastFrame& frame) const
{
  const RayCastOptics& optics = frame.Optics;
  const TableVersion scalars = this->Input.GetScalarVersion();
  const TableVersion ofVertices = optics.CellScalars ? TableVersion() : scalars;
  const TableVersions boundary = this->Input.GetBoundaryVersions();
  std::vector<RayCastTableState> tables{ { RayCastTable::Cells, this->Input.GetLinkVersion() },
    { RayCastTable::Boundary, boundary },
    { RayCastTable::Vertices, { this->Input.GetMeshVersion(), ofVertices } },
    { RayCastTable::Functions, this->Property.GetVersion() } };
  const auto addIf = [&tables](bool wanted, RayCastTable table, TableVersion version)
  {
    if (wanted)
    {
      tables.push_back({ table, version });
    }
  };
  if (!optics.LongLists)
  {
    tables.push_back({ RayCastTable::BoundaryTree, boundary });
  }
  addIf(optics.CellScalars, RayCastTable::CellScalars, scalars);
  addIf(optics.VertexGradients, RayCastTable::VertexGradients, this->VertexGradients.GetVersion());
  addIf(optics.UsesCellGradients(), RayCastTable::CellGradients, this->CellGradients.GetVersion());
  addIf(optics.HasComponents(), RayCastTable::Components, this->Components.GetVersion());
  addIf(optics.Illuminated, RayCastTable::Illumination, this->Illumination.GetVersion());
  addIf(optics.PreIntegrated, RayCastTable::PreIntegration, this->PreIntegration.GetVersion());
  addIf(frame.Refracting.Met, RayCastTable::RefractedRays, this->Membrane.GetSightVersion());
  return tables;
}

//------------------------------------------------------------------------------
std::int64_t RayCastTables::GetBytes() const
{
  const std::size_t vectors = this->Components.GetValues().size();
  const std::size_t table = this->PreIntegration.GetTable().GetValues().size();
  return this->Input.GetBytes() + this->Membrane.GetBytes() + this->VertexGradients.GetBytes() +
    this->CellGradients.GetBytes() + this->Illumination.GetBytes() +
    static_cast<std::int64_t>(vectors * sizeof(glm::vec3) + table * sizeof(float));
}

//------------------------------------------------------------------------------
const std::vector<Statistic<RayCastTables>>& RayCastTables::ListStatistics()
{
  using Self = RayCastTables;
  static const std::vector<Statistic<Self>> list{
    { "NumberOfMeshBuilds", "builds of the mesh tables, since construction",
      [](Self& self) { return double(self.Input.GetBuildVersion().GetChanges()); } },
    { "NumberOfPointUpdates",
      "updates of the positions alone (points have moved, the cells are the same)",
      [](Self& self) { return double(self.Input.GetNumberOfPointUpdates()); } },
    { "NumberOfScalarUpdates", "updates of the scalars, when their values have changed",
      [](Self& self) { return double(self.Input.GetScalarVersion().GetChanges()); } },
    { "NumberOfTransferFunctionBuilds", "reductions of the volume property to control points",
      [](Self& self) { return double(self.Property.GetNumberOfBuilds()); } },
    { "NumberOfActiveSetBuilds",
      "builds of the set of active cells: new mesh, new scalars, other visible scalars",
      [](Self& self) { return double(self.Input.GetActiveSetBuilds()); } },
    { "NumberOfMembraneBuilds", "builds of the membranes' patches, each when its shape has changed",
      [](Self& self) { return double(self.Membrane.GetShapeVersion().GetChanges()); } },
    { "NumberOfCellSearches",
      "times that the input's cells were looked up for picks or events: once per mesh",
      [](Self& self) { return double(self.Input.GetNumberOfInputCellSearches()); } },
    { "NumberOfTetrahedra", "tetrahedra of the mesh, in all cells",
      [](Self& self) { return double(self.Input.GetMesh().GetNumberOfCells()); } },
    { "NumberOfTransparentCells", "tetrahedra with a scalar that is not finite",
      [](Self& self) { return double(self.Input.GetMesh().GetNumberOfUnknownCells()); } },
    { "NumberOfRejectedCells", "tetrahedra and cells that are left out because they are not valid",
      [](Self& self) { return double(self.Input.GetNumberOfRejectedCells()); } },
    { "NumberOfCellDivisions", "adaptive divisions of the cells, since construction",
      [](Self& self) { return double(self.Input.GetDivision().GetNumberOfDivisions()); } },
    { "NumberOfFoldedCells", "cells of the last division that are folded inside out in parts",
      [](Self& self) { return double(self.Input.GetNumberOfFoldedCells()); } },
    { "NumberOfUnresolvedEdges",
      "edges of the last division that exceed the tolerance after 23 divisions",
      [](Self& self) { return double(self.Input.GetDivision().GetCounts().UnresolvedEdges); } },
    { "DivisionError",
      "largest error of the tetrahedra that adaptive division has made or found accurate enough, "
      "in the unit of the tolerance",
      [](Self& self) { return self.Input.GetDivision().GetError(); } },
  };
  return list;
}

}
