// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// All images of points through several surfaces, against dense searches and closed forms.
#include "RefractionTestRandom.h"
#include "StackTestScene.h"

namespace
{

using namespace meniscus;
using namespace meniscus::reference;
using namespace meniscus::test;

const double Pi = std::acos(-1.0);

// Rays from a dense grid in every patch of the first surface, traced through all interfaces. It
// does not depend on the point that is looked for, and uses no bounds, derivatives or predictions.
class DenseSearch
{
public:
  DenseSearch(const StackSolver& solver, int parts)
    : Stack(solver.GetStack())
    , Parts(parts)
  {
    const auto facets = static_cast<std::int32_t>(
      this->Stack.GetLinks()[0].Surface->GetMembrane().GetFacets().size());
    for (const auto& [facet, i] : Product(Below<std::int32_t>(facets), parts + 1))
    {
      for (int j = 0; i + j <= parts; ++j)
      {
        this->Rays.push_back(this->Trace({ facet, this->GetPlace(i, j) }));
      }
    }
  }

  // Sight points of the images of a point behind all interfaces.
  std::vector<glm::dvec3> Find(const glm::dvec3& point) const
  {
    const glm::dvec3 local = point - this->Stack.GetOrigin();
    std::vector<glm::dvec3> found;
    const int perFacet = (this->Parts + 1) * (this->Parts + 2) / 2;
    for (std::size_t k = 0; k < this->Rays.size(); k += static_cast<std::size_t>(perFacet))
    {
      const auto facet = static_cast<std::int32_t>(k / static_cast<std::size_t>(perFacet));
      const auto at = [this, k](int i, int j) -> const Ray&
      {
        // Rows i hold Parts + 1 - i rays.
        return this
          ->Rays[k + static_cast<std::size_t>(i * (this->Parts + 1) - i * (i - 1) / 2 + j)];
      };
      for (int i = 0; i < this->Parts; ++i)
      {
        for (int j = 0; i + j < this->Parts; ++j)
        {
          this->Try(facet, local, { at(i, j), at(i + 1, j), at(i, j + 1) },
            this->GetPlace(i + 1.0 / 3.0, j + 1.0 / 3.0), found);
          if (i + j + 1 < this->Parts)
          {
            this->Try(facet, local, { at(i + 1, j), at(i, j + 1), at(i + 1, j + 1) },
              this->GetPlace(i + 2.0 / 3.0, j + 2.0 / 3.0), found);
          }
        }
      }
    }
    return found;
  }

  // Distance of a point from the ray of a sight place; infinite if the ray does not reach it.
  double GetDistance(const glm::dvec3& point, const StackPlace& place) const
  {
    const glm::dvec3 local = point - this->Stack.GetOrigin();
    const Ray ray = this->Trace(place);
    return ray.IsValid && glm::dot(local - ray.Origin, ray.Direction) > 0.0
      ? glm::length(glm::cross(local - ray.Origin, ray.Direction))
      : std::numeric_limits<double>::infinity();
  }

private:
  struct Ray
  {
    glm::dvec3 Sight;
    glm::dvec3 Origin;
    glm::dvec3 Direction;
    bool IsValid = false;
  };

  glm::dvec2 GetPlace(double i, double j) const { return glm::dvec2(i, j) / double(this->Parts); }

  Ray Trace(const StackPlace& place) const
  {
    StackPath path;
    const std::size_t count = this->Stack.GetLinks().size();
    if (this->Stack.Trace(place, count, false, path) != PathEnd::Passed)
    {
      return {};
    }
    return { path.Points[0].Ray.Origin, path.GetLast().Origin, path.GetLast().Direction, true };
  }

  static glm::dvec2 Meet(const Ray& ray, const glm::dvec3& point, const glm::dvec3 axes[3])
  {
    const glm::dvec3 hit = ray.Origin - point -
      (glm::dot(ray.Origin - point, axes[2]) / glm::dot(ray.Direction, axes[2])) * ray.Direction;
    return { glm::dot(hit, axes[0]), glm::dot(hit, axes[1]) };
  }

