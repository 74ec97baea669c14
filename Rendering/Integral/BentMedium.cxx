// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rendering/Integral/BentMedium.h"

#include "Filters/Common/ThreadedLoop.h"
#include "Rendering/Input/ConcatenatedArray.h"

#include "vtkAbstractMapper.h"
#include "vtkDataObject.h"
#include "vtkInformation.h"

#include <cstdint>
#include <string>

namespace meniscus
{

//------------------------------------------------------------------------------
ScalarSelection SelectPointValues(vtkInformation* wanted)
{
  ScalarSelection selection;
  selection.Component = 0;
  selection.ScalarMode = VTK_SCALAR_MODE_USE_POINT_DATA;
  if (wanted->Has(vtkDataObject::FIELD_NAME()))
  {
    selection.ScalarMode = VTK_SCALAR_MODE_USE_POINT_FIELD_DATA;
    selection.AccessMode = VTK_GET_ARRAY_BY_NAME;
    selection.ArrayName = wanted->Get(vtkDataObject::FIELD_NAME());
  }
  return selection;
}

//------------------------------------------------------------------------------
InputReport BentMedium::Update(vtkDataObject* input, vtkInformation* wanted,
  const MediumQuantity& quantity, const std::function<bool(double)>& goOn)
{
  InputBlocks blocks;
  InputReport report = CollectInputBlocks(input, SelectPointValues(wanted), blocks);
  if (report.Error.empty() && blocks.Parts.empty())
  {
    report.Error = "The input has no cells";
  }
  else if (report.Error.empty() && this->Scalars && !HaveSameGrids(*this->Scalars, blocks))
  {
    report.Error =
      "The scalars of the volume and the values of the medium are not in the same data "
      "sets";
  }
  if (!report.Error.empty())
  {
    return report;
  }
  DivisionRequest division;
  division.Fields = blocks;
  division.Component = 0;
  this->Input.SetHasSingleDepths(false);
  InputBlocks meshOf = blocks;
  meshOf.Place = this->Scalars ? this->Scalars->Place : blocks.Place;
  const InputReport ofMesh = this->Input.UpdateMesh(meshOf, goOn, division);
  report.Error = ofMesh.Error;
  report.Warning += ofMesh.Warning;
  if (!report.Error.empty() || !goOn(1.0))
  {
    return report;
  }
  const bool hasNewValues = this->ValueWatch.HasChanged(
    ScalarVersions(blocks), [&blocks]() { return DigestScalars(blocks); });
  const TableVersions versions = { this->Input.GetBuildVersion(), this->Input.GetMeshVersion() };
  if (hasNewValues || !(versions == this->MeshVersions) || !(quantity == this->Quantity) ||
    this->Version.GetChanges() == 0)
  {
    this->MeshVersions = versions;
    this->Quantity = quantity;
    report.Warning += (report.Warning.empty() ? "" : " ") + this->ReadIndices(blocks, quantity);
  }
  if (this->Mesh.GetNumberOfActiveCells() == 0)
  {
    report.Error = "No cell has an index of refraction in all of its points";
  }
  return report;
}

//------------------------------------------------------------------------------
/** Reads the indices of refraction and the mesh of the cells that have them; returns a warning. */
std::string BentMedium::ReadIndices(const InputBlocks& blocks, const MediumQuantity& quantity)
{
  this->Version.Bump();
  const std::vector<double> values =
    GatherValues(blocks, 0, this->Input.GetSources(FieldAssociation::Points),
      this->Input.GetInterpolatedPoints(FieldAssociation::Points));
  this->SquaredIndices = quantity.IsDensity
    ? SquareIndicesOfGas(values, quantity.GladstoneDale, this->Faults)
    : SquareIndices(values, this->Faults);
  this->Mesh = this->Input.GetMesh();
  const std::int64_t holes = ActivateCellsWithIndex(this->Mesh, this->SquaredIndices, ThreadedLoop);
  this->Tree.Build(this->Mesh);
  this->Cones.Build(this->Mesh, this->Tree);
  this->Terms = ComputeEdgeTerms(this->Mesh, this->SquaredIndices, FacetLoop);
  this->Table.Build(this->Mesh, this->SquaredIndices, &this->Terms, ThreadedLoop);
  std::string warning;
  if (holes > 0 && this->Mesh.GetNumberOfActiveCells() > 0)
  {
    warning += std::to_string(this->Faults.NotFinite) +
      " points have a value that is not finite and " + std::to_string(this->Faults.NotPositive) +
      " a negative density or an index of 0 or less; " + std::to_string(holes) +
      " tetrahedra at them are left out. ";
  }
  if (this->Faults.BelowOne > 0)
  {
    warning +=
      std::to_string(this->Faults.BelowOne) + " points have an index of refraction below 1. ";
  }
  return warning;
}

//------------------------------------------------------------------------------
EntryRaster BentMedium::DrawBoundary(const RayImage& image) const
{
  return { this->Mesh, this->Tree, image, ThreadedLoop };
}

//------------------------------------------------------------------------------
GradedMedium BentMedium::MakeField(double outsideIndex, bool isStraight) const
{
  GradedMedium field;
  field.Mesh = &this->Mesh;
  field.Tree = &this->Tree;
  field.Cones = &this->Cones;
  field.SquaredIndices = &this->SquaredIndices;
  field.Terms = &this->Terms;
  field.Table = &this->Table;
  field.OutsideIndex = outsideIndex;
  field.IsStraight = isStraight;
  return field;
}

}
