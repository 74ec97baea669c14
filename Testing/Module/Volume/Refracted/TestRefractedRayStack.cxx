// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Rays behind several interfaces, compared with Snell's law at planes and spheres.
#include "KernelSurfaces.h"
#include "RefractionTestRandom.h"

#include "Simd/InstructionSets.h"
#include "Volume/Refracted/PatchIntersector.h"
#include "Volume/Refracted/PatchTree.h"
#include "Volume/Refracted/RayLegs.h"
#include "Volume/Refracted/RefractedRayField.h"
#include "Volume/Refracted/RefractedRayStack.h"
#include "Volume/Refracted/RefractionFrames.h"
#include "Volume/Refracted/StackBlock.h"

#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/matrix.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

using namespace meniscus;
using namespace meniscus::test;
using meniscus::testing::Random;

namespace
{

constexpr int Size = 96;
constexpr int TileSize = RefractedRayTiles::TileSize;
constexpr int Columns = (Size + TileSize - 1) / TileSize;

const WorldBox Everywhere{ glm::dvec3(0.0), glm::dvec3(1e3) };

StackedInterface InterfaceOf(const Membrane& surface, const CurvedPatches& patches,
  const PatchTree& tree, double exterior, double interior)
{
  return { &surface, &patches, &tree, exterior, interior };
}

/** A sheet and its tree. */
struct StackedSheet : Sheet
{
  PatchTree Tree;

  StackedSheet(const std::function<double(double, double)>& height, int cells)
    : Sheet(height, cells)
  {
    this->Tree.Build(this->Surface, this->Patches, SerialLoop);
  }
  StackedInterface Between(double exterior, double interior) const
  {
    return InterfaceOf(this->Surface, this->Patches, this->Tree, exterior, interior);
  }
};

/** A unit sphere and its tree. */
struct StackedSphere
{
  Membrane Surface;
  CurvedPatches Patches;
  PatchTree Tree;

  explicit StackedSphere(int resolution)
  {
    EXPECT_TRUE(BuildSphere(resolution, this->Surface, this->Patches));
    this->Tree.Build(this->Surface, this->Patches, SerialLoop);
  }
  StackedInterface Between(double exterior, double interior) const
  {
    return InterfaceOf(this->Surface, this->Patches, this->Tree, exterior, interior);
  }
};

/** View whose rays are traced wherever they go. */
RefractedRayField::View LookAtAll(
  const glm::dvec3& eye, const glm::dvec3& target, double width, bool isParallel)
{
  RefractedRayField::View view = LookAt(eye, target, width, isParallel, Size);
  SetMesh(view, Everywhere);
  return view;
}

RayLegs LegsOf(const RefractedRayStack& stack, const RefractedRayField::View& view)
{
  std::vector<const RefractedRayTiles*> list;
  for (const RefractedRayTiles& rays : stack.GetRays())
  {
    list.push_back(&rays);
  }
  return RayLegs(view.Frame, Size, Size, list);
}

/** A ray in world coordinates; a direction of 0 stands for none. */
struct WorldRay
{
  glm::dvec3 Start{ 0.0 };
  glm::dvec3 Direction{ 0.0 };
};

/** Leg of a pixel's ray in world coordinates; none if there is no such leg. */
WorldRay LegOf(
  const RayLegs& legs, const RefractedRayField::View& view, int column, int row, int number)
{
  RayLeg leg;
  const int tile = row / TileSize * Columns + column / TileSize;
  const int pixel = row % TileSize * TileSize + column % TileSize;
  if (!legs.Find(tile, pixel, number, leg))
  {
    return {};
  }
  const glm::dmat3& toWorld = view.Frame.ViewToWorld;
  return { view.Center + toWorld * leg.Begin, toWorld * leg.Step };
}

RefractedRay RayOf(const RefractedRayTiles& rays, int column, int row)
{
  const RefractedRay* tile = rays.GetTile(row / TileSize * Columns + column / TileSize);
  return tile ? tile[row % TileSize * TileSize + column % TileSize] : RefractedRay();
}

/**
 * Snell's law for unit vectors, by components: along the surface the direction is multiplied by
 * n1 / n2. The result is 0 beyond the critical angle.
 */
glm::dvec3 Snell(const glm::dvec3& direction, glm::dvec3 normal, double before, double behind)
{
  normal = glm::dot(direction, normal) > 0.0 ? -normal : normal;
  const glm::dvec3 along = before / behind * (direction - glm::dot(direction, normal) * normal);
  const double squared = 1.0 - glm::dot(along, along);
  return squared < 0.0 ? glm::dvec3(0.0) : along - std::sqrt(squared) * normal;
}

/** Lengths at which a unit ray meets a sphere about the origin: the first and the second. */
bool MeetSphere(const WorldRay& ray, double radius, double& first, double& second)
{
  const double half = glm::dot(ray.Start, ray.Direction);
  const double squared = half * half - glm::dot(ray.Start, ray.Start) + radius * radius;
  first = -half - std::sqrt(std::max(squared, 0.0));
  second = -half + std::sqrt(std::max(squared, 0.0));
  return squared > 0.0;
}

const std::function<double(double, double)> Shapes[] = { [](double, double) { return 0.0; },
  [](double x, double y) { return std::sqrt(4.0 - x * x - y * y) - 1.7; },
  [](double x, double y) { return 0.05 * std::sin(5.0 * x + 1.0) * std::sin(4.0 * y); } };

}

