// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "KernelMeshes.h"
#include "KernelPicture.h"

using namespace meniscus;
using namespace meniscus::test;

namespace
{

/** The scalar is z, normalised; attenuation and colour are constant. */
PictureScene MakeScene(const MeshArrays& arrays, double attenuation)
{
  PictureScene scene;
  scene.Mesh.Build(arrays.View());
  scene.Intervals = ConstantFunction(attenuation);
  for (const std::int64_t point : scene.Mesh.GetSourcePoints())
  {
    const double z = arrays.PointAt(point).z - scene.Mesh.GetCenter().z;
    scene.Scalars.push_back(static_cast<float>(z / scene.Mesh.GetRadius()));
  }
  return scene;
}

/** A mesh of this size about the origin, with an attenuation of one over it, and a camera before
 * it. */
PictureScene MakeSceneOfSize(double scale)
{
  const MeshArrays arrays =
    Moved(KuhnGrid(2), [scale](const glm::dvec3& p) { return scale * (p - 0.5); });
  PictureScene scene = MakeScene(arrays, 1.0 / scale);
  RayFrameInput input;
  input.WorldToView = glm::translate(glm::dmat4(1.0), glm::dvec3(0.0, 0.0, -10.0 * scale));
  input.ViewToClip = glm::perspective(0.2, 1.0, scale, 30.0 * scale);
  input.Center = scene.Mesh.GetCenter();
  input.Radius = scene.Mesh.GetRadius();
  input.ImageSize = glm::dvec2(64.0);
  EXPECT_EQ(ComputeRayFrame(input, scene.Frame), RayFrameStatus::Ok) << scale;
  return scene;
}

/** Runs each test with every instruction set that this processor supports. */
class PacketWalkTest : public ::testing::TestWithParam<InstructionSet>
{
};

INSTANTIATE_TEST_SUITE_P(
  Sets, PacketWalkTest, ::testing::ValuesIn(GetInstructionSets()), TestNameOf);

}

TEST_P(PacketWalkTest, ConstantFieldGivesTheChord)
{
  PictureScene scene = MakeScene(KuhnGrid(3), 0.7);
  scene.Frame = FrameAlongZ(scene.Mesh, 0.75, 150);
  const Picture picture = CastPicture(scene, 150, GetParam());
  EXPECT_EQ(picture.Statistics.Lost, 0);
  EXPECT_EQ(picture.Statistics.Rays, 100 * 100);
  for (const auto& [j, i] : Product(150, 150))
  {
    const bool inside = std::abs(i - 74.5) < 50.0 && std::abs(j - 74.5) < 50.0;
    ASSERT_NEAR(picture.Alpha(i, j), inside ? 1.0 - std::exp(-0.7) : 0.0, 1e-6) << i << " " << j;
  }
}

TEST_P(PacketWalkTest, RaysThroughVerticesAndEdgesOfAnAlignedGrid)
{
  // Pixels of 1/24 on a grid of 1/4: many rays run along edges and through vertices, all others in
  // planes of faces. A ray on the outer boundary may count as inside or outside, but consistently.
  PictureScene scene = MakeScene(KuhnGrid(4), 1.0);
  scene.Frame = FrameAlongZ(scene.Mesh, 0.5, 24);
  const Picture picture = CastPicture(scene, 25, GetParam());
  EXPECT_EQ(picture.Statistics.Lost, 0);
  const double full = 1.0 - std::exp(-1.0);
  for (const auto& [j, i] : Product(25, 25))
  {
    const bool border = i == 0 || j == 0 || i == 24 || j == 24;
    const float alpha = picture.Alpha(i, j);
    ASSERT_NEAR(alpha, border && alpha < 0.5 * full ? 0.0 : full, 1e-6) << i << " " << j;
  }
}

