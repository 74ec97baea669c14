// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Two blocks of a dense medium under one light from the side: one throws its shadow on the other.
#include "RegressionScene.h"

#include <vtkTetrahedraRayCastMapper.h>

using namespace meniscus::test;

int TestTetrahedraRayCastShadows(int argc, char* argv[])
{
  const auto property = MakeConstantProperty(1.0, 1.0, 0.8, 0.5, 0.2);
  property->ShadeOn();
  property->SetAmbient(0.1);
  property->SetDiffuse(0.9);
  RegressionScene scene;
  scene.SetProperty(property);
  const auto mapper =
    ShowMesh(scene, MakeBlock(16, ConstantField(1.0), TwoBlocks(0.5)), 20.0, 30.0);
  mapper->SetGlobalIlluminationReach(1.0f);
  mapper->SetVolumetricScatteringBlending(1.0f);
  vtkNew<vtkLight> light;
  light->SetLightTypeToSceneLight();
  light->SetFocalPoint(0.0, 0.0, 0.0);
  light->SetPosition(1.0, 0.5, 0.5);
  light->SetIntensity(2.0);
  scene.GetRenderer()->AddLight(light);
  return Finish(argc, argv, scene);
}
