// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// A volume behind two surfaces, the sides of a pane with water behind it, and next to the pane.
#include "RegressionScene.h"

#include <vtkRefractingInterfaceCollection.h>
#include <vtkTetrahedraRayCastMapper.h>

using namespace meniscus::test;

int TestTetrahedraRayCastInterfaces(int argc, char* argv[])
{
  const double range[2] = { -1.5, 1.5 };
  RegressionScene scene;
  scene.SetProperty(MakeProperty(FunctionKind::Peaked, range, 3.5));
  const auto mapper = ShowMesh(scene, MakeBlock(12, WavyField(3.0)), 20.0, 70.0);
  vtkNew<vtkRefractingInterfaceCollection> interfaces;
  interfaces->AddInterface(1.0, 1.52);
  interfaces->AddInterface(1.52, 1.333);
  mapper->SetInterfaces(interfaces);
  for (const double height : { 1.6, 1.3 })
  {
    vtkNew<vtkPlaneSource> side; // normals along y, the direction up of LookAt()
    side->SetOrigin(-0.8, height, 0.8);
    side->SetPoint1(0.8, height, 0.8);
    side->SetPoint2(-0.8, height, -0.8);
    side->SetResolution(4, 4);
    mapper->AddMembraneConnection(side->GetOutputPort());
  }
  return Finish(argc, argv, scene);
}
