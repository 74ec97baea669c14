// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Maximum, minimum, average and additive blending.
#include "OpticsTruth.h"

using namespace meniscus::test;
using namespace meniscus::reference;

namespace
{

constexpr int Size = 100;

void ExpectReference(RayCastScene& scene, const ProjectionMode& mode, const std::string& what)
{
  scene.GetWindow()->Render();
  const auto integrator = MakeReference(scene.MakeGrid(), scene.GetVolume()->GetMatrix());
  vtkVolumeProperty* property = scene.GetVolume()->GetProperty();
  const auto function = FunctionOf(mode, property);
  double range[2];
  scene.MakeGrid()->GetPointData()->GetScalars()->GetFiniteRange(range);
  ExpectTrace(
    scene,
    [&](const Ray& ray)
    {
      std::vector<RaySegment> segments;
      integrator->FindSegments(ray, segments);
      return meniscus::reference::Project(ray, segments, mode.Truth, function, range);
    },
    what);
}

// Attenuation (alpha) equal to s over the range [0, 1] of s.
vtkSmartPointer<vtkVolumeProperty> IdentityProperty(double unit)
{
  auto property = MakeConstantProperty(0.0, 1, 1, 1, unit);
  property->SetScalarOpacity(MakeOpacity({ { 0.0, 0.0 }, { 1.0, 1.0 } }));
  return property;
}

} // anonymous namespace

TEST(TetrahedraRayCastProjections, LinearFieldInABox)
{
  // s from 0 to 1 along x + y; white with alpha s.
  const auto field = [](double x, double y, double) { return 0.5 + 0.25 * (x + y); };
  const Grid grid = MakeBlock(5, field);
  for (const ProjectionMode& mode : ProjectionModes)
  {
    RayCastScene scene(grid, IdentityProperty(3.0), Size, Size);
    scene.GetRayCaster()->SetBlendMode(mode.Number);
    LookAt(scene.GetRenderer(), grid->GetBounds(), 33.0, 21.0, 1.2);
    ExpectTrace(
      scene,
      [&](const Ray& ray)
      {
        const auto [origin, direction, begin, end] = ClipToCube(ray);
        if (begin >= end)
        {
          return std::array<double, 4>{ 0.0, 0.0, 0.0, 0.0 };
        }
        const double s0 =
          field(origin[0] + begin * direction[0], origin[1] + begin * direction[1], 0.0);
        const double s1 =
          field(origin[0] + end * direction[0], origin[1] + end * direction[1], 0.0);
        double shown = 0.5 * (s0 + s1);
        if (mode.Truth == Projection::Additive)
        {
          const double length = (end - begin) * vtkMath::Norm(direction.data());
          shown = std::min(1.0, length / 3.0 * (s0 * s0 + s0 * s1 + s1 * s1) / 3.0);
          return std::array<double, 4>{ shown, shown, shown, 1.0 };
        }
        shown = mode.Truth == Projection::Maximum ? std::max(s0, s1) : shown;
        shown = mode.Truth == Projection::Minimum ? std::min(s0, s1) : shown;
        return std::array<double, 4>{ shown, shown, shown, shown };
      },
      mode.Name);
  }
}

TEST(TetrahedraRayCastProjections, CurvedFieldsAndHoles)
{
  for (const bool hollow : { false, true })
  {
    const Grid grid = MakeBlock(9, WavyField(3.0), hollow ? Shell(0.5, 0.95) : Region());
    for (const ProjectionMode& mode : ProjectionModes)
    {
      for (const FunctionKind kind : { FunctionKind::Smooth, FunctionKind::Peaked })
      {
        RayCastScene scene(grid, MakeProperty(kind, grid, 3.4), Size, Size);
        scene.GetRayCaster()->SetBlendMode(mode.Number);
        LookAt(scene.GetRenderer(), grid->GetBounds(), 30.0, 20.0, 1.0, hollow);
        ExpectReference(scene, mode,
          std::string(mode.Name) + (hollow ? ", shell" : ", block") +
            (kind == FunctionKind::Smooth ? ", smooth" : ", peaked"));
      }
    }
  }
}

TEST(TetrahedraRayCastProjections, ScaledAndMirroredVolume)
{
  const Grid grid = MakeBlock(6, WavyField(3.0));
  for (const ProjectionMode& mode : ProjectionModes)
  {
    RayCastScene scene(grid, MakeProperty(FunctionKind::Smooth, grid, 3.4), Size, Size);
    scene.GetRayCaster()->SetBlendMode(mode.Number);
    scene.GetVolume()->SetScale(-0.8, 1.4, 1.0);
    LookAt(scene.GetRenderer(), scene.GetVolume()->GetBounds(), 30.0, 20.0);
    ExpectReference(scene, mode, mode.Name);
  }
}

