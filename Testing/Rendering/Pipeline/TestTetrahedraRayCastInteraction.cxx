// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Picking, level of detail during interaction, translucent neighbours.
#include "MembraneScene.h"
#include "RayCastScene.h"

#include <vtkHardwareSelector.h>
#include <vtkInformation.h>
#include <vtkLODProp3D.h>
#include <vtkProp.h>
#include <vtkSelection.h>
#include <vtkSelectionNode.h>

using namespace meniscus::test;

namespace
{

constexpr int Size = 120;
constexpr double Range[2] = { -1.0, 1.0 };
constexpr double Bounds[6] = { -1.0, 1.0, -1.0, 1.0, -1.0, 1.0 };

vtkSmartPointer<vtkVolumeProperty> Smooth()
{
  return MakeProperty(FunctionKind::Smooth, Range, 3.4);
}

vtkSmartPointer<vtkActor> AddPlane(vtkRenderer* renderer, double z, double opacity)
{
  auto actor = MakeActor(MakePlane(4.0, z, 1)->GetOutputPort());
  actor->GetProperty()->SetLighting(false);
  actor->GetProperty()->SetColor(0.2, 0.8, 0.4);
  actor->GetProperty()->SetOpacity(opacity);
  renderer->AddActor(actor);
  return actor;
}

// The prop that a hardware selection finds at a pixel.
vtkProp* PropAt(vtkHardwareSelector* selector, int x, int y)
{
  const unsigned int pixel[2] = { static_cast<unsigned int>(x), static_cast<unsigned int>(y) };
  return selector->GetPixelInformation(pixel).Prop;
}

struct PickCounts
{
  std::size_t Volume = 0;
  std::size_t Other = 0;
};

// Expects every pixel of the volume to select the volume, and all others `behind` (null: nothing).
PickCounts ExpectPicks(RayCastScene& scene, vtkProp* behind, int association)
{
  scene.GetVolume()->SetVisibility(true);
  const FloatImage image = scene.RenderFloat();
  scene.GetWindow()->Render();
  vtkNew<vtkHardwareSelector> selector;
  selector->SetRenderer(scene.GetRenderer());
  selector->SetArea(0, 0, Size - 1, Size - 1);
  selector->SetFieldAssociation(association);
  EXPECT_TRUE(selector->CaptureBuffers());
  PickCounts counts;
  for (const auto& [y, x] : Product(Size, Size))
  {
    vtkProp* found = PropAt(selector, x, y);
    const bool isVolume = found == scene.GetVolume();
    counts.Volume += isVolume;
    counts.Other += found == behind;
    if (!behind)
    {
      EXPECT_EQ(isVolume, image.GetPixel(x, y)[3] > 0.0f) << x << ", " << y;
    }
  }
  return counts;
}

} // anonymous namespace

TEST(TetrahedraRayCastPicking, TheVolumeIsFoundWhereItIsVisible)
{
  const Grid grid = MakeBlock(6, WavyField(3.0), Torus(0.6, 0.3));
  for (const auto& [association, backend] :
    Product(List(int(vtkDataObject::FIELD_ASSOCIATION_CELLS),
              int(vtkDataObject::FIELD_ASSOCIATION_POINTS)),
      List(int(vtkTetrahedraRayCastMapper::OPENGL), int(vtkTetrahedraRayCastMapper::NATIVE))))
  {
    RayCastScene scene(grid, Smooth(), Size, Size);
    scene.GetRayCaster()->SetBackend(backend);
    LookAt(scene.GetRenderer(), Bounds, 30.0, 40.0);
    const PickCounts counts = ExpectPicks(scene, nullptr, association);
    EXPECT_GT(counts.Volume, 1000u);
    EXPECT_GT(counts.Other, 1000u);
  }
}

