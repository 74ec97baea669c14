// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// The array RGBA compared with the mapper's picture of the same camera.
#include "MembraneScene.h"
#include "RayCastScene.h"

#include <vtkTetrahedraRayIntegral.h>

using namespace meniscus::test;

namespace
{

constexpr int Width = 150;
constexpr int Height = 120;

FloatImage ImageOf(vtkTetrahedraRayIntegral* filter)
{
  filter->Update();
  FloatImage image{ Width, Height, {} };
  vtkDataArray* rgba = filter->GetOutput()->GetPointData()->GetArray("RGBA");
  for (vtkIdType i = 0; rgba && i < rgba->GetNumberOfTuples(); ++i)
  {
    for (int channel = 0; channel < 4; ++channel)
    {
      image.Rgba.push_back(static_cast<float>(rgba->GetComponent(i, channel)));
    }
  }
  return image;
}

void ExpectMapperPicture(bool parallel, vtkPolyData* membrane)
{
  Grid grid = MakeBlock(8, WavyField(2.0), Torus(0.6, 0.3));
  const double range[2] = { -1.0, 1.0 };
  RayCastScene scene(grid, MakeProperty(FunctionKind::Sharp, range, 1.0), Width, Height);
  scene.GetRayCaster()->SetBackend(vtkTetrahedraRayCastMapper::NATIVE);
  LookAt(scene.GetRenderer(), grid->GetBounds(), 30.0, 25.0, 1.0, parallel);
  vtkNew<vtkTetrahedraRayIntegral> filter;
  filter->SetInputData(grid);
  filter->SetImageSize(Width, Height);
  filter->SetCamera(scene.GetRenderer()->GetActiveCamera());
  filter->SetVolumeProperty(scene.GetVolume()->GetProperty());
  filter->GetArraySelection()->DisableArray("Integral");
  filter->GetArraySelection()->EnableArray("RGBA");
  if (membrane)
  {
    scene.GetRayCaster()->SetMembraneData(membrane);
    filter->SetMembraneData(membrane);
  }
  ExpectSamePicture(ImageOf(filter), scene.RenderFloat(), parallel ? "parallel" : "perspective");
}

}

//------------------------------------------------------------------------------
TEST(RayIntegralPicture, MapperPicture)
{
  ExpectMapperPicture(false, nullptr);
  ExpectMapperPicture(true, nullptr);
}

//------------------------------------------------------------------------------
TEST(RayIntegralPicture, MapperPictureThroughAMembrane)
{
  ExpectMapperPicture(false, MakePlaneCase(0.3, 4.0, 4).Mesh);
}