/**
 * The field of one interface finds the patches of a ray by their projections, the stack by a tree;
 * both use the same Newton steps, whose error is below 1e-9 of a facet
 * (PatchIntersector::LastStep).
 */
TEST(RefractedRayStack, OneInterfaceIsThatOfTheField)
{
  Random random(3);
  int met = 0;
  int different = 0;
  for (const auto& shape : Shapes)
  {
    for (const int cells : { 1, 3, 12, 48 })
    {
      const StackedSheet sheet(shape, cells);
      // The longest side of a facet is the diagonal of a square of side 2 / cells, on a slope of at
      // most 1: 4 / cells.
      const double twoErrors = 2.0 * 1e-9 * 4.0 / cells;
      for (int i = 0; i < 8; ++i)
      {
        const double side = i % 4 == 3 ? -1.0 : 1.0;
        const glm::dvec3 eye(random(-2.0, 2.0), random(-2.0, 2.0), side * random(0.2, 3.0));
        RefractedRayField::View view =
          LookAtAll(eye, random.Point(glm::dvec3(-0.8, -0.8, -0.1), glm::dvec3(0.8, 0.8, 0.1)),
            random(0.5, 3.0), i % 3 == 0);
        view.Exterior = 1.0;
        view.Interior = 1.4;
        RefractedRayField field;
        field.Build(sheet.Surface, sheet.Patches, view);
        RefractedRayStack stack;
        stack.Build({ sheet.Between(1.0, 1.4) }, view);
        EXPECT_EQ(stack.IsSeen(), field.IsSeen());
        for (int pixel = 0; pixel < Size * Size; ++pixel)
        {
          const RefractedRay one = RayOf(field.GetRays(), pixel % Size, pixel / Size);
          const RefractedRay other = RayOf(stack.GetRays()[0], pixel % Size, pixel / Size);
          met += one.MeetsInterface() ? 1 : 0;
          const bool same = one.MeetsInterface() == other.MeetsInterface() &&
            one.GoesOn() == other.GoesOn() &&
            (!one.MeetsInterface() || std::fabs(one.Depth - other.Depth) < twoErrors) &&
            glm::length(one.Step - other.Step) < 1e-8;
          different += same ? 0 : 1;
        }
      }
    }
  }
  EXPECT_EQ(different, 0);
  EXPECT_GT(met, 100000);
}

