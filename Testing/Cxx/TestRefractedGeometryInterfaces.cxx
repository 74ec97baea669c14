// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Virtual geometry behind two surfaces: a checked floor in a ball of glass, upside down.
#include "RegressionScene.h"

#include <vtkRefractedGeometryFilter.h>
#include <vtkRefractingInterfaceCollection.h>

using namespace meniscus::test;

int TestRefractedGeometryInterfaces(int argc, char* argv[])
{
  RegressionScene scene;
  LookAtWater(scene, 2.5);
  const auto checks = MakeCheckedPlane(5.0, -2.0, 30);
  vtkNew<vtkSphereSource> ball;
  ball->SetCenter(0.0, 0.0, -0.4);
  ball->SetRadius(0.5);
  ball->SetThetaResolution(48);
  ball->SetPhiResolution(24);
  ball->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  vtkNew<vtkRefractingInterfaceCollection> interfaces; // rays enter the ball and leave it
  interfaces->AddInterface(1.0, 1.5);
  interfaces->AddInterface(1.0, 1.5);
  vtkNew<vtkRefractedGeometryFilter> filter;
  filter->SetInputData(checks);
  filter->AddMembraneConnection(ball->GetOutputPort());
  filter->AddMembraneConnection(ball->GetOutputPort());
  filter->SetInterfaces(interfaces);
  filter->SetCamera(scene.GetRenderer()->GetActiveCamera());
  filter->SetImagesToFirstImage();
  SetFlatColor(AddSurface(scene, filter->GetOutputPort()), 1.0, 1.0, 1.0);
  return Finish(argc, argv, scene);
}