TEST_P(PacketWalkTest, TangledMeshesEndOnTheBoundary)
{
  for (unsigned int seed = 1; seed <= 5; ++seed)
  {
    MeshArrays arrays = KuhnGrid(8);
    Jitter(arrays, 0.06, seed); // about a fifth of the cells inverted
    PictureScene scene = MakeScene(arrays, 1.0);
    scene.Frame = FrameAlongZ(scene.Mesh, 0.6, 100);
    const Picture picture = CastPicture(scene, 100, GetParam());
    EXPECT_EQ(picture.Statistics.Lost, 0) << "seed " << seed;
    EXPECT_GT(picture.Statistics.Steps, 100000);
    EXPECT_LT(picture.Statistics.Steps, 100 * 100 * 200);
  }
}

TEST_P(PacketWalkTest, TinyAndHugeMeshes)
{
  for (const double scale : { 1e-30, 1e-6, 1e6, 1e30 })
  {
    const PictureScene scene = MakeSceneOfSize(scale);
    const Picture picture = CastPicture(scene, 64, GetParam());
    EXPECT_EQ(picture.Statistics.Lost, 0);
    EXPECT_NEAR(picture.Alpha(32, 32), 1.0 - std::exp(-1.0), 1e-5) << scale;
  }
}

// Lengths that exceed all floats: means stay what they are, integrals are as large as can be shown.
TEST_P(PacketWalkTest, MeansAndIntegralsOfEndlessMeshes)
{
  PictureScene scene = MakeSceneOfSize(1e60);
  scene.Intervals = ConstantFunction(0.5);
  const auto castCenter = [&](BlendMode blending)
  {
    scene.Optics.Blending = blending;
    const Picture picture = CastPicture(scene, 64, GetParam());
    EXPECT_EQ(picture.Statistics.Lost, 0);
    const float* rgba = &picture.Rgba[4 * (32 * 64 + 32)];
    return glm::vec4(rgba[0], rgba[1], rgba[2], rgba[3]);
  };
  EXPECT_EQ(castCenter(BlendMode::AverageIntensity).a, 0.5f);
  EXPECT_EQ(castCenter(BlendMode::Additive), glm::vec4(1.0f));
  // The product of attenuation and length exceeds all floats as well.
  scene.Intervals = ConstantFunction(1e30);
  EXPECT_EQ(castCenter(BlendMode::Additive), glm::vec4(1.0f));
}

TEST_P(PacketWalkTest, NeedlesSeenAslant)
{
  // Along needles with an aspect ratio of 1e4 edges are long in u and in v, and most of their
  // products cancels in the areas by which depth and scalar are interpolated. The box is 2e4 x 1 x
  // 1, seen near its middle; attenuation increases across it from 0 to 0.6.
  const MeshArrays arrays =
    Moved(KuhnGrid(4), [](const glm::dvec3& p) { return (p - 0.5) * glm::dvec3(2e4, 1.0, 1.0); });
  PictureScene scene = MakeScene(arrays, 0.0);
  const double edge = 0.5 / scene.Mesh.GetRadius();
  scene.Intervals = BuildIntervals(
    { { -edge, 0.0, glm::dvec3(1.0) }, { edge, 0.6, glm::dvec3(1.0) } }, ScalarNormalization());
  constexpr int size = 48;
  constexpr double halfSide = 0.5;
  const glm::dmat4 turn = glm::rotate(glm::dmat4(1.0), 0.9, glm::normalize(glm::dvec3(1, 2, 3)));
  RayFrameInput input;
  input.WorldToView = glm::translate(glm::dmat4(1.0), glm::dvec3(0.0, 0.0, -3e4)) * turn;
  input.ViewToClip = glm::ortho(-halfSide, halfSide, -halfSide, halfSide, 1.0, 6e4);
  input.Center = scene.Mesh.GetCenter();
  input.Radius = scene.Mesh.GetRadius();
  input.ImageSize = glm::dvec2(size);
  ASSERT_EQ(ComputeRayFrame(input, scene.Frame), RayFrameStatus::Ok);
  const Picture picture = CastPicture(scene, size, GetParam());
  EXPECT_EQ(picture.Statistics.Lost, 0);
  const glm::dmat3 back = glm::transpose(glm::dmat3(turn));
  const glm::dvec3 along = back * glm::dvec3(0.0, 0.0, 1.0);
  double largest = 0.0;
  int seen = 0;
  for (const auto& [j, i] : Product(size, size))
  {
    const glm::dvec3 place =
      back * glm::dvec3(2.0 * (i + 0.5) / size - 1.0, 2.0 * (j + 0.5) / size - 1.0, 0.0) * halfSide;
    double begin = -1e9;
    double end = 1e9;
    for (int axis = 0; axis < 3; ++axis)
    {
      const double half = axis == 0 ? 1e4 : 0.5;
      const double a = (-half - place[axis]) / along[axis];
      const double b = (half - place[axis]) / along[axis];
      begin = std::max(begin, std::min(a, b));
      end = std::min(end, std::max(a, b));
    }
    const double mean = 0.6 * (0.5 + place.z + 0.5 * (begin + end) * along.z);
    const double alpha = -std::expm1(-mean * std::max(0.0, end - begin));
    seen += alpha > 0.1 ? 1 : 0;
    largest = std::max(largest, std::abs(picture.Alpha(i, j) - alpha));
  }
  EXPECT_GT(seen, size * size / 4);
  // Cells have a depth of 1,700. Single precision rounds such depths by 7.5e-5, and their mean by
  // about as much again per vertex: 3e-4 where the attenuation is 0.6.
  EXPECT_LT(largest, 2e-4);
}