/** Rays keep their direction behind a pane, and are displaced by d sin(t1 - t2) / cos(t2). */
TEST(RefractedRayStack, PaneIsTheClosedForm)
{
  const double thickness = 0.4;
  const StackedSheet front([](double, double) { return 0.1; }, 5);
  const StackedSheet back([=](double, double) { return 0.1 - thickness; }, 7);
  int seen = 0;
  for (const bool parallel : { false, true })
  {
    RefractedRayField::View view =
      LookAtAll(glm::dvec3(0.9, 0.6, 2.5), glm::dvec3(0.1, 0.0, 0.0), 1.2, parallel);
    RefractedRayStack stack;
    stack.Build({ front.Between(1.0, 1.5), back.Between(1.5, 1.0) }, view);
    const RayLegs legs = LegsOf(stack, view);
    for (int pixel = 0; pixel < Size * Size; ++pixel)
    {
      const WorldRay sight = LegOf(legs, view, pixel % Size, pixel / Size, 0);
      const WorldRay behind = LegOf(legs, view, pixel % Size, pixel / Size, 2);
      if (behind.Direction == glm::dvec3(0.0))
      {
        continue;
      }
      ++seen;
      EXPECT_LE(glm::length(behind.Direction - sight.Direction), 1e-14);
      const glm::dvec3 direction = glm::normalize(sight.Direction);
      const double outside = std::acos(-direction.z);
      const double inside = std::asin(std::sin(outside) / 1.5);
      const glm::dvec3 between = behind.Start - sight.Start;
      EXPECT_NEAR(glm::length(between - glm::dot(between, direction) * direction),
        thickness * std::sin(outside - inside) / std::cos(inside), 1e-13);
    }
    EXPECT_EQ(stack.GetCounts().Missing, 0);
    EXPECT_EQ(stack.GetCounts().Reflected, 0);
  }
  EXPECT_EQ(seen, 2 * Size * Size);
}

/** Each ray that meets a ball goes through it; its legs are those of a tracer in double. */
TEST(RefractedRayStack, BallIsEnteredAndLeft)
{
  Random random(17);
  int met = 0;
  int close = 0;
  int wrong = 0;
  double largest = 0.0;
  for (const int resolution : { 10, 16, 24 })
  {
    const StackedSphere sphere(resolution);
    for (const double index : { 1.5, 1.0 / 1.5 })
    {
      const glm::dvec3 eye =
        random(1.2, 5.0) * glm::normalize(random.Point(glm::dvec3(-1.0), glm::dvec3(1.0)));
      RefractedRayField::View view = LookAtAll(eye, glm::dvec3(0.0), 2.5, false);
      RefractedRayStack stack;
      stack.Build({ sphere.Between(1.0, index), sphere.Between(1.0, index) }, view);
      const RayLegs legs = LegsOf(stack, view);
      int reflected = 0;
      for (int pixel = 0; pixel < Size * Size; ++pixel)
      {
        WorldRay ray = LegOf(legs, view, pixel % Size, pixel / Size, 0);
        ray.Direction = glm::normalize(ray.Direction);
        const WorldRay behind = LegOf(legs, view, pixel % Size, pixel / Size, 2);
        double first = 0.0;
        double second = 0.0;
        if (!MeetSphere(ray, 1.0, first, second))
        {
          wrong += behind.Direction != glm::dvec3(0.0) ? 1 : 0;
          continue;
        }
        ray.Start += first * ray.Direction;
        const double cosine = -glm::dot(ray.Direction, ray.Start);
        const double radicand = 1.0 - (1.0 - cosine * cosine) / (index * index);
        if (cosine < 1e-3 || std::fabs(radicand) < 1e-3)
        {
          ++close; // touches the ball, or is refracted along it
          continue;
        }
        const glm::dvec3 inside = Snell(ray.Direction, ray.Start, 1.0, index);
        if (inside == glm::dvec3(0.0))
        {
          ++reflected;
          wrong += behind.Direction != glm::dvec3(0.0) ? 1 : 0;
          continue;
        }
        ray.Direction = inside;
        MeetSphere(ray, 1.0, first, second);
        ray.Start += second * ray.Direction;
        ray.Direction = Snell(ray.Direction, ray.Start, index, 1.0);
        ++met;
        if (behind.Direction == glm::dvec3(0.0))
        {
          ++wrong;
          continue;
        }
        const double error = std::max(glm::length(behind.Start - ray.Start),
          glm::length(glm::normalize(behind.Direction) - ray.Direction));
        largest = std::max(largest, error);
      }
      EXPECT_EQ(reflected > 0, index < 1.0);
      // A ray inside a sphere leaves it at the angle at which it has entered.
      EXPECT_EQ(stack.GetCounts().Reflected, 0);
      EXPECT_EQ(stack.GetCounts().Missing, 0);
    }
  }
  EXPECT_EQ(wrong, 0);
  EXPECT_GT(met, 20000);
  EXPECT_LT(close, met / 100);
  // Newton's error, 1e-9 of a facet, grows by the inverse cosine at each surface, at most 1e3 where
  // no ray is left out.
  EXPECT_LT(largest, 1e-6);
}

