// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Paths through wavy surfaces: derivatives, and a joint iteration for all sight points as oracle.
#include "RefractionTestRandom.h"
#include "StackTestScene.h"

namespace
{

using namespace meniscus;
using namespace meniscus::reference;
using namespace meniscus::test;

const double Pi = std::acos(-1.0);

// Three wavy interfaces between four media.
void SetWaves(StackSolver& solver, const glm::dvec3& eye)
{
  SetStack(solver,
    { { MakeSurface(MakeWaves(200.0, 0.0, 1.5, 6.0, 40)), { 1.0, 1.5 } },
      { MakeSurface(MakeWaves(200.0, -15.0, 1.0, 8.0, 50)), { 1.5, 1.2 } },
      { MakeSurface(MakeWaves(200.0, -30.0, 1.2, 5.0, 45)), { 1.2, 1.333 } } },
    eye);
}

// The equations h_k parallel to N_k for all sight points of a path at once: two unknowns per
// interface, the place in its patch.
class JointEquations
{
public:
  JointEquations(const RefractionStack& stack, const StackPath& path, const glm::dvec3& point)
    : Stack(stack)
    , Point(point)
  {
    for (std::size_t k = 0; k < path.Count; ++k)
    {
      const RefractionStack::Link& link = stack.GetLinks()[k];
      this->Patches.push_back(
        link.Surface->GetPatch(path.Points[k].Place.Facet, !link.Passage.FromFront));
      this->Unknowns.push_back(path.Points[k].Place.B.x);
      this->Unknowns.push_back(path.Points[k].Place.B.y);
    }
  }

  std::vector<glm::dvec3> GetSightPoints() const
  {
    std::vector<glm::dvec3> result;
    for (std::size_t k = 0; k < this->Patches.size(); ++k)
    {
      result.push_back(this->At(this->Unknowns, k).Position);
    }
    return result;
  }

  // Newton's method with differences; returns the length of the last step.
  double Solve(int steps)
  {
    double last = 0.0;
    const std::size_t n = this->Unknowns.size();
    for (int i = 0; i < steps; ++i)
    {
      const std::vector<double> f = this->GetResiduals(this->Unknowns);
      std::vector<std::vector<double>> rows(n, std::vector<double>(n + 1));
      constexpr double h = 1e-6;
      for (std::size_t j = 0; j < n; ++j)
      {
        std::vector<double> above = this->Unknowns;
        std::vector<double> below = this->Unknowns;
        above[j] += h;
        below[j] -= h;
        const std::vector<double> fAbove = this->GetResiduals(above);
        const std::vector<double> fBelow = this->GetResiduals(below);
        for (std::size_t k = 0; k < n; ++k)
        {
          rows[k][j] = (fAbove[k] - fBelow[k]) / (2.0 * h);
          rows[k][n] = -f[k];
        }
      }
      last = 0.0;
      const std::vector<double> step = Eliminate(std::move(rows));
      for (std::size_t j = 0; j < n; ++j)
      {
        this->Unknowns[j] += step[j];
        last = std::max(last, std::fabs(step[j]));
      }
    }
    return last;
  }

  std::vector<double> Unknowns;

private:
  PatchPoint At(const std::vector<double>& unknowns, std::size_t k) const
  {
    PatchPoint at = this->Patches[k].Evaluate({ unknowns[2 * k], unknowns[2 * k + 1] });
    at.Position += this->Stack.GetLinks()[k].Shift;
    return at;
  }

  std::vector<double> GetResiduals(const std::vector<double>& unknowns) const
  {
    std::vector<double> result;
    for (std::size_t k = 0; k < this->Patches.size(); ++k)
    {
      const meniscus::InterfacePassage& passage = this->Stack.GetLinks()[k].Passage;
      const PatchPoint at = this->At(unknowns, k);
      const glm::dvec3 before = k == 0 ? this->Stack.GetEye() : this->At(unknowns, k - 1).Position;
      const glm::dvec3 behind =
        k + 1 == this->Patches.size() ? this->Point : this->At(unknowns, k + 1).Position;
      const glm::dvec3 a = at.Position - before;
      const glm::dvec3 b = behind - at.Position;
      const glm::dvec3 h =
        passage.Before * glm::length(b) * a - passage.Behind * glm::length(a) * b;
      const glm::dvec3 across = glm::cross(at.Normal, h);
      const CurvedPatch& patch = this->Patches[k];
      result.push_back(glm::dot(across, patch.Corner[1] - patch.Corner[0]));
      result.push_back(glm::dot(across, patch.Corner[2] - patch.Corner[0]));
    }
    return result;
  }