TEST_P(PacketWalkTest, FlatMeshesHaveNothingToShow)
{
  const MeshArrays flat =
    Moved(KuhnGrid(3), [](const glm::dvec3& p) { return glm::dvec3(p.x, 0.5, p.z); });
  PictureScene scene = MakeScene(flat, 1.0);
  scene.Frame = FrameAlongZ(scene.Mesh, 0.6, 64);
  const Picture picture = CastPicture(scene, 65, GetParam());
  EXPECT_EQ(picture.Statistics.Lost, 0);
  EXPECT_EQ(picture.Alpha(32, 40), 0.0f);
}

TEST_P(PacketWalkTest, OpaqueDepthAndNearPlaneCutTheRay)
{
  PictureScene scene = MakeScene(KuhnGrid(2), 1.0);
  scene.Frame = FrameAlongZ(scene.Mesh, 0.6, 60);
  // Window depth of the mesh's centre, where the depth is 0: half of the cube is in front of it.
  const glm::dvec2& numerator = scene.Frame.DepthNumerator;
  const auto half = static_cast<float>(numerator.y / (numerator.y - numerator.x));
  const double expected = 1.0 - std::exp(-0.5);
  EXPECT_NEAR(CastPicture(scene, 60, GetParam(), half).Alpha(33, 31), expected, 1e-6);
  scene.Frame.NearDepth = 0.0;
  EXPECT_NEAR(CastPicture(scene, 60, GetParam()).Alpha(33, 31), expected, 1e-6);
}

TEST_P(PacketWalkTest, CellsWithoutScalarAreTransparent)
{
  PictureScene scene = MakeScene(KuhnGrid(1), 1.0);
  scene.Frame = FrameAlongZ(scene.Mesh, 0.6, 60);
  std::fill(scene.Scalars.begin(), scene.Scalars.end(), std::numeric_limits<float>::quiet_NaN());
  const Picture picture = CastPicture(scene, 60, GetParam());
  EXPECT_EQ(picture.Alpha(33, 31), 0.0f);
  EXPECT_GT(picture.Statistics.Steps, 0);
}