/** From its centre, a shell between concentric spheres is not seen. */
TEST(RefractedRayStack, ConcentricDomeKeepsDirections)
{
  // The outer sphere is the unit sphere seen in another unit: its membrane is scaled.
  const StackedSphere inner(24);
  std::vector<double> points;
  std::vector<double> normals;
  std::vector<std::int64_t> triangles;
  for (const glm::dvec3& place : inner.Surface.GetPositions())
  {
    const glm::dvec3 normal = glm::normalize(place + inner.Surface.GetOrigin());
    normals.insert(normals.end(), { normal.x, normal.y, normal.z });
    points.insert(points.end(), { 1.2 * normal.x, 1.2 * normal.y, 1.2 * normal.z });
  }
  for (const Membrane::Facet& facet : inner.Surface.GetFacets())
  {
    triangles.insert(triangles.end(), facet.begin(), facet.end());
  }
  Membrane surface;
  CurvedPatches patches;
  PatchTree tree;
  ASSERT_EQ(surface.Build({ points.data(), points.size() / 3, triangles.data(),
              triangles.size() / 3, nullptr, normals.data() }),
    MembraneStatus::Ready);
  patches.Build(surface, SerialLoop);
  tree.Build(surface, patches, SerialLoop);
  RefractedRayField::View view = LookAtAll(glm::dvec3(0.0), glm::dvec3(0.3, 0.4, -1.0), 1.8, false);
  // Air, glass, water; the normals point outwards.
  RefractedRayStack stack;
  stack.Build({ inner.Between(1.5, 1.0), InterfaceOf(surface, patches, tree, 1.333, 1.5) }, view);
  const RayLegs legs = LegsOf(stack, view);
  double largest = 0.0;
  for (int pixel = 0; pixel < Size * Size; ++pixel)
  {
    const WorldRay sight = LegOf(legs, view, pixel % Size, pixel / Size, 0);
    const WorldRay behind = LegOf(legs, view, pixel % Size, pixel / Size, 2);
    ASSERT_NE(behind.Direction, glm::dvec3(0.0));
    largest = std::max(
      largest, glm::length(glm::normalize(behind.Direction) - glm::normalize(sight.Direction)));
    // Eq. 2.4: a unit of depth is 1.333 times as long in water.
    EXPECT_NEAR(glm::length(behind.Direction), 1.333 * glm::length(sight.Direction), 1e-12);
  }
  // The normals of a patch are those of its sphere within the error of Newton's last step.
  EXPECT_LT(largest, 1e-9);
}

/** Rays that pass the first sheet and miss the second end at the first, and are counted. */
TEST(RefractedRayStack, RaysThatMissAnInterfaceAreCounted)
{
  const StackedSheet front([](double, double) { return 0.1; }, 5);
  // A sheet that is seen through one half of the first one.
  const StackedSheet back([](double, double) { return -1.5; }, 4);
  RefractedRayField::View view =
    LookAtAll(glm::dvec3(1.2, 0.0, 2.0), glm::dvec3(0.0, 0.0, 0.1), 2.3, false);
  RefractedRayStack stack;
  stack.Build({ front.Between(1.0, 1.5), back.Between(1.5, 1.0) }, view);
  const RayLegs legs = LegsOf(stack, view);
  int missing = 0;
  int through = 0;
  int beside = 0;
  for (int pixel = 0; pixel < Size * Size; ++pixel)
  {
    WorldRay ray = LegOf(legs, view, pixel % Size, pixel / Size, 0);
    const glm::dvec3 direction = glm::normalize(ray.Direction);
    const glm::dvec3 place = ray.Start + (0.1 - ray.Start.z) / ray.Direction.z * ray.Direction;
    const bool meetsFirst = std::max(std::fabs(place.x), std::fabs(place.y)) < 1.0;
    const glm::dvec3 inside = Snell(direction, glm::dvec3(0.0, 0.0, 1.0), 1.0, 1.5);
    const glm::dvec3 exit = place + (-1.5 - 0.1) / inside.z * inside;
    const double outside = std::max(std::fabs(exit.x), std::fabs(exit.y)) - 1.0;
    ASSERT_GT(std::fabs(outside), 1e-7); // no ray meets an edge
    const bool goesThrough = meetsFirst && outside < 0.0;
    beside += meetsFirst ? 0 : 1;
    missing += meetsFirst && outside > 0.0 ? 1 : 0;
    through += goesThrough ? 1 : 0;
    EXPECT_EQ(RayOf(stack.GetRays()[0], pixel % Size, pixel / Size).MeetsInterface(), meetsFirst);
    for (const int leg : { 1, 2 })
    {
      EXPECT_EQ(LegOf(legs, view, pixel % Size, pixel / Size, leg).Direction != glm::dvec3(0.0),
        goesThrough);
    }
  }
  EXPECT_EQ(stack.GetCounts().Missing, missing);
  EXPECT_GT(missing, 500);
  EXPECT_GT(through, 500);
  EXPECT_GT(beside, 500);
}

