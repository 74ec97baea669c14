// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Settings and counters of vtkRefractedGeometryFilter in words.
#include "Filters/vtkRefractedGeometryFilterInternals.h"

#include "Filters/Common/Accessors.h"

#include "vtkCamera.h"
#include "vtkImplicitFunction.h"

meniscusStatisticsMacro(vtkRefractedGeometryFilter);
meniscusSetClampMacro(vtkRefractedGeometryFilter, Mode, int, REFRACTION, REFLECTION);
meniscusSetClampMacro(vtkRefractedGeometryFilter, ViewAspectRatio, double, 0.0, 1000.0);
meniscusSetClampMacro(vtkRefractedGeometryFilter, MembraneModel, int, FLAT_FACETS, CURVED);
meniscusSetClampMacro(vtkRefractedGeometryFilter, Images, int, FIRST_IMAGE, ALL_IMAGES);
meniscusSetClampMacro(vtkRefractedGeometryFilter, AngularTolerance, double, 1e-8, 10.0);
meniscusSetClampMacro(vtkRefractedGeometryFilter, ReflectanceModel, int, FRESNEL, SCHLICK);
meniscusSetClampMacro(
  vtkRefractedGeometryFilter, OutputPointsPrecision, int, SINGLE_PRECISION, DEFAULT_PRECISION);
meniscusGetInternalMacro(vtkRefractedGeometryFilter, vtkTypeInt64, NumberOfPatchBuilds() const,
  Scene.GetNumberOfPatchBuilds());
meniscusGetInternalMacro(vtkRefractedGeometryFilter, vtkTypeInt64, NumberOfEyeUpdates() const,
  Scene.GetNumberOfEyeUpdates());
meniscusGetInternalMacro(
  vtkRefractedGeometryFilter, vtkTypeInt64, NumberOfSolvedVertices() const, SolvedVertices);
meniscusGetInternalMacro(
  vtkRefractedGeometryFilter, vtkTypeInt64, NumberOfFailedSolves() const, FailedSolves);

//------------------------------------------------------------------------------
/** All numbers that the class reports. */
const std::vector<meniscus::Statistic<vtkRefractedGeometryFilter>>&
vtkRefractedGeometryFilter::vtkInternals::List()
{
  using Self = vtkRefractedGeometryFilter;
  static const std::vector<meniscus::Statistic<Self>> list{
    { "NumberOfPatchBuilds", "times that a membrane's shape was read, since construction",
      [](Self& self) { return double(self.GetNumberOfPatchBuilds()); } },
    { "NumberOfEyeUpdates", "times that refracted rays were computed for it",
      [](Self& self) { return double(self.GetNumberOfEyeUpdates()); } },
    { "NumberOfSolvedVertices", "points solved, since construction",
      [](Self& self) { return double(self.GetNumberOfSolvedVertices()); } },
    { "NumberOfFailedSolves", "points without an answer: not finite or out of range",
      [](Self& self) { return double(self.GetNumberOfFailedSolves()); } },
    { "NumberOfUndecidedSearches",
      "searches that may have missed an image: at a focus, or within rounding of a caustic "
      "or of the membrane",
      [](Self& self) { return double(self.Internals->Scene.GetNumberOfUndecided()); } },
    { "NumberOfVerticesWithoutImage", "points that had no image, since construction",
      [](Self& self) { return double(self.Internals->VerticesWithoutImage); } },
    { "NumberOfSkippedCells",
      "cells left out because they need a point that has no image or does not exist",
      [](Self& self) { return double(self.Internals->SkippedCells); } },
    { "NumberOfCulledVertices",
      "points not solved because the camera cannot show them (ViewCulling)",
      [](Self& self) { return double(self.Internals->CulledVertices); } },
    { "NumberOfCulledCells", "cells left out because the camera cannot show them (ViewCulling)",
      [](Self& self) { return double(self.Internals->CulledCells); } },
    { "NumberOfSkippedFacets",
      "triangles of the current membrane that were skipped: without area, not finite, with "
      "a point that does not exist, or present twice",
      [](Self& self) { return double(self.Internals->Scene.GetNumberOfSkippedFacets()); } },
    { "NumberOfMembranePointsBehind",
      "points of the membrane, of up to 256 that are examined, that the eye sees through "
      "another piece of it",
      [](Self& self) { return double(self.Internals->Scene.GetNumberOfMembranePointsBehind()); } },
    { "IsEyeEnclosed",
      "1 if the eye is inside a closed membrane whose normals point outwards, otherwise 0",
      [](Self& self) { return double(self.Internals->Scene.IsEyeEnclosed()); } },
  };
  return list;
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
  meniscus::PrintStatistics(meniscus::MeasureStatistics(*this, vtkInternals::List()), os, indent);
}
