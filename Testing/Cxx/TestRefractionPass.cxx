// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Waves through vtkRefractionPass: a floor behind a coloured medium, Fresnel reflectance.
#include "RegressionScene.h"

#include <vtkRefractedGeometryFilter.h>
#include <vtkRefractionPass.h>

using namespace meniscus::test;

int TestRefractionPass(int argc, char* argv[])
{
  RegressionScene scene;
  LookAtWater(scene, 4.0);
  vtkNew<vtkTrivialProducer> waves;
  waves->SetOutput(MakeWaves(1.2, 0.0, 24));
  vtkNew<vtkRefractedGeometryFilter> floor;
  floor->SetInputData(MakeCheckedPlane(1.5, -1.0, 13));
  floor->SetMembraneConnection(waves->GetOutputPort());
  floor->SetCamera(scene.GetRenderer()->GetActiveCamera());
  const auto water = MakeActor(waves->GetOutputPort());
  const auto object = AddSurface(scene, floor->GetOutputPort());
  SetFlatColor(object, 1.0, 1.0, 1.0);
  scene.GetRenderer()->RemoveActor(object); // the pass draws it
  vtkNew<vtkRefractionPass> pass;
  pass->AddRefraction(water, object, floor);
  pass->SetReflectanceModelToFresnel();
  pass->SetAttenuationCoefficients(0.6, 0.2, 0.1);
  scene.GetRenderer()->SetPass(pass);
  const int result = Finish(argc, argv, scene);
  scene.GetRenderer()->SetPass(nullptr);
  return result;
}