/** In a prism of 45 degrees all light is reflected, and each ray ends at the oblique face. */
TEST(RefractedRayStack, TotalReflectionEndsRays)
{
  const StackedSheet front([](double, double) { return 2.0; }, 2);
  const StackedSheet oblique([](double x, double) { return x; }, 3);
  RefractedRayField::View view = LookAtAll(glm::dvec3(0.0, 0.0, 4.0), glm::dvec3(0.0), 1.8, true);
  RefractedRayStack stack;
  // The critical angle is 41.8 degrees for 1.5 and 48.8 degrees for 1.33.
  for (const double index : { 1.5, 1.33 })
  {
    stack.Build({ front.Between(1.0, index), oblique.Between(index, 1.0) }, view);
    EXPECT_EQ(stack.GetCounts().Reflected, index == 1.5 ? Size * Size : 0);
    EXPECT_EQ(stack.GetCounts().Missing, 0);
    const RayLegs legs = LegsOf(stack, view);
    for (int pixel = 0; pixel < Size * Size; ++pixel)
    {
      const WorldRay glass = LegOf(legs, view, pixel % Size, pixel / Size, 1);
      ASSERT_NE(glass.Direction, glm::dvec3(0.0));
      const RefractedRay last = RayOf(stack.GetRays()[1], pixel % Size, pixel / Size);
      EXPECT_EQ(last.GoesOn(), index == 1.33);
      const RefractedRay before = RayOf(stack.GetRays()[0], pixel % Size, pixel / Size);
      const glm::dvec3 end = glass.Start + (last.Depth - before.Depth) * glass.Direction;
      EXPECT_NEAR(end.z, end.x, 1e-13);
    }
  }
}

/** A surface is met only from the side of the medium that the ray is in. */
TEST(RefractedRayStack, RaysComeFromTheSideOfTheirMedium)
{
  const StackedSheet front([](double, double) { return 0.1; }, 2);
  const StackedSheet back([](double, double) { return -0.3; }, 3);
  RefractedRayField::View view = LookAtAll(glm::dvec3(0.4, 0.2, 2.0), glm::dvec3(0.0), 0.8, false);
  const auto countMissing = [&](double exterior, double interior)
  {
    RefractedRayStack stack;
    stack.Build({ front.Between(1.0, 1.5), back.Between(exterior, interior) }, view);
    const bool hasMedium = exterior == 1.5 || interior == 1.5;
    EXPECT_EQ(stack.GetCounts().Mismatched, hasMedium ? 0 : Size * Size);
    return stack.GetCounts().Missing;
  };
  EXPECT_EQ(countMissing(1.5, 1.333), 0);
  EXPECT_EQ(countMissing(1.333, 1.5), Size * Size); // the glass would be below
  EXPECT_EQ(countMissing(1.0, 1.333), Size * Size); // no glass at all
  // An open surface listed twice is not met again.
  RefractedRayStack twice;
  twice.Build({ front.Between(1.0, 1.5), front.Between(1.0, 1.5) }, view);
  EXPECT_EQ(twice.GetCounts().Missing, Size * Size);
  // Nor is one in front of the first.
  RefractedRayStack reversed;
  reversed.Build({ back.Between(1.0, 1.5), front.Between(1.5, 1.0) }, view);
  EXPECT_EQ(reversed.GetCounts().Missing, Size * Size);
}

/** Rays through interfaces to a small mesh, compared with those to a mesh that is everywhere. */
struct EndedRays
{
  int Shown = 0;
  int Ended = 0;
  int Wrong = 0;
  std::int64_t Untraced = 0;

