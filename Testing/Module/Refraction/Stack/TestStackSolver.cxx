// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Virtual points behind surfaces in sequence, against closed forms and exact paths.
#include "Refraction/Stack/StackLight.h"
#include "RefractionTestRandom.h"
#include "StackTestScene.h"

namespace
{

using namespace meniscus;
using namespace meniscus::reference;
using namespace meniscus::test;

const double Pi = std::acos(-1.0);

}

//------------------------------------------------------------------------------
// Both glass surfaces are around the eye: no ray is refracted at all.
TEST(RefractionStack, DomePortAroundTheEyeKeepsDirections)
{
  const glm::dvec3 eye(3.0, -2.0, 7.0);
  for (const bool outwards : { false, true })
  {
    const meniscus::InterfaceMedia inner =
      outwards ? meniscus::InterfaceMedia{ 1.5, 1.0 } : meniscus::InterfaceMedia{ 1.0, 1.5 };
    const meniscus::InterfaceMedia outer =
      outwards ? meniscus::InterfaceMedia{ 1.333, 1.5 } : meniscus::InterfaceMedia{ 1.5, 1.333 };
    StackSolver solver;
    SetStack(solver,
      { { MakeSurface(MakeSphere(eye, 50.0, 3, outwards)), inner },
        { MakeSurface(MakeSphere(eye, 57.0, 3, outwards)), outer } },
      eye);
    EXPECT_TRUE(solver.GetStack().HasPassage());
    Random random(3);
    double largest = 0.0;
    for (int i = 0; i < 1000; ++i)
    {
      const glm::dvec3 direction = glm::normalize(random.Point(glm::dvec3(-1.0), glm::dvec3(1.0)));
      const double depth = random(1.0, 400.0);
      const StackVertex vertex = SolveAlone(solver, eye + (57.0 + depth) * direction);
      ASSERT_EQ(vertex.State, ImageState::Found);
      largest = std::max(largest, glm::length(glm::normalize(vertex.Position - eye) - direction));
      EXPECT_NEAR(glm::length(vertex.Position - eye), 50.0 + 7.0 / 1.5 + depth / 1.333, 1e-9);
    }
    EXPECT_LT(largest, 1e-12);
    RecordProperty(outwards ? "outwards" : "inwards", std::to_string(largest * 1e15) + "e-15");
  }
}

//------------------------------------------------------------------------------
// A point at R / n from the centre of a ball is seen at n R on the same radius, by every ray. The
// ball is listed twice; the point is between entering and leaving it.
TEST(RefractionStack, AplanaticPointsOfABallAreSeenExactly)
{
  const glm::dvec3 centre(5.0, 1.0, -2.0);
  constexpr double radius = 30.0;
  constexpr double n = 1.52;
  const auto ball = MakeSurface(MakeSphere(centre, radius, 4, true));
  Random random(4);
  for (int i = 0; i < 40; ++i)
  {
    const glm::dvec3 axis = glm::normalize(random.Point(glm::dvec3(-1.0), glm::dvec3(1.0)));
    // An eye before which the surface in front of the point lies: all rays from the point leave
    // through the side of the axis's other end without total reflection.
    const glm::dvec3 across = glm::normalize(glm::cross(axis, glm::dvec3(0.3, -0.5, 0.8)));
    const glm::dvec3 eye = centre - 150.0 * axis + random(-100.0, 100.0) * across;
    StackSolver solver;
    SetStack(solver, { { ball, { 1.0, n } }, { ball, { 1.0, n } } }, eye);
    const StackVertex vertex = SolveAlone(solver, centre + (radius / n) * axis);
    ASSERT_EQ(vertex.State, ImageState::Found) << i;
    EXPECT_EQ(vertex.Passed, 1);
    EXPECT_LT(GetDistance(centre + n * radius * axis, eye, vertex.SightPoint - eye), 1e-9);
  }
}

