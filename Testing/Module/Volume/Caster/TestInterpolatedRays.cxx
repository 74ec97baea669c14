// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Rays that are interpolated between others: where they may be, and what that changes.
#include "KernelMeshes.h"
#include "KernelPicture.h"

#include "Volume/Caster/InterpolatedRays.h"

#include <cmath>
#include <random>

using namespace meniscus;
using namespace meniscus::test;

namespace
{

/** Pixels along a side: four tiles. */
constexpr int Size = 64;
/** Attenuation per unit of length. */
constexpr double Attenuation = 0.7;
/** Rounding of some 20 segments, and of interpolation. */
constexpr double Rounding = 3e-6;
/** Error of a crease or a step, as the largest of three colours whose quadratic mean it is. */
const double LargestError = 0.5 * LargestInterpolatedDifference * std::sqrt(3.0);

/** Rays along z over a square of half side `extent` about the middle of the unit square. */
PictureScene MakeScene(const MeshArrays& arrays, double extent)
{
  PictureScene scene;
  scene.Mesh.Build(arrays.View());
  scene.Intervals = ConstantFunction(Attenuation);
  scene.Scalars.assign(scene.Mesh.GetSourcePoints().size(), 0.0f);
  scene.Frame = FrameAlongZ(scene.Mesh, extent, Size);
  return scene;
}

Picture CastAll(PictureScene& scene, InstructionSet set, const std::vector<float>& depths)
{
  scene.Optics.Interpolating = false;
  Picture picture = CastPicture(scene, Size, set, depths);
  EXPECT_EQ(picture.Statistics.Interpolated, 0);
  return picture;
}

Picture CastSome(PictureScene& scene, InstructionSet set, const std::vector<float>& depths)
{
  scene.Optics.Interpolating = true;
  return CastPicture(scene, Size, set, depths);
}

std::vector<float> NoDepths()
{
  return std::vector<float>(std::size_t{ Size } * Size, 1.0f);
}

/** Expects colours that differ by so much at most, and colours in the same pixels. */
void ExpectAlike(const Picture& a, const Picture& b, double tolerance)
{
  EXPECT_EQ(a.Statistics.Rays, b.Statistics.Rays);
  double largest = 0.0;
  for (std::size_t i = 0; i < a.Rgba.size(); ++i)
  {
    largest = std::max(largest, std::abs(double{ a.Rgba[i] } - double{ b.Rgba[i] }));
    ASSERT_EQ(a.Rgba[i] == 0.0f, b.Rgba[i] == 0.0f) << i;
  }
  EXPECT_LE(largest, tolerance);
}

class InterpolatedRaysTest : public ::testing::TestWithParam<InstructionSet>
{
};

INSTANTIATE_TEST_SUITE_P(
  Sets, InterpolatedRaysTest, ::testing::ValuesIn(GetInstructionSets()), TestNameOf);

}

// Squares of 8 rays have 9 x 9 rays in a tile of 32 x 32: no other one is needed in a field whose
// chords are all 1.
TEST_P(InterpolatedRaysTest, EqualRaysAreCastOncePerQuarter)
{
  PictureScene scene = MakeScene(KuhnGrid(3), 0.5);
  const Picture picture = CastSome(scene, GetParam(), NoDepths());
  EXPECT_EQ(picture.Statistics.Rays, Size * Size);
  EXPECT_EQ(picture.Statistics.Interpolated, Size * Size - 4 * 9 * 9);
  for (const auto& [row, column] : Product(Size, Size))
  {
    ASSERT_NEAR(picture.Alpha(column, row), 1.0 - std::exp(-Attenuation), Rounding)
      << column << ", " << row;
  }
}

// The box covers pixels 11 to 52 of each row, and a bar in front of it the columns 26 and 27, which
// no square of rays four apart has: rays that enter the mesh twice there show where it is.
TEST_P(InterpolatedRaysTest, SilhouettesAreCast)
{
  const double extent = 0.5 * Size / 42.0;
  const double pixel = 1.0 / 42.0;
  const MeshArrays bar = Moved(KuhnGrid(2),
    [&](const glm::dvec3& p)
    { return glm::dvec3((15.0 + 2.0 * p.x) * pixel, p.y, 2.0 + 0.5 * p.z); });
  PictureScene scene = MakeScene(Joined(KuhnGrid(3), bar), extent);
  const Picture picture = CastSome(scene, GetParam(), NoDepths());
  EXPECT_EQ(picture.Statistics.Rays, 42 * 42);
  EXPECT_GT(picture.Statistics.Interpolated, 42 * 42 / 4);
  for (const auto& [row, column] : Product(Size, Size))
  {
    const bool inside = std::abs(column - 31.5) < 21.0 && std::abs(row - 31.5) < 21.0;
    const bool behind = column == 26 || column == 27;
    const double length = inside ? (behind ? 1.5 : 1.0) : 0.0;
    ASSERT_NEAR(picture.Alpha(column, row), 1.0 - std::exp(-Attenuation * length), Rounding)
      << column << ", " << row;
  }
}