  void Compare(
    const std::vector<StackedInterface>& list, RefractedRayField::View view, const WorldBox& box)
  {
    RefractedRayStack all;
    SetMesh(view, Everywhere);
    all.Build(list, view);
    RefractedRayStack some;
    SetMesh(view, box);
    some.Build(list, view);
    EXPECT_EQ(some.GetCounts().Missing, all.GetCounts().Missing);
    EXPECT_EQ(some.GetCounts().Reflected, all.GetCounts().Reflected);
    EXPECT_EQ(all.GetNumberOfUntracedBlocks(), 0);
    this->Untraced += some.GetNumberOfUntracedBlocks();
    const RayLegs legs = LegsOf(all, view);
    for (int pixel = 0; pixel < Size * Size; ++pixel)
    {
      const auto rayOf = [pixel](const RefractedRayStack& stack, std::size_t interface)
      { return RayOf(stack.GetRays()[interface], pixel % Size, pixel / Size); };
      bool comes = false;
      for (std::size_t k = list.size(); k > 0; --k)
      {
        const WorldRay ray = LegOf(legs, view, pixel % Size, pixel / Size, static_cast<int>(k));
        const RefractedRay exact = rayOf(all, k - 1);
        const RefractedRay found = rayOf(some, k - 1);
        const RefractedRay next = k < list.size() ? rayOf(all, k) : RefractedRay();
        comes = comes ||
          (exact.GoesOn() && box.Meets(ray.Start, ray.Direction, next.Depth - exact.Depth));
        this->Shown += comes ? 1 : 0;
        this->Ended += exact.GoesOn() && !found.GoesOn() ? 1 : 0;
        this->Wrong += comes && (exact.Depth != found.Depth || exact.Step != found.Step) ? 1 : 0;
      }
      this->Wrong += rayOf(all, 0).Depth != rayOf(some, 0).Depth ? 1 : 0;
    }
  }
};

/** Rays end early only where they do not come to the mesh. */
TEST(RefractedRayStack, EndsOnlyRaysThatDoNotComeToTheMesh)
{
  Random random(23);
  const StackedSheet front(Shapes[2], 12);
  const StackedSheet back([](double x, double y) { return Shapes[1](y, x) - 0.8; }, 9);
  const std::vector<StackedInterface> pane{ front.Between(1.0, 1.5), back.Between(1.5, 1.1) };
  EndedRays rays;
  for (int i = 0; i < 96; ++i)
  {
    const RefractedRayField::View view =
      LookAt(glm::dvec3(random(-1.0, 1.0), random(-1.0, 1.0), random(0.5, 3.0)),
        random.Point(glm::dvec3(-0.5), glm::dvec3(0.5)), random(0.5, 2.0), i % 3 == 0, Size);
    rays.Compare(pane, view,
      { random.Point(glm::dvec3(-1.0, -1.0, -2.0), glm::dvec3(1.0, 1.0, 0.5)),
        random.Point(glm::dvec3(0.05), glm::dvec3(0.5)) });
  }
  EXPECT_EQ(rays.Wrong, 0);
  EXPECT_GT(rays.Shown, 10000);
  EXPECT_GT(rays.Ended, 10000);
  // Half of the blocks of 8 x 8 rays.
  EXPECT_GT(rays.Untraced, 96 * Size * Size / (8 * 8) / 2);
}

/** The same from behind, at sheets of few and of many facets, through a ball, and into dense media.
 */
TEST(RefractedRayStack, BoundsOfLegsHoldFromEachSide)
{
  Random random(29);
  const StackedSheet coarse(Shapes[0], 1);
  const StackedSheet waves([](double x, double y) { return Shapes[2](x, y) - 0.4; }, 48);
  const StackedSphere sphere(12);
  // Media from above, and from below in the reverse order.
  const std::vector<StackedInterface> above{ coarse.Between(1.0, 2.0), waves.Between(2.0, 1.0) };
  const std::vector<StackedInterface> below{ waves.Between(2.0, 1.0), coarse.Between(1.0, 2.0) };
  const std::vector<StackedInterface> ball{ sphere.Between(1.0, 1.5), sphere.Between(1.0, 1.5) };
  const std::vector<StackedInterface> behind{ coarse.Between(1.0, 1.3), sphere.Between(1.3, 1.0),
    sphere.Between(1.3, 1.0) };
  EndedRays rays;
  for (int i = 0; i < 48; ++i)
  {
    const std::vector<StackedInterface>& list =
      i % 4 == 0 ? above : (i % 4 == 1 ? below : (i % 4 == 2 ? ball : behind));
    const double side = i % 4 == 1 ? -1.0 : 1.0;
    const RefractedRayField::View view =
      LookAt(glm::dvec3(random(-1.0, 1.0), random(-1.0, 1.0), side * random(1.5, 3.0)),
        random.Point(glm::dvec3(-0.5), glm::dvec3(0.5)), random(0.5, 3.0), i % 3 == 0, Size);
    rays.Compare(list, view,
      { random.Point(glm::dvec3(-0.9), glm::dvec3(0.9)),
        random.Point(glm::dvec3(0.05), glm::dvec3(0.4)) });
  }
  EXPECT_EQ(rays.Wrong, 0);
  EXPECT_GT(rays.Shown, 5000);
  EXPECT_GT(rays.Ended, 5000);
  EXPECT_GT(rays.Untraced, 48 * Size * Size / (8 * 8) / 4);
}

