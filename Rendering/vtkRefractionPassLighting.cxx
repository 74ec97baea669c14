// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Lighting of vtkRefractionPass in true space: lights, waves and shadows.
#include "Rendering/RefractionPassInternals.h"

#include "vtkOpenGLRenderWindow.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"

#include <algorithm>
#include <iterator>
#include <memory>
#include <string>
#include <vector>

//------------------------------------------------------------------------------
/**
 * Activates the tables of an object, and of what hides light from it, in place of another object's;
 * null for none.
 * @param origin point that the object's places are relative to.
 */
void vtkRefractionPass::vtkInternals::ActivateTables(
  const meniscus::Refraction* refraction, vtkShaderProgram* program, const glm::dvec3& origin)
{
  meniscus::WaveLight* tables =
    refraction && refraction->ReadsTables ? refraction->Waves.get() : nullptr;
  meniscus::ShadowCasters* shadows =
    refraction && refraction->IsLitInTrueSpace && refraction->HasShadows
    ? &this->Casters[refraction->Membrane]
    : nullptr;
  if (this->Tables && tables != this->Tables)
  {
    this->Tables->Deactivate();
  }
  if (this->Shadows && shadows != this->Shadows)
  {
    this->Shadows->Deactivate();
  }
  this->Tables = tables;
  this->Shadows = shadows;
  if (tables)
  {
    auto* object = static_cast<vtkActor*>(refraction->Object.Get());
    tables->Activate(program, object->GetProperty()->GetRepresentation() == VTK_SURFACE, origin);
  }
  if (shadows)
  {
    const auto number = static_cast<int>(refraction - this->Refractions.All.data());
    shadows->Activate(program, number, origin);
  }
}

//------------------------------------------------------------------------------
/** Forgets what hides light behind membranes that are no longer drawn, or all if it is unwanted. */
void vtkRefractionPass::vtkInternals::ForgetCasters(bool areWanted)
{
  const std::vector<vtkActor*> membranes = this->Refractions.ListMembranes();
  for (auto entry = this->Casters.begin(); entry != this->Casters.end();)
  {
    const bool isKept =
      areWanted && std::find(membranes.begin(), membranes.end(), entry->first) != membranes.end();
    entry = isKept ? std::next(entry) : this->Casters.erase(entry);
  }
}

//------------------------------------------------------------------------------
/** Takes the lights over for the objects of a membrane; reports those that are left out. */
void vtkRefractionPass::UpdateLighting(vtkRenderer* renderer, vtkActor* membrane)
{
  vtkInternals& internals = *this->Internals;
  if (this->Lighting != TRUE_SPACE)
  {
    return;
  }
  const std::string warning = internals.Lighting.Update(renderer, membrane);
  internals.SkippedLights += internals.Lighting.GetNumberOfSkippedLights();
  if (!warning.empty() && warning != internals.LastLightWarning)
  {
    vtkWarningMacro(<< warning << ".");
  }
  internals.LastLightWarning = warning;
  const bool hasShadows = this->Shadows && this->UpdateShadows(renderer, membrane);
  for (meniscus::Refraction& refraction : internals.Refractions.All)
  {
    if (refraction.Membrane == membrane && refraction.IsLitInTrueSpace)
    {
      refraction.PreparePlaces(renderer, internals.Places);
      this->UpdateWaves(renderer, refraction);
      if (refraction.HasShadows != hasShadows)
      {
        refraction.HasShadows = hasShadows;
        internals.ShaderTime.Modified();
      }
    }
  }
}

//------------------------------------------------------------------------------
/** Takes over what casts shadows behind a membrane. Returns false if nothing does. */
bool vtkRefractionPass::UpdateShadows(vtkRenderer* renderer, vtkActor* membrane)
{
  vtkInternals& internals = *this->Internals;
  std::vector<meniscus::ShadowCasters::Caster> found;
  int number = 0;
  for (const meniscus::Refraction& refraction : internals.Refractions.All)
  {
    if (refraction.Membrane == membrane && refraction.CastsShadows())
    {
      refraction.Filter->Update();
      found.push_back({ number, refraction.Filter->GetInputDataObject(0, 0) });
    }
    ++number;
  }
  meniscus::ShadowCasters& casters = internals.Casters[membrane];
  const vtkTypeInt64 before = casters.GetNumberOfUpdates();
  casters.Update(found);
  internals.ShadowUpdates += casters.GetNumberOfUpdates() - before;
  if (casters.IsEmpty())
  {
    return false;
  }
  const std::string error =
    casters.Upload(static_cast<vtkOpenGLRenderWindow*>(renderer->GetRenderWindow()));
  if (!error.empty())
  {
    vtkErrorMacro("Shadows are not drawn: " << error << ".");
  }
  return error.empty();
}

//------------------------------------------------------------------------------
/** Computes the light on an object through waves; its shader is made again if it begins or ends. */
void vtkRefractionPass::UpdateWaves(vtkRenderer* renderer, meniscus::Refraction& refraction)
{
  vtkInternals& internals = *this->Internals;
  const std::vector<meniscus::WaveSource> sources =
    internals.Lighting.ListWaveSources(refraction.Filter);
  bool readsTables = false;
  if (!sources.empty() && refraction.Object->GetVisibility())
  {
    refraction.Waves =
      refraction.Waves ? refraction.Waves : std::make_shared<meniscus::WaveLight>();
    meniscus::WaveLight& waves = *refraction.Waves;
    const vtkTypeInt64 before = waves.GetNumberOfUpdates();
    waves.Update(refraction.Filter, sources, this->NumberOfLightCells);
    internals.LightUpdates += waves.GetNumberOfUpdates() - before;
    if (!waves.IsEmpty())
    {
      const std::string error =
        waves.Upload(static_cast<vtkOpenGLRenderWindow*>(renderer->GetRenderWindow()),
          refraction.GetMapper()->GetInput());
      readsTables = error.empty();
      if (!readsTables)
      {
        vtkErrorMacro("The light through waves is not drawn: " << error << ".");
      }
    }
  }
  if (readsTables != refraction.ReadsTables)
  {
    refraction.ReadsTables = readsTables;
    internals.ShaderTime.Modified();
  }
}