TEST_P(PacketWalkTest, OneRayAndManyInAPacketAgree)
{
  PictureScene scene = MakeScene(KuhnGrid(6), 1.0);
  scene.Frame = FrameAlongZ(scene.Mesh, 0.4, 40);
  const Picture all = CastPicture(scene, 41, GetParam());
  const Picture one = CastPicture(scene, 1, GetParam());
  EXPECT_GT(one.Alpha(0, 0), 0.5f);
  EXPECT_EQ(all.Alpha(20, 20), one.Alpha(0, 0));
}

TEST_P(PacketWalkTest, LengthOfTheTransferFunctionDoesNotMatter)
{
  // The same ramp with few, some and many points, for which the look-up uses different methods.
  PictureScene scene = MakeScene(KuhnGrid(3), 1.0);
  scene.Frame = FrameAlongZ(scene.Mesh, 0.6, 48);
  std::vector<Picture> pictures;
  for (const int count : { 2, 12, 28, 200 })
  {
    std::vector<TransferFunctionPoint> points;
    for (int i = 0; i < count; ++i)
    {
      const double x = i / (count - 1.0);
      points.push_back({ 2.0 * x - 1.0, 3.0 * x, glm::dvec3(x, 1.0 - x, 0.5) });
    }
    scene.Intervals = BuildIntervals(points, ScalarNormalization());
    pictures.push_back(CastPicture(scene, 48, GetParam()));
  }
  for (const auto& [i, p] :
    Product(Below<std::size_t>(pictures[0].Rgba.size()), Numbers<std::size_t>(1, pictures.size())))
  {
    ASSERT_NEAR(pictures[0].Rgba[i], pictures[p].Rgba[i], 2e-6);
  }
}

TEST(RayFrame, RejectsWhatIsNoCamera)
{
  RayFrameInput input;
  input.ViewToClip = glm::perspective(0.5, 1.0, 1.0, 10.0);
  RayFrame frame;
  EXPECT_EQ(ComputeRayFrame(input, frame), RayFrameStatus::Ok);
  input.ModelToWorld[0] = glm::dvec4(0.0);
  EXPECT_EQ(ComputeRayFrame(input, frame), RayFrameStatus::Singular);
  input.ModelToWorld = glm::dmat4(1.0);
  input.ViewToClip[0][3] = 0.1;
  EXPECT_EQ(ComputeRayFrame(input, frame), RayFrameStatus::NotACamera);
}

TEST(RayFrame, RaysPassThroughTheirPixels)
{
  RayFrameInput input;
  input.WorldToView = glm::lookAt(
    glm::dvec3(1e6 + 3.0, -2.0, 4.0), glm::dvec3(1e6, 0.0, 0.0), glm::dvec3(0.0, 0.0, 1.0));
  input.ViewToClip = glm::perspective(0.7, 1.3, 0.5, 50.0);
  input.Center = glm::dvec3(1e6, 0.2, -0.1);
  input.Radius = 1.7;
  input.ImageSize = glm::dvec2(640.0, 480.0);
  RayFrame frame;
  ASSERT_EQ(ComputeRayFrame(input, frame), RayFrameStatus::Ok);
  for (const glm::dvec3& offset : { glm::dvec3(0.3, -0.5, 0.8), glm::dvec3(-0.9, 0.1, 0.2) })
  {
    const glm::dvec4 world(input.Center + input.Radius * offset, 1.0);
    const glm::dvec4 clip = input.ViewToClip * input.WorldToView * world;
    const double i = 0.5 * 640.0 * clip.x / clip.w;
    const double j = 0.5 * 480.0 * clip.y / clip.w;
    const double depth = glm::dot(frame.RowDepth, offset);
    const glm::dvec2 onRay = frame.Origin.At(i, j) + depth * frame.Slope.At(i, j);
    EXPECT_NEAR(onRay.x, glm::dot(frame.RowX, offset), 1e-8);
    EXPECT_NEAR(onRay.y, glm::dot(frame.RowY, offset), 1e-8);
    EXPECT_NEAR(frame.DepthAt(clip.z / clip.w), depth, 1e-8);
  }
}