/**
 * A prism turns rays away from a mesh that is seen without it, and towards one that is not. Only
 * the latter has to be traced to the second surface.
 */
TEST(RefractedRayStack, StraightRaysToTheMeshDoNotMatter)
{
  const StackedSheet front([](double, double) { return 0.0; }, 12);
  const StackedSheet back([](double x, double) { return -0.5 + 0.5 * x; }, 12);
  const std::vector<StackedInterface> prism{ front.Between(1.0, 1.6), back.Between(1.6, 1.0) };
  RefractedRayField::View view =
    LookAt(glm::dvec3(0.0, 0.0, 20.0), glm::dvec3(0.0), 0.2, false, Size);
  const double depth = 4.0;
  // The angle between the surfaces is atan(1/2); rays come to the first one along its normal.
  const double inside = std::atan(0.5);
  const double turned = std::asin(1.6 * std::sin(inside)) - inside;
  const WorldBox straight{ glm::dvec3(0.0, 0.0, -depth), glm::dvec3(0.2) };
  const WorldBox aside{ glm::dvec3(-std::tan(turned) * (depth - 0.5), 0.0, -depth),
    glm::dvec3(0.2) };
  const auto countShown = [&](const WorldBox& box)
  {
    SetMesh(view, box);
    RefractedRayStack stack;
    stack.Build(prism, view);
    const RayLegs legs = LegsOf(stack, view);
    int shown = 0;
    for (int pixel = 0; pixel < Size * Size; ++pixel)
    {
      const WorldRay ray = LegOf(legs, view, pixel % Size, pixel / Size, 2);
      shown += ray.Direction != glm::dvec3(0.0) ? 1 : 0;
    }
    const int blocks = Size * Size / StackBlock::Size;
    EXPECT_EQ(stack.GetNumberOfUntracedBlocks(), shown > 0 ? 0 : blocks);
    return shown;
  };
  EXPECT_EQ(countShown(straight), 0);
  EXPECT_EQ(countShown(aside), Size * Size);
}

/** Tiles that showed the mesh hold nothing of it after another view, in an image of any size. */
TEST(RefractedRayStack, BuildsDoNotDependOnEarlierOnes)
{
  const StackedSheet front(Shapes[2], 12);
  const StackedSheet back([](double x, double y) { return Shapes[2](y, x) - 0.4; }, 9);
  const std::vector<StackedInterface> pane{ front.Between(1.0, 1.5), back.Between(1.5, 1.1) };
  Random random(31);
  RefractedRayStack kept;
  int met = 0;
  for (int i = 0; i < 24; ++i)
  {
    RefractedRayField::View view = LookAt(glm::dvec3(random(-1.0, 1.0), random(-1.0, 1.0), 2.0),
      random.Point(glm::dvec3(-0.5), glm::dvec3(0.5)), random(0.5, 2.0), false, Size);
    view.Width = i % 3 == 0 ? Size - 13 : Size;
    SetMesh(view,
      { random.Point(glm::dvec3(-1.0, -1.0, -1.0), glm::dvec3(1.0, 1.0, 0.0)),
        random.Point(glm::dvec3(0.05), glm::dvec3(0.5)) });
    const std::vector<StackedInterface> list(pane.begin(), pane.end() - (i % 5 == 0 ? 1 : 0));
    kept.Build(list, view);
    RefractedRayStack fresh;
    fresh.Build(list, view);
    ASSERT_EQ(kept.GetRays().size(), fresh.GetRays().size());
    for (std::size_t k = 0; k < list.size(); ++k)
    {
      for (int tile = 0; tile < fresh.GetRays()[k].GetNumberOfTiles(); ++tile)
      {
        const RefractedRay* one = kept.GetRays()[k].GetTile(tile);
        const RefractedRay* other = fresh.GetRays()[k].GetTile(tile);
        ASSERT_EQ(one != nullptr, other != nullptr);
        for (int pixel = 0; other && pixel < RefractedRayTiles::RaysOfTile; ++pixel)
        {
          ASSERT_TRUE(
            one[pixel].Depth == other[pixel].Depth && one[pixel].Step == other[pixel].Step);
          met += other[pixel].GoesOn() ? 1 : 0;
        }
      }
    }
  }
  EXPECT_GT(met, 10000);
}