TEST(TetrahedraRayCastPicking, OpaqueGeometryHidesIt)
{
  RayCastScene scene(MakeBlock(4, WavyField(3.0)), Smooth(), Size, Size);
  LookAt(scene.GetRenderer(), Bounds, 0.0, 0.0);
  const auto plane = AddPlane(scene.GetRenderer(), 1.5, 1.0);
  EXPECT_EQ(ExpectPicks(scene, plane, vtkDataObject::FIELD_ASSOCIATION_CELLS).Volume, 0u);
  plane->SetPosition(0.0, 0.0, -3.0);
  const PickCounts behind = ExpectPicks(scene, plane, vtkDataObject::FIELD_ASSOCIATION_CELLS);
  EXPECT_GT(behind.Volume, 1000u);
  EXPECT_GT(behind.Other, 1000u);
}

TEST(TetrahedraRayCastPicking, TransparentPartsAreNotFound)
{
  RayCastScene scene(
    MakeBlock(4, WavyField(3.0)), MakeConstantProperty(0.0, 1, 1, 1, 1.0), Size, Size);
  LookAt(scene.GetRenderer(), Bounds, 30.0, 20.0);
  EXPECT_EQ(ExpectPicks(scene, nullptr, vtkDataObject::FIELD_ASSOCIATION_CELLS).Volume, 0u);
}

TEST(TetrahedraRayCastPicking, PictureAfterwardsIsTheSame)
{
  RayCastScene scene(MakeBlock(4, WavyField(3.0)), Smooth(), Size, Size);
  LookAt(scene.GetRenderer(), Bounds, 30.0, 20.0);
  const ByteImage before = scene.RenderBytes();
  ExpectPicks(scene, nullptr, vtkDataObject::FIELD_ASSOCIATION_CELLS);
  EXPECT_EQ(scene.RenderBytes().Rgb, before.Rgb);
}

TEST(TetrahedraRayCastDetail, FewerRaysDuringInteractionAllOfThemWhenStill)
{
  const Grid grid = MakeBlock(8, WavyField(3.0));
  for (const int backend :
    { int(vtkTetrahedraRayCastMapper::OPENGL), int(vtkTetrahedraRayCastMapper::NATIVE) })
  {
    RayCastScene scene(grid, Smooth(), Size, Size);
    vtkTetrahedraRayCastMapper* mapper = scene.GetRayCaster();
    mapper->SetBackend(backend);
    LookAt(scene.GetRenderer(), Bounds, 30.0, 20.0);
    const FloatImage still = scene.RenderFloat();
    const vtkTypeInt64 rays = mapper->GetNumberOfRays();
    EXPECT_EQ(mapper->GetStatistic("UsedImageSampleDistance"), 1.0);

    // A higher frame rate than can be reached.
    scene.GetWindow()->SetDesiredUpdateRate(1e6);
    const FloatImage moving = scene.RenderFloat();
    EXPECT_EQ(
      mapper->GetStatistic("UsedImageSampleDistance"), mapper->GetMaximumImageSampleDistance());
    EXPECT_NEAR(static_cast<double>(mapper->GetNumberOfRays()), static_cast<double>(rays) / 64.0,
      0.15 * static_cast<double>(rays) / 64.0);
    EXPECT_NE(moving.Rgba, still.Rgba);
    double sum = 0.0;
    for (std::size_t i = 0; i < still.Rgba.size(); ++i)
    {
      sum += std::fabs(moving.Rgba[i] - still.Rgba[i]);
    }
    EXPECT_LT(sum / static_cast<double>(still.Rgba.size()), 0.02);

    scene.GetWindow()->SetDesiredUpdateRate(1e-4);
    EXPECT_EQ(scene.RenderFloat().Rgba, still.Rgba);
    EXPECT_EQ(mapper->GetStatistic("UsedImageSampleDistance"), 1.0);

    scene.GetWindow()->SetDesiredUpdateRate(1e6);
    mapper->AutoAdjustSampleDistancesOff();
    EXPECT_EQ(scene.RenderFloat().Rgba, still.Rgba);
  }
}