  // Newton's method with differences, from the middle of a small triangle whose image, enlarged by
  // its size, holds the point.
  void Try(std::int32_t facet, const glm::dvec3& point, const std::array<Ray, 3>& corners,
    glm::dvec2 b, std::vector<glm::dvec3>& found) const
  {
    if (!corners[0].IsValid || !corners[1].IsValid || !corners[2].IsValid)
    {
      return;
    }
    glm::dvec3 axes[3];
    axes[2] = corners[0].Direction;
    axes[0] = glm::normalize(glm::cross(axes[2], glm::dvec3(0.36, 0.48, 0.8)));
    axes[1] = glm::cross(axes[2], axes[0]);
    glm::dvec2 low(1e300);
    glm::dvec2 high(-1e300);
    for (const Ray& ray : corners)
    {
      low = glm::min(low, Meet(ray, point, axes));
      high = glm::max(high, Meet(ray, point, axes));
    }
    const glm::dvec2 size = high - low;
    if (low.x > size.x || low.y > size.y || high.x < -size.x || high.y < -size.y)
    {
      return;
    }
    constexpr double h = 1e-6;
    for (int i = 0; i < 20; ++i)
    {
      const Ray ray = this->Trace({ facet, b });
      const Ray byX[2] = { this->Trace({ facet, b + glm::dvec2(h, 0.0) }),
        this->Trace({ facet, b - glm::dvec2(h, 0.0) }) };
      const Ray byY[2] = { this->Trace({ facet, b + glm::dvec2(0.0, h) }),
        this->Trace({ facet, b - glm::dvec2(0.0, h) }) };
      if (!ray.IsValid || !byX[0].IsValid || !byX[1].IsValid || !byY[0].IsValid || !byY[1].IsValid)
      {
        return;
      }
      const glm::dvec2 f = Meet(ray, point, axes);
      const glm::dvec2 u = (Meet(byX[0], point, axes) - Meet(byX[1], point, axes)) / (2.0 * h);
      const glm::dvec2 v = (Meet(byY[0], point, axes) - Meet(byY[1], point, axes)) / (2.0 * h);
      const double determinant = u.x * v.y - u.y * v.x;
      const glm::dvec2 move(
        -(f.x * v.y - f.y * v.x) / determinant, -(u.x * f.y - u.y * f.x) / determinant);
      b += move;
      if (!(std::max({ -b.x, -b.y, b.x + b.y - 1.0 }) < 0.1))
      {
        return;
      }
      if (glm::length(move) < 1e-8)
      {
        const bool isInside = std::max({ -b.x, -b.y, b.x + b.y - 1.0 }) <= 1e-7;
        const bool isKnown = std::any_of(found.begin(), found.end(),
          [&ray](const glm::dvec3& other) { return glm::length(other - ray.Sight) < 1e-5; });
        if (isInside && !isKnown && glm::dot(point - ray.Origin, ray.Direction) > 0.0)
        {
          found.push_back(ray.Sight);
        }
        return;
      }
    }
  }

