// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Line integrals of a scalar through a mesh with a hole, as an image; the window only shows it.
#include "RegressionScene.h"

#include <vtkTetrahedraRayIntegral.h>

using namespace meniscus::test;

int TestTetrahedraRayIntegral(int argc, char* argv[])
{
  vtkNew<vtkTetrahedraRayIntegral> rays;
  rays->SetInputDataObject(MakeBlock(16, RadialField(), Shell(0.4, 0.9)));
  rays->SetDirection(-1.0, 2.2, -0.9);
  rays->SetViewUp(0.0, 0.0, 1.0);
  rays->SetImageSize(RegressionSize, RegressionSize);
  rays->Update();
  RegressionScene scene;
  const double range[2] = { 0.0, 1.3 };
  ShowImage(scene, rays->GetOutput(), "Integral", range);
  return Finish(argc, argv, scene);
}