TEST(TetrahedraRayCastDetail, RaysOfACoarseImageAreExact)
{
  // An image of half the size has the rays of a window of that size.
  const Grid grid = MakeBlock(6, WavyField(3.0));
  RayCastScene coarse(grid, Smooth(), 2 * Size, 2 * Size);
  coarse.GetRayCaster()->AutoAdjustSampleDistancesOff();
  coarse.GetRayCaster()->SetImageSampleDistance(2.0f);
  LookAt(coarse.GetRenderer(), Bounds, 30.0, 20.0);
  RayCastScene small(grid, Smooth(), Size, Size);
  LookAt(small.GetRenderer(), Bounds, 30.0, 20.0);
  coarse.GetWindow()->Render();
  small.GetWindow()->Render();
  EXPECT_EQ(coarse.GetRayCaster()->GetNumberOfTraversalSteps(),
    small.GetRayCaster()->GetNumberOfTraversalSteps());
  const FloatImage large = coarse.RenderFloat();
  const FloatImage truth = small.RenderFloat();
  for (const auto& [y, x] : Product(Numbers<int>(1, Size - 1), Numbers<int>(1, Size - 1)))
  {
    // Interpolation weights of a pixel at a quarter of the distance between rays: 9, 3, 3, 1 of
    // 16.
    const float expected = (9.0f * truth.GetPixel(x, y)[3] + 3.0f * truth.GetPixel(x + 1, y)[3] +
                             3.0f * truth.GetPixel(x, y + 1)[3] + truth.GetPixel(x + 1, y + 1)[3]) /
      16.0f;
    // Texture filters have positions of 8 bits.
    ASSERT_NEAR(large.GetPixel(2 * x + 1, 2 * y + 1)[3], expected, 0.01f) << x << ", " << y;
  }
}

// Pixels between the window's edge and the first ray have the colour of that ray.
TEST(TetrahedraRayCastDetail, OppositeEdgesOfACoarseImageAreNotMixed)
{
  const Grid grid = MakeBlock(6, WavyField(3.0));
  for (const int backend :
    { int(vtkTetrahedraRayCastMapper::OPENGL), int(vtkTetrahedraRayCastMapper::NATIVE) })
  {
    RayCastScene coarse(grid, Smooth(), 2 * Size, 2 * Size);
    coarse.GetRayCaster()->AutoAdjustSampleDistancesOff();
    coarse.GetRayCaster()->SetImageSampleDistance(2.0f);
    RayCastScene small(grid, Smooth(), Size, Size);
    for (RayCastScene* scene : { &coarse, &small })
    {
      scene->GetRayCaster()->SetBackend(backend);
      LookAt(scene->GetRenderer(), Bounds, 30.0, 20.0);
      // The left edge cuts the volume, which does not reach the right one.
      scene->GetRenderer()->GetActiveCamera()->SetWindowCenter(0.9, 0.0);
    }
    const FloatImage large = coarse.RenderFloat();
    const FloatImage truth = small.RenderFloat();
    std::size_t covered = 0;
    for (int y = 1; y < Size - 1; ++y)
    {
      ASSERT_EQ(truth.GetPixel(Size - 1, y)[3], 0.0f) << y;
      const float alpha = truth.GetPixel(0, y)[3];
      covered += alpha > 0.3f;
      // As above, between the rays of two rows.
      ASSERT_NEAR(
        large.GetPixel(0, 2 * y + 1)[3], 0.75f * alpha + 0.25f * truth.GetPixel(0, y + 1)[3], 0.01f)
        << y;
    }
    EXPECT_GT(covered, 20u);
  }
}

