// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// A torus of tetrahedra, translucent and not lit, in front of an opaque plane.
#include "RegressionScene.h"

#include <vtkTetrahedraRayCastMapper.h>

using namespace meniscus::test;

int TestTetrahedraRayCastComposite(int argc, char* argv[])
{
  const double range[2] = { -1.5, 1.5 };
  RegressionScene scene;
  scene.SetProperty(MakeProperty(FunctionKind::Smooth, range, 1.5));
  const auto mapper = ShowMesh(scene, MakeBlock(20, WavyField(3.0), Torus(0.65, 0.3)), 30.0, 40.0);
  const auto plane = MakePlane(0.6, -0.2, 1);
  AddSurface(scene, plane->GetOutputPort(), 0.9, 0.8, 0.6);
  return Finish(argc, argv, scene);
}