  // Gaussian elimination with pivots; the last column is the right-hand side.
  static std::vector<double> Eliminate(std::vector<std::vector<double>> rows)
  {
    const std::size_t n = rows.size();
    for (std::size_t i = 0; i < n; ++i)
    {
      std::size_t pivot = i;
      for (std::size_t k = i; k < n; ++k)
      {
        pivot = std::fabs(rows[k][i]) > std::fabs(rows[pivot][i]) ? k : pivot;
      }
      std::swap(rows[i], rows[pivot]);
      for (std::size_t k = 0; k < n; ++k)
      {
        const double factor = k == i ? 0.0 : rows[k][i] / rows[i][i];
        for (std::size_t j = i; j <= n; ++j)
        {
          rows[k][j] -= factor * rows[i][j];
        }
      }
    }
    std::vector<double> result;
    for (std::size_t i = 0; i < n; ++i)
    {
      result.push_back(rows[i][n] / rows[i][i]);
    }
    return result;
  }

  const RefractionStack& Stack;
  glm::dvec3 Point;
  std::vector<CurvedPatch> Patches;
};

}

//------------------------------------------------------------------------------
TEST(RefractionStackPaths, DerivativesAgreeWithDifferences)
{
  StackSolver solver;
  SetWaves(solver, { 5.0, 120.0, -8.0 });
  const RefractionStack& stack = solver.GetStack();
  ASSERT_EQ(stack.GetLinks().size(), 3u);
  Random random(11);
  int compared = 0;
  for (int i = 0; i < 400; ++i)
  {
    const auto facet = static_cast<std::int32_t>(random(0.0, 3200.0));
    const glm::dvec2 b(random(0.1, 0.4), random(0.1, 0.4));
    StackPath path;
    if (stack.Trace({ facet, b }, 3, false, path) != PathEnd::Passed)
    {
      continue;
    }
    for (int k = 0; k < 2; ++k)
    {
      constexpr double h = 1e-6;
      glm::dvec2 step(0.0);
      step[k] = h;
      StackPath above = path;
      StackPath below = path;
      if (stack.Trace({ facet, b + step }, 3, true, above) != PathEnd::Passed ||
        stack.Trace({ facet, b - step }, 3, true, below) != PathEnd::Passed)
      {
        continue;
      }
      // Normals of two patches at their common edge are equal, and their derivatives are not.
      if (above.Points[1].Place.Facet != below.Points[1].Place.Facet ||
        above.Points[2].Place.Facet != below.Points[2].Place.Facet)
      {
        continue;
      }
      ++compared;
      // Error of second-order differences: h^2, and rounding 1e-14 * 200 / h.
      const auto differ = [](const glm::dvec3& first, const glm::dvec3& second)
      { return (first - second) / (2.0 * h); };
      EXPECT_LT(glm::length(differ(above.GetLast().Origin, below.GetLast().Origin) -
                  path.GetLast().OriginBy[k]),
        1e-5);
      EXPECT_LT(glm::length(differ(above.GetLast().Direction, below.GetLast().Direction) -
                  path.GetLast().DirectionBy[k]),
        1e-6);
      EXPECT_LT(glm::length(differ(above.Sight, below.Sight) - path.SightBy[k]), 1e-7);
    }
  }
  EXPECT_GT(compared, 500);
}

