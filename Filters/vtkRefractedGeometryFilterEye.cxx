// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Eye of vtkRefractedGeometryFilter, and its place relative to the surfaces.
#include "Filters/vtkRefractedGeometryFilterInternals.h"

#include "Filters/Membrane/MembraneMessages.h"

#include "vtkBoundingBox.h"
#include "vtkCamera.h"
#include "vtkMath.h"
#include "vtkPolyData.h"
#include "vtkRefractingInterface.h"
#include "vtkRefractingInterfaceCollection.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

//------------------------------------------------------------------------------
std::array<double, 3> vtkRefractedGeometryFilter::GetEye()
{
  if (!this->Camera)
  {
    return { this->EyePosition[0], this->EyePosition[1], this->EyePosition[2] };
  }
  const glm::dvec3 eye = this->Internals->FindEye(this).Position;
  return { eye.x, eye.y, eye.z };
}

//------------------------------------------------------------------------------
// Angular tolerance in radians, as seen from the eye.
double vtkRefractedGeometryFilter::GetTolerance()
{
  return this->Camera ? this->AngularTolerance * this->Internals->FindEye(this).Degree
                      : vtkMath::RadiansFromDegrees(this->AngularTolerance);
}

//------------------------------------------------------------------------------
meniscus::CameraEye vtkRefractedGeometryFilter::vtkInternals::FindEye(
  vtkRefractedGeometryFilter* self) const
{
  vtkBoundingBox bounds;
  for (int i = 0; i < self->GetNumberOfMembranes(); ++i)
  {
    if (vtkPolyData* membrane = vtkPolyData::SafeDownCast(self->GetInputDataObject(1, i)))
    {
      bounds.AddBounds(membrane->GetBounds());
    }
  }
  return meniscus::FindEye(self->Camera, bounds);
}

//------------------------------------------------------------------------------
// Text of the warning that no point has an image; empty if there is a warning already.
std::string vtkRefractedGeometryFilter::vtkInternals::DescribeNoImage(
  vtkRefractedGeometryFilter* self) const
{
  const std::vector<meniscus::RefractionStack::Link> links = this->Scene.ListLinks();
  if (!this->Scene.SeesSurface() || links.empty())
  {
    return std::string();
  }
  const meniscus::Membrane& first = this->Scene.GetFirstMembrane();
  const meniscus::InterfacePassage& passage = links.front().Passage;
  const std::array<double, 3> eye = self->GetEye();
  return meniscus::DescribeNoImage(first, glm::dvec3(eye[0], eye[1], eye[2]) - first.GetOrigin(),
    passage.FromFront ? 1.0 : -1.0, passage.Before, passage.Behind);
}

//------------------------------------------------------------------------------
// Text of the error for properties that do not fit each other; empty if they do.
std::string vtkRefractedGeometryFilter::FindUnsupported()
{
  const bool isOne = this->Interfaces->GetNumberOfItems() < 2;
  const double* light = this->LightDirection;
  if (this->Mode == REFLECTION && !isOne)
  {
    return "Mode REFLECTION mirrors at one interface, and the list has more";
  }
  if (this->MembraneModel != CURVED && (this->Mode == REFLECTION || !isOne))
  {
    return std::string(isOne ? "Mode REFLECTION needs" : "Several refracting interfaces need") +
      " the membrane model CURVED";
  }
  if (this->VirtualNormals && !isOne &&
    std::any_of(light, light + 3, [](double c) { return c != 0.0; }))
  {
    return "With several refracting interfaces, VirtualNormals need a light at the eye, "
           "LightDirection (0, 0, 0)";
  }
  // std::hypot is not used: with three arguments, the library of gcc 12 takes a NaN for a zero.
  if (this->VirtualNormals && !std::isfinite(light[0] + light[1] + light[2]))
  {
    std::ostringstream text;
    text << "The light's direction (" << light[0] << ", " << light[1] << ", " << light[2]
         << ") is not finite";
    return text.str();
  }
  return std::string();
}

//------------------------------------------------------------------------------
bool vtkRefractedGeometryFilter::UpdateScene(vtkInformationVector* membranes)
{
  vtkInternals& internals = *this->Internals;
  meniscus::SceneMessages messages;
  messages.Error = this->FindUnsupported();
  if (messages.Error.empty())
  {
    this->WarnOfModes();
  }
  const bool isReady = internals.Scene.Update(
    { membranes, 1, this->Interfaces, this->MembraneModel == CURVED, this->Mode == REFLECTION },
    this->GetEye(), messages);
  internals.RelativeIndices.clear();
  if (isReady && internals.Scene.GetPathSolver())
  {
    const auto& links = internals.Scene.GetStack().GetLinks();
    for (const meniscus::RefractionStack::Link& link : links)
    {
      internals.RelativeIndices.push_back(link.Passage.Behind / links.front().Passage.Before);
    }
  }
  meniscus::Report(this, messages);
  return isReady;
}

//------------------------------------------------------------------------------
std::vector<double> vtkRefractedGeometryFilter::GetRelativeIndicesOfRefraction()
{
  if (this->Interfaces->GetNumberOfItems() < 2 || this->Internals->RelativeIndices.empty())
  {
    return { this->GetInteriorIndexOfRefraction() / this->GetExteriorIndexOfRefraction() };
  }
  return this->Internals->RelativeIndices;
}
