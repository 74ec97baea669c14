// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Clipping planes: cells are cut, not left out.
#include "OpticsTruth.h"

#include <vtkPlaneCollection.h>

using namespace meniscus::test;
using namespace meniscus::reference;

namespace
{

constexpr int Size = 100;

const std::vector<HalfSpace> Planes{ { { 0.3, -1.0, 0.2 }, { 0.1, 0.4, 0.0 } },
  { { -2.0, 0.1, 0.7 }, { 0.5, 0.0, 0.1 } }, { { 0.0, 0.0, 0.01 }, { 0.0, 0.0, -0.6 } } };

void Clip(RayCastScene& scene, const std::vector<HalfSpace>& halfSpaces)
{
  for (const HalfSpace& half : halfSpaces)
  {
    AddClippingPlane(scene.GetRayCaster(), half);
  }
}

// Length of a ray in the box [-1, 1]^3.
double LengthInBox(const Ray& ray)
{
  const Ray inside = ClipToCube(ray);
  return std::max(0.0, inside.End - inside.Begin) * vtkMath::Norm(ray.Direction.data());
}

void ExpectReference(
  RayCastScene& scene, const std::vector<HalfSpace>& halfSpaces, const std::string& what)
{
  scene.GetWindow()->Render();
  const auto integrator = MakeReference(scene.MakeGrid(), scene.GetVolume()->GetMatrix());
  const auto function = ToReference(scene.GetVolume()->GetProperty());
  ExpectTrace(
    scene,
    [&](const Ray& ray)
    {
      const Ray clipped = ClipRay(ray, halfSpaces);
      return clipped.Begin < clipped.End ? integrator->Trace(clipped, function)
                                         : std::array<double, 4>{ 0.0, 0.0, 0.0, 0.0 };
    },
    what);
}

} // anonymous namespace

TEST(TetrahedraRayCastClipping, ConstantMediumInACutBox)
{
  const Grid grid = MakeBlock(4, ConstantField(0.5));
  for (const bool parallel : { false, true })
  {
    for (std::size_t count = 1; count <= Planes.size(); ++count)
    {
      const std::vector<HalfSpace> planes(
        Planes.begin(), Planes.begin() + static_cast<long>(count));
      RayCastScene scene(grid, MakeConstantProperty(0.7, 1, 1, 1, 0.8), Size, Size);
      Clip(scene, planes);
      LookAt(scene.GetRenderer(), grid->GetBounds(), 33.0, 21.0, 1.2, parallel);
      ExpectTrace(
        scene,
        [&planes](const Ray& ray)
        {
          const double alpha = -std::expm1(-LengthInBox(ClipRay(ray, planes)) * 0.7 / 0.8);
          return std::array<double, 4>{ alpha, alpha, alpha, alpha };
        },
        std::to_string(count) + (parallel ? " planes, parallel" : " planes, perspective"));
    }
  }
}

TEST(TetrahedraRayCastClipping, CellsAreCutExactly)
{
  const Grid grid = MakeBlock(8, WavyField(3.0), Torus(0.6, 0.3));
  const double range[2] = { -1.0, 1.0 };
  for (const FunctionKind kind : { FunctionKind::Smooth, FunctionKind::Peaked })
  {
    RayCastScene scene(grid, MakeProperty(kind, range, 3.4), Size, Size);
    Clip(scene, Planes);
    ExpectReference(scene, Planes, "torus");
  }
}

TEST(TetrahedraRayCastClipping, PlanesAreInWorldCoordinates)
{
  const Grid grid = MakeBlock(6, WavyField(3.0));
  const double range[2] = { -1.0, 1.0 };
  RayCastScene scene(grid, MakeProperty(FunctionKind::Smooth, range, 3.4), Size, Size);
  scene.GetVolume()->SetScale(-0.8, 1.4, 1.0);
  scene.GetVolume()->RotateWXYZ(31.0, 0.3, 1.0, 0.2);
  scene.GetVolume()->SetPosition(0.2, -0.1, 0.3);
  Clip(scene, Planes);
  LookAt(scene.GetRenderer(), scene.GetVolume()->GetBounds(), 30.0, 20.0);
  ExpectReference(scene, Planes, "transformed volume");
}