// A coarse image of an interaction leaves 1/512 of the light, at most half a level of 8 bits. Still
// images, fixed distances and opacities that the application sets are not concerned.
TEST(TetrahedraRayCastDetail, RaysOfAMovingImageEndEarlier)
{
  const Grid grid = MakeBlock(6, WavyField(3.0));
  const auto dense = Smooth();
  dense->SetScalarOpacityUnitDistance(0.05 * dense->GetScalarOpacityUnitDistance());
  for (const int backend :
    { int(vtkTetrahedraRayCastMapper::OPENGL), int(vtkTetrahedraRayCastMapper::NATIVE) })
  {
    RayCastScene scene(grid, dense, Size, Size);
    vtkTetrahedraRayCastMapper* mapper = scene.GetRayCaster();
    mapper->SetBackend(backend);
    mapper->SetMaximumImageSampleDistance(2.0f);
    const auto renderAt = [&scene, mapper](bool adjusts, float distance)
    {
      mapper->SetAutoAdjustSampleDistances(adjusts);
      mapper->SetImageSampleDistance(distance);
      return scene.RenderFloat().Rgba;
    };
    const auto still = renderAt(true, 1.0f);
    EXPECT_EQ(still, renderAt(false, 1.0f));

    scene.GetWindow()->SetDesiredUpdateRate(1e6); // more than can be reached
    const auto moving = renderAt(true, 1.0f);
    const vtkTypeInt64 steps = mapper->GetNumberOfTraversalSteps();
    EXPECT_EQ(mapper->GetStatistic("UsedImageSampleDistance"), 2.0);
    const auto fixed = renderAt(false, 2.0f);
    EXPECT_LT(steps, mapper->GetNumberOfTraversalSteps() * 9 / 10);
    float largest = 0.0f;
    for (std::size_t i = 0; i < fixed.size(); ++i)
    {
      largest = std::max(largest, std::abs(moving[i] - fixed[i]));
    }
    EXPECT_LE(largest, 0.5f / 255.0f);
    EXPECT_GT(largest, 0.05f / 255.0f);

    mapper->SetEarlyTerminationOpacity(1.0);
    EXPECT_EQ(renderAt(true, 1.0f), renderAt(false, 2.0f));
  }
}

// Rays of coarse images are interpolated by the native backend where that errs by at most a level,
// in the quadratic mean of three colours, one of which may differ more.
TEST(TetrahedraRayCastDetail, RaysOfAMovingImageAreInterpolated)
{
  const Grid grid = MakeBlock(6, WavyField(3.0));
  RayCastScene scene(grid, Smooth(), 4 * Size, 4 * Size);
  vtkTetrahedraRayCastMapper* mapper = scene.GetRayCaster();
  mapper->SetMaximumImageSampleDistance(2.0f);
  const auto renderAt = [&scene, mapper](bool adjusts, double opacity)
  {
    mapper->SetAutoAdjustSampleDistances(adjusts);
    mapper->SetImageSampleDistance(adjusts ? 1.0f : 2.0f);
    mapper->SetEarlyTerminationOpacity(opacity);
    return scene.RenderFloat().Rgba;
  };
  const auto countInterpolated = [mapper]
  { return static_cast<vtkTypeInt64>(mapper->GetStatistic("NumberOfInterpolatedRays")); };
  const double defaultOpacity = mapper->GetEarlyTerminationOpacity();
  const double coarseOpacity = 1.0 - 1.0 / 512.0;
  for (const int backend :
    { int(vtkTetrahedraRayCastMapper::OPENGL), int(vtkTetrahedraRayCastMapper::NATIVE) })
  {
    mapper->SetBackend(backend);
    scene.GetWindow()->SetDesiredUpdateRate(1e-4);
    renderAt(true, defaultOpacity);
    EXPECT_EQ(countInterpolated(), 0) << "still";
    scene.GetWindow()->SetDesiredUpdateRate(1e6); // more than can be reached
    const auto truth = renderAt(false, coarseOpacity);
    const vtkTypeInt64 rays = mapper->GetNumberOfRays();
    const vtkTypeInt64 steps = mapper->GetNumberOfTraversalSteps();
    EXPECT_EQ(countInterpolated(), 0) << "fixed distance";
    EXPECT_EQ(renderAt(true, coarseOpacity), truth);
    EXPECT_EQ(countInterpolated(), 0) << "chosen opacity";

    const auto moving = renderAt(true, defaultOpacity);
    EXPECT_EQ(mapper->GetStatistic("UsedImageSampleDistance"), 2.0);
    EXPECT_EQ(mapper->GetNumberOfRays(), rays);
    if (backend == vtkTetrahedraRayCastMapper::OPENGL)
    {
      EXPECT_EQ(moving, truth);
      EXPECT_EQ(countInterpolated(), 0);
      continue;
    }
    EXPECT_GT(countInterpolated(), rays / 10);
    EXPECT_LT(mapper->GetNumberOfTraversalSteps(), steps * 19 / 20);
    float largest = 0.0f;
    for (std::size_t i = 0; i < truth.size(); ++i)
    {
      largest = std::max(largest, std::abs(moving[i] - truth[i]));
    }
    EXPECT_LE(largest, std::sqrt(3.0f) / 255.0f);
    EXPECT_GT(largest, 0.0f);
  }
}

