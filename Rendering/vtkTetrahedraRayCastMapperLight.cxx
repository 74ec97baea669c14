// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Global illumination of vtkTetrahedraRayCastMapper.
#include "Rendering/Common/VTKVersions.h"
#include "Rendering/RayCastMapperInternals.h"

#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkTetrahedraRayCastMapper.h"
#include "vtkVolume.h"
#include "vtkVolumeProperty.h"

#include <algorithm>

namespace
{

/** A value within [0, largest]; NaN becomes 0. */
float Clamped(float value, float largest)
{
  return value > 0.0f ? std::min(value, largest) : 0.0f;
}

}

//------------------------------------------------------------------------------
void vtkTetrahedraRayCastMapper::SetGlobalIlluminationReach(float reach)
{
  const float clamped = Clamped(reach, 1.0f);
  if (clamped != this->GlobalIlluminationReach)
  {
    this->GlobalIlluminationReach = clamped;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
void vtkTetrahedraRayCastMapper::SetVolumetricScatteringBlending(float blending)
{
  const float clamped = Clamped(blending, 2.0f);
  if (clamped != this->VolumetricScatteringBlending)
  {
    this->VolumetricScatteringBlending = clamped;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
/** Reports progress. Returns false if the user aborts. */
bool vtkTetrahedraRayCastMapper::GoOn(vtkRenderWindow* window, double fraction)
{
  this->UpdateProgress(fraction);
  return !this->GetAbortExecute() && !window->CheckAbortStatus();
}

//------------------------------------------------------------------------------
/** Decides whether the light of a frame is attenuated, and gathers the lights if it is. */
void vtkTetrahedraRayCastMapper::PrepareIllumination(
  vtkRenderer* renderer, vtkVolume* volume, meniscus::RayCastFrame& frame)
{
  vtkInternals& internals = *this->Internals;
  meniscus::RayCastOptics& optics = frame.Optics;
  optics.Illuminated = optics.Illuminated && optics.Shading;
  meniscus::ViewContext world;
  if (!optics.Illuminated || !internals.ComputeWorldFrame(volume, world).empty())
  {
    optics.Illuminated = false;
    return;
  }
  // Surfaces reflect all light; a medium without a gradient that reflects light scatters all of it.
  optics.Lighting.Scattering = !optics.Model().IsMedium() ? 0.0
    : optics.HasGradients()                               ? 0.5 * this->VolumetricScatteringBlending
                                                          : 1.0;
  optics.Lighting.Anisotropy = meniscus::GetScatteringAnisotropy(volume->GetProperty(), 0);
  meniscus::VolumeIllumination::Request& request = internals.IlluminationRequest;
  request.Base = world.Frame;
  request.Optics = optics;
  request.Optics.Lighting.Lights.clear();
  request.Optics.ClippingPlanes.clear();
  meniscus::GatherShading(volume->GetProperty(), renderer, world, request.Optics);
  meniscus::GatherClippingPlanes(this->ClippingPlanes, world, request.Optics);
  request.Reach = this->GlobalIlluminationReach;
  internals.IlluminationWindow = renderer->GetRenderWindow();
}

//------------------------------------------------------------------------------
/** Casts the shadows of a frame. Returns false if the user aborts. */
bool vtkTetrahedraRayCastMapper::UpdateIllumination(meniscus::RayCastFrame& frame)
{
  vtkInternals& internals = *this->Internals;
  const bool updated = internals.Illumination.Update(internals, internals.IlluminationRequest,
    [this, &internals](double fraction)
    { return this->GoOn(internals.IlluminationWindow, fraction); });
  frame.Optics.Lighting.BrightestLight = internals.Illumination.GetBrightestLight();
  return updated;
}