TEST(TetrahedraRayCastClipping, CameraInsideAndPlanesThroughIt)
{
  const Grid grid = MakeBlock(6, WavyField(3.0));
  const double range[2] = { -1.0, 1.0 };
  RayCastScene scene(grid, MakeProperty(FunctionKind::Smooth, range, 3.4), Size, Size);
  const std::vector<HalfSpace> planes{ { { 0.0, 1.0, 0.3 }, { 0.1, 0.1, 0.0 } },
    { { 1.0, 0.0, 0.0 }, { 0.4, 0.0, 0.0 } } };
  Clip(scene, planes);
  vtkCamera* camera = scene.GetRenderer()->GetActiveCamera();
  camera->SetPosition(0.1, 0.1, 0.0);
  camera->SetFocalPoint(1.0, 0.5, -0.3);
  camera->SetViewUp(0.0, 0.0, 1.0);
  camera->SetViewAngle(70.0);
  camera->SetClippingRange(0.001, 10.0);
  ExpectReference(scene, planes, "camera inside");
}

TEST(TetrahedraRayCastClipping, RaysInThePlanes)
{
  // Half of an aligned block, seen along the plane that halves it, through faces and edges.
  const Grid grid = MakeBlock(4, ConstantField(0.5));
  const std::vector<HalfSpace> planes{ { { 1.0, 0.0, 0.0 }, { 0.0, 0.0, 0.0 } } };
  RayCastScene scene(grid, MakeConstantProperty(0.7, 1, 1, 1, 0.8), Size + 1, Size + 1);
  Clip(scene, planes);
  LookAlongAxis(scene.GetRenderer(), grid->GetBounds(), 2);
  const FloatImage image = scene.RenderFloat();
  const PixelRays rays(scene.GetRenderer());
  const double inside = -std::expm1(-2.0 * 0.7 / 0.8);
  for (const auto& [y, x] : Product(image.Height, image.Width))
  {
    const Ray ray = rays.GetRay(x, y);
    const bool met = std::fabs(ray.Origin[0]) < 0.999 && std::fabs(ray.Origin[1]) < 0.999;
    if (met && std::fabs(ray.Origin[0]) > 1e-6)
    {
      ASSERT_NEAR(image.GetPixel(x, y)[3], ray.Origin[0] > 0.0 ? inside : 0.0, FloatTolerance);
    }
    else if (met)
    {
      // In the plane: either one side or the other.
      const double alpha = image.GetPixel(x, y)[3];
      ASSERT_TRUE(std::fabs(alpha - inside) < FloatTolerance || alpha == 0.0) << alpha;
    }
  }
}

TEST(TetrahedraRayCastClipping, NothingIsLeft)
{
  const Grid grid = MakeBlock(4, ConstantField(0.5));
  RayCastScene scene(grid, MakeConstantProperty(0.7, 1, 1, 1, 0.8), Size, Size);
  Clip(
    scene, { { { 1.0, 0.0, 0.0 }, { 0.2, 0.0, 0.0 } }, { { -1.0, 0.0, 0.0 }, { 0.1, 0.0, 0.0 } } });
  LookAt(scene.GetRenderer(), grid->GetBounds(), 33.0, 21.0);
  for (const float value : scene.RenderFloat().Rgba)
  {
    ASSERT_EQ(value, 0.0f);
  }
  // Rays without a visible part take no step.
  EXPECT_EQ(scene.GetRayCaster()->GetNumberOfTraversalSteps(), 0);
}

TEST(TetrahedraRayCastClipping, TooManyPlanesAreAnError)
{
  const Grid grid = MakeBlock(2, ConstantField(0.5));
  RayCastScene scene(grid, MakeConstantProperty(0.7, 1, 1, 1, 0.8), Size, Size);
  Clip(scene, std::vector<HalfSpace>(33, Planes[0]));
  LookAt(scene.GetRenderer(), grid->GetBounds(), 33.0, 21.0);
  const auto errors = ObserveErrors(scene.GetRayCaster());
  const ByteImage image = scene.RenderBytes();
  EXPECT_TRUE(HasText(errors->GetText(), "33 clipping planes"));
  EXPECT_EQ(*std::max_element(image.Rgb.begin(), image.Rgb.end()), 0);
}