// An opaque object in a single pixel is between rays that are cast. One behind the mesh divides no
// square.
TEST_P(InterpolatedRaysTest, EdgesOfOpaqueObjectsAreCast)
{
  PictureScene scene = MakeScene(KuhnGrid(3), 0.5);
  const RayFrame& frame = scene.Frame;
  const auto windowDepthAt = [&frame](double share)
  {
    // Rays along z: window depths are affine in the depth.
    const double first = frame.DepthAt(-1.0);
    const double wanted = share * frame.Reach;
    const double perWindow = frame.DepthAt(0.0) - first;
    return static_cast<float>(0.5 * (wanted - first) / perWindow);
  };
  std::vector<float> depths = NoDepths();
  depths[std::size_t{ 21 } * Size + 42] = windowDepthAt(0.0);
  const Picture truth = CastAll(scene, GetParam(), depths);
  EXPECT_LT(truth.Alpha(42, 21), 0.9f * truth.Alpha(41, 21));
  const Picture picture = CastSome(scene, GetParam(), depths);
  EXPECT_GT(picture.Statistics.Interpolated, Size * Size / 2);
  EXPECT_LT(picture.Statistics.Interpolated, Size * Size - 4 * 9 * 9);
  ExpectAlike(picture, truth, Rounding);
  depths[std::size_t{ 21 } * Size + 42] = windowDepthAt(1.0001);
  EXPECT_EQ(CastSome(scene, GetParam(), depths).Statistics.Interpolated, Size * Size - 4 * 9 * 9);
}

// The chords of a pyramid have creases, along its edges, at all angles to the squares.
TEST_P(InterpolatedRaysTest, CreasesAreWithinTheTolerance)
{
  for (const double height : { 0.1, 0.3, 1.0 })
  {
    const MeshArrays pyramid = Moved(KuhnGrid(6),
      [height](const glm::dvec3& p)
      {
        const glm::dvec2 out = glm::abs(glm::dvec2(p) - 0.5);
        const double turned = std::max(out.x, out.y);
        return glm::dvec3(
          p.x + 0.2 * (p.y - 0.5), p.y - 0.2 * (p.x - 0.5), p.z * (0.2 + height * (0.5 - turned)));
      });
    PictureScene scene = MakeScene(pyramid, 0.7);
    const Picture truth = CastAll(scene, GetParam(), NoDepths());
    const Picture picture = CastSome(scene, GetParam(), NoDepths());
    EXPECT_GT(picture.Statistics.Interpolated, truth.Statistics.Rays / 10) << height;
    EXPECT_LT(picture.Statistics.Steps, truth.Statistics.Steps * 19 / 20) << height;
    ExpectAlike(picture, truth, LargestError);
  }
}

// Details of a few pixels: every ray is cast.
TEST_P(InterpolatedRaysTest, RaysOfANoisyFieldAreCast)
{
  PictureScene scene = MakeScene(KuhnGrid(24), 0.5);
  std::mt19937 engine(11);
  std::uniform_real_distribution<float> random(0.0f, 1.0f);
  for (float& scalar : scene.Scalars)
  {
    scalar = random(engine);
  }
  scene.Intervals = { { 0.0f, 1.0f, 0.0f, 10.0f, glm::vec3(1.0f), glm::vec3(-1.0f) } };
  const Picture truth = CastAll(scene, GetParam(), NoDepths());
  const Picture picture = CastSome(scene, GetParam(), NoDepths());
  EXPECT_LT(picture.Statistics.Interpolated, Size * Size / 100);
  ExpectAlike(picture, truth, LargestError);
}

TEST_P(InterpolatedRaysTest, RaysOfIsosurfacesAreCast)
{
  PictureScene scene = MakeScene(KuhnGrid(3), 0.5);
  scene.Optics.Blending = BlendMode::Isosurfaces;
  EXPECT_EQ(CastSome(scene, GetParam(), NoDepths()).Statistics.Interpolated, 0);
}
