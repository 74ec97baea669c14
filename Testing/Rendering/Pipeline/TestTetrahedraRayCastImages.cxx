// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// A few small images compared with baselines, to detect changes that the numeric tests do not
// cover. The baselines were inspected; each pixel must be within one grey level.
#include "MembraneScene.h"
#include "RayCastScene.h"
#include "StrictImage.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkContourValues.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSphereSource.h>
#include <vtkUnstructuredGrid.h>
#include <vtkVolumeMapper.h>
#include <vtkVolumeProperty.h>

using namespace meniscus::test;

namespace
{

constexpr int Size = 300;
constexpr int Threshold = 1; // grey levels: rounding to 8 bits
constexpr double Range[2] = { -1.5, 1.5 };

void expectBaseline(VolumeScene& scene, const std::string& name)
{
  const ByteImage image = scene.renderBytes();
  const BaselineResult result = compareToBaseline(image, name, Threshold);
  EXPECT_TRUE(result.Passed) << result.Message;

  // The same image with one wrong pixel must fail.
  ByteImage wrong = image;
  unsigned char& value = wrong.Rgb[wrong.Rgb.size() / 2];
  value = static_cast<unsigned char>(value < 128 ? value + 3 : value - 3);
  EXPECT_EQ(compareStrictly(image, wrong, Threshold).PixelsBeyond, 1u);
}

} // anonymous namespace

TEST(TetrahedraRayCastImages, SmoothBlock)
{
  const Grid grid = makeBlock(12, wavyField(3.0));
  RayCastScene scene(grid, makeProperty(FunctionKind::Smooth, Range, 3.5), Size, Size);
  lookAt(scene.renderer(), grid->GetBounds(), 30.0, 20.0);
  expectBaseline(scene, "TetrahedraRayCastSmoothBlock");
}

TEST(TetrahedraRayCastImages, SharpTorus)
{
  const Grid grid = makeBlock(24, wavyField(3.0), torus(0.65, 0.3));
  RayCastScene scene(grid, makeProperty(FunctionKind::Sharp, Range, 3.5), Size, Size);
  lookAt(scene.renderer(), grid->GetBounds(), 25.0, 35.0, 1.2);
  scene.renderer()->SetBackground(1.0, 1.0, 1.0);
  expectBaseline(scene, "TetrahedraRayCastSharpTorus");
}

TEST(TetrahedraRayCastImages, OpaqueSphereInTwoBlocks)
{
  const Grid grid = makeBlock(12, wavyField(3.0), twoBlocks(0.4));
  RayCastScene scene(grid, makeProperty(FunctionKind::Sparse, Range, 3.5), Size, Size);
  vtkNew<vtkSphereSource> sphere;
  sphere->SetRadius(0.7);
  sphere->SetThetaResolution(48);
  sphere->SetPhiResolution(48);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(sphere->GetOutputPort());
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(0.8, 0.7, 0.5);
  scene.renderer()->AddActor(actor);
  lookAt(scene.renderer(), grid->GetBounds(), 30.0, 20.0, 1.1, true);
  expectBaseline(scene, "TetrahedraRayCastOpaqueSphere");
}

TEST(TetrahedraRayCastImages, ThroughAPlane)
{
  // Lit surfaces rise out of the water and continue below it, refracted.
  const Grid grid = makeBlock(16, wavyField(3.0));
  auto property = makeProperty(FunctionKind::Opaque, Range, 3.5);
  property->GetIsoSurfaceValues()->SetValue(0, 0.2);
  property->ShadeOn();
  RayCastScene scene(grid, property, Size, Size);
  scene.rayCaster()->SetBlendMode(vtkVolumeMapper::ISOSURFACE_BLEND);
  const MembraneCase plane = makePlaneCase(0.3, 1.6, 2);
  scene.rayCaster()->SetMembraneData(plane.Mesh);
  lookAt(scene.renderer(), grid->GetBounds(), 30.0, 25.0);
  expectBaseline(scene, "TetrahedraRayCastThroughAPlane");
}

TEST(TetrahedraRayCastImages, ThroughADome)
{
  const Grid grid = makeBlock(16, wavyField(4.0));
  RayCastScene scene(grid, makeProperty(FunctionKind::Smooth, Range, 3.5), Size, Size);
  const MembraneCase dome = makeDomeCase(1.6, 1.5, 0.9, 16);
  scene.rayCaster()->SetMembraneData(dome.Mesh);
  lookAt(scene.renderer(), grid->GetBounds(), 30.0, 50.0);
  expectBaseline(scene, "TetrahedraRayCastThroughADome");
}

TEST(TetrahedraRayCastImages, CameraInside)
{
  const Grid grid = makeBlock(12, wavyField(3.0));
  RayCastScene scene(grid, makeProperty(FunctionKind::Smooth, Range, 3.5), Size, Size);
  vtkCamera* camera = scene.renderer()->GetActiveCamera();
  camera->SetPosition(0.1, 0.2, 0.3);
  camera->SetFocalPoint(-1.0, 0.1, -0.4);
  camera->SetViewAngle(75.0);
  camera->SetClippingRange(0.001, 10.0);
  expectBaseline(scene, "TetrahedraRayCastCameraInside");
}
