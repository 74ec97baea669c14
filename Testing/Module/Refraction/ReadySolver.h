// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "MembraneMeshes.h"
#include "Refraction/Curved/CurvedMembraneSolver.h"
#include "TestBasics.h"

namespace meniscus::test
{

/** A solver with a membrane that can be used and an eye that sees it. */
struct ReadySolver : CurvedMembraneSolver
{
  ReadySolver() = default;
  explicit ReadySolver(const reference::MembraneMesh& mesh, const glm::dvec3& eye,
    double exterior = 1.0, double interior = 1.333, bool reflects = false)
  {
    this->Set(mesh, eye, exterior, interior, reflects);
  }

  void Set(const reference::MembraneMesh& mesh, const glm::dvec3& eye, double exterior = 1.0,
    double interior = 1.333, bool reflects = false)
  {
    EXPECT_EQ(this->SetMembrane(mesh.AsInput()), MembraneStatus::Ready);
    EXPECT_EQ(this->SetEye(eye, exterior, interior, SerialLoop, reflects), EyeStatus::Ready);
  }

  VirtualVertex SolveOne(const glm::dvec3& point) const
  {
    VirtualVertex vertex;
    this->Solve(&point.x, 0, 1, &vertex);
    return vertex;
  }
};

}
