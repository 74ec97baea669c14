// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Images in mirrors: planes in closed form, spheres by Alhazen's equation, waves by a dense search.
#include "OracleImages.h"
#include "ReadySolver.h"
#include "Refraction/Curved/InjectivityGrid.h"
#include "Refraction/Membrane/Optics.h"
#include "Refraction/Tubes/RefractedRayBounds.h"
#include "RefractionTestRandom.h"

#include <complex>

namespace
{

using namespace meniscus;
using namespace meniscus::reference;
using namespace meniscus::test;

struct Mirror : ReadySolver
{
  Mirror(const MembraneMesh& mesh, const glm::dvec3& eye)
    : ReadySolver(mesh, eye, 1.0, 1.333, true)
  {
  }
  EyeStatus Look(const glm::dvec3& eye)
  {
    return this->SetEye(eye, 1.0, 1.333, meniscus::SerialLoop, true);
  }
};

//------------------------------------------------------------------------------
// The mirror image by a plane is the reflected point. Sight points beyond the border are no images.
TEST(Reflection, PlaneMirrorsAreExact)
{
  constexpr double half = 1.0;
  const glm::dvec3 eye(0.2, 3.0, 0.1);
  Mirror geometry(meniscus::reference::MakeSquare(2.0 * half, 8, 0.0), eye);
  Random random(5);
  std::vector<VirtualVertex> images;
  int seen = 0;
  int hidden = 0;
  for (int i = 0; i < 2000; ++i)
  {
    const glm::dvec3 point = random.Point({ -2.0, 1e-3, -2.0 }, { 2.0, 2.0, 2.0 });
    const glm::dvec3 exact(point.x, -point.y, point.z);
    const glm::dvec3 sight = eye + (exact - eye) * (eye.y / (eye.y + point.y));
    const double reach = std::max(std::fabs(sight.x), std::fabs(sight.z));
    if (std::fabs(reach - half) < 1e-6)
    {
      continue;
    }
    const VirtualVertex one = geometry.SolveOne(point);
    geometry.FindImages(point, images);
    if (reach > half)
    {
      EXPECT_EQ(one.State, ImageState::NoImage);
      EXPECT_TRUE(images.empty());
      ++hidden;
      continue;
    }
    ASSERT_EQ(one.State, ImageState::Found);
    ASSERT_EQ(images.size(), 1u);
    for (const VirtualVertex& vertex : { one, images.front() })
    {
      EXPECT_LT(glm::length(vertex.Position - exact), 1e-12);
      EXPECT_LT(glm::length(vertex.SightPoint - sight), 1e-12);
      EXPECT_NEAR(vertex.Depth, glm::length(point - sight), 1e-12);
      EXPECT_EQ(vertex.Orientation, 1);
      EXPECT_NEAR(vertex.Reflectance,
        meniscus::FresnelReflectance(eye.y / glm::length(sight - eye), 1.0, 1.333), 1e-12);
    }
    ++seen;
  }
  EXPECT_GT(seen, 300);
  EXPECT_GT(hidden, 300);
}

//------------------------------------------------------------------------------
TEST(Reflection, PointsBehindAndOnAPlaneMirror)
{
  Mirror geometry(meniscus::reference::MakeSquare(2.0, 8, 0.0), { 0.2, 3.0, 0.1 });
  Random random(7);
  std::vector<VirtualVertex> images;
  for (int i = 0; i < 200; ++i)
  {
    const glm::dvec3 behind = random.Point({ -2.0, -2.0, -2.0 }, { 2.0, -1e-9, 2.0 });
    EXPECT_EQ(geometry.SolveOne(behind).State, ImageState::NoImage);
    EXPECT_EQ(geometry.FindImages(behind, images), ImageState::NoImage);
    const glm::dvec3 on = random.Point({ -0.9, 0.0, -0.9 }, { 0.9, 0.0, 0.9 });
    ASSERT_EQ(geometry.FindImages(on, images), ImageState::Found);
    ASSERT_EQ(images.size(), 1u);
    EXPECT_EQ(images.front().Position, on);
    EXPECT_EQ(images.front().Depth, 0.0);
    EXPECT_EQ(geometry.SolveOne(on).Position, on);
  }
  EXPECT_EQ(geometry.GetNumberOfUndecidedSearches() + geometry.GetNumberOfUndecidedSides(), 0);
  const double bad = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(geometry.FindImages({ bad, 1.0, 0.0 }, images), ImageState::NotFinite);
}

//------------------------------------------------------------------------------
// A mirror that is seen from behind, and an eye on it.
TEST(Reflection, BacksOfMirrorsShowNothing)
{
  Mirror geometry(meniscus::reference::MakeSquare(2.0, 8, 0.0), { 0.1, 1.0, 0.2 });
  EXPECT_EQ(geometry.Look({ 0.1, 0.0, 0.2 }), EyeStatus::OnTheMembrane);
  ASSERT_EQ(geometry.Look({ 0.1, -1.0, 0.2 }), EyeStatus::Ready);
  EXPECT_FALSE(geometry.FacesEye());
  std::vector<VirtualVertex> images;
  for (const double height : { 1.0, -1.0, -0.5 })
  {
    EXPECT_EQ(geometry.FindImages({ 0.3, height, 0.1 }, images), ImageState::NoImage);
    EXPECT_EQ(geometry.SolveOne({ 0.3, height, 0.1 }).State, ImageState::NoImage);
  }
}

//------------------------------------------------------------------------------
// Roots of a polynomial of fourth degree by Durand and Kerner's iteration, in extended precision.
using Complex = std::complex<long double>;

std::array<Complex, 4> FindRoots(const std::array<Complex, 5>& coefficients)
{
  std::array<Complex, 4> roots;
  for (std::size_t i = 0; i < 4; ++i)
  {
    roots[i] = std::pow(Complex(0.4L, 0.9L), static_cast<int>(i));
  }
  for (const auto& [step, i] : Product(500, Below<std::size_t>(4)))
  {
    Complex value = coefficients[4];
    for (std::size_t k = 4; k-- > 0;)
    {
      value = value * roots[i] + coefficients[k];
    }
    Complex product = coefficients[4];
    for (std::size_t k = 0; k < 4; ++k)
    {
      product *= k == i ? Complex(1.0L) : roots[i] - roots[k];
    }
    roots[i] -= value / product;
  }
  return roots;
}

// Alhazen's problem on the unit sphere. In the plane of centre, eye e and point p, as complex
// numbers, the mirror's normal at z halves the angle if (e - z)(p - z) / z^2 is real; with
// conj(z) = 1 / z on the circle this is a polynomial of fourth degree in z. `side` is +1 if the
// outside is the mirror.
std::vector<glm::dvec3> SolveAlhazen(const glm::dvec3& eye, const glm::dvec3& point, double side)
{
  const glm::dvec3 first = glm::normalize(eye);
  const glm::dvec3 across = glm::normalize(point - glm::dot(point, first) * first);
  const Complex e(glm::length(eye), 0.0L);
  const Complex p(glm::dot(point, first), glm::dot(point, across));
  const auto roots = FindRoots(
    { -e * p, e + p, Complex(0.0L), -(std::conj(e) + std::conj(p)), std::conj(e) * std::conj(p) });
  std::vector<glm::dvec3> sights;
  for (const Complex& z : roots)
  {
    const auto height = [&z, side](const Complex& at)
    { return static_cast<double>(((at - z) * std::conj(z)).real()) * side; };
    if (std::fabs(static_cast<double>(std::abs(z)) - 1.0) < 1e-9 && height(e) > 0.0 &&
      height(p) > 0.0)
    {
      sights.push_back(
        static_cast<double>(z.real()) * first + static_cast<double>(z.imag()) * across);
    }
  }
  return sights;
}

struct Ball
{
  const char* Name;
  double Side;
  glm::dvec3 Eye;
  double Reach; ///< of the points from the centre
};

// Patches reproduce spheres, so the image points are those of the sphere.
TEST(Reflection, SpheresShowTheImagesOfAlhazensProblem)
{
  const Ball balls[] = { { "convex", 1.0, { 1.3, 2.0, 0.4 }, 3.0 },
    { "convex, near", 1.0, { 0.3, 0.2, 1.1 }, 2.0 }, { "concave", -1.0, { 0.3, 0.4, 0.2 }, 0.98 },
    { "concave, near the mirror", -1.0, { 0.1, -0.9, 0.2 }, 0.98 } };
  for (const Ball& ball : balls)
  {
    Mirror geometry(meniscus::reference::MakeSphere(32, ball.Side), ball.Eye);
    Random random(11);
    std::vector<VirtualVertex> images;
    int points = 0;
    int several = 0;
    int close = 0;
    double largest = 0.0;
    while (points < 400)
    {
      const glm::dvec3 point = random.Point(glm::dvec3(-ball.Reach), glm::dvec3(ball.Reach));
      const double radius = glm::length(point);
      if (ball.Side > 0.0 ? radius < 1.01 : radius > ball.Reach)
      {
        continue;
      }
      ++points;
      const std::vector<glm::dvec3> exact = SolveAlhazen(ball.Eye, point, ball.Side);
      geometry.FindImages(point, images);
      if (HasClosePair(exact, 1e-3))
      {
        ++close;
        continue;
      }
      ASSERT_EQ(images.size(), exact.size())
        << ball.Name << ": " << point.x << " " << point.y << " " << point.z;
      for (const glm::dvec3& sight : exact)
      {
        const glm::dvec3 seen =
          sight + glm::normalize(sight - ball.Eye) * glm::length(point - sight);
        double nearest = 1e300;
        for (const VirtualVertex& vertex : images)
        {
          nearest = std::min(nearest, glm::length(vertex.Position - seen));
        }
        largest = std::max(largest, nearest);
      }
      several += exact.size() > 1;
      const VirtualVertex one = geometry.SolveOne(point);
      EXPECT_EQ(one.State == ImageState::Found, !exact.empty()) << ball.Name;
    }
    EXPECT_LT(largest, 1e-9) << ball.Name;
    EXPECT_LT(close, points / 20) << ball.Name;
    EXPECT_EQ(several > points / 2, ball.Side < 0.0) << ball.Name;
    std::printf("%s: largest error %.1e\n", ball.Name, largest);
  }
}

//------------------------------------------------------------------------------
// Inside and outside of closed mirrors: nothing is seen through them.
TEST(Reflection, ClosedMirrorsHideTheirOtherSide)
{
  std::vector<VirtualVertex> images;
  Mirror ball(meniscus::reference::MakeSphere(16, 1.0), { 0.0, 3.0, 0.5 });
  EXPECT_EQ(ball.FindImages({ 0.1, 0.5, 0.2 }, images), ImageState::NoImage);
  Mirror room(meniscus::reference::MakeSphere(16, -1.0), { 0.1, 0.2, 0.3 });
  EXPECT_EQ(room.FindImages({ 2.0, 0.5, 0.2 }, images), ImageState::NoImage);
  EXPECT_EQ(room.FindImages({ 0.3, -0.2, 0.1 }, images), ImageState::Found);
  // An eye inside of a ball sees the backs of its facets only.
  ASSERT_EQ(ball.Look({ 0.1, 0.2, 0.3 }), EyeStatus::Ready);
  EXPECT_FALSE(ball.FacesEye());
  EXPECT_EQ(ball.FindImages({ 0.3, -0.2, 0.1 }, images), ImageState::NoImage);
  EXPECT_EQ(ball.FindImages({ 2.0, 0.5, 0.2 }, images), ImageState::NoImage);
}

//------------------------------------------------------------------------------
struct WaveCase
{
  const char* Name;
  HeightField Field;
  glm::dvec3 Eye;
  double Lowest;
  double Highest;
  double Reach;
};

std::vector<WaveCase> GetWaveCases()
{
  const double k = 0.03 * std::acos(-1.0);
  const HeightField waves{ HeightField::Shape::Waves, 200.0, 1.5, k, 1.0, 1.0, true };
  const HeightField dome{ HeightField::Shape::Dome, 200.0, 8.0, 0.025, 1.0, 1.0, true };
  const HeightField dish{ HeightField::Shape::Dome, 200.0, -8.0, 0.025, 1.0, 1.0, true };
  return { { "waves", waves, { 20.0, 300.0, 10.0 }, 20.0, 250.0, 80.0 },
    { "low eye", waves, { 150.0, 60.0, 20.0 }, 20.0, 100.0, 60.0 },
    { "dome", dome, { 5.0, 400.0, 3.0 }, 20.0, 200.0, 60.0 },
    { "dish", dish, { 5.0, 400.0, 3.0 }, 20.0, 200.0, 40.0 } };
}

TEST(Reflection, WavesShowAllImagesAndNoOthers)
{
  constexpr int cells = 96;
  for (const WaveCase& test : GetWaveCases())
  {
    SCOPED_TRACE(test.Name);
    Mirror geometry(test.Field.MakeMesh(cells), test.Eye);
    Random random(83);
    OracleCounts counts;
    constexpr int points = 200;
    for (int i = 0; i < points; ++i)
    {
      const glm::dvec3 point = random.Point(
        { -test.Reach, test.Lowest, -test.Reach }, { test.Reach, test.Highest, test.Reach });
      ExpectImagesOfTheField(geometry, test.Field, cells, test.Eye, point, counts);
    }
    EXPECT_GT(counts.Images, points / 2);
    EXPECT_EQ(counts.Several > points / 20, test.Field.Amplitude != 8.0);
    EXPECT_LT(counts.Close, points / 5);
  }
}

//------------------------------------------------------------------------------
// The test for at most one image holds where the search finds at most one.
TEST(Reflection, RegionsWithOneImageHaveOne)
{
  HeightField field = GetWaveCases().front().Field;
  field.Amplitude = 0.5;
  const glm::dvec3 eye(20.0, 300.0, 10.0);
  Mirror geometry(field.MakeMesh(64), eye);
  geometry.PrepareField();
  ASSERT_TRUE(geometry.HasConvexField());
  // Heights along the frame, which points down.
  meniscus::InjectivityGrid unique;
  unique.Build(geometry.GetMembrane(), geometry.GetPatches(), geometry.GetFrame(),
    geometry.HasConvexField(), geometry.GetLargestBulge(), geometry.GetMedia(), -800.0, -10.0,
    meniscus::SerialLoop);
  Random random(3);
  std::vector<VirtualVertex> images;
  int proved = 0;
  int several = 0;
  for (int i = 0; i < 600; ++i)
  {
    const glm::dvec3 point = random.Point({ -60.0, 12.0, -60.0 }, { 60.0, 790.0, 60.0 });
    const glm::dvec3 local = point - geometry.GetMembrane().GetOrigin();
    geometry.FindImages(point, images);
    several += images.size() > 1;
    if (unique.HoldsAtMostOne(local - glm::dvec3(1.0), local + glm::dvec3(1.0)))
    {
      EXPECT_LE(images.size(), 1u) << point.x << " " << point.y << " " << point.z;
      ++proved;
    }
  }
  EXPECT_GT(proved, 20);
  EXPECT_GT(several, 20);
}

//------------------------------------------------------------------------------
// Bounds of reflected rays hold the rays of random places of strongly bent patches.
TEST(Reflection, RayBoundsHoldAllRays)
{
  meniscus::Membrane membrane;
  membrane.Build(meniscus::reference::MakeRandom(200.0, 12, 4.0, 0.3, 71).AsInput());
  meniscus::CurvedPatches patches;
  patches.Build(membrane, meniscus::SerialLoop);
  const glm::dvec3 eye(60.0, 40.0, -20.0);
  Random random(73);
  int rays = 0;
  for (std::int32_t facet = 0; facet < 288; ++facet)
  {
    const meniscus::CurvedPatch patch = patches.GetPatch(facet);
    const meniscus::TubeBounds bounds = meniscus::BoundReflectedRays(patch, eye);
    for (int i = 0; i < 20; ++i)
    {
      glm::dvec2 b(random(0.0, 1.0), random(0.0, 1.0));
      b = b.x + b.y > 1.0 ? glm::dvec2(1.0 - b.x, 1.0 - b.y) : b;
      const meniscus::PatchPoint at = patch.Evaluate(b);
      const meniscus::RefractionRay ray = meniscus::ComputeReflectionRay(
        glm::normalize(at.Position - eye), glm::normalize(at.Normal));
      if (ray.Kind != meniscus::RayKind::Refracted)
      {
        continue;
      }
      ASSERT_TRUE(bounds.IsValid());
      for (int axis = 0; axis < 3; ++axis)
      {
        EXPECT_LE(bounds.DirectionLow[axis], ray.Direction[axis] + 1e-15);
        EXPECT_GE(bounds.DirectionHigh[axis], ray.Direction[axis] - 1e-15);
        EXPECT_LE(bounds.StartLow[axis], at.Position[axis]);
        EXPECT_GE(bounds.StartHigh[axis], at.Position[axis]);
      }
      ++rays;
    }
  }
  EXPECT_GT(rays, 4000);
}

//------------------------------------------------------------------------------
// Points in the troughs of waves and below their crests, by the analytic height. The waves are so
// steep that they reflect rays to each other; such a ray goes on below the surface, but nothing is
// seen there.
TEST(Reflection, PointsBelowTheWavesHaveNoImage)
{
  HeightField field = GetWaveCases().front().Field;
  field.Amplitude = 12.0;
  Mirror geometry(field.MakeMesh(96), { 20.0, 300.0, 10.0 });
  Random random(17);
  std::vector<VirtualVertex> images;
  int above = 0;
  for (int i = 0; i < 500; ++i)
  {
    const glm::dvec3 point = random.Point({ -90.0, -20.0, -90.0 }, { 90.0, 12.0, 90.0 });
    const double height = point.y - field.GetHeight(point.x, point.z);
    geometry.FindImages(point, images);
    if (height < -0.01)
    {
      EXPECT_TRUE(images.empty()) << point.x << " " << point.y << " " << point.z;
      EXPECT_EQ(geometry.SolveOne(point).State, ImageState::NoImage);
      EXPECT_FALSE(geometry.IsOnRaySide(point - geometry.GetMembrane().GetOrigin()));
    }
    else if (height > 0.01)
    {
      EXPECT_TRUE(geometry.IsOnRaySide(point - geometry.GetMembrane().GetOrigin()));
      above += !images.empty();
    }
  }
  EXPECT_GT(above, 50);
}

}
