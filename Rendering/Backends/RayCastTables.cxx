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
  std::vector<RayCastTableState> tables{ { RayCastTable::Cells, this->Input.GetLinkVersion() },
    { RayCastTable::Boundary, this->Input.GetBoundaryVersions() },
    { RayCastTable::Vertices, { this->Input.GetMeshVersion(), ofVertices } },
    { RayCastTable::Functions, this->Property.GetVersion() } };
  const auto addIf = [&tables](bool wanted, RayCastTable table, TableVersion version)
  {
    if (wanted)
    {
      tables.push_back({ table, version });
    }
  };
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

}
