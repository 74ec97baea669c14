// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// True positions of chains of points, against those of each point alone.
#include "RefractionTestRandom.h"
#include "StackTestScene.h"

#include "Refraction/Stack/StackInverse.h"

namespace
{

using namespace meniscus;
using meniscus::reference::MembraneMesh;
using namespace meniscus::test;

constexpr double Size = 200.0;

// The same surface with the opposite normals.
MembraneMesh Reverse(MembraneMesh mesh)
{
  for (double& x : mesh.Normals)
  {
    x = -x;
  }
  for (std::size_t i = 0; i < mesh.Triangles.size(); i += 3)
  {
    std::swap(mesh.Triangles[i], mesh.Triangles[i + 1]);
  }
  return mesh;
}

// Water below glass; the glass has an upper side of waves, and a lower one with normals downwards.
std::vector<Interface> MakePane()
{
  return { { MakeSurface(MakeWaves(Size, 0.0, 1.5, 6.0, 40)), { 1.0, 1.5 } },
    { MakeSurface(Reverse(MakeWaves(Size, -15.0, 1.0, 8.0, 50))), { 1.333, 1.5 } } };
}

// Points in rows. The default spacing makes them wider than the surfaces.
std::vector<glm::dvec3> MakeRows(double height, double spacing = 6.2)
{
  constexpr int across = 60;
  std::vector<glm::dvec3> points;
  for (int i = 0; i < across * across; ++i)
  {
    const double x = i % across - 0.5 * across;
    const double z = i / across - 0.5 * across;
    points.emplace_back(spacing * x, height, 1.02 * spacing * z);
  }
  return points;
}

std::vector<glm::dvec3> Shuffle(std::vector<glm::dvec3> points)
{
  Random random(3);
  for (std::size_t i = points.size() - 1; i > 0; --i)
  {
    std::swap(points[i], points[static_cast<std::size_t>(random(0.0, static_cast<double>(i)))]);
  }
  return points;
}

// Newton's method leaves 1e-14 of a facet at each interface, which later ones magnify.
constexpr double Tolerance = 1e-11 * Size;

struct Tally
{
  std::array<int, 5> States{}; // by SeenState
  double Largest = 0.0;        // distance of two positions

  void Compare(const TruePosition& found, const TruePosition& alone)
  {
    ASSERT_EQ(found.State, alone.State);
    ++this->States[static_cast<std::size_t>(alone.State)];
    const double distance = glm::length(found.Position - alone.Position);
    this->Largest = distance <= this->Largest ? this->Largest : distance; // keeps a NaN
  }
  int Count(SeenState state) const { return this->States[static_cast<std::size_t>(state)]; }
};

Tally CompareChain(
  const std::vector<Interface>& list, const glm::dvec3& eye, const std::vector<glm::dvec3>& points)
{
  StackSolver solver;
  SetStack(solver, list, eye);
  StackChain chain;
  Tally tally;
  for (const glm::dvec3& point : points)
  {
    tally.Compare(FindTruePosition(solver.GetStack(), 1.0, point, &chain),
      FindTruePosition(solver.GetStack(), 1.0, point));
  }
  EXPECT_LE(tally.Largest, Tolerance);
  return tally;
}

}

//------------------------------------------------------------------------------
TEST(StackInverse, ChainsBehindAPane)
{
  const glm::dvec3 eye(20.0, 150.0, 10.0);
  for (const auto& points : { MakeRows(-80.0), Shuffle(MakeRows(-80.0)) })
  {
    const Tally tally = CompareChain(MakePane(), eye, points);
    EXPECT_GT(tally.Count(SeenState::Refracted), 1000);
    EXPECT_GT(tally.Count(SeenState::Unrefracted), 100); // rays that miss the pane
  }
}

