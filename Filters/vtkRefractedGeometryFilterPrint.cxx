// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Settings and counters of vtkRefractedGeometryFilter in words.
#include "Filters/vtkRefractedGeometryFilterInternals.h"

#include "vtkCamera.h"
#include "vtkImplicitFunction.h"

//------------------------------------------------------------------------------
vtkTypeInt64 vtkRefractedGeometryFilter::GetNumberOfPatchBuilds() const
{
  const vtkInternals& internals = *this->Internals;
  return internals.Scene.GetNumberOfPatchBuilds() + internals.Stack.GetNumberOfPatchBuilds();
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkRefractedGeometryFilter::GetNumberOfEyeUpdates() const
{
  const vtkInternals& internals = *this->Internals;
  return internals.Scene.GetNumberOfEyeUpdates() + internals.Stack.GetNumberOfEyeUpdates();
}

//------------------------------------------------------------------------------
bool vtkRefractedGeometryFilter::IsEyeEnclosed() const
{
  return this->Internals->Scene.IsEyeEnclosed();
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkRefractedGeometryFilter::GetNumberOfMembranePointsBehind() const
{
  return this->Internals->Scene.GetNumberOfMembranePointsBehind();
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkRefractedGeometryFilter::GetNumberOfSolvedVertices() const
{
  return this->Internals->SolvedVertices;
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkRefractedGeometryFilter::GetNumberOfFailedSolves() const
{
  return this->Internals->FailedSolves;
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkRefractedGeometryFilter::GetNumberOfUndecidedSearches() const
{
  return this->Internals->Scene.GetNumberOfUndecided() +
    this->Internals->Stack.GetSolver().GetNumberOfUndecidedSearches();
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkRefractedGeometryFilter::GetNumberOfVerticesWithoutImage() const
{
  return this->Internals->VerticesWithoutImage;
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkRefractedGeometryFilter::GetNumberOfSkippedCells() const
{
  return this->Internals->SkippedCells;
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkRefractedGeometryFilter::GetNumberOfCulledVertices() const
{
  return this->Internals->CulledVertices;
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkRefractedGeometryFilter::GetNumberOfCulledCells() const
{
  return this->Internals->CulledCells;
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkRefractedGeometryFilter::GetNumberOfSkippedFacets() const
{
  return static_cast<vtkTypeInt64>(this->Internals->Scene.GetNumberOfSkippedFacets());
}

//------------------------------------------------------------------------------
void vtkRefractedGeometryFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Mode: " << (this->Mode == REFLECTION ? "REFLECTION" : "REFRACTION") << "\n";
  os << indent << "EyePosition: (" << this->EyePosition[0] << ", " << this->EyePosition[1] << ", "
     << this->EyePosition[2] << ")\n";
  os << indent << "Camera: " << this->Camera.Get() << "\n";
  os << indent << "ViewCulling: " << (this->ViewCulling ? "on" : "off") << "\n";
  os << indent << "ViewAspectRatio: " << this->ViewAspectRatio << "\n";
  os << indent << "ExteriorIndexOfRefraction: " << this->GetExteriorIndexOfRefraction() << "\n";
  os << indent << "InteriorIndexOfRefraction: " << this->GetInteriorIndexOfRefraction() << "\n";
  os << indent << "MembraneModel: " << (this->MembraneModel == CURVED ? "CURVED" : "FLAT_FACETS")
     << "\n";
  os << indent << "ExactMembrane: " << this->GetExactMembrane() << "\n";
  os << indent << "Images: " << (this->Images == ALL_IMAGES ? "ALL_IMAGES" : "FIRST_IMAGE") << "\n";
  os << indent << "AngularTolerance: " << this->AngularTolerance << "\n";
  os << indent << "CloseSeams: " << this->CloseSeams << "\n";
  os << indent
     << "ReflectanceModel: " << (this->ReflectanceModel == SCHLICK ? "SCHLICK" : "FRESNEL") << "\n";
  os << indent << "VirtualNormals: " << (this->VirtualNormals ? "on" : "off") << "\n";
  os << indent << "TrueGeometry: " << (this->TrueGeometry ? "on" : "off") << "\n";
  os << indent << "LightDirection: (" << this->LightDirection[0] << ", " << this->LightDirection[1]
     << ", " << this->LightDirection[2] << ")\n";
  os << indent << "OutputPointsPrecision: " << this->OutputPointsPrecision << "\n";
  os << indent << "NumberOfPatchBuilds: " << this->GetNumberOfPatchBuilds() << "\n";
  os << indent << "NumberOfEyeUpdates: " << this->GetNumberOfEyeUpdates() << "\n";
  os << indent << "NumberOfSolvedVertices: " << this->GetNumberOfSolvedVertices() << "\n";
  os << indent << "NumberOfFailedSolves: " << this->GetNumberOfFailedSolves() << "\n";
  os << indent << "NumberOfUndecidedSearches: " << this->GetNumberOfUndecidedSearches() << "\n";
  os << indent << "NumberOfVerticesWithoutImage: " << this->GetNumberOfVerticesWithoutImage()
     << "\n";
  os << indent << "NumberOfSkippedCells: " << this->GetNumberOfSkippedCells() << "\n";
  os << indent << "NumberOfCulledVertices: " << this->GetNumberOfCulledVertices() << "\n";
  os << indent << "NumberOfCulledCells: " << this->GetNumberOfCulledCells() << "\n";
  os << indent << "EyeEnclosed: " << (this->IsEyeEnclosed() ? "yes" : "no") << "\n";
  os << indent << "NumberOfMembranePointsBehind: " << this->GetNumberOfMembranePointsBehind()
     << "\n";
  os << indent << "NumberOfSkippedFacets: " << this->GetNumberOfSkippedFacets() << "\n";
}
