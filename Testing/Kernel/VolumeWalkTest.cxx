// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/RayWalk.h"
#include "VolumeTestMeshes.h"

#include <glm/gtc/matrix_transform.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace meniscus;
using namespace meniscus::test;

namespace
{

constexpr float Far = 1e30f;

/** A mesh ready for rays; the scalar is z, normalised. */
struct Scene
{
  TetrahedralMesh Mesh;
  BoundaryTree Tree;
  std::vector<float> Scalars;
  std::vector<TransferFunctionInterval> Intervals;
  RayCastScene Cast;

  Scene(const MeshArrays& arrays, double attenuation)
    : Intervals(ConstantFunction(attenuation))
  {
    this->Mesh.Build(arrays.View());
    this->Tree.Build(this->Mesh);
    for (const std::int64_t point : this->Mesh.GetSourcePoints())
    {
      const double z = arrays.PointAt(point).z - this->Mesh.GetCenter().z;
      this->Scalars.push_back(static_cast<float>(z / this->Mesh.GetRadius()));
    }
    this->Cast = { &this->Mesh, &this->Tree, &this->Scalars, &this->Intervals, RayFrame(), 0.0f };
  }
};

}

TEST(RayWalk, ConstantFieldGivesTheChord)
{
  Scene scene(KuhnGrid(3), 0.7);
  scene.Cast.Frame = FrameAlongZ(scene.Mesh, 0.75, 150);
  RayWalk walk(scene.Cast);
  int hits = 0;
  for (int j = 0; j < 150; ++j)
  {
    for (int i = 0; i < 150; ++i)
    {
      const glm::vec2 pixel(i - 74.5f, j - 74.5f);
      const bool inside = std::abs(pixel.x) < 50.0f && std::abs(pixel.y) < 50.0f;
      const RayResult result = walk.Cast(pixel, Far);
      ASSERT_FALSE(result.Lost);
      ASSERT_NEAR(result.Color.a, inside ? 1.0 - std::exp(-0.7) : 0.0, 1e-6) << i << " " << j;
      hits += inside ? 1 : 0;
    }
  }
  EXPECT_EQ(hits, 100 * 100);
}

TEST(RayWalk, RaysThroughVerticesAndEdgesOfAnAlignedGrid)
{
  // Pixels of 1/24 on a grid of 1/4: many rays run along edges and through vertices, all others in
  // planes of faces. A ray on the outer boundary may count as in or out, but as one of them.
  Scene scene(KuhnGrid(4), 1.0);
  scene.Cast.Frame = FrameAlongZ(scene.Mesh, 0.5, 24);
  RayWalk walk(scene.Cast);
  for (int j = 0; j <= 24; ++j)
  {
    for (int i = 0; i <= 24; ++i)
    {
      const RayResult result = walk.Cast(glm::vec2(i - 12, j - 12), Far);
      ASSERT_FALSE(result.Lost);
      const bool border = i == 0 || j == 0 || i == 24 || j == 24;
      const double full = 1.0 - std::exp(-1.0);
      const double expected = border && result.Color.a < 0.5 * full ? 0.0 : full;
      ASSERT_NEAR(result.Color.a, expected, 1e-6) << i << " " << j;
    }
  }
}

TEST(RayWalk, TangledMeshesEndOnTheBoundary)
{
  for (unsigned int seed = 1; seed <= 5; ++seed)
  {
    MeshArrays arrays = KuhnGrid(8);
    Jitter(arrays, 0.06, seed); // about a fifth of the cells inverted
    Scene scene(arrays, 1.0);
    scene.Cast.Frame = FrameAlongZ(scene.Mesh, 0.6, 100);
    RayWalk walk(scene.Cast);
    std::int64_t steps = 0;
    for (int j = 0; j < 100; ++j)
    {
      for (int i = 0; i < 100; ++i)
      {
        const RayResult result = walk.Cast(glm::vec2(i - 49.5f, j - 49.5f), Far);
        ASSERT_FALSE(result.Lost) << "seed " << seed << " pixel " << i << " " << j;
        steps += result.Steps;
      }
    }
    EXPECT_GT(steps, 100000);
    EXPECT_LT(steps, 100 * 100 * 200);
  }
}

TEST(RayWalk, FlatAndTinyAndHugeMeshes)
{
  for (const double scale : { 1e-30, 1e-6, 1e6, 1e30 })
  {
    MeshArrays arrays = KuhnGrid(2);
    for (double& coordinate : arrays.Points)
    {
      coordinate = scale * (coordinate - 0.5);
    }
    Scene scene(arrays, 1.0 / scale);
    RayFrameInput input;
    input.WorldToView = glm::translate(glm::dmat4(1.0), glm::dvec3(0.0, 0.0, -10.0 * scale));
    input.ViewToClip = glm::perspective(0.2, 1.0, scale, 30.0 * scale);
    input.Center = scene.Mesh.GetCenter();
    input.Radius = scene.Mesh.GetRadius();
    input.ImageSize = glm::dvec2(64.0);
    ASSERT_EQ(ComputeRayFrame(input, scene.Cast.Frame), RayFrameStatus::Ok) << scale;
    RayWalk walk(scene.Cast);
    const RayResult result = walk.Cast(glm::vec2(0.5f, 0.5f), Far);
    EXPECT_FALSE(result.Lost);
    EXPECT_NEAR(result.Color.a, 1.0 - std::exp(-1.0), 1e-5) << scale;
  }
  MeshArrays flat = KuhnGrid(3);
  for (std::size_t i = 1; i < flat.Points.size(); i += 3)
  {
    flat.Points[i] = 0.5;
  }
  Scene scene(flat, 1.0);
  scene.Cast.Frame = FrameAlongZ(scene.Mesh, 0.6, 64);
  RayWalk walk(scene.Cast);
  for (int i = 0; i < 64; ++i)
  {
    EXPECT_FALSE(walk.Cast(glm::vec2(i - 32.0f, 0.0f), Far).Lost);
  }
}

TEST(RayWalk, EndDepthAndNearPlaneCutTheRay)
{
  Scene scene(KuhnGrid(2), 1.0);
  scene.Cast.Frame = FrameAlongZ(scene.Mesh, 0.6, 60);
  RayWalk walk(scene.Cast);
  // Depth 0 is the mesh's centre: half of the cube.
  EXPECT_NEAR(walk.Cast(glm::vec2(3.3f, 1.7f), 0.0f).Color.a, 1.0 - std::exp(-0.5), 1e-6);
  scene.Cast.Frame.NearDepth = 0.0;
  RayWalk inside(scene.Cast);
  EXPECT_NEAR(inside.Cast(glm::vec2(3.3f, 1.7f), Far).Color.a, 1.0 - std::exp(-0.5), 1e-6);
}

TEST(RayWalk, CellsWithoutScalarAreTransparent)
{
  Scene scene(KuhnGrid(1), 1.0);
  scene.Cast.Frame = FrameAlongZ(scene.Mesh, 0.6, 60);
  std::fill(scene.Scalars.begin(), scene.Scalars.end(), std::numeric_limits<float>::quiet_NaN());
  RayWalk walk(scene.Cast);
  const RayResult result = walk.Cast(glm::vec2(3.3f, 1.7f), Far);
  EXPECT_EQ(result.Color.a, 0.0f);
  EXPECT_GT(result.Steps, 0);
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