//------------------------------------------------------------------------------
// Points on exact rays through a ball of 5,120 facets, in front of the focus, behind it, and among
// caustics: whichever image is found, the exact path of its sight ray leads to the point.
TEST(RefractionStack, BallLensAgreesWithExactPaths)
{
  const glm::dvec3 eye(4.0, 200.0, -3.0);
  const glm::dvec3 centre(0.0, 0.0, 0.0);
  const auto ball = MakeSurface(MakeSphere(centre, 40.0, 4, true));
  StackSolver solver;
  SetStack(solver, { { ball, { 1.0, 1.5 } }, { ball, { 1.0, 1.5 } } }, eye);
  const std::vector<ExactSurface> exact{ { 1.0, 1.5, centre, 40.0 },
    { 1.5, 1.0, centre, 40.0, glm::dvec3(0.0), true } };
  Random random(5);
  double largest = 0.0;
  double largestSame = 0.0;
  int same = 0;
  constexpr int points = 4000;
  for (int i = 0; i < points; ++i)
  {
    // Sight rays that meet the ball at up to 0.98 of its radius.
    const double angle = random(0.0, 2.0 * Pi);
    const double r = 39.0 * std::sqrt(random(0.0, 1.0));
    const glm::dvec3 toward = glm::normalize(centre - eye);
    const glm::dvec3 side = glm::normalize(glm::cross(toward, glm::dvec3(1.0, 0.0, 0.0)));
    const glm::dvec3 target =
      centre + r * (std::cos(angle) * side + std::sin(angle) * glm::cross(toward, side));
    const auto path = TraceExactly(exact, eye, target - eye);
    ASSERT_TRUE(path);
    const auto image = MakeImage(exact, *path, random(1.0, 150.0));
    const StackVertex vertex = SolveAlone(solver, image.Point);
    ASSERT_EQ(vertex.State, ImageState::Found) << i;
    const auto own = TraceExactly(exact, eye, vertex.SightPoint - eye);
    ASSERT_TRUE(own);
    const glm::dvec3 last = own->Points[1];
    largest = std::max(largest, GetDistance(image.Point, last, own->Directions[2]));
    EXPECT_GT(glm::dot(image.Point - last, own->Directions[2]), 0.0);
    const auto ownImage = MakeImage(exact, *own, glm::length(image.Point - last));
    EXPECT_LT(glm::length(ownImage.Virtual - vertex.Position), 1e-6);
    if (glm::length(path->Points[0] - vertex.SightPoint) < 1e-3)
    {
      ++same;
      largestSame = std::max(largestSame, glm::length(image.Virtual - vertex.Position));
    }
  }
  EXPECT_LT(largest, 1e-6);
  EXPECT_LT(largestSame, 1e-6);
  EXPECT_GT(same, points / 3);
  EXPECT_EQ(solver.GetNumberOfUndecidedSearches(), 0);
  RecordProperty("largest_distance", std::to_string(largest * 1e9) + "e-9");
  RecordProperty("largest_virtual", std::to_string(largestSame * 1e9) + "e-9");
}

//------------------------------------------------------------------------------
// Two caps of 5,000 facets each; the second one is concave to the eye.
TEST(RefractionStack, BiconvexLensAgreesWithExactPaths)
{
  const glm::dvec3 eye(2.0, 150.0, 1.0);
  constexpr double r1 = 60.0;
  constexpr double r2 = 80.0;
  // Vertices at y = 8 and y = -8.
  const glm::dvec3 c1(0.0, 8.0 - r1, 0.0);
  const glm::dvec3 c2(0.0, r2 - 8.0, 0.0);
  const glm::dvec3 up(0.0, 1.0, 0.0);
  StackSolver solver;
  SetStack(solver,
    { { MakeSurface(MakeCap(c1, r1, up, up, 40.0, 50)), { 1.0, 1.52 } },
      { MakeSurface(MakeCap(c2, r2, -up, up, 40.0, 50)), { 1.52, 1.333 } } },
    eye);
  const std::vector<ExactSurface> exact{ { 1.0, 1.52, c1, r1 },
    { 1.52, 1.333, c2, r2, glm::dvec3(0.0), true } };
  Random random(6);
  double largest = 0.0;
  for (int i = 0; i < 4000; ++i)
  {
    const glm::dvec3 target(random(-17.0, 17.0), 8.0, random(-17.0, 17.0));
    const auto path = TraceExactly(exact, eye, target - eye);
    ASSERT_TRUE(path);
    // Before the focus, where every point has one image.
    const auto image = MakeImage(exact, *path, random(0.5, 40.0));
    const StackVertex vertex = SolveAlone(solver, image.Point);
    ASSERT_EQ(vertex.State, ImageState::Found) << i;
    largest = std::max(largest, glm::length(image.Virtual - vertex.Position));
  }
  EXPECT_LT(largest, 1e-6);
  EXPECT_EQ(solver.GetNumberOfUndecidedSearches(), 0);
  RecordProperty("largest_error", std::to_string(largest * 1e9) + "e-9");
}

