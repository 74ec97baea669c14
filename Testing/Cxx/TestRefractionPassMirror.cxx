// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// A convex mirror: a ball that mirrors the checked floor around it.
#include "RegressionScene.h"

#include <vtkRefractedGeometryFilter.h>
#include <vtkRefractionPass.h>

using namespace meniscus::test;

int TestRefractionPassMirror(int argc, char* argv[])
{
  RegressionScene scene;
  LookAtWater(scene, 4.0);
  vtkNew<vtkTrivialProducer> checks;
  checks->SetOutput(MakeCheckedPlane(3.0, -0.9, 16));
  vtkNew<vtkSphereSource> ball;
  ball->SetRadius(0.7);
  ball->SetThetaResolution(48);
  ball->SetPhiResolution(25);
  vtkNew<vtkSphere> exact;
  exact->SetRadius(0.7);
  vtkNew<vtkRefractedGeometryFilter> mirrored;
  mirrored->SetModeToReflection();
  mirrored->SetInputConnection(checks->GetOutputPort());
  mirrored->SetMembraneConnection(ball->GetOutputPort());
  mirrored->SetExactMembrane(exact);
  mirrored->SetCamera(scene.GetRenderer()->GetActiveCamera());
  SetFlatColor(AddSurface(scene, checks->GetOutputPort()), 1.0, 1.0, 1.0);
  const auto image = AddSurface(scene, mirrored->GetOutputPort());
  SetFlatColor(image, 1.0, 1.0, 1.0);
  scene.GetRenderer()->RemoveActor(image); // the pass draws it
  const auto mirror = MakeActor(ball->GetOutputPort());
  vtkNew<vtkRefractionPass> pass;
  pass->AddReflection(mirror, image, mirrored);
  pass->SetReflectanceModelToMirror();
  scene.GetRenderer()->SetPass(pass);
  const int result = Finish(argc, argv, scene);
  scene.GetRenderer()->SetPass(nullptr);
  return result;
}