  const RefractionStack& Stack;
  int Parts;
  std::vector<Ray> Rays;
};

// Compares all images of a point with those of the dense search. Returns their number.
std::size_t Compare(
  const StackSolver& solver, const DenseSearch& dense, const glm::dvec3& point, double same)
{
  std::vector<StackPath> images;
  const ImageState state = solver.FindImages(point, images);
  EXPECT_EQ(state == ImageState::Found, !images.empty());
  const std::vector<glm::dvec3> truth = dense.Find(point);
  for (const glm::dvec3& sight : truth)
  {
    EXPECT_TRUE(std::any_of(images.begin(), images.end(),
      [&sight, same](const StackPath& image)
      { return glm::length(image.Points[0].Ray.Origin - sight) < same; }))
      << "missed, among " << images.size() << " of " << truth.size();
  }
  for (const StackPath& image : images)
  {
    EXPECT_LT(dense.GetDistance(point, image.Points[0].Place), 1e-6) << "false";
    for (const StackPath& other : images)
    {
      EXPECT_TRUE(&other == &image ||
        glm::length(other.Points[0].Ray.Origin - image.Points[0].Ray.Origin) > 1e-7)
        << "twice";
    }
  }
  EXPECT_GE(images.size(), truth.size());
  return images.size();
}

// Chooses places in the first surface until the rays of `count` of them pass all interfaces and are
// turned by at least `turn`. A point behind on each ray must be shown there, and by a search for
// one image.
void FindPlantedPoints(const StackSolver& solver, Random& random, int count, double turn)
{
  const RefractionStack& stack = solver.GetStack();
  const std::size_t interfaces = stack.GetLinks().size();
  const auto facets = stack.GetLinks()[0].Surface->GetMembrane().GetFacets().size();
  std::vector<StackPath> images;
  StackPath path;
  int planted = 0;
  for (int i = 0; i < 1000000 && planted < count; ++i)
  {
    const auto facet = std::min(static_cast<std::size_t>(random(0.0, double(facets))), facets - 1);
    glm::dvec2 b(random(0.0, 1.0), random(0.0, 1.0));
    b = b.x + b.y > 1.0 ? 1.0 - b : b;
    path.Forget(interfaces);
    if (stack.Trace({ static_cast<std::int32_t>(facet), b }, interfaces, false, path) !=
        PathEnd::Passed ||
      glm::dot(path.GetLast().Direction, path.Sight) > std::cos(turn))
    {
      continue;
    }
    SCOPED_TRACE(i);
    ++planted;
    const glm::dvec3 sight = path.Points[0].Ray.Origin;
    const glm::dvec3 point =
      path.GetLast().Origin + random(1.0, 100.0) * path.GetLast().Direction + stack.GetOrigin();
    solver.FindImages(point, images);
    EXPECT_TRUE(std::any_of(images.begin(), images.end(),
      [&sight, interfaces](const StackPath& image) {
        return image.Count == interfaces && glm::length(image.Points[0].Ray.Origin - sight) < 1e-5;
      }))
      << "missed, among " << images.size();
    EXPECT_EQ(SolveAlone(solver, point).State, ImageState::Found);
  }
  EXPECT_EQ(planted, count);
}

/** Points by the number of their images. */
struct ImageCounts
{
  std::size_t Images = 0;
  std::size_t Several = 0;
  std::size_t None = 0;
};

/** Compares the images of random points in a box with those of a dense search. */
ImageCounts CompareInBox(const StackSolver& solver, unsigned int seed, int points,
  const glm::dvec3& lower, const glm::dvec3& upper)
{
  const DenseSearch dense(solver, 10);
  Random random(seed);
  ImageCounts counts;
  for (int i = 0; i < points; ++i)
  {
    SCOPED_TRACE(i);
    const std::size_t count = Compare(solver, dense, random.Point(lower, upper), 1e-5);
    counts.Images += count;
    counts.Several += count > 1;
    counts.None += count == 0;
  }
  ::testing::Test::RecordProperty("images", std::to_string(counts.Images));
  ::testing::Test::RecordProperty("several", std::to_string(counts.Several));
  ::testing::Test::RecordProperty("none", std::to_string(counts.None));
  ::testing::Test::RecordProperty(
    "undecided", std::to_string(solver.GetNumberOfUndecidedSearches()));
  return counts;
}

}

//------------------------------------------------------------------------------
// Waves so steep that points far behind have up to a dozen images.
TEST(RefractionStackImages, AgreeWithADenseSearchThroughTwoWavySurfaces)
{
  StackSolver solver;
  SetStack(solver,
    { { MakeSurface(MakeWaves(100.0, 0.0, 1.3, 8.0, 24)), { 1.0, 1.5 } },
      { MakeSurface(MakeWaves(100.0, -12.0, 1.0, 9.0, 28)), { 1.5, 1.2 } } },
    { 5.0, 90.0, -8.0 });
  const ImageCounts counts =
    CompareInBox(solver, 21, 300, { -60.0, -300.0, -60.0 }, { 60.0, -14.0, 60.0 });
  EXPECT_EQ(solver.GetNumberOfUndecidedSearches(), 0);
  EXPECT_GT(counts.Several, 70u);
}