//------------------------------------------------------------------------------
TEST(RefractionStack, PointsAreRefractedByTheInterfacesInFrontOfThem)
{
  const glm::dvec3 eye(0.0, 80.0, 0.0);
  const auto first = MakeSurface(MakePlane(0.0, 400.0, 5));
  StackSolver both;
  SetStack(both,
    { { first, { 1.0, 1.5 } }, { MakeSurface(MakePlane(-20.0, 400.0, 5)), { 1.5, 1.333 } } }, eye);
  StackSolver one;
  SetStack(one, { { first, { 1.0, 1.5 } } }, eye);
  Random random(7);
  for (int i = 0; i < 500; ++i)
  {
    const glm::dvec3 before(random(-50.0, 50.0), random(1.0, 70.0), random(-50.0, 50.0));
    const StackVertex own = SolveAlone(both, before);
    const double reach = 80.0 / (80.0 - before.y); // to where the straight ray meets the first one
    if (std::max(std::fabs(before.x), std::fabs(before.z)) * reach > 200.0)
    {
      EXPECT_EQ(own.State, ImageState::NoImage);
      continue;
    }
    EXPECT_EQ(own.State, ImageState::Found);
    EXPECT_EQ(own.Position, before);
    EXPECT_EQ(own.Passed, 0);
    EXPECT_EQ(own.Facet, -1);
    const glm::dvec3 between(random(-50.0, 50.0), random(-19.9, -0.1), random(-50.0, 50.0));
    const StackVertex vertex = SolveAlone(both, between);
    ASSERT_EQ(vertex.State, ImageState::Found);
    EXPECT_EQ(vertex.Passed, 1);
    EXPECT_EQ(vertex.Position, SolveAlone(one, between).Position);
  }
  // On an interface the two answers agree, and one is given.
  for (const double y : { 0.0, -20.0 })
  {
    const glm::dvec3 on(12.0, y, -7.0);
    const StackVertex at = SolveAlone(both, on);
    const StackVertex behind = SolveAlone(both, on - glm::dvec3(0.0, 1e-9, 0.0));
    ASSERT_EQ(at.State, ImageState::Found) << y;
    ASSERT_EQ(behind.State, ImageState::Found) << y;
    EXPECT_LT(glm::length(at.Position - behind.Position), 1e-8);
  }
}

//------------------------------------------------------------------------------
// Points whose rays miss a later interface are not seen, on whichever side of it they lie.
TEST(RefractionStack, RaysThatMissALaterInterfaceShowNothing)
{
  const glm::dvec3 eye(0.0, 80.0, 0.0);
  StackSolver solver;
  SetStack(solver,
    { { MakeSurface(MakePlane(0.0, 400.0, 5)), { 1.0, 1.5 } },
      { MakeSurface(MakePlane(-20.0, 40.0, 5)), { 1.5, 1.333 } } },
    eye);
  EXPECT_EQ(SolveAlone(solver, { 0.0, -40.0, 0.0 }).State, ImageState::Found);
  EXPECT_EQ(SolveAlone(solver, { 100.0, -40.0, 0.0 }).State, ImageState::NoImage);
  EXPECT_EQ(SolveAlone(solver, { 100.0, -10.0, 0.0 }).State, ImageState::NoImage);
  EXPECT_EQ(SolveAlone(solver, { 5.0, -10.0, 0.0 }).State, ImageState::Found);
  EXPECT_EQ(SolveAlone(solver, { 0.0, 90.0, 0.0 }).State, ImageState::NoImage); // behind the eye
  EXPECT_EQ(SolveAlone(solver, { std::nan(""), -40.0, 0.0 }).State, ImageState::NotFinite);
}

