// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Schlieren image of a block in which the index of refraction varies.
#include "RegressionScene.h"

#include <vtkTetrahedraSchlieren.h>

using namespace meniscus::test;

int TestTetrahedraSchlieren(int argc, char* argv[])
{
  const Field wave = WavyField(3.0);
  vtkNew<vtkTetrahedraSchlieren> rays;
  rays->SetInputDataObject(
    MakeBlock(12, [&](double x, double y, double z) { return 1.0 + 1e-3 * wave(x, y, z); }));
  rays->SetQuantityToRefractiveIndex();
  rays->SetDirection(-1.0, 2.2, -0.9);
  rays->SetViewUp(0.0, 0.0, 1.0);
  rays->SetImageSize(RegressionSize, RegressionSize);
  rays->SetKnifeRange(0.005);
  rays->Update();
  RegressionScene scene;
  const double range[2] = { 0.0, 1.0 };
  ShowImage(scene, rays->GetOutput(), "Schlieren", range);
  return Finish(argc, argv, scene);
}