//------------------------------------------------------------------------------
// The joint iteration has all sight points as unknowns and no ray; it starts at places that are off
// by up to a tenth of a facet. Both solve the same equations on the same patches.
TEST(RefractionStackPaths, AgreeWithTheJointIteration)
{
  StackSolver solver;
  SetWaves(solver, { 5.0, 120.0, -8.0 });
  Random random(12);
  int compared = 0;
  for (int i = 0; i < 300; ++i)
  {
    const glm::dvec3 point(random(-40.0, 40.0), random(-60.0, -33.0), random(-40.0, 40.0));
    StackSolver::Memory memory;
    const StackVertex vertex = solver.SolvePoint(point, memory);
    ASSERT_EQ(vertex.State, ImageState::Found);
    ASSERT_EQ(vertex.Passed, 3);
    JointEquations joint(solver.GetStack(), memory.Path, point - solver.GetStack().GetOrigin());
    for (double& unknown : joint.Unknowns)
    {
      unknown += random(-0.1, 0.1);
    }
    if (!(joint.Solve(12) < 1e-9))
    {
      continue; // next to a caustic the start was too far away
    }
    const std::vector<glm::dvec3> sights = joint.GetSightPoints();
    ++compared;
    for (std::size_t k = 0; k < 3; ++k)
    {
      // Newton's error of 1e-12 of a facet, and that of the differences' Jacobian, 1e-9 steps.
      EXPECT_LT(glm::length(sights[k] - memory.Path.Points[k].Ray.Origin), 1e-8) << i << " " << k;
    }
  }
  EXPECT_GT(compared, 290);
}

//------------------------------------------------------------------------------
// Every point on a traced ray has an image: no bounds are too narrow, no search ends early.
TEST(RefractionStackPaths, PointsOnTracedRaysHaveImages)
{
  StackSolver solver;
  SetWaves(solver, { 5.0, 120.0, -8.0 });
  const RefractionStack& stack = solver.GetStack();
  Random random(13);
  int points = 0;
  for (int i = 0; i < 3000; ++i)
  {
    const auto facet = static_cast<std::int32_t>(random(0.0, 3200.0));
    const double u = random(0.0, 1.0);
    StackPath path;
    if (stack.Trace({ facet, { u, random(0.0, 1.0 - u) } }, 3, false, path) != PathEnd::Passed)
    {
      continue;
    }
    ++points;
    const glm::dvec3 local = path.GetLast().Origin + random(0.1, 300.0) * path.GetLast().Direction;
    const StackVertex vertex = meniscus::test::SolveAlone(solver, local + stack.GetOrigin());
    EXPECT_EQ(vertex.State, ImageState::Found) << i << " facet " << facet;
  }
  EXPECT_GT(points, 2000);
}

//------------------------------------------------------------------------------
// Steep waves, seen at a slant: lines cross the second surface several times. The leg to it stays
// above the exact waves, within the error of the patches, up to the nearest crossing.
TEST(RefractionStackPaths, LegsEndAtTheNearestCrossing)
{
  const HeightField steep{ HeightField::Shape::Waves, 200.0, 6.0, 10.0 * Pi / 200.0, 1.0, 1.333 };
  MembraneMesh mesh = steep.MakeMesh(80);
  mesh.Translate({ 0.0, -20.0, 0.0 });
  StackSolver solver;
  const glm::dvec3 eye(0.0, 70.0, 150.0);
  SetStack(solver,
    { { MakeSurface(meniscus::reference::MakePlane(0.0, 400.0, 20)), { 1.0, 1.05 } },
      { MakeSurface(mesh), { 1.05, 1.333 } } },
    eye);
  Random random(14);
  int found = 0;
  for (int i = 0; i < 250; ++i)
  {
    const glm::dvec3 point(random(-60.0, 60.0), random(-60.0, -30.0), random(-60.0, 60.0));
    StackSolver::Memory memory;
    const StackVertex vertex = solver.SolvePoint(point, memory);
    if (vertex.State != ImageState::Found || vertex.Passed != 2)
    {
      continue;
    }
    ++found;
    double lowest = 1.0;
    for (int k = 0; k <= 500; ++k)
    {
      const glm::dvec3 on =
        vertex.SightPoint + k / 500.0 * (vertex.LastSightPoint - vertex.SightPoint);
      lowest = std::min(lowest, on.y + 20.0 - steep.GetHeight(on.x, on.z));
    }
    EXPECT_GT(lowest, -0.01) << i;
  }
  EXPECT_GT(found, 100);
}