/** The bounds of the steps hold, and lead to the frames that the single rays need. */
TEST(RefractedRayStack, StepBoundsChooseTheFramesOfAllRays)
{
  const StackedSphere sphere(16);
  const std::vector<StackedInterface> ball{ sphere.Between(1.0, 2.0), sphere.Between(1.0, 2.0) };
  int several = 0;
  for (const double width : { 0.1, 0.3, 0.6, 1.0, 1.5, 2.0, 2.5 })
  {
    RefractedRayField::View view =
      LookAt(glm::dvec3(0.3, 0.2, 2.5), glm::dvec3(0.0), width, false, Size);
    SetMesh(view, Everywhere);
    RefractedRayStack stack;
    stack.Build(ball, view);
    AxisBox steps;
    for (int pixel = 0; pixel < Size * Size; ++pixel)
    {
      for (const RefractedRayTiles& rays : stack.GetRays())
      {
        const RefractedRay ray = RayOf(rays, pixel % Size, pixel / Size);
        steps.Add(ray.GoesOn() ? AxisBox{ ray.Step, ray.Step } : AxisBox());
      }
    }
    EXPECT_EQ(stack.GetStepBounds().Low, steps.Low);
    EXPECT_EQ(stack.GetStepBounds().High, steps.High);
    const RayLegs legs = LegsOf(stack, view);
    RefractionFrames each;
    each.Turn(legs, stack.GetMeanDirection(), SerialLoop);
    RefractionFrames bounded;
    bounded.Turn(legs, stack.GetMeanDirection(), SerialLoop, stack.GetStepBounds());
    int frames = 0;
    for (int index = 0; index < RefractionFrames::Number; ++index)
    {
      // Frames that are not needed are not turned.
      const glm::dmat3& turn = each.Get(index).FromView;
      EXPECT_EQ(bounded.Get(index).FromView, turn) << width;
      frames += turn != glm::dmat3(1.0) ? 1 : 0;
    }
    several += frames > 1 ? 1 : 0;
  }
  EXPECT_GT(several, 0);
  EXPECT_LT(several, 7);
}

TEST(RefractedRayStack, TheOrderOfTilesDoesNotMatter)
{
  const StackedSheet front(Shapes[2], 12);
  const StackedSheet back([](double x, double y) { return Shapes[2](y, x) - 0.4; }, 9);
  const std::vector<StackedInterface> pane{ front.Between(1.0, 1.5), back.Between(1.5, 1.1) };
  RefractedRayField::View view = LookAtAll(glm::dvec3(0.4, 0.2, 2.0), glm::dvec3(0.0), 1.7, false);
  RefractedRayStack forward;
  forward.Build(pane, view);
  RefractedRayStack backward;
  backward.Build(pane, view,
    [](std::size_t count, const std::function<void(std::size_t, std::size_t)>& body)
    {
      for (std::size_t i = count; i > 0; --i)
      {
        body(i - 1, i);
      }
    });
  EXPECT_EQ(forward.GetMeanDirection(), backward.GetMeanDirection());
  EXPECT_EQ(forward.GetCounts().Missing, backward.GetCounts().Missing);
  for (int pixel = 0; pixel < Size * Size; ++pixel)
  {
    for (const std::size_t k : { std::size_t{ 0 }, std::size_t{ 1 } })
    {
      const RefractedRay one = RayOf(forward.GetRays()[k], pixel % Size, pixel / Size);
      const RefractedRay other = RayOf(backward.GetRays()[k], pixel % Size, pixel / Size);
      ASSERT_TRUE(one.Depth == other.Depth && one.Step == other.Step);
    }
  }
}