//------------------------------------------------------------------------------
// A point off the axis of a ball is seen in the plane of eye, centre and point only. There, the
// distance of the point from the exact ray is a function of one angle, whose zeros are counted.
TEST(RefractionStackImages, BallLensShowsTheZerosOfOneFunction)
{
  const glm::dvec3 eye(4.0, 200.0, -3.0);
  const glm::dvec3 centre(0.0, 0.0, 0.0);
  constexpr double radius = 40.0;
  const auto ball = MakeSurface(MakeSphere(centre, radius, 4, true));
  StackSolver solver;
  SetStack(solver, { { ball, { 1.0, 1.5 } }, { ball, { 1.0, 1.5 } } }, eye);
  const std::vector<ExactSurface> exact{ { 1.0, 1.5, centre, radius },
    { 1.5, 1.0, centre, radius, glm::dvec3(0.0), true } };
  const glm::dvec3 toward = glm::normalize(centre - eye);
  const glm::dvec3 across = glm::normalize(glm::cross(toward, glm::dvec3(1.0, 0.0, 0.0)));
  Random random(22);
  std::array<int, 4> byCount{};
  for (int i = 0; i < 500; ++i)
  {
    // Behind the ball, in front of and behind the focus at about 1.5 radii.
    const double angle = random(0.0, 2.0 * Pi);
    const glm::dvec3 side = std::cos(angle) * across + std::sin(angle) * glm::cross(toward, across);
    const glm::dvec3 point =
      centre + random(1.02 * radius, 5.0 * radius) * toward + random(0.5, 8.0) * side;
    // Positive where the ray passes on the side of `side`; NaN where it does not pass.
    const auto measure = [&](double t)
    {
      const auto path = TraceExactly(exact, eye, std::cos(t) * toward + std::sin(t) * side);
      if (!path || !(glm::dot(point - path->Points[1], path->Directions[2]) > 0.0))
      {
        return std::nan("");
      }
      const glm::dvec3 away = point - path->Points[1];
      return glm::dot(
        side - toward * glm::dot(side, path->Directions[2]) / glm::dot(toward, path->Directions[2]),
        away);
    };
    const double edge = std::asin(radius / glm::length(centre - eye));
    std::vector<double> zeros;
    constexpr int steps = 4000;
    for (int k = 0; k < steps; ++k)
    {
      // Finer towards the edge of the ball, where the ray's place goes with a square root.
      const auto getAngle = [edge](double part) { return edge * std::sin(Pi * (part - 0.5)); };
      double low = getAngle((k + 0.5) / (steps + 1.0));
      double high = getAngle((k + 1.5) / (steps + 1.0));
      if (!(measure(low) * measure(high) < 0.0))
      {
        continue;
      }
      for (int j = 0; j < 60; ++j)
      {
        const double middle = 0.5 * (low + high);
        (measure(low) * measure(middle) <= 0.0 ? high : low) = middle;
      }
      zeros.push_back(0.5 * (low + high));
    }
    std::vector<StackPath> images;
    solver.FindImages(point, images);
    ASSERT_EQ(images.size(), zeros.size()) << i;
    ++byCount[std::min<std::size_t>(zeros.size(), 3)];
    for (const double zero : zeros)
    {
      const auto path = TraceExactly(exact, eye, std::cos(zero) * toward + std::sin(zero) * side);
      double nearest = 1e300;
      for (const StackPath& image : images)
      {
        nearest = std::min(nearest,
          glm::length(
            image.Points[0].Ray.Origin + solver.GetStack().GetOrigin() - path->Points[0]));
      }
      EXPECT_LT(nearest, 1e-6) << i;
    }
  }
  EXPECT_GT(byCount[1], 50);
  EXPECT_GT(byCount[3], 50);
  EXPECT_LT(solver.GetNumberOfUndecidedSearches(), 3); // next to the caustic
}

//------------------------------------------------------------------------------
// In front of, between, on and behind planes a point has one image, that of a search for one.
TEST(RefractionStackImages, PlanesShowOneImageEach)
{
  const glm::dvec3 eye(0.0, 80.0, 0.0);
  StackSolver solver;
  SetStack(solver,
    { { MakeSurface(MakePlane(0.0, 400.0, 10)), { 1.0, 1.5 } },
      { MakeSurface(MakePlane(-20.0, 400.0, 7)), { 1.5, 1.333 } } },
    eye);
  Random random(23);
  std::vector<StackPath> images;
  for (int i = 0; i < 600; ++i)
  {
    const double heights[5] = { random(1.0, 70.0), 0.0, random(-19.0, -1.0), -20.0,
      random(-100.0, -21.0) };
    const glm::dvec3 point(random(-20.0, 20.0), heights[i % 5], random(-20.0, 20.0));
    ASSERT_EQ(solver.FindImages(point, images), ImageState::Found) << point.y;
    ASSERT_EQ(images.size(), 1u) << point.y;
    const StackVertex vertex = solver.MakeVertex(point, images[0]);
    const StackVertex first = SolveAlone(solver, point);
    if (heights[i % 5] != 0.0 && heights[i % 5] != -20.0) // on a plane it is seen from either side
    {
      EXPECT_EQ(vertex.Passed, first.Passed);
    }
    EXPECT_EQ(vertex.Orientation, first.Orientation);
    // The remaining error of Newton's method, 1e-12 of a facet of 40.
    EXPECT_LT(glm::length(vertex.Position - first.Position), 1e-10);
    EXPECT_NEAR(vertex.Depth, first.Depth, 1e-10);
    double legs[2];
    solver.MeasureLegs(point, images[0], legs);
    EXPECT_NEAR(legs[0] + legs[1], vertex.Depth, 1e-12);
  }
  EXPECT_EQ(solver.FindImages({ 0.0, 90.0, 0.0 }, images), ImageState::NoImage);
  EXPECT_TRUE(images.empty());
  EXPECT_EQ(solver.FindImages({ 0.0, std::nan(""), 0.0 }, images), ImageState::NotFinite);
}

