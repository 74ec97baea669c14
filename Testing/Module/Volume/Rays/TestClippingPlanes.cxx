// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Clipping planes in the frame of the rays.
#include "KernelMeshes.h"

#include "TestBasics.h"
#include "Volume/Rays/ClippingPlanes.h"

using namespace meniscus;
using namespace meniscus::test;

TEST(ClippingPlanes, DistanceAlongRays)
{
  TetrahedralMesh mesh;
  const MeshArrays arrays = KuhnGrid(2);
  mesh.Build(arrays.View());
  const RayFrame frame = FrameAlongZ(mesh, 0.7, 100);
  const glm::dvec3 normal(0.3, -2.0, 0.9);
  const glm::dvec3 origin(0.2, 0.9, 0.4);
  // The view looks along -z of the world, and depth 0 is at the mesh's centre.
  const RayClippingPlane plane =
    ComputeClippingPlane(frame, normal, glm::dot(normal, mesh.GetCenter() - origin));
  for (const auto& [depth, i, j] :
    Product(List(-0.8, 0.0, 0.5), List(-40.0, 0.0, 13.5), List(-7.25, 31.0)))
  {
    const glm::dvec2 across = frame.Origin.At(i, j) + depth * frame.Slope.At(i, j);
    const glm::dvec3 world = mesh.GetCenter() + frame.ViewToWorld * glm::dvec3(across, depth);
    const glm::dvec3 place(1.0, i, j);
    const double height = glm::dot(plane.Constant, place) + depth * glm::dot(plane.PerDepth, place);
    const double size = glm::length(frame.ViewToWorld[0]) * glm::length(normal);
    EXPECT_NEAR(height, glm::dot(normal, world - origin) / size, 1e-13);
  }
}

TEST(ClippingPlanes, NormalOfNoLengthKeepsEverything)
{
  const RayClippingPlane plane = ComputeClippingPlane(RayFrame(), glm::dvec3(0.0), 3.0);
  EXPECT_EQ(plane.Constant, glm::dvec3(0.0));
  EXPECT_EQ(plane.PerDepth, glm::dvec3(0.0));
}