//------------------------------------------------------------------------------
// From an index of 1.5 to 1, sight rays beyond 41.8 degrees are totally reflected at the second
// interface. What lies on them in front of it is seen.
TEST(RefractionStack, TotalReflectionAtALaterInterfaceShowsNothing)
{
  const glm::dvec3 eye(0.0, 80.0, 0.0);
  StackSolver solver;
  SetStack(solver,
    { { MakeSurface(MakePlane(0.0, 2000.0, 20)), { 1.5, 1.6 } },
      { MakeSurface(MakePlane(-20.0, 2000.0, 20)), { 1.6, 1.0 } } },
    eye);
  const std::vector<ExactSurface> exact{ { 1.5, 1.6, glm::dvec3(0.0), 0.0, { 0.0, 1.0, 0.0 } },
    { 1.6, 1.0, { 0.0, -20.0, 0.0 }, 0.0, { 0.0, 1.0, 0.0 } } };
  const double critical = std::asin(1.0 / 1.5);
  const auto path =
    TraceExactly(exact, eye, { std::sin(0.95 * critical), -std::cos(0.95 * critical), 0.0 });
  ASSERT_TRUE(path);
  const auto image = MakeImage(exact, *path, 30.0);
  const StackVertex vertex = SolveAlone(solver, image.Point);
  ASSERT_EQ(vertex.State, ImageState::Found);
  EXPECT_LT(glm::length(vertex.Position - image.Virtual), 1e-8);
  // Between the interfaces, on a ray that is reflected at the second one.
  EXPECT_EQ(SolveAlone(solver, { 200.0, -15.0, 0.0 }).State, ImageState::Found);
  EXPECT_FALSE(TraceExactly(exact, eye, { 200.0, -80.0, 0.0 }));
}

//------------------------------------------------------------------------------
TEST(RefractionStack, EqualIndicesChangeNoBit)
{
  const glm::dvec3 eye(10.0, 90.0, 5.0);
  const auto top = MakeSurface(
    MakeCap({ 0.0, -100.0, 0.0 }, 100.0, { 0.0, 1.0, 0.0 }, { 0.0, 1.0, 0.0 }, 80.0, 20));
  const auto other = MakeSurface(MakePlane(-5.0, 300.0, 9));
  StackSolver plain;
  SetStack(plain, { { top, { 1.0, 1.4 } } }, eye);
  StackSolver padded;
  SetStack(
    padded, { { other, { 1.0, 1.0 } }, { top, { 1.0, 1.4 } }, { other, { 1.4, 1.4 } } }, eye);
  StackSolver none;
  SetStack(none, { { top, { 1.3, 1.3 } }, { other, { 1.3, 1.3 } }, { top, { 1.3, 1.3 } } }, eye);
  EXPECT_EQ(padded.GetStack().GetLinks().size(), 1u);
  EXPECT_EQ(none.GetStack().GetLinks().size(), 0u);
  Random random(8);
  for (int i = 0; i < 500; ++i)
  {
    const glm::dvec3 point = random.Point({ -30.0, -80.0, -30.0 }, { 30.0, -20.0, 30.0 });
    const StackVertex a = SolveAlone(plain, point);
    const StackVertex b = SolveAlone(padded, point);
    ASSERT_EQ(a.State, ImageState::Found);
    EXPECT_EQ(a.Position, b.Position);
    EXPECT_EQ(a.SightPoint, b.SightPoint);
    EXPECT_EQ(a.Depth, b.Depth);
    EXPECT_EQ(SolveAlone(none, point).Position, point);
    EXPECT_EQ(SolveAlone(none, point).State, ImageState::Found);
  }
}

