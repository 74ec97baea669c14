// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rendering/Integral/BentVolume.h"

#include "Rendering/Integral/BentMedium.h"
#include "Rendering/Property/RayCastOptics.h"
#include "Volume/Caster/PacketTables.h"
#include "Volume/Graded/OpaqueTriangles.h"

#include "vtkVolumeProperty.h"

#include <cstddef>
#include <string>

namespace meniscus
{

//------------------------------------------------------------------------------
InputReport BentVolume::Update(
  const InputBlocks& scalars, vtkVolumeProperty* property, bool perUnitDistance, BentMedium& medium)
{
  InputReport report = this->Property.Reduce(
    property, BlendMode::Composite, perUnitDistance, ComponentMixture::None, 1);
  if (!report.Error.empty())
  {
    return report;
  }
  VolumeInput& input = medium.GetInput();
  const InputReport ofScalars = input.UpdateScalars(scalars, 0, this->Property.GetFeatures());
  report.Error = ofScalars.Error;
  report.Warning += ofScalars.Warning;
  if (property->GetShade() || UsesGradientOpacity(property))
  {
    report.Warning += (report.Warning.empty() ? "" : " ") +
      std::string("Shading and gradient opacity of the volume property have no effect.");
  }
  if (!report.Error.empty())
  {
    return report;
  }
  this->Property.Normalize(input.GetNormalization(), this->Components);
  input.UpdateActiveCells(this->Property.GetVisibleScalars(), TetrahedralMesh::CellJumps::Hidden);
  this->Intervals = PackIntervals(this->Property.GetIntervals());
  this->Seen = &input.GetMesh();
  this->Medium.Mesh = &medium.GetMesh();
  this->Medium.HasCellScalars = input.GetFieldAssociation() == FieldAssociation::Cells;
  this->Medium.Scalars =
    this->Medium.HasCellScalars ? &input.GetCellScalars() : &input.GetScalars();
  this->Medium.Intervals = &this->Intervals;
  return report;
}

//------------------------------------------------------------------------------
void BentVolume::MarkCells(std::vector<std::uint8_t>& flags) const
{
  for (std::size_t c = 0; c < flags.size(); ++c)
  {
    flags[c] |= this->Seen->IsActiveCell(static_cast<std::int64_t>(c)) ? HasLight : 0;
  }
}

}
