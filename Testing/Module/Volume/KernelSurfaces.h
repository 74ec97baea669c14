// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "MathBasics.h"
#include "Refraction/Surface/Interface.h"
#include "Volume/Refracted/RefractedRayStack.h"

namespace meniscus::test
{

/** A refracting surface with its boxes. */
struct TestSurface
{
  std::shared_ptr<RefractingSurface> Shape = std::make_shared<RefractingSurface>();
  const Membrane& Surface = Shape->GetMembrane();
  const CurvedPatches& Patches = Shape->GetPatches();

  TestSurface() = default;
  explicit TestSurface(const MembraneInput& input) { this->Set(input); }
  TestSurface(const TestSurface&) = delete;
  TestSurface& operator=(const TestSurface&) = delete;
  void Set(const MembraneInput& input);
  Interface Between(double exterior, double interior) const
  {
    return { this->Shape, { exterior, interior } };
  }
};

/** The sheet z = height(x, y) over [-1, 1] squared. */
struct Sheet : TestSurface
{
  Sheet(const std::function<double(double, double)>& height, int cells);
  /** Makes the same surface another sheet. */
  void SetHeight(const std::function<double(double, double)>& height, int cells);
};

/** A closed sphere about the origin with its own normals; patches reproduce it. */
struct Sphere : TestSurface
{
  explicit Sphere(int resolution, double radius = 1.0);
};

/** A box along the world's axes. */
struct WorldBox
{
  glm::dvec3 Center;
  glm::dvec3 Half;

  /** True if the box contains a point start + t along, 0 <= t <= end. */
  bool Meets(const glm::dvec3& start, const glm::dvec3& along, double end) const;
};

/** A view of size x size pixels from an eye, or along parallel rays. */
RefractedRayStack::View LookAt(
  const glm::dvec3& eye, const glm::dvec3& target, double width, bool parallel, int size);

/**
 * Sets the bounds of the mesh.
 * @param parts of its boundary.
 */
void SetMesh(
  RefractedRayStack::View& view, const WorldBox& box, const std::vector<WorldBox>& parts = {});

}