//------------------------------------------------------------------------------
TEST(RefractionStack, ListStartsBehindAnEyeBetweenInterfaces)
{
  const auto first = MakeSurface(MakePlane(0.0, 300.0, 5));
  const auto second = MakeSurface(MakePlane(-20.0, 300.0, 5));
  const glm::dvec3 eye(0.0, -8.0, 0.0);
  StackSolver inside;
  SetStack(inside, { { first, { 1.0, 1.5 } }, { second, { 1.5, 1.0 } } }, eye);
  ASSERT_EQ(inside.GetStack().GetLinks().size(), 1u);
  EXPECT_EQ(inside.GetStack().GetLinks()[0].Index, 1u);
  StackSolver alone;
  SetStack(alone, { { second, { 1.5, 1.0 } } }, eye);
  const glm::dvec3 point(3.0, -40.0, 2.0);
  EXPECT_LT(glm::length(SolveAlone(inside, point).Position - SolveAlone(alone, point).Position),
    1e-12 * 100.0);

  // In a ball: the list begins where rays leave it.
  const auto ball = MakeSurface(MakeSphere(glm::dvec3(0.0), 30.0, 3, true));
  StackSolver within;
  SetStack(within, { { ball, { 1.0, 1.5 } }, { ball, { 1.0, 1.5 } } }, { 1.0, 2.0, 3.0 });
  ASSERT_EQ(within.GetStack().GetLinks().size(), 1u);
  EXPECT_FALSE(within.GetStack().GetLinks()[0].Passage.FromFront);

  // Behind both: nothing passes.
  StackSolver behind;
  SetStack(behind, { { first, { 1.0, 1.5 } }, { second, { 1.5, 1.333 } } }, { 0.0, -50.0, 0.0 });
  EXPECT_FALSE(behind.GetStack().HasPassage());
  EXPECT_EQ(SolveAlone(behind, point).State, ImageState::NoImage);
}

//------------------------------------------------------------------------------
// The critical angle is at 165 from the point of the first pane below the eye, and the pane begins
// 163.5 from there: only next to its border do rays pass. None goes to the middle of a facet, which
// is 40 wide, or of a quarter of it.
TEST(RefractionStack, ListBeginsAtAPaneThatFewRaysPass)
{
  const std::vector<Interface> list = { { MakeSurface(MakePlane(0.0, 200.0, 5)), { 1.0, 0.6 } },
    { MakeSurface(MakePlane(-5.0, 400.0, 5)), { 0.6, 1.5 } } };
  StackSolver solver;
  SetStack(solver, list, { -263.5, 220.0, 0.0 });
  EXPECT_TRUE(solver.GetStack().HasPassage());
  EXPECT_EQ(solver.GetStack().GetLinks().size(), 2u);
  // Beyond the critical angle everywhere.
  SetStack(solver, list, { -265.5, 220.0, 0.0 });
  EXPECT_EQ(solver.GetStack().GetLinks().size(), 1u);
}

//------------------------------------------------------------------------------
// A sea of two facets in front of a window: no ray through a part of 2^-6 of a facet meets it.
TEST(RefractionStack, ListBeginsAtFacetsMuchLargerThanTheNextSurface)
{
  for (const double half : { 300.0, 1e4, 1e6 })
  {
    const std::vector<Interface> list = { { MakeSurface(MakePlane(0.0, half, 1)), { 1.0, 1.333 } },
      { MakeSurface(MakePlane(-20.0, 2.0, 3)), { 1.333, 1.5 } } };
    StackSolver solver;
    SetStack(solver, list, { 7.0, 80.0, 3.0 });
    EXPECT_TRUE(solver.GetStack().HasPassage()) << half;
    EXPECT_EQ(solver.GetStack().GetLinks().size(), 2u) << half;
  }
}

