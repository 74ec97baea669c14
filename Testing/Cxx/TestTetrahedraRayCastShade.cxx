// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// A lit volume of voxels, straight from a source, whose light depends on gradients.
#include "RegressionScene.h"

#include <vtkRTAnalyticSource.h>
#include <vtkTetrahedraRayCastMapper.h>

using namespace meniscus::test;

int TestTetrahedraRayCastShade(int argc, char* argv[])
{
  vtkNew<vtkRTAnalyticSource> wavelet;
  wavelet->SetWholeExtent(-10, 10, -10, 10, -10, 10);
  vtkNew<vtkTetrahedraRayCastMapper> mapper;
  mapper->SetInputConnection(wavelet->GetOutputPort());
  mapper->SetGradientsToVertexGradients();
  const double range[2] = { 37.0, 277.0 };
  const auto property = MakeProperty(FunctionKind::Opaque, range, 20.0);
  property->ShadeOn();
  property->SetSpecular(0.4);
  property->SetSpecularPower(20.0);
  RegressionScene scene;
  scene.SetMapper(mapper);
  scene.SetProperty(property);
  const double bounds[6] = { -10.0, 10.0, -10.0, 10.0, -10.0, 10.0 };
  LookAt(scene.GetRenderer(), bounds, 35.0, 25.0);
  return Finish(argc, argv, scene);
}
