// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Caustics: light from above through waves, on a floor that is seen directly.
#include "RegressionScene.h"

#include <vtkLookupTable.h>
#include <vtkRefractedLightFilter.h>

using namespace meniscus::test;

int TestRefractedLight(int argc, char* argv[])
{
  RegressionScene scene;
  LookAtWater(scene, 3.5);
  const auto floor = MakePlane(0.8, -1.0, 60);
  vtkNew<vtkRefractedLightFilter> light;
  light->SetInputConnection(floor->GetOutputPort());
  light->SetMembraneData(MakeWaves(1.2, 0.0, 32));
  light->SetLightPosition(0.2, 0.1, 1.0);
  vtkNew<vtkLookupTable> grey;
  grey->SetSaturationRange(0.0, 0.0);
  grey->SetValueRange(0.1, 1.0);
  const auto actor = AddSurface(scene, light->GetOutputPort());
  vtkMapper* mapper = actor->GetMapper();
  mapper->SetScalarModeToUseCellFieldData();
  mapper->SelectColorArray("RefractionIrradiance");
  mapper->SetLookupTable(grey);
  mapper->SetScalarRange(0.0, 2.5);
  actor->GetProperty()->LightingOff(); // the colours contain the light
  return Finish(argc, argv, scene);
}
