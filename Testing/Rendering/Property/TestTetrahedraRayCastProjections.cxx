// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Maximum, minimum, average and additive blending.
#include "OpticsTruth.h"

#include <vtkContourValues.h>
#include <vtkDataArray.h>
#include <vtkPiecewiseFunction.h>
#include <vtkPlane.h>
#include <vtkPointData.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkUnstructuredGrid.h>
#include <vtkVolume.h>
#include <vtkVolumeMapper.h>
#include <vtkVolumeProperty.h>

#include <algorithm>
#include <cmath>

using namespace meniscus::test;
using meniscus::reference::Projection;
using meniscus::reference::Ray;
using meniscus::reference::RaySegment;

namespace
{

constexpr int Size = 160;

const std::vector<std::pair<int, Projection>> Modes{ { vtkVolumeMapper::MAXIMUM_INTENSITY_BLEND,
                                                       Projection::Maximum },
  { vtkVolumeMapper::MINIMUM_INTENSITY_BLEND, Projection::Minimum },
  { vtkVolumeMapper::AVERAGE_INTENSITY_BLEND, Projection::Average },
  { vtkVolumeMapper::ADDITIVE_BLEND, Projection::Additive } };

TracedComparison expectReference(RayCastScene& scene, Projection projection,
  const std::string& what, double tolerance = FloatTolerance)
{
  scene.window()->Render();
  const auto integrator = makeReference(scene.grid(), scene.volume()->GetMatrix());
  vtkVolumeProperty* property = scene.volume()->GetProperty();
  const auto function =
    projection == Projection::Additive ? toReference(property) : toAlphas(property);
  double range[2];
  scene.grid()->GetPointData()->GetScalars()->GetFiniteRange(range);
  return expectTrace(
    scene,
    [&](const Ray& ray)
    {
      std::vector<RaySegment> segments;
      integrator->findSegments(ray, segments);
      return meniscus::reference::project(ray, segments, projection, function, range);
    },
    what, tolerance);
}

// Attenuation (alpha) equal to s over the range [0, 1] of s.
vtkSmartPointer<vtkVolumeProperty> identityProperty(double unit)
{
  auto property = makeConstantProperty(0.0, 1, 1, 1, unit);
  vtkNew<vtkPiecewiseFunction> opacity;
  opacity->AddPoint(0.0, 0.0);
  opacity->AddPoint(1.0, 1.0);
  property->SetScalarOpacity(opacity);
  return property;
}

} // anonymous namespace

TEST(TetrahedraRayCastProjections, LinearFieldInABox)
{
  // s from 0 to 1 along x + y; white with alpha s.
  const auto field = [](double x, double y, double) { return 0.5 + 0.25 * (x + y); };
  const Grid grid = makeBlock(5, field);
  for (const auto& mode : Modes)
  {
    RayCastScene scene(grid, identityProperty(3.0), Size, Size);
    scene.rayCaster()->SetBlendMode(mode.first);
    lookAt(scene.renderer(), grid->GetBounds(), 33.0, 21.0, 1.2);
    expectTrace(
      scene,
      [&](const Ray& ray)
      {
        double begin = ray.Begin;
        double end = ray.End;
        for (int axis = 0; axis < 3; ++axis)
        {
          const double a = (-1.0 - ray.Origin[axis]) / ray.Direction[axis];
          const double b = (1.0 - ray.Origin[axis]) / ray.Direction[axis];
          begin = std::max(begin, std::min(a, b));
          end = std::min(end, std::max(a, b));
        }
        if (begin >= end)
        {
          return std::array<double, 4>{ 0.0, 0.0, 0.0, 0.0 };
        }
        const auto at = [&](double t) {
          return field(
            ray.Origin[0] + t * ray.Direction[0], ray.Origin[1] + t * ray.Direction[1], 0.0);
        };
        const double s0 = at(begin);
        const double s1 = at(end);
        double shown = 0.5 * (s0 + s1);
        if (mode.second == Projection::Additive)
        {
          const double length = (end - begin) *
            std::sqrt(ray.Direction[0] * ray.Direction[0] + ray.Direction[1] * ray.Direction[1] +
              ray.Direction[2] * ray.Direction[2]);
          shown = std::min(1.0, length / 3.0 * (s0 * s0 + s0 * s1 + s1 * s1) / 3.0);
          return std::array<double, 4>{ shown, shown, shown, 1.0 };
        }
        shown = mode.second == Projection::Maximum ? std::max(s0, s1) : shown;
        shown = mode.second == Projection::Minimum ? std::min(s0, s1) : shown;
        return std::array<double, 4>{ shown, shown, shown, shown };
      },
      "mode " + std::to_string(mode.first));
  }
}

TEST(TetrahedraRayCastProjections, CurvedFieldsAndHoles)
{
  for (const bool hollow : { false, true })
  {
    const Grid grid = makeBlock(9, wavyField(3.0), hollow ? shell(0.5, 0.95) : Region());
    double range[2];
    grid->GetPointData()->GetScalars()->GetFiniteRange(range);
    for (const auto& mode : Modes)
    {
      for (const FunctionKind kind : { FunctionKind::Smooth, FunctionKind::Peaked })
      {
        RayCastScene scene(grid, makeProperty(kind, range, 3.4), Size, Size);
        scene.rayCaster()->SetBlendMode(mode.first);
        lookAt(scene.renderer(), grid->GetBounds(), 30.0, 20.0, 1.0, hollow);
        expectReference(scene, mode.second,
          "mode " + std::to_string(mode.first) + (hollow ? ", shell" : ", block") +
            (kind == FunctionKind::Smooth ? ", smooth" : ", peaked"));
      }
    }
  }
}

