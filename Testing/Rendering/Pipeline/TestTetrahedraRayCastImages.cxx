// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// A few small images compared with baselines, to detect changes that the numeric tests do not
// cover. The baselines were inspected; each pixel must be within one grey level.
#include "MembraneScene.h"
#include "RayCastScene.h"
#include "StrictImage.h"

using namespace meniscus::test;

namespace
{

constexpr int Size = 300;
constexpr int Threshold = 1; // grey levels: rounding to 8 bits
constexpr double Range[2] = { -1.5, 1.5 };

void ExpectBaseline(VolumeScene& scene, const std::string& name)
{
  const ByteImage image = scene.RenderBytes();
  const BaselineResult result = CompareToBaseline(image, name, Threshold);
  EXPECT_TRUE(result.Passed) << result.Message;

  // The same image with one wrong pixel must fail.
  ByteImage wrong = image;
  unsigned char& value = wrong.Rgb[wrong.Rgb.size() / 2];
  value = static_cast<unsigned char>(value < 128 ? value + 3 : value - 3);
  EXPECT_EQ(CompareStrictly(image, wrong, Threshold).PixelsBeyond, 1u);
}

} // anonymous namespace

TEST(TetrahedraRayCastImages, SmoothBlock)
{
  const Grid grid = MakeBlock(12, WavyField(3.0));
  RayCastScene scene(grid, MakeProperty(FunctionKind::Smooth, Range, 3.5), Size, Size);
  ExpectBaseline(scene, "TetrahedraRayCastSmoothBlock");
}

TEST(TetrahedraRayCastImages, SharpTorus)
{
  const Grid grid = MakeBlock(24, WavyField(3.0), Torus(0.65, 0.3));
  RayCastScene scene(grid, MakeProperty(FunctionKind::Sharp, Range, 3.5), Size, Size);
  LookAt(scene.GetRenderer(), grid->GetBounds(), 25.0, 35.0, 1.2);
  scene.GetRenderer()->SetBackground(1.0, 1.0, 1.0);
  ExpectBaseline(scene, "TetrahedraRayCastSharpTorus");
}

TEST(TetrahedraRayCastImages, OpaqueSphereInTwoBlocks)
{
  const Grid grid = MakeBlock(12, WavyField(3.0), TwoBlocks(0.4));
  RayCastScene scene(grid, MakeProperty(FunctionKind::Sparse, Range, 3.5), Size, Size);
  vtkNew<vtkSphereSource> sphere;
  sphere->SetRadius(0.7);
  sphere->SetThetaResolution(48);
  sphere->SetPhiResolution(48);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(sphere->GetOutputPort());
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(0.8, 0.7, 0.5);
  scene.GetRenderer()->AddActor(actor);
  LookAt(scene.GetRenderer(), grid->GetBounds(), 30.0, 20.0, 1.1, true);
  ExpectBaseline(scene, "TetrahedraRayCastOpaqueSphere");
}

TEST(TetrahedraRayCastImages, ThroughAPlane)
{
  // Lit surfaces rise out of the water and continue below it, refracted.
  const Grid grid = MakeBlock(16, WavyField(3.0));
  auto property = MakeProperty(FunctionKind::Opaque, Range, 3.5);
  property->GetIsoSurfaceValues()->SetValue(0, 0.2);
  property->ShadeOn();
  RayCastScene scene(grid, property, Size, Size);
  scene.GetRayCaster()->SetBlendMode(vtkVolumeMapper::ISOSURFACE_BLEND);
  const MembraneCase plane = MakePlaneCase(0.3, 1.6, 2);
  scene.GetRayCaster()->SetMembraneData(plane.Mesh);
  LookAt(scene.GetRenderer(), grid->GetBounds(), 30.0, 25.0);
  ExpectBaseline(scene, "TetrahedraRayCastThroughAPlane");
}

TEST(TetrahedraRayCastImages, ThroughADome)
{
  const Grid grid = MakeBlock(16, WavyField(4.0));
  RayCastScene scene(grid, MakeProperty(FunctionKind::Smooth, Range, 3.5), Size, Size);
  const MembraneCase dome = MakeDomeCase(1.6, 1.5, 0.9, 16);
  scene.GetRayCaster()->SetMembraneData(dome.Mesh);
  LookAt(scene.GetRenderer(), grid->GetBounds(), 30.0, 50.0);
  ExpectBaseline(scene, "TetrahedraRayCastThroughADome");
}

TEST(TetrahedraRayCastImages, CameraInside)
{
  const Grid grid = MakeBlock(12, WavyField(3.0));
  RayCastScene scene(grid, MakeProperty(FunctionKind::Smooth, Range, 3.5), Size, Size);
  vtkCamera* camera = scene.GetRenderer()->GetActiveCamera();
  camera->SetPosition(0.1, 0.2, 0.3);
  camera->SetFocalPoint(-1.0, 0.1, -0.4);
  camera->SetViewAngle(75.0);
  camera->SetClippingRange(0.001, 10.0);
  ExpectBaseline(scene, "TetrahedraRayCastCameraInside");
}
