// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Two volumes of one renderer: VTK draws them in the order of addition. Sorted from back to front
// by the renderer's culler, those that do not overlap show the same picture as one input of blocks.
#include "RayCastScene.h"

#include <vtkCullerCollection.h>
#include <vtkFrustumCoverageCuller.h>

using namespace meniscus::test;

namespace
{

constexpr int Size = 96;
constexpr double Bounds[6] = { -1.0, 1.0, -1.0, 1.0, -2.0, 2.0 };
constexpr double Range[2] = { -1.5, 1.5 };

Grid MakeBlockAt(double depth)
{
  const Grid grid = MakeBlock(3, WavyField(2.0 + depth));
  TransformPoints(grid, { 0.0, 0.0, depth }, 0.8);
  return grid;
}

/** Picture of two volumes, added in an order, from the front or from the back. */
FloatImage DrawTwo(bool frontFirst, bool fromBack, bool isSorted)
{
  const auto property = MakeProperty(FunctionKind::Smooth, Range, 0.5);
  const Grid grids[2] = { MakeBlockAt(1.2), MakeBlockAt(-1.2) };
  RayCastScene scene(grids[frontFirst ? 0 : 1], property, Size, Size);
  vtkNew<vtkTetrahedraRayCastMapper> mapper;
  mapper->SetBackend(BackendUnderTest());
  mapper->SetInputData(grids[frontFirst ? 1 : 0]);
  vtkNew<vtkVolume> volume;
  volume->SetMapper(mapper);
  volume->SetProperty(property);
  scene.GetRenderer()->AddVolume(volume);
  if (isSorted)
  {
    auto* culler =
      vtkFrustumCoverageCuller::SafeDownCast(scene.GetRenderer()->GetCullers()->GetItemAsObject(0));
    culler->SetSortingStyleToBackToFront();
  }
  LookAt(scene.GetRenderer(), Bounds, fromBack ? 200.0 : 20.0, 10.0);
  return scene.RenderFloat();
}

FloatImage DrawBlocks(bool fromBack)
{
  RayCastScene scene(nullptr, MakeProperty(FunctionKind::Smooth, Range, 0.5), Size, Size);
  scene.GetRayCaster()->SetInputDataObject(MakeBlocks({ MakeBlockAt(1.2), MakeBlockAt(-1.2) }));
  LookAt(scene.GetRenderer(), Bounds, fromBack ? 200.0 : 20.0, 10.0);
  return scene.RenderFloat();
}

float Difference(const FloatImage& a, const FloatImage& b)
{
  float difference = 0.0f;
  for (std::size_t i = 0; i < a.Rgba.size(); ++i)
  {
    difference = std::max(difference, std::abs(a.Rgba[i] - b.Rgba[i]));
  }
  return difference;
}

} // anonymous namespace

TEST(TetrahedraRayCastTwoVolumes, SortedByTheCuller)
{
  for (const bool fromBack : { false, true })
  {
    const FloatImage expected = DrawBlocks(fromBack);
    for (const bool frontFirst : { false, true })
    {
      EXPECT_LE(Difference(DrawTwo(frontFirst, fromBack, true), expected), 1.0e-4f)
        << "front first: " << frontFirst << ", from the back: " << fromBack;
    }
    // Without, only one of the orders is right.
    EXPECT_LE(Difference(DrawTwo(fromBack, fromBack, false), expected), 1.0e-4f);
    EXPECT_GT(Difference(DrawTwo(!fromBack, fromBack, false), expected), 0.1f);
  }
}