TEST(TetrahedraRayCastProjections, ScaledAndMirroredVolume)
{
  const Grid grid = makeBlock(6, wavyField(3.0));
  double range[2];
  grid->GetPointData()->GetScalars()->GetFiniteRange(range);
  for (const auto& mode : Modes)
  {
    RayCastScene scene(grid, makeProperty(FunctionKind::Smooth, range, 3.4), Size, Size);
    scene.rayCaster()->SetBlendMode(mode.first);
    scene.volume()->SetScale(-0.8, 1.4, 1.0);
    lookAt(scene.renderer(), scene.volume()->GetBounds(), 30.0, 20.0);
    expectReference(scene, mode.second, "mode " + std::to_string(mode.first));
  }
}

TEST(TetrahedraRayCastProjections, UnknownModeWarnsAndComposites)
{
  const Grid grid = makeBlock(3, wavyField(3.0));
  const double range[2] = { -1.0, 1.0 };
  for (const int mode : { -1, int(vtkVolumeMapper::SLICE_BLEND), 77 })
  {
    RayCastScene scene(grid, makeProperty(FunctionKind::Smooth, range, 3.4), Size, Size);
    scene.rayCaster()->SetBlendMode(mode);
    const auto warnings = vtkSmartPointer<ErrorObserver>::Take(ErrorObserver::New());
    warnings->observe(scene.rayCaster());
    lookAt(scene.renderer(), grid->GetBounds(), 30.0, 20.0);
    expectMatchesReference(scene, "mode " + std::to_string(mode));
    EXPECT_EQ(warnings->Warnings.size(), 1u);
  }
}

TEST(TetrahedraRayCastProjections, ModesCanBeSwitched)
{
  // With composite blending again, opacity is an attenuation.
  const Grid grid = makeBlock(4, wavyField(3.0));
  double range[2];
  grid->GetPointData()->GetScalars()->GetFiniteRange(range);
  RayCastScene scene(grid, makeProperty(FunctionKind::Smooth, range, 3.4), Size, Size);
  lookAt(scene.renderer(), grid->GetBounds(), 30.0, 20.0);
  const FloatImage first = scene.renderFloat();
  for (const auto& mode : Modes)
  {
    scene.rayCaster()->SetBlendMode(mode.first);
    expectReference(scene, mode.second, "mode " + std::to_string(mode.first));
  }
  scene.rayCaster()->SetBlendModeToComposite();
  EXPECT_EQ(scene.renderFloat().Rgba, first.Rgba);
  EXPECT_EQ(scene.rayCaster()->GetNumberOfMeshBuilds(), 1);
  EXPECT_EQ(scene.rayCaster()->GetNumberOfScalarUpdates(), 1);
}

TEST(TetrahedraRayCastProjections, EveryModeWalksTheSameCells)
{
  const Grid grid = makeBlock(6, wavyField(3.0), torus(0.6, 0.3));
  const double range[2] = { -1.0, 1.0 };
  RayCastScene scene(grid, makeProperty(FunctionKind::Smooth, range, 3.4), Size, Size);
  scene.rayCaster()->SetEarlyTerminationOpacity(1.0);
  lookAt(scene.renderer(), grid->GetBounds(), 30.0, 20.0);
  scene.window()->Render();
  const vtkTypeInt64 steps = scene.rayCaster()->GetNumberOfTraversalSteps();
  EXPECT_GT(steps, 0);
  // All scalars are visible with this function, so no cell is skipped.
  EXPECT_EQ(scene.rayCaster()->GetNumberOfActiveCells(), grid->GetNumberOfCells());
  for (const int mode : { 1, 2, 3, 4 })
  {
    scene.rayCaster()->SetBlendMode(mode);
    scene.window()->Render();
    EXPECT_EQ(scene.rayCaster()->GetNumberOfTraversalSteps(), steps) << mode;
    EXPECT_EQ(scene.rayCaster()->GetNumberOfLostRays(), 0) << mode;
  }
}

TEST(TetrahedraRayCastProjections, SkipOnlyWhatTheModeCannotShow)
{
  const Grid grid = makeBlock(8, linearField(1.0, 0.0, 0.0));
  const double range[2] = { -1.0, 1.0 };
  auto property = makeProperty(FunctionKind::Sparse, range, 3.4);
  property->GetIsoSurfaceValues()->SetValue(0, 0.1);
  RayCastScene scene(grid, property, Size, Size);
  lookAt(scene.renderer(), grid->GetBounds(), 30.0, 20.0);
  scene.window()->Render();
  EXPECT_LT(scene.rayCaster()->GetNumberOfActiveCells(), grid->GetNumberOfCells() / 2);
  for (const int mode : { 1, 2, 3, 4 })
  {
    scene.rayCaster()->SetBlendMode(mode);
    scene.window()->Render();
    EXPECT_EQ(scene.rayCaster()->GetNumberOfActiveCells(), grid->GetNumberOfCells()) << mode;
  }
  // x = 0.1 runs through one of 8 layers.
  scene.rayCaster()->SetBlendMode(vtkVolumeMapper::ISOSURFACE_BLEND);
  scene.window()->Render();
  EXPECT_LE(scene.rayCaster()->GetNumberOfActiveCells(), grid->GetNumberOfCells() / 8);
  EXPECT_GT(scene.rayCaster()->GetNumberOfActiveCells(), 0);
}
