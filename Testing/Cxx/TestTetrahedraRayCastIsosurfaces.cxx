// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Two lit isosurfaces, the outer one translucent.
#include "RegressionScene.h"

#include <vtkTetrahedraRayCastMapper.h>

using namespace meniscus::test;

int TestTetrahedraRayCastIsosurfaces(int argc, char* argv[])
{
  vtkNew<vtkVolumeProperty> property;
  vtkNew<vtkColorTransferFunction> color;
  color->AddRGBPoint(0.5, 1.0, 0.4, 0.1);
  color->AddRGBPoint(0.9, 0.2, 0.5, 1.0);
  vtkNew<vtkPiecewiseFunction> opacity;
  opacity->AddPoint(0.5, 1.0);
  opacity->AddPoint(0.9, 0.35);
  property->SetColor(color);
  property->SetScalarOpacity(opacity);
  property->GetIsoSurfaceValues()->SetValue(0, 0.5);
  property->GetIsoSurfaceValues()->SetValue(1, 0.9);
  property->ShadeOn();
  RegressionScene scene;
  scene.SetProperty(property);
  const auto mapper = ShowMesh(scene, MakeBlock(16, RadialField()), 30.0, 20.0);
  mapper->SetBlendMode(vtkVolumeMapper::ISOSURFACE_BLEND);
  return Finish(argc, argv, scene);
}
