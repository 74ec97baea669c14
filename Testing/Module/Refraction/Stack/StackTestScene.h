// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "ExactStack.h"
#include "HeightField.h"
#include "Refraction/Stack/StackSolver.h"
#include "TestBasics.h"

namespace meniscus::test
{

inline std::shared_ptr<const RefractingSurface> MakeSurface(const reference::MembraneMesh& mesh)
{
  auto surface = std::make_shared<RefractingSurface>();
  EXPECT_EQ(surface->SetMembrane(mesh.AsInput(), SurfaceParts::Crossings), MembraneStatus::Ready);
  return surface;
}

/** A square of side `size` about the y axis at height `y`, with `waves` half waves along a side. */
inline reference::MembraneMesh MakeWaves(
  double size, double y, double amplitude, double waves, int cells)
{
  using reference::HeightField;
  const HeightField field{ HeightField::Shape::Waves, size, amplitude,
    waves * std::acos(-1.0) / size, 1.0, 1.333 };
  reference::MembraneMesh mesh = field.MakeMesh(cells);
  mesh.Translate({ 0.0, y, 0.0 });
  return mesh;
}

/** Sets interfaces and eye, which must be valid. */
inline void SetStack(StackSolver& solver, const std::vector<Interface>& list, const glm::dvec3& eye)
{
  ASSERT_EQ(solver.SetInterfaces(list).Fault, MediaFault::None);
  ASSERT_EQ(solver.SetEye(eye), EyeStatus::Ready);
}

/** Distance of a line from a point. */
inline double GetDistance(
  const glm::dvec3& point, const glm::dvec3& origin, const glm::dvec3& direction)
{
  return glm::length(glm::cross(point - origin, glm::normalize(direction)));
}

/**
 * Sine of the angle, in the first of some layers of thickness d and index n, of the ray that spans
 * the distance r along them: sum d tan t = r is monotone, so bisection to the last bit.
 */
inline double BisectSine(
  const std::vector<double>& thickness, const std::vector<double>& index, double r)
{
  double low = 0.0;
  double high = 1.0;
  for (const double n : index)
  {
    high = std::min(high, n / index[0]);
  }
  for (int i = 0; i < 200; ++i)
  {
    const double middle = 0.5 * (low + high);
    double reached = 0.0;
    for (std::size_t k = 0; k < index.size(); ++k)
    {
      const double sine = middle * index[0] / index[k];
      reached += thickness[k] * sine / std::sqrt((1.0 - sine) * (1.0 + sine));
    }
    (reached < r ? low : high) = middle;
  }
  return low;
}

/** Image of a point without a point before it. */
inline StackVertex SolveAlone(const StackSolver& solver, const glm::dvec3& point)
{
  StackSolver::Memory memory;
  return solver.SolvePoint(point, memory);
}

}