//------------------------------------------------------------------------------
// Large facets that reflect nearly everywhere: the eye is in the denser medium. The surface behind
// them is as large.
TEST(RefractionStack, ListBeginsAtFacetsThatReflectNearlyEverywhere)
{
  for (const auto& [half, index] : Product(List(300.0, 4e3, 7e4, 5e6), List(1.0003, 1.35)))
  {
    MembraneMesh first = MakePlane(0.0, 2.0 * half, 2);
    first.Translate(half * glm::dvec3(0.3, 0.0, -0.2));
    MembraneMesh second = MakePlane(-0.5, 200.0 * half, 1);
    second.Translate(100.0 * half * glm::dvec3(-0.6, 0.0, 0.45));
    StackSolver solver;
    SetStack(solver,
      { { MakeSurface(first), { index, 1.0 } }, { MakeSurface(second), { 1.0, 2.3 } } },
      { 0.2, 1.5, 0.1 });
    EXPECT_EQ(solver.GetStack().GetLinks().size(), 2u) << half << ", index " << index;
  }
}

//------------------------------------------------------------------------------
TEST(RefractionStack, WrongOrderIsNoticed)
{
  StackSolver solver;
  SetStack(solver,
    { { MakeSurface(MakePlane(-20.0, 300.0, 5)), { 1.0, 1.5 } },
      { MakeSurface(MakePlane(0.0, 300.0, 5)), { 1.5, 1.333 } } },
    { 0.0, 80.0, 0.0 });
  EXPECT_FALSE(solver.GetStack().HasPassage() && solver.GetStack().GetLinks().size() == 2);
}

//------------------------------------------------------------------------------
TEST(RefractionStack, EyeOnASurfaceIsAnError)
{
  StackSolver solver;
  ASSERT_EQ(solver
              .SetInterfaces({ { MakeSurface(MakePlane(0.0, 300.0, 5)), { 1.0, 1.5 } },
                { MakeSurface(MakePlane(-20.0, 300.0, 5)), { 1.5, 1.0 } } })
              .Fault,
    meniscus::MediaFault::None);
  EXPECT_EQ(solver.SetEye({ 1.0, 0.0, 2.0 }), EyeStatus::OnTheMembrane);
  EXPECT_EQ(solver.SetEye({ 1.0, std::nan(""), 2.0 }), EyeStatus::NotFinite);
}

//------------------------------------------------------------------------------
// Chains begin at multiples of Chain, so ranges that do give the same bits.
TEST(RefractionStack, RangesDoNotChangeResults)
{
  const auto ball = MakeSurface(MakeSphere(glm::dvec3(0.0), 40.0, 3, true));
  StackSolver solver;
  SetStack(solver, { { ball, { 1.0, 1.4 } }, { ball, { 1.0, 1.4 } } }, { 0.0, 150.0, 10.0 });
  constexpr std::size_t count = 5 * StackSolver::Chain;
  std::vector<double> points;
  for (std::size_t i = 0; i < count; ++i)
  {
    const double t = static_cast<double>(i) / count;
    points.insert(points.end(), { 30.0 * std::sin(7.0 * t), -60.0 - 20.0 * t, 30.0 * t - 15.0 });
  }
  std::vector<meniscus::VirtualVertex> whole(count);
  std::vector<meniscus::StackDetail> details(count);
  std::vector<double> legs(2 * count);
  solver.Solve(points.data(), 0, count, whole.data(), details.data(), legs.data());
  const std::vector<double> wholeLegs = legs;
  std::vector<meniscus::VirtualVertex> parts(count);
  for (const std::size_t k : { 3u, 0u, 4u, 1u, 2u })
  {
    solver.Solve(points.data(), k * StackSolver::Chain, (k + 1) * StackSolver::Chain, parts.data(),
      details.data(), legs.data());
  }
  EXPECT_EQ(legs, wholeLegs);
  for (std::size_t i = 0; i < count; ++i)
  {
    EXPECT_EQ(whole[i].State, ImageState::Found);
    EXPECT_EQ(whole[i].Position, parts[i].Position);
    EXPECT_NEAR(legs[2 * i] + legs[2 * i + 1], whole[i].Depth, 1e-12 * 200.0);
  }
}

