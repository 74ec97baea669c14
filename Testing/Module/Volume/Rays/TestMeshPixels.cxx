// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Box of the pixels whose rays may meet the mesh, against the points of its box.
#include "KernelMeshes.h"
#include "TestBasics.h"
#include "Volume/Rays/MeshPixels.h"

#include <glm/gtc/matrix_transform.hpp>

#include <random>

using namespace meniscus::test;
using namespace meniscus;

namespace
{

constexpr int Width = 90;
constexpr int Height = 60;

/** A flat block of 3 x 2 x 1 cubes. */
TetrahedralMesh MakeMesh()
{
  TetrahedralMesh mesh;
  mesh.Build(KuhnBlock(3, 2, 1, 1.0).View());
  return mesh;
}

struct View
{
  glm::dmat4 WorldToView{ 1.0 };
  glm::dmat4 ViewToClip{ 1.0 };
};

RayFrame FrameOf(const View& view, const TetrahedralMesh& mesh)
{
  RayFrameInput input;
  input.WorldToView = view.WorldToView;
  input.ViewToClip = view.ViewToClip;
  input.Center = mesh.GetCenter();
  input.Radius = mesh.GetRadius();
  input.HalfSize = mesh.GetHalfSize() / mesh.GetRadius();
  input.ImageSize = glm::dvec2(Width, Height);
  RayFrame frame;
  EXPECT_EQ(ComputeRayFrame(input, frame), RayFrameStatus::Ok);
  return frame;
}

}

TEST(MeshPixels, HoldAllPointsOfTheBoxAndFewMore)
{
  const TetrahedralMesh mesh = MakeMesh();
  std::mt19937 random(3);
  const auto number = [&random](double lower, double upper)
  { return lower + (upper - lower) * (random() / 4294967295.0); };
  for (int i = 0; i < 200; ++i)
  {
    View view;
    const double distance = number(3.5, 9.0);
    const glm::dvec3 direction =
      glm::normalize(glm::dvec3(number(-1, 1), number(-1, 1), number(-1, 1)));
    view.WorldToView = glm::lookAt(mesh.GetCenter() + distance * direction,
      mesh.GetCenter() + glm::dvec3(number(-1, 1), number(-1, 1), number(-1, 1)),
      glm::dvec3(0.1, 1.0, 0.2));
    view.ViewToClip = i % 2 == 0 ? glm::perspective(number(0.3, 1.5), 1.5, 0.1, 40.0)
                                 : glm::ortho(-3.0, 3.0, -2.0, 2.0, 0.1, 40.0);
    const RayFrame frame = FrameOf(view, mesh);
    ASSERT_TRUE(frame.ShowsWholeDepth());
    const ProjectedFaces::PixelBox box = FindMeshPixels(frame, Width, Height, mesh);
    glm::dvec2 lower(1.0e+9);
    glm::dvec2 upper(-1.0e+9);
    for (int corner = 0; corner < 8; ++corner)
    {
      const glm::dvec3 signs(corner % 2 * 2 - 1, corner / 2 % 2 * 2 - 1, corner / 4 * 2 - 1);
      const glm::dvec4 clip = view.ViewToClip * view.WorldToView *
        glm::dvec4(mesh.GetCenter() + signs * mesh.GetHalfSize(), 1.0);
      // From the image's lower left corner.
      const glm::dvec2 pixel = (0.5 + 0.5 * glm::dvec2(clip) / clip.w) * glm::dvec2(Width, Height);
      lower = glm::min(lower, pixel);
      upper = glm::max(upper, pixel);
    }
    const auto limit = [](double place, int size)
    { return std::min(std::max(place, 0.0), static_cast<double>(size)); };
    EXPECT_LE(box.Left, limit(lower.x, Width)) << i;
    EXPECT_GE(box.Right, limit(upper.x, Width)) << i;
    EXPECT_LE(box.Bottom, limit(lower.y, Height)) << i;
    EXPECT_GE(box.Top, limit(upper.y, Height)) << i;
    EXPECT_GE(box.Left, limit(lower.x - 2.001, Width) - 0.001) << i;
    EXPECT_LE(box.Right, limit(upper.x + 2.001, Width)) << i;
    EXPECT_GE(box.Bottom, limit(lower.y - 2.001, Height) - 0.001) << i;
    EXPECT_LE(box.Top, limit(upper.y + 2.001, Height)) << i;
  }
}

/** A view of the middle of the mesh along -z, with these distances of the clipping planes. */
View MakeViewAlongZ(const TetrahedralMesh& mesh, double distance, double first, double last)
{
  View view;
  view.WorldToView = glm::lookAt(
    mesh.GetCenter() + glm::dvec3(0.0, 0.0, distance), mesh.GetCenter(), glm::dvec3(0.0, 1.0, 0.0));
  view.ViewToClip = glm::perspective(0.5, 1.5, first, last);
  return view;
}

TEST(MeshPixels, AreAllIfThePlanesCutTheMesh)
{
  const TetrahedralMesh mesh = MakeMesh();
  const View view = MakeViewAlongZ(mesh, 0.2, 0.1, 40.0);
  const RayFrame frame = FrameOf(view, mesh);
  EXPECT_FALSE(frame.ShowsWholeDepth());
  const ProjectedFaces::PixelBox box = FindMeshPixels(frame, Width, Height, mesh);
  EXPECT_EQ(box.Left, 0);
  EXPECT_EQ(box.Right, Width);
  EXPECT_EQ(box.Bottom, 0);
  EXPECT_EQ(box.Top, Height);
}

/** The depth of a flat box that is seen from its broad side is not that of the sphere around it. */
TEST(MeshPixels, ReachIsThatOfTheBox)
{
  const TetrahedralMesh mesh = MakeMesh();
  View view = MakeViewAlongZ(mesh, 4.0, 3.4, 4.6);
  const RayFrame frame = FrameOf(view, mesh);
  EXPECT_NEAR(frame.Reach, mesh.GetHalfSize().z / mesh.GetRadius(), 1.0e-6);
  EXPECT_TRUE(frame.ShowsWholeDepth());
  EXPECT_EQ(frame.EndAt(0.0), -frame.Reach);
  EXPECT_EQ(frame.EndAt(1.0), frame.Reach);
  view.ViewToClip = glm::perspective(0.5, 1.5, 3.6, 4.6);
  EXPECT_FALSE(FrameOf(view, mesh).ShowsWholeDepth());
  view.ViewToClip = glm::perspective(0.5, 1.5, 3.4, 4.4);
  EXPECT_FALSE(FrameOf(view, mesh).ShowsWholeDepth());
}