//------------------------------------------------------------------------------
// Where some rays miss the second surface, or are reflected at it, the others are still found.
TEST(RefractionStackImages, AgreeWithADenseSearchAtBordersAndCriticalAngles)
{
  StackSolver solver;
  SetStack(solver,
    { { MakeSurface(MakeWaves(100.0, 0.0, 1.0, 7.0, 20)), { 1.0, 1.6 } },
      { MakeSurface(MakeWaves(100.0, -10.0, 1.2, 7.0, 24)), { 1.6, 1.0 } } },
    { 60.0, 50.0, 8.0 });
  const ImageCounts counts =
    CompareInBox(solver, 24, 100, { -90.0, -100.0, -70.0 }, { 40.0, -13.0, 70.0 });
  EXPECT_GT(counts.Images, 100u);
  EXPECT_GT(counts.None, 2u);
}

//------------------------------------------------------------------------------
// Rays pass all interfaces in a tenth and a fortieth of the width of the first surface's two
// facets: none of the first rays that are tried do.
TEST(RefractionStackImages, SmallBallBehindLargeFacets)
{
  const auto pane = MakeSurface(MakePlane(0.0, 200.0, 1));
  for (const double radius : { 10.0, 2.5 })
  {
    const auto ball = MakeSurface(MakeSphere({ 31.0, -60.0, 17.0 }, radius, 3, true));
    for (const double index : { 1.6, 0.7 })
    {
      SCOPED_TRACE(::testing::Message() << "radius " << radius << ", index " << index);
      StackSolver solver;
      SetStack(solver,
        { { pane, { 1.0, 1.3 } }, { ball, { 1.3, index } }, { ball, { 1.3, index } } },
        { 10.0, 150.0, -20.0 });
      Random random(25);
      FindPlantedPoints(solver, random, 20, 0.0);
    }
  }
}

//------------------------------------------------------------------------------
// Next to the critical angle of a ball of air in glass, rays from one facet leave to all sides: no
// plane through the point meets all of them.
TEST(RefractionStackImages, RaysOfOneFacetGoToAllSides)
{
  const auto pane = MakeSurface(MakePlane(0.0, 200.0, 3));
  const auto ball = MakeSurface(MakeSphere({ 10.0, -90.0, 10.0 }, 40.0, 2, true));
  StackSolver solver;
  SetStack(solver, { { pane, { 1.0, 1.78 } }, { ball, { 1.78, 0.62 } }, { ball, { 1.39, 0.62 } } },
    { 3.6, 215.0, -28.0 });
  Random random(26);
  FindPlantedPoints(solver, random, 40, 1.2);
}