//------------------------------------------------------------------------------
// Between surfaces that a line crosses once, the places of an earlier ray are first guesses: they
// must not reach from one range of points, or of patches, to the next.
TEST(RefractionStack, RangesOfRaysThroughPanesDoNotChangeResults)
{
  const auto first = MakeSurface(meniscus::test::MakeWaves(100.0, 0.0, 0.8, 3.0, 12));
  const auto second = MakeSurface(MakePlane(-15.0, 120.0, 9));
  const std::vector<Interface> list{ { first, { 1.0, 1.5 } }, { second, { 1.5, 1.333 } } };
  const glm::dvec3 eye(5.0, 90.0, -8.0);
  const auto singly = [](std::size_t count, const meniscus::RangeBody& body)
  {
    for (std::size_t i = count; i-- > 0;)
    {
      body(i, i + 1);
    }
  };
  StackSolver solver;
  SetStack(solver, list, eye);
  StackSolver other;
  ASSERT_EQ(other.SetInterfaces(list).Fault, meniscus::MediaFault::None);
  ASSERT_EQ(other.SetEye(eye, singly), EyeStatus::Ready);
  constexpr std::size_t chains = 60;
  constexpr std::size_t count = chains * StackSolver::Chain;
  std::vector<double> points;
  Random random(9);
  for (std::size_t i = 0; i < count; ++i)
  {
    points.insert(points.end(), { random(-40.0, 40.0), random(-90.0, -16.0), random(-40.0, 40.0) });
  }
  std::vector<meniscus::VirtualVertex> whole(count);
  std::vector<meniscus::VirtualVertex> parts(count);
  std::vector<meniscus::StackDetail> details(count);
  std::vector<double> legs(2 * count);
  solver.Solve(points.data(), 0, count, whole.data(), details.data(), legs.data());
  for (std::size_t k = chains; k-- > 0;)
  {
    other.Solve(points.data(), k * StackSolver::Chain, (k + 1) * StackSolver::Chain, parts.data(),
      details.data(), legs.data());
  }
  int found = 0;
  for (std::size_t i = 0; i < count; ++i)
  {
    EXPECT_EQ(whole[i].State, parts[i].State) << i;
    EXPECT_EQ(whole[i].Position, parts[i].Position) << i;
    EXPECT_EQ(whole[i].SightPoint, parts[i].SightPoint) << i;
    found += whole[i].State == ImageState::Found;
  }
  EXPECT_GT(found, 3000);

  meniscus::LitTriangles floor;
  const auto mesh = MakePlane(-50.0, 80.0, 12);
  for (std::size_t i = 0; i < mesh.Points.size(); i += 3)
  {
    floor.Points.emplace_back(mesh.Points[i], mesh.Points[i + 1], mesh.Points[i + 2]);
  }
  for (std::size_t i = 0; i < mesh.Triangles.size(); i += 3)
  {
    floor.Triangles.push_back({ mesh.Triangles[i], mesh.Triangles[i + 1], mesh.Triangles[i + 2] });
    floor.Cells.push_back(static_cast<std::int64_t>(i / 3));
  }
  const meniscus::StackLight light(solver.GetStack(), floor);
  const auto serial = light.Gather(floor.Cells.size(), meniscus::SerialLoop);
  const auto parallel = light.Gather(floor.Cells.size(), singly);
  double most = 0.0;
  for (std::size_t i = 0; i < serial.size(); ++i)
  {
    EXPECT_EQ(serial[i].Flux, parallel[i].Flux);
    EXPECT_EQ(serial[i].Vector, parallel[i].Vector);
    EXPECT_EQ(serial[i].Path, parallel[i].Path);
    most = std::max(most, serial[i].Flux);
  }
  EXPECT_GT(most, 0.0);
}
