// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Images with a closed form: the length of a ray in a box, and a constant or a linear medium in it.
#include "RayCastScene.h"

using namespace meniscus::test;
using namespace meniscus::reference;

namespace
{

constexpr int Size = 100;

// A ray in the coordinates of the box [-1, 1]^3, with its entry and exit.
struct BoxHit
{
  Vector3 Origin;
  Vector3 Direction;
  double Begin;
  double End;
  double WorldLength;
};

BoxHit HitBox(const Ray& ray, vtkMatrix4x4* toData)
{
  double origin[4] = { ray.Origin[0], ray.Origin[1], ray.Origin[2], 1.0 };
  double direction[4] = { ray.Direction[0], ray.Direction[1], ray.Direction[2], 0.0 };
  toData->MultiplyPoint(origin, origin);
  toData->MultiplyPoint(direction, direction);
  BoxHit hit{ {}, {}, ray.Begin, ray.End, 0.0 };
  for (int axis = 0; axis < 3; ++axis)
  {
    hit.Origin[axis] = origin[axis];
    hit.Direction[axis] = direction[axis];
    const double a = (-1.0 - origin[axis]) / direction[axis];
    const double b = (1.0 - origin[axis]) / direction[axis];
    hit.Begin = std::max(hit.Begin, std::min(a, b));
    hit.End = std::min(hit.End, std::max(a, b));
  }
  hit.WorldLength = std::max(0.0, hit.End - hit.Begin) * vtkMath::Norm(ray.Direction.data());
  return hit;
}

// Renders the box and compares alpha and colour (white emission) with a closed form of alpha.
void ExpectClosedForm(
  RayCastScene& scene, const std::string& what, const std::function<double(const BoxHit&)>& alphaOf)
{
  scene.GetVolume()->ComputeMatrix();
  vtkNew<vtkMatrix4x4> toData;
  vtkMatrix4x4::Invert(scene.GetVolume()->GetMatrix(), toData);
  const FloatImage image = scene.RenderFloat();
  const PixelRays rays(scene.GetRenderer());
  double largest = 0.0;
  std::size_t covered = 0;
  for (const auto& [y, x] : Product(image.Height, image.Width))
  {
    const double alpha = alphaOf(HitBox(rays.GetRay(x, y), toData));
    covered += alpha > 0.0;
    for (int c = 0; c < 4; ++c)
    {
      largest = std::max(largest, std::fabs(image.GetPixel(x, y)[c] - alpha));
    }
  }
  EXPECT_GT(covered, 1000u) << what;
  EXPECT_LE(largest, FloatTolerance) << what;
  EXPECT_EQ(scene.GetRayCaster()->GetNumberOfLostRays(), 0) << what;
}

struct Placement
{
  const char* Name;
  double Scale[3];
  double Angle;
};

const std::vector<Placement> Placements{ { "identity", { 1, 1, 1 }, 0 },
  { "rotated", { 1, 1, 1 }, 37 }, { "scaled", { 2.5, 2.5, 2.5 }, 0 },
  { "mirrored", { -1, 1, 1 }, 20 }, { "anisotropic", { 0.3, 2.0, 1.0 }, 15 } };

void MakePlace(RayCastScene& scene, const Placement& placement, bool parallel = false)
{
  scene.GetVolume()->SetScale(placement.Scale[0], placement.Scale[1], placement.Scale[2]);
  scene.GetVolume()->RotateWXYZ(placement.Angle, 0.3, 1.0, 0.2);
  scene.GetVolume()->SetPosition(0.4, -0.2, 0.1);
  LookAt(scene.GetRenderer(), scene.GetVolume()->GetBounds(), 33.0, 21.0, 1.2, parallel);
}

} // anonymous namespace

TEST(TetrahedraRayCastClosedForm, ConstantFieldAsAttenuationCoefficient)
{
  const Grid grid = MakeBlock(4, ConstantField(0.5));
  for (const double opacity : { 0.05, 0.6, 1.0 })
  {
    for (const double unit : { 0.25, 1.0, 4.0 })
    {
      RayCastScene scene(grid, MakeConstantProperty(opacity, 1, 1, 1, unit), Size, Size);
      MakePlace(scene, Placements[0]);
      ExpectClosedForm(scene,
        "opacity " + std::to_string(opacity) + " unit " + std::to_string(unit),
        [=](const BoxHit& hit) { return -std::expm1(-hit.WorldLength * opacity / unit); });
    }
  }
}

TEST(TetrahedraRayCastClosedForm, ConstantFieldAsOpacityPerUnitDistance)
{
  const Grid grid = MakeBlock(4, ConstantField(0.5));
  for (const double opacity : { 0.05, 0.6, 0.95 })
  {
    RayCastScene scene(grid, MakeConstantProperty(opacity, 1, 1, 1, 0.7), Size, Size);
    scene.GetRayCaster()->SetOpacityModel(vtkTetrahedraRayCastMapper::OPACITY_PER_UNIT_DISTANCE);
    MakePlace(scene, Placements[0]);
    ExpectClosedForm(scene, "opacity " + std::to_string(opacity),
      [=](const BoxHit& hit) { return 1.0 - std::pow(1.0 - opacity, hit.WorldLength / 0.7); });
  }
}

TEST(TetrahedraRayCastClosedForm, LengthIsMeasuredInWorldCoordinates)
{
  const Grid grid = MakeBlock(3, ConstantField(0.5));
  for (const Placement& placement : Placements)
  {
    for (const bool parallel : { false, true })
    {
      RayCastScene scene(grid, MakeConstantProperty(0.4, 1, 1, 1, 0.8), Size, Size);
      MakePlace(scene, placement, parallel);
      ExpectClosedForm(scene, placement.Name,
        [](const BoxHit& hit) { return -std::expm1(-hit.WorldLength * 0.4 / 0.8); });
    }
  }
}

TEST(TetrahedraRayCastClosedForm, LinearField)
{
  // Attenuation k (s + 2) with s linear: the optical depth is the mean of both ends times the
  // length.
  const Grid grid = MakeBlock(5, LinearField(0.5, 1.0, -0.5));
  auto property = MakeConstantProperty(0.0, 1, 1, 1, 1.5);
  property->SetScalarOpacity(MakeOpacity({ { -2.0, 0.0 }, { 2.0, 1.0 } }));
  for (const Placement& placement : Placements)
  {
    RayCastScene scene(grid, property, Size, Size);
    MakePlace(scene, placement);
    ExpectClosedForm(scene, placement.Name,
      [](const BoxHit& hit)
      {
        const double middle = 0.5 * (hit.Begin + hit.End);
        double scalar = 0.0;
        const double weights[3] = { 0.5, 1.0, -0.5 };
        for (int axis = 0; axis < 3; ++axis)
        {
          scalar += weights[axis] * (hit.Origin[axis] + middle * hit.Direction[axis]);
        }
        return -std::expm1(-hit.WorldLength * 0.25 * (scalar + 2.0) / 1.5);
      });
  }
}

TEST(TetrahedraRayCastClosedForm, TransparentFunctionLeavesTheBackground)
{
  RayCastScene scene(
    MakeBlock(3, RadialField()), MakeConstantProperty(0.0, 1, 1, 1, 1.0), Size, Size);
  MakePlace(scene, Placements[0]);
  for (const float value : scene.RenderFloat().Rgba)
  {
    ASSERT_EQ(value, 0.0f);
  }
}