// The same for rays behind a membrane above the mesh. Turned round, the camera is in front of the
// mesh, and the membrane behind it.
TEST(TetrahedraRayCastDetail, RefractedRaysOfAMovingImageAreInterpolated)
{
  RayCastScene scene(MakeBlock(6, WavyField(3.0)), Smooth(), 4 * Size, 4 * Size);
  vtkTetrahedraRayCastMapper* mapper = scene.GetRayCaster();
  mapper->SetBackend(vtkTetrahedraRayCastMapper::NATIVE);
  mapper->SetMaximumImageSampleDistance(2.0f);
  mapper->SetMembraneData(MakeDomeCase(1.4, 8.0, 4.5, 16).Mesh);
  scene.GetWindow()->SetDesiredUpdateRate(1e6); // more than can be reached
  for (const double elevation : { 60.0, -60.0 })
  {
    LookAt(scene.GetRenderer(), Bounds, 20.0, elevation);
    mapper->SetAutoAdjustSampleDistances(false);
    mapper->SetImageSampleDistance(2.0f);
    const auto truth = scene.RenderFloat().Rgba;
    const vtkTypeInt64 rays = mapper->GetNumberOfRays();
    EXPECT_EQ(mapper->GetStatistic("NumberOfInterpolatedRays"), 0.0);
    mapper->SetAutoAdjustSampleDistances(true);
    const auto moving = scene.RenderFloat().Rgba;
    EXPECT_EQ(mapper->GetNumberOfRays(), rays) << elevation;
    EXPECT_GT(mapper->GetStatistic("NumberOfInterpolatedRays"), 0.1 * static_cast<double>(rays));
    float largest = 0.0f;
    for (std::size_t i = 0; i < truth.size(); ++i)
    {
      largest = std::max(largest, std::abs(moving[i] - truth[i]));
    }
    // Moving images also leave 1/512 of the light.
    EXPECT_LE(largest, (std::sqrt(3.0f) + 0.5f) / 255.0f) << elevation;
    EXPECT_GT(largest, 0.0f);
  }
}

TEST(TetrahedraRayCastDetail, LevelsOfDetailProp)
{
  RayCastScene scene(MakeBlock(6, WavyField(3.0)), Smooth(), Size, Size);
  LookAt(scene.GetRenderer(), Bounds, 30.0, 20.0);
  const ByteImage truth = scene.RenderBytes();
  EXPECT_GT(scene.GetRayCaster()->GetTimeToDraw(), 0.0);
  scene.GetRenderer()->RemoveVolume(scene.GetVolume());
  vtkNew<vtkLODProp3D> prop;
  prop->AddLOD(scene.GetRayCaster(), scene.GetVolume()->GetProperty(), 0.0);
  scene.GetRenderer()->AddViewProp(prop);
  EXPECT_EQ(scene.RenderBytes().Rgb, truth.Rgb);
}

