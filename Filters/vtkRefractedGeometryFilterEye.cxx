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

#include <array>
#include <string>

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
  const std::array<double, 3> place = self->GetEye();
  const glm::dvec3 eye(place[0], place[1], place[2]);
  const auto& links = this->Stack.GetSolver().GetStack().GetLinks();
  if (self->Interfaces->GetNumberOfItems() > 1 && !links.empty())
  {
    const meniscus::Membrane& first = links.front().Surface->GetMembrane();
    const meniscus::InterfacePassage& passage = links.front().Passage;
    return this->Stack.GetSolver().GetStack().HasPassage()
      ? meniscus::DescribeNoImage(first, eye - first.GetOrigin(), passage.FromFront ? 1.0 : -1.0,
          passage.Before, passage.Behind)
      : std::string();
  }
  const meniscus::Membrane& membrane = this->Scene.GetMembrane();
  return this->Scene.IsEyeBehind()
    ? std::string()
    : meniscus::DescribeNoImage(membrane, eye - membrane.GetOrigin(), 1.0,
        self->GetExteriorIndexOfRefraction(), self->GetInteriorIndexOfRefraction());
}

//------------------------------------------------------------------------------
meniscus::MembraneView vtkRefractedGeometryFilter::vtkInternals::GetView(
  vtkRefractedGeometryFilter* self) const
{
  const std::array<double, 3> eye = self->GetEye();
  return { { eye[0], eye[1], eye[2], self->GetExteriorIndexOfRefraction(),
             self->GetInteriorIndexOfRefraction() },
    self->Mode == REFLECTION, self->Interfaces->GetFirstInterface()->GetTurnTowardsEye() };
}

//------------------------------------------------------------------------------
bool vtkRefractedGeometryFilter::UpdateEye()
{
  meniscus::SceneMessages messages;
  const bool ready = this->Internals->Scene.SetEye(this->Internals->GetView(this), messages);
  if (!messages.Error.empty())
  {
    vtkErrorMacro(<< messages.Error << "; the output is empty.");
  }
  if (!messages.Warning.empty())
  {
    vtkWarningMacro(<< messages.Warning);
  }
  return ready;
}