TEST(TetrahedraRayCastProjections, UnknownModeWarnsAndComposites)
{
  const Grid grid = MakeBlock(3, WavyField(3.0));
  const double range[2] = { -1.0, 1.0 };
  for (const int mode : { -1, int(vtkVolumeMapper::SLICE_BLEND), 77 })
  {
    RayCastScene scene(grid, MakeProperty(FunctionKind::Smooth, range, 3.4), Size, Size);
    scene.GetRayCaster()->SetBlendMode(mode);
    const auto warnings = ObserveErrors(scene.GetRayCaster());
    ExpectMatchesReference(scene, "mode " + std::to_string(mode));
    EXPECT_EQ(warnings->Warnings.size(), 1u);
  }
}

TEST(TetrahedraRayCastProjections, ModesCanBeSwitched)
{
  // With composite blending again, opacity is an attenuation.
  const Grid grid = MakeBlock(4, WavyField(3.0));
  RayCastScene scene(grid, MakeProperty(FunctionKind::Smooth, grid, 3.4), Size, Size);
  const FloatImage first = scene.RenderFloat();
  for (const ProjectionMode& mode : ProjectionModes)
  {
    scene.GetRayCaster()->SetBlendMode(mode.Number);
    ExpectReference(scene, mode, mode.Name);
  }
  scene.GetRayCaster()->SetBlendModeToComposite();
  EXPECT_EQ(scene.RenderFloat().Rgba, first.Rgba);
  EXPECT_EQ(scene.GetRayCaster()->GetNumberOfMeshBuilds(), 1);
  EXPECT_EQ(scene.GetRayCaster()->GetNumberOfScalarUpdates(), 1);
}

TEST(TetrahedraRayCastProjections, EveryModeWalksTheSameCells)
{
  const Grid grid = MakeBlock(6, WavyField(3.0), Torus(0.6, 0.3));
  const double range[2] = { -1.0, 1.0 };
  RayCastScene scene(grid, MakeProperty(FunctionKind::Smooth, range, 3.4), Size, Size);
  scene.GetRayCaster()->SetEarlyTerminationOpacity(1.0);
  scene.GetWindow()->Render();
  const vtkTypeInt64 steps = scene.GetRayCaster()->GetNumberOfTraversalSteps();
  EXPECT_GT(steps, 0);
  // All scalars are visible with this function, so no cell is skipped.
  EXPECT_EQ(scene.GetRayCaster()->GetNumberOfActiveCells(), grid->GetNumberOfCells());
  for (const ProjectionMode& mode : ProjectionModes)
  {
    scene.GetRayCaster()->SetBlendMode(mode.Number);
    scene.GetWindow()->Render();
    EXPECT_EQ(scene.GetRayCaster()->GetNumberOfTraversalSteps(), steps) << mode.Name;
    EXPECT_EQ(scene.GetRayCaster()->GetNumberOfLostRays(), 0) << mode.Name;
  }
}

TEST(TetrahedraRayCastProjections, SkipOnlyWhatTheModeCannotShow)
{
  const Grid grid = MakeBlock(8, LinearField(1.0, 0.0, 0.0));
  const double range[2] = { -1.0, 1.0 };
  auto property = MakeProperty(FunctionKind::Sparse, range, 3.4);
  property->GetIsoSurfaceValues()->SetValue(0, 0.1);
  RayCastScene scene(grid, property, Size, Size);
  scene.GetWindow()->Render();
  EXPECT_LT(scene.GetRayCaster()->GetNumberOfActiveCells(), grid->GetNumberOfCells() / 2);
  for (const ProjectionMode& mode : ProjectionModes)
  {
    scene.GetRayCaster()->SetBlendMode(mode.Number);
    scene.GetWindow()->Render();
    EXPECT_EQ(scene.GetRayCaster()->GetNumberOfActiveCells(), grid->GetNumberOfCells())
      << mode.Name;
  }
  // x = 0.1 runs through one of 8 layers.
  scene.GetRayCaster()->SetBlendMode(vtkVolumeMapper::ISOSURFACE_BLEND);
  scene.GetWindow()->Render();
  EXPECT_LE(scene.GetRayCaster()->GetNumberOfActiveCells(), grid->GetNumberOfCells() / 8);
  EXPECT_GT(scene.GetRayCaster()->GetNumberOfActiveCells(), 0);
}
