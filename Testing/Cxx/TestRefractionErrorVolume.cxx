// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Errors of flat facets of waves, in a slice through the box below them.
#include "RegressionScene.h"

#include <vtkRefractionErrorVolume.h>

using namespace meniscus::test;

int TestRefractionErrorVolume(int argc, char* argv[])
{
  vtkNew<vtkRefractionErrorVolume> volume;
  volume->SetInputData(MakeWaves(1.2, 0.0, 16));
  volume->SetMembraneModelToFlatFacets();
  volume->SetEyePosition(0.0, 0.0, 4.0);
  volume->SetModelBounds(-1.0, 1.0, -1.0, 1.0, -0.6, -0.6);
  volume->SetSampleDimensions(RegressionSize, RegressionSize, 1);
  volume->Update();
  RegressionScene scene;
  const double range[2] = { 0.0, 0.008 };
  ShowImage(scene, volume->GetOutput(), "RefractionError", range);
  return Finish(argc, argv, scene);
}
