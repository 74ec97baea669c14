// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Rendering/Pass/MembraneComposer.h"
#include "Rendering/Pass/RefractionTarget.h"
#include "Rendering/Pass/ShadowCasters.h"
#include "Rendering/Pass/TrueSpaceLighting.h"
#include "Rendering/RefractionPassList.h"
#include "Volume/Optics/RefractionMedium.h"
#include "vtkRefractionPass.h"

#include "vtkActor.h"
#include "vtkNew.h"
#include "vtkOpaquePass.h"
#include "vtkRenderPass.h"
#include "vtkSmartPointer.h"
#include "vtkTexture.h"
#include "vtkTimeStamp.h"
#include "vtkTranslucentPass.h"

#include <glm/vec3.hpp>

#include <map>
#include <string>

class vtkShaderProgram;

class vtkRefractionPass::vtkInternals
{
public:
  enum class Stages
  {
    Objects,
    Mirrored,
    Membrane
  };

  meniscus::RefractionList Refractions;
  vtkSmartPointer<vtkRenderPass> ScenePass;
  vtkSmartPointer<vtkTexture> Reflection;
  vtkNew<vtkOpaquePass> Opaque;
  vtkNew<vtkTranslucentPass> Translucent;
  /** Draws the membrane's mapper, independently of the property of the membrane's actor. */
  vtkNew<vtkActor> Surface;
  Stages Stage = Stages::Objects;

  meniscus::RefractionMedium Medium;
  meniscus::RefractionTarget Objects;
  meniscus::RefractionTarget Mirrored;
  meniscus::RefractionTarget Membrane;
  meniscus::MembraneComposer Composer;
  meniscus::TrueSpaceLighting Lighting;
  /** Buffers of the objects that are lit in true space, while they are drawn. */
  meniscus::LocalPlaces Places;
  /** Last time that an object's shader changed. */
  vtkTimeStamp ShaderTime;
  std::string LastLightWarning;
  std::size_t ReportedInterfaces = 0; ///< number of interfaces in the last picture
  vtkMTimeType MediumFaultTime = 0;
  vtkTypeInt64 SkippedLights = 0;

  vtkTypeInt64 Drawn = 0;
  vtkTypeInt64 Skipped = 0;

  /** Tables that are active; null for none. */
  meniscus::WaveLight* Tables = nullptr;
  vtkTypeInt64 LightUpdates = 0;

  /** Objects that hide light, by the membrane in front of them. */
  std::map<vtkActor*, meniscus::ShadowCasters> Casters;
  /** Those whose tables are active; null for none. */
  meniscus::ShadowCasters* Shadows = nullptr;
  vtkTypeInt64 ShadowUpdates = 0;

  void ActivateTables(
    const meniscus::Refraction* refraction, vtkShaderProgram* program, const glm::dvec3& origin);
  void ForgetCasters(bool areWanted);
};