TEST(TetrahedraRayCastNeighbors, TranslucentGeometry)
{
  // The volume is blended over translucent geometry, behind it or in front, as VTK's volumes are.
  const Grid grid = MakeBlock(6, WavyField(3.0));
  for (const auto& [peeling, z] : Product(List(false, true), List(-1.5, 1.5)))
  {
    RayCastScene scene(grid, Smooth(), Size, Size);
    LookAt(scene.GetRenderer(), Bounds, 0.0, 0.0);
    const ByteImage alone = scene.RenderBytes();
    const FloatImage volume = scene.RenderFloat();
    const auto plane = AddPlane(scene.GetRenderer(), z, 0.5);
    scene.GetRenderer()->SetUseDepthPeeling(peeling);
    scene.GetRenderer()->SetMaximumNumberOfPeels(4);
    scene.GetRenderer()->SetOcclusionRatio(0.0);
    const ByteImage image = scene.RenderBytes();
    const double color[3] = { 0.2, 0.8, 0.4 };
    for (const auto& [y, x] : Product(Size, Size))
    {
      const float* rgba = volume.GetPixel(x, y);
      for (int c = 0; c < 3; ++c)
      {
        const double expected = rgba[c] + (1.0 - rgba[3]) * 0.5 * color[c];
        ASSERT_NEAR(image.GetPixel(x, y)[c], 255.0 * expected, 1.51)
          << x << ", " << y << (peeling ? ", peeling" : "") << " z " << z;
      }
    }
  }
}

TEST(TetrahedraRayCastNeighbors, PeeledVolumesAreLeftOutWithAWarning)
{
  RayCastScene scene(MakeBlock(6, WavyField(3.0)), Smooth(), Size, Size);
  LookAt(scene.GetRenderer(), Bounds, 0.0, 0.0);
  scene.GetRenderer()->SetUseDepthPeeling(true);
  scene.GetRenderer()->SetUseDepthPeelingForVolumes(true);
  const ByteImage alone = scene.RenderBytes();
  scene.GetVolume()->VisibilityOff();
  const auto plane = AddPlane(scene.GetRenderer(), 1.5, 0.5);
  const ByteImage translucent = scene.RenderBytes();
  EXPECT_NE(translucent.Rgb, alone.Rgb);
  scene.GetVolume()->VisibilityOn();
  const auto told = ObserveErrors(scene.GetRayCaster());
  EXPECT_EQ(scene.RenderBytes().Rgb, translucent.Rgb);
  ASSERT_EQ(told->Warnings.size(), 1u);
  EXPECT_TRUE(HasText(told->Warnings.front(), "UseDepthPeelingForVolumes"));
  plane->VisibilityOff();
  EXPECT_EQ(scene.RenderBytes().Rgb, alone.Rgb);
}

TEST(TetrahedraRayCastNeighbors, SeveralVolumes)
{
  // Two volumes apart in depth: the front one is drawn over the back one, each as if alone.
  const Grid grid = MakeBlock(4, WavyField(3.0));
  RayCastScene scene(grid, Smooth(), Size, Size);
  vtkNew<vtkTetrahedraRayCastMapper> mapper;
  mapper->SetInputData(grid);
  vtkNew<vtkVolume> second;
  second->SetMapper(mapper);
  second->SetProperty(scene.GetVolume()->GetProperty());
  second->SetPosition(0.3, 0.2, 3.0);
  const double bounds[6] = { -1.0, 1.3, -1.0, 1.2, -1.0, 4.0 };
  LookAt(scene.GetRenderer(), bounds, 20.0, 10.0);
  const FloatImage back = scene.RenderFloat();
  scene.GetRenderer()->RemoveVolume(scene.GetVolume());
  scene.GetRenderer()->AddVolume(second);
  const FloatImage front = scene.RenderFloat();
  scene.GetRenderer()->RemoveVolume(second);
  scene.GetRenderer()->AddVolume(scene.GetVolume());
  scene.GetRenderer()->AddVolume(second);
  const FloatImage both = scene.RenderFloat();
  for (std::size_t i = 0; i < both.Rgba.size(); ++i)
  {
    const float transmitted = 1.0f - front.Rgba[i / 4 * 4 + 3];
    ASSERT_NEAR(both.Rgba[i], front.Rgba[i] + transmitted * back.Rgba[i], 1e-6) << i;
  }
}