//------------------------------------------------------------------------------
// Rays that miss the second surface, or are totally reflected at it.
TEST(StackInverse, ChainsBehindASmallerSurface)
{
  const std::vector<Interface> list = { { MakeSurface(MakeWaves(Size, 0.0, 1.5, 6.0, 40)),
                                          { 1.0, 1.5 } },
    { MakeSurface(MakeWaves(0.5 * Size, -15.0, 8.0, 4.0, 30)), { 1.5, 1.0 } } };
  const Tally tally = CompareChain(list, glm::dvec3(20.0, 60.0, 10.0), MakeRows(-80.0));
  EXPECT_GT(tally.Count(SeenState::Refracted), 100);
  EXPECT_GT(tally.Count(SeenState::Missed), 100);
  EXPECT_GT(tally.Count(SeenState::TotallyReflected), 100);
}

//------------------------------------------------------------------------------
// Lines cross a ball twice, so that every ray has to be searched for.
TEST(StackInverse, ChainsBehindABall)
{
  MembraneMesh mesh = meniscus::reference::MakeSphere(60, 1.0);
  for (double& x : mesh.Points)
  {
    x *= 40.0;
  }
  const auto ball = MakeSurface(mesh);
  const Tally tally = CompareChain({ { ball, { 1.0, 1.5 } }, { ball, { 1.0, 1.5 } } },
    glm::dvec3(5.0, 150.0, 10.0), MakeRows(-50.0, 2.0));
  EXPECT_GT(tally.Count(SeenState::Refracted), 300);
}

//------------------------------------------------------------------------------
// Eyes in front of both interfaces and between them, in turn: the first link of the one is the
// second of the other.
TEST(StackInverse, ChainsOfSeveralEyes)
{
  StackSolver solver;
  const std::array<glm::dvec3, 2> eyes = { glm::dvec3(20.0, 150.0, 10.0),
    glm::dvec3(3.0, -7.0, 2.0) };
  SetStack(solver, MakePane(), eyes[0]);
  meniscus::EyeTracers tracers(solver.GetStack(), 1.0);
  StackChain chain;
  Tally tally;
  std::size_t i = 0;
  for (const glm::dvec3& point : MakeRows(-80.0))
  {
    const glm::dvec3& eye = eyes[i++ % eyes.size()];
    meniscus::SightRayTracer& tracer = tracers.Get(eye);
    tally.Compare(
      FindTruePosition(tracer, eye, point, &chain), FindTruePosition(tracer, eye, point));
  }
  EXPECT_LE(tally.Largest, Tolerance);
  EXPECT_GT(tally.Count(SeenState::Refracted), 1000);
}

//------------------------------------------------------------------------------
// A ray through several crests of waves: the crossing nearest to a place counts, and the first one
// from the eye on.
TEST(StackInverse, SurfacesAreMetNearAPlace)
{
  const glm::dvec3 eye(-180.0, 16.0, 12.5);
  const glm::dvec3 direction = glm::normalize(glm::dvec3(1.0, -0.05, 0.0));
  meniscus::RefractionStack stack;
  stack.SetInterfaces({ { MakeSurface(MakeWaves(Size, 0.0, 15.0, 8.0, 60)), { 1.0, 1.333 } } });
  ASSERT_EQ(stack.SetEye(eye), meniscus::EyeStatus::Ready);
  const auto& link = stack.GetLinks().front();
  std::vector<double> distances{ 0.0 };
  meniscus::SurfaceCrossing crossing;
  while (
    link.FindCrossing(stack.GetEye() - link.Shift, direction, distances.back() + 1.0, crossing))
  {
    distances.push_back(crossing.Distance);
  }
  ASSERT_GT(distances.size(), 2u);
  const meniscus::StackPatches patches(stack.GetLinks(), stack.GetOrigin());
  for (const auto& [i, off] : Product(Below<std::size_t>(distances.size()), List(-0.5, 0.0, 0.5)))
  {
    meniscus::PatchPoint at;
    const glm::dvec3 near = eye + (distances[i] + off) * direction;
    ASSERT_TRUE(patches.Meet(0, eye, direction, near, at));
    EXPECT_NEAR(
      glm::dot(at.Position - eye, direction), distances[std::max<std::size_t>(i, 1)], 1e-6);
  }
}