//------------------------------------------------------------------------------
// A point on a ray, on any leg, is looked for in the part of the patch from which the ray comes.
// The facets of the second surface are much smaller than those of the first, so that patches are
// divided.
TEST(RefractionStackImages, PartsHoldTheRaysOfTheirPatch)
{
  StackSolver solver;
  SetStack(solver,
    { { MakeSurface(MakeWaves(100.0, 0.0, 1.3, 8.0, 8)), { 1.0, 1.5 } },
      { MakeSurface(MakeWaves(100.0, -12.0, 0.6, 9.0, 60)), { 1.5, 1.2 } } },
    { 5.0, 90.0, -8.0 });
  const RefractionStack& stack = solver.GetStack();
  const auto facets =
    static_cast<std::int32_t>(stack.GetLinks()[0].Surface->GetMembrane().GetFacets().size());
  Random random(28);
  int rays = 0;
  std::size_t parts = 0;
  for (std::int32_t facet = 0; facet < facets; ++facet)
  {
    const StackBeamParts beam(stack, facet);
    for (int i = 0; i < 40; ++i)
    {
      glm::dvec2 b(random(0.0, 1.0), random(0.0, 1.0));
      b = b.x + b.y > 1.0 ? 1.0 - b : b;
      StackPath path;
      path.Forget(2);
      if (stack.Trace({ facet, b }, 2, false, path) != PathEnd::Passed)
      {
        continue;
      }
      ++rays;
      const glm::dvec3 between =
        glm::mix(path.Points[0].Ray.Origin, path.Points[1].Ray.Origin, random(0.0, 1.0));
      const glm::dvec3 behind =
        path.GetLast().Origin + random(0.0, 200.0) * path.GetLast().Direction;
      for (const std::size_t count : { 1u, 2u })
      {
        bool isFound = false;
        beam.Visit(count, count == 1 ? between : behind, 1e-10,
          [&](const StackBeamParts::Part& part)
          {
            ++parts;
            const glm::dvec2 u = beam.GetPlace(part.Samples[1]) - beam.GetPlace(part.Samples[0]);
            const glm::dvec2 v = beam.GetPlace(part.Samples[2]) - beam.GetPlace(part.Samples[0]);
            const glm::dvec2 away = b - beam.GetPlace(part.Samples[0]);
            const double area = u.x * v.y - u.y * v.x;
            const double s = (away.x * v.y - away.y * v.x) / area;
            const double t = (u.x * away.y - u.y * away.x) / area;
            isFound = isFound || std::min({ s, t, 1.0 - s - t }) > -1e-9;
          });
        EXPECT_TRUE(isFound) << "facet " << facet << ", leg " << count;
      }
    }
  }
  EXPECT_GT(rays, 2000);
  RecordProperty("parts", std::to_string(parts));
}

//------------------------------------------------------------------------------
TEST(RefractionStackImages, SightRaysBehindParallelPlanesAreThoseOfTheSearch)
{
  const glm::dvec3 eye(3.0, 80.0, -5.0);
  StackSolver solver;
  SetStack(solver,
    { { MakeSurface(MakePlane(0.0, 400.0, 10)), { 1.0, 1.5 } },
      { MakeSurface(MakePlane(-20.0, 400.0, 7)), { 1.5, 1.1 } },
      { MakeSurface(MakePlane(-30.0, 400.0, 3)), { 1.1, 1.4 } } },
    eye);
  const ParallelPlanes& planes = solver.GetPlanes();
  ASSERT_FALSE(planes.IsEmpty());
  Random random(29);
  for (int i = 0; i < 400; ++i)
  {
    const double heights[4] = { random(1.0, 70.0), random(-19.0, -1.0), random(-29.0, -21.0),
      random(-90.0, -31.0) };
    const glm::dvec3 point(random(-40.0, 40.0), heights[i % 4], random(-40.0, 40.0));
    const glm::dvec3 local = point - solver.GetStack().GetOrigin();
    ASSERT_EQ(planes.CountInFront(local), i % 4);
    if (i % 4 == 0)
    {
      continue;
    }
    const StackVertex vertex = SolveAlone(solver, point);
    ASSERT_EQ(vertex.State, ImageState::Found);
    const glm::dvec3 sight = planes.FindSight(local, static_cast<std::size_t>(i % 4));
    EXPECT_LT(glm::length(sight - glm::normalize(vertex.SightPoint - eye)), 1e-12);
  }
  EXPECT_EQ(planes.CountInFront({ 0.0, -20.0, 0.0 }), -1);
  // The point straight below the eye.
  EXPECT_EQ(planes.FindSight({ 3.0, -50.0, -5.0 }, 3), glm::dvec3(0.0, -1.0, 0.0));
  SetStack(solver,
    { { MakeSurface(MakePlane(0.0, 400.0, 10)), { 1.0, 1.5 } },
      { MakeSurface(MakeWaves(400.0, -20.0, 1e-3, 5.0, 20)), { 1.5, 1.1 } } },
    eye);
  EXPECT_TRUE(solver.GetPlanes().IsEmpty());
}

//------------------------------------------------------------------------------
TEST(RefractionStackImages, EqualIndicesLeaveOnePath)
{
  StackSolver solver;
  const auto plane = MakeSurface(MakePlane(0.0, 100.0, 4));
  SetStack(solver, { { plane, { 1.3, 1.3 } }, { plane, { 1.3, 1.3 } } }, { 0.0, 50.0, 0.0 });
  std::vector<StackPath> images;
  const glm::dvec3 point(0.1, -7.3, 1e3);
  ASSERT_EQ(solver.FindImages(point, images), ImageState::Found);
  ASSERT_EQ(images.size(), 1u);
  EXPECT_EQ(solver.MakeVertex(point, images[0]).Position, point);
}
