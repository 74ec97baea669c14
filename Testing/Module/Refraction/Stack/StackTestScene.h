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

/** Image of a point without a point before it. */
inline StackVertex SolveAlone(const StackSolver& solver, const glm::dvec3& point)
{
  StackSolver::Memory memory;
  return solver.SolvePoint(point, memory);
}

}
