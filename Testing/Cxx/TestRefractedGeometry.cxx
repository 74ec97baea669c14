// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Virtual geometry below waves: a checked floor and a ball, drawn as ordinary geometry.
#include "RegressionScene.h"

#include <vtkRefractedGeometryFilter.h>

using namespace meniscus::test;

int TestRefractedGeometry(int argc, char* argv[])
{
  RegressionScene scene;
  LookAtWater(scene, 4.0);
  const auto waves = MakeWaves(1.2, 0.0, 24);
  vtkNew<vtkSphereSource> ball;
  ball->SetCenter(0.1, 0.0, -0.5);
  ball->SetRadius(0.35);
  ball->SetThetaResolution(40);
  ball->SetPhiResolution(20);
  vtkNew<vtkRefractedGeometryFilter> floor;
  floor->SetInputData(MakeCheckedPlane(1.0, -1.0, 9));
  vtkNew<vtkRefractedGeometryFilter> object;
  object->SetInputConnection(ball->GetOutputPort());
  object->SetVirtualNormals(true);
  for (vtkRefractedGeometryFilter* filter : { floor.Get(), object.Get() })
  {
    filter->SetMembraneData(waves);
    filter->SetCamera(scene.GetRenderer()->GetActiveCamera());
  }
  SetFlatColor(AddSurface(scene, floor->GetOutputPort()), 1.0, 1.0, 1.0);
  AddSurface(scene, object->GetOutputPort(), 1.0, 0.5, 0.2);
  return Finish(argc, argv, scene);
}
