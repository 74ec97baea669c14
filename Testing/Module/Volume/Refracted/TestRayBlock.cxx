// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Blocks of rays against boxes and patches: no ray that meets one is left out.
#include "KernelSurfaces.h"
#include "RefractionTestRandom.h"

#include "Simd/InstructionSets.h"
#include "TestBasics.h"
#include "Volume/Refracted/PatchIntersectionBatch.h"
#include "Volume/Refracted/PatchIntersector.h"
#include "Volume/Refracted/RayBlock.h"

#include <glm/mat2x2.hpp>
#include <glm/mat2x3.hpp>

using namespace meniscus;
using namespace meniscus::test;
using meniscus::test::Random;

namespace
{

double Cap(double x, double y)
{
  return std::sqrt(4.0 - x * x - y * y) - 1.7;
}

double Waves(double x, double y)
{
  return 0.05 * std::sin(5.0 * x + 1.0) * std::sin(4.0 * y);
}

}

TEST(RayBlock, NoRayMissesItsBox)
{
  Random random(29);
  int meets = 0;
  for (int i = 0; i < 200; ++i)
  {
    const glm::dvec3 low = random.Point(glm::dvec3(-1.0), glm::dvec3(0.0));
    const AxisBox box{ low, low + random.Point(glm::dvec3(0.0), glm::dvec3(1.0)) };
    const AxisBox away{ box.Low + glm::dvec3(2e4), box.High + glm::dvec3(2e4) };
    for (int ray = 0; ray < RayBlock::Size; ++ray)
    {
      // To a place of the box, or along its sides, where a component of the direction is 0.
      glm::dvec3 target = random.Point(box.Low, box.High);
      glm::dvec3 start = random.Point(glm::dvec3(-1e3), glm::dvec3(1e3));
      target[ray % 3] = ray % 2 == 0 ? box.Low[ray % 3] : target[ray % 3];
      start[ray % 3] = ray % 4 == 0 ? box.Low[ray % 3] : start[ray % 3];
      // The only ray of the block that meets the box; the others go away from it.
      RayBlock rays;
      for (int before = 0; before < ray; ++before)
      {
        rays.Add(start, start - target, 0.0, 0.0);
      }
      rays.Add(start, target - start, 0.0, 0.0);
      for (const InstructionSet set : GetInstructionSets())
      {
        InvertDirections(set, rays);
        meets += MeetsBox(box, set, rays) ? 1 : 0;
        EXPECT_FALSE(MeetsBox(away, set, rays));
      }
    }
  }
  EXPECT_EQ(meets, 200 * RayBlock::Size * static_cast<int>(GetInstructionSets().size()));
}

/** Tubes are as narrow as their rays, of any number and in any instruction set. */
TEST(RayBlock, TubesBoundRays)
{
  Random random(31);
  for (int count = 1; count <= RayBlock::Size; ++count)
  {
    RayBlock rays;
    TubeBounds expected;
    TubeBounds ofUnits;
    const double first = random(-1.0, 1.0);
    for (int ray = 0; ray < count; ++ray)
    {
      const glm::dvec3 start = random.Point(glm::dvec3(-1.0), glm::dvec3(1.0));
      const glm::dvec3 direction = random.Point(glm::dvec3(-1.0), glm::dvec3(1.0));
      rays.Add(start, direction, first, 0.0);
      expected.Add(start + first * direction, direction);
      ofUnits.Add(start + first * direction, direction * (1.0 / glm::length(direction)));
    }
    CompleteRays(BestInstructionSet(), rays);
    const auto expectEqual = [](const TubeBounds& a, const TubeBounds& b)
    {
      EXPECT_EQ(a.StartLow, b.StartLow);
      EXPECT_EQ(a.StartHigh, b.StartHigh);
      EXPECT_EQ(a.DirectionLow, b.DirectionLow);
      EXPECT_EQ(a.DirectionHigh, b.DirectionHigh);
    };
    for (const InstructionSet set : GetInstructionSets())
    {
      expectEqual(FindTube(first, set, rays), expected);
      expectEqual(FindUnitTube(first, set, rays), ofUnits);
    }
    for (int ray = 0; ray < count; ++ray)
    {
      rays.Last[ray] = random(-1.0, 1.0);
    }
    EXPECT_EQ(rays.GetFarthest(), *std::max_element(rays.Last, rays.Last + count));
  }
}

/**
 * The bounds of a patch about its facet's plane leave out no ray that meets the patch, at any
 * slant, on the side and between the depths that count, and few others.
 */
TEST(RayBlock, NoRayMissesThePatchThatItMeets)
{
  Random random(41);
  const Sphere sphere(12);
  const Sheet sheet(Waves, 5);
  int missed = 0;
  int met = 0;
  int passing = 0;
  int taken = 0;
  const auto planeOf = [](const CurvedPatch& patch)
  { return glm::cross(patch.Corner[1] - patch.Corner[0], patch.Corner[2] - patch.Corner[0]); };
  const auto test = [&](const CurvedPatch& patch, double unit)
  {
    const PatchIntersector tracer(patch, 1.0, BestInstructionSet());
    RayBlock rays;
    double depths[RayBlock::Size];
    bool meets[RayBlock::Size];
    for (int ray = 0; ray < RayBlock::Size; ++ray)
    {
      // A place on the patch or, near by, on what continues it, and a ray through it.
      meets[ray] = ray % 2 == 0;
      double x = random(0.0, 1.0);
      double y = random(0.0, 1.0);
      if (x + y > 1.0)
      {
        x = 1.0 - x;
        y = 1.0 - y;
      }
      const PatchPoint place = patch.Evaluate({ meets[ray] ? x : -x - 0.5, y });
      glm::dvec3 direction = random.Point(glm::dvec3(-1.0), glm::dvec3(1.0));
      // Also rays along the surface.
      const glm::dvec3 normal = glm::normalize(place.Normal);
      direction -= (ray % 4 < 2 ? 0.97 : 0.0) * glm::dot(direction, normal) * normal;
      depths[ray] = random(0.5, 2.0);
      const double facing = glm::dot(direction, place.Normal) < 0.0 ? -1.0 : 1.0;
      rays.Add(place.Position - depths[ray] * unit * direction, unit * direction, 0.0,
        ray % 3 == 0 ? 0.0 : facing);
      if (ray % 5 == 0)
      {
        rays.First[ray] = depths[ray] - 1e-3;
        rays.Last[ray] = depths[ray] + 1e-3;
      }
    }
    CompleteRays(BestInstructionSet(), rays);
    // The tube of all rays, and the tube of each by itself between depths about the place.
    const TubeBounds tube = FindTube(0.0, BestInstructionSet(), rays);
    EXPECT_TRUE(tracer.MayMeet(tube, { 0.0, 2.0 }));
    for (int ray = 0; ray < RayBlock::Size; ++ray)
    {
      TubeBounds own;
      own.Add(rays.GetStart(ray), rays.GetDirection(ray));
      const bool mayMeet = tracer.MayMeet(own, { depths[ray] - 1e-3, depths[ray] + 1e-3 });
      EXPECT_TRUE(mayMeet || !meets[ray]);
      const glm::dvec3 away = 2.0 * patch.GetSize() * glm::normalize(planeOf(patch));
      own.StartLow += away;
      own.StartHigh += away;
      EXPECT_FALSE(tracer.MayMeet(own, { depths[ray], depths[ray] }));
    }
    bool found[RayBlock::Size] = {};
    tracer.Meet(rays,
      [&](std::int32_t ray, const MembraneHit& hit)
      { found[ray] = found[ray] || std::fabs(hit.Depth - depths[ray]) < 1e-7; });
    for (int ray = 0; ray < RayBlock::Size; ++ray)
    {
      met += meets[ray] ? 1 : 0;
      missed += meets[ray] && !found[ray] ? 1 : 0;
      passing += meets[ray] ? 0 : 1;
      taken += !meets[ray] && rays.Meets[ray] != 0 ? 1 : 0;
    }
  };
  const CurvedPatches* const surfaces[] = { &sphere.Patches, &sheet.Patches };
  for (const CurvedPatches* surface : surfaces)
  {
    for (std::int32_t facet = 0; facet < 50; ++facet)
    {
      test(surface->GetPatch(facet), 1.0);
      test(surface->GetPatch(facet), 30.0);
    }
  }
  EXPECT_EQ(missed, 0);
  EXPECT_EQ(met, 100 * RayBlock::Size);
  EXPECT_LT(taken, passing / 2);
}

/** Rays that do not meet the patch from the side that counts, or at a depth that counts. */
TEST(RayBlock, PatchesThatDoNotCountAreLeftOut)
{
  const Sheet sheet(Cap, 6);
  const CurvedPatch patch = sheet.Patches.GetPatch(20);
  const PatchPoint middle = patch.Evaluate({ 1.0 / 3.0, 1.0 / 3.0 });
  const PatchIntersector tracer(patch, 1.0, BestInstructionSet());
  RayBlock rays;
  const glm::dvec3 direction = -glm::normalize(middle.Normal);
  for (const double facing : { -1.0, 0.0, 1.0, -1.0, -1.0 })
  {
    rays.Add(middle.Position - direction, direction, 0.0, facing);
  }
  rays.Last[3] = 0.9;
  rays.First[4] = 1.1;
  CompleteRays(BestInstructionSet(), rays);
  int hits = 0;
  tracer.Meet(rays, [&hits](std::int32_t, const MembraneHit&) { ++hits; });
  EXPECT_EQ(hits, 2);
  const bool expected[] = { true, true, false, false, false };
  for (int ray = 0; ray < rays.Count; ++ray)
  {
    EXPECT_EQ(rays.Meets[ray] != 0, expected[ray]) << ray;
  }
}

/**
 * Distance along a ray between a point of it and the patch: by the nearest point of the patch,
 * which the method of Gauss and Newton finds, and the tangent plane there.
 */
double DepthError(const CurvedPatch& patch, const glm::dvec3& point, const glm::dvec3& direction)
{
  glm::dvec2 place = patch.ProjectToFacet(point);
  PatchJet jet;
  patch.Evaluate(place, jet);
  for (int step = 0; step < 30; ++step)
  {
    const glm::dvec3 offset = point - jet.Position;
    const glm::dmat2x3 by(jet.PositionBy[0], jet.PositionBy[1]);
    place += glm::inverse(glm::transpose(by) * by) * (glm::transpose(by) * offset);
    patch.Evaluate(place, jet);
  }
  const glm::dvec3 normal = glm::normalize(glm::cross(jet.PositionBy[0], jet.PositionBy[1]));
  return glm::length(point - jet.Position) / std::fabs(glm::dot(normal, direction));
}

/** Intersections are as exact as PatchIntersector::LastStep promises: to 1e-9 of the facet. */
TEST(RayBlock, IntersectionsAreWithinTheirBound)
{
  Random random(43);
  int hits = 0;
  double largest = 0.0;
  for (const auto& shape : { Cap, Waves })
  {
    for (const int cells : { 1, 2, 3, 5, 8, 13, 21 })
    {
      const Sheet sheet(shape, cells);
      const auto facets = static_cast<std::int32_t>(sheet.Surface.GetFacets().size());
      for (int i = 0; i < 400; ++i)
      {
        const CurvedPatch patch =
          sheet.Patches.GetPatch(static_cast<std::int32_t>(random(0.0, 0.999) * facets));
        const PatchIntersector tracer(patch, 1.0, BestInstructionSet());
        RayBlock rays;
        for (int ray = 0; ray < RayBlock::Size; ++ray)
        {
          const PatchPoint place = patch.Evaluate({ random(0.0, 0.5), random(0.0, 0.5) });
          // Within 70 degrees of the normal: slants below 3.
          const glm::dvec3 normal = glm::normalize(place.Normal);
          const glm::dvec3 beside = glm::cross(normal, random.Point(glm::dvec3(-1), glm::dvec3(1)));
          const glm::dvec3 direction = glm::normalize(2.7 * beside - glm::length(beside) * normal);
          rays.Add(place.Position - random(0.5, 2.0) * direction, direction, 0.0, 0.0);
        }
        CompleteRays(BestInstructionSet(), rays);
        tracer.Meet(rays,
          [&](std::int32_t ray, const MembraneHit& hit)
          {
            const glm::dvec3 start = rays.GetStart(ray);
            const glm::dvec3 direction = rays.GetDirection(ray);
            const double error = DepthError(patch, start + hit.Depth * direction, direction);
            ++hits;
            largest = std::max(largest, error / patch.GetSize());
          });
      }
    }
  }
  EXPECT_GT(hits, 100000);
  EXPECT_LT(largest, 1e-9);
}

/** Starts on patches whose normals differ little are as close as GentleStartKernel promises. */
TEST(RayBlock, StartsAreNearPatches)
{
  Random random(47);
  int gentle = 0;
  int others = 0;
  for (const int cells : { 3, 13, 21, 34, 55 })
  {
    const Sheet sheet(Cap, cells);
    const auto facets = static_cast<std::int32_t>(sheet.Surface.GetFacets().size());
    for (int i = 0; i < 200; ++i)
    {
      const CurvedPatch patch =
        sheet.Patches.GetPatch(static_cast<std::int32_t>(random(0.0, 0.999) * facets));
      const glm::dvec3 u = patch.Corner[1] - patch.Corner[0];
      const glm::dvec3 v = patch.Corner[2] - patch.Corner[0];
      const glm::dvec3 normal = glm::cross(u, v);
      const double squared = glm::dot(normal, normal);
      const FacetPlane plane{ patch.Corner[0], normal, glm::cross(v, normal) / squared,
        glm::cross(normal, u) / squared };
      const glm::dvec3 up = normal / std::sqrt(squared);
      const double steepest = patch.GetSize() *
        std::max(
          { glm::length(plane.ByX), glm::length(plane.ByY), glm::length(plane.ByX + plane.ByY) });
      double spread = 0.0;
      for (const glm::dvec3& corner : patch.Normal)
      {
        spread =
          std::max(spread, glm::length(glm::dot(up, corner) < 0.0 ? up + corner : up - corner));
      }
      PatchIntersectionBatch lanes;
      for (int ray = 0; ray < PatchIntersectionBatch::Size; ++ray)
      {
        const glm::dvec3 place = patch.GetFlatPoint({ random(0.0, 0.5), random(0.0, 0.5) });
        const glm::dvec3 beside = glm::cross(up, random.Point(glm::dvec3(-1), glm::dvec3(1)));
        const glm::dvec3 direction = glm::normalize(2.7 * beside - glm::length(beside) * up);
        lanes.Add(ray, place - direction, direction);
        const FacetPlane::Meeting meeting = plane.Meet(place - direction, direction);
        lanes.Depth[ray] = meeting.Depth;
        lanes.X[ray] = meeting.X;
        lanes.Y[ray] = meeting.Y;
        lanes.Slant[ray] = std::sqrt(squared) / std::fabs(meeting.Along);
      }
      const PatchStart start(patch, plane, patch.GetSize(), spread);
      (start.IsGentle ? gentle : others) += 1;
      StartNearPatch(start, InstructionSet::Portable, lanes);
      for (const InstructionSet set : GetInstructionSets())
      {
        PatchIntersectionBatch same = lanes;
        StartNearPatch(start, set, same);
        for (int ray = 0; ray < lanes.Count; ++ray)
        {
          EXPECT_EQ(same.PatchX[ray], lanes.PatchX[ray]) << NameOf(set);
          EXPECT_EQ(same.PatchY[ray], lanes.PatchY[ray]) << NameOf(set);
          EXPECT_EQ(same.Behind[ray], lanes.Behind[ray]) << NameOf(set);
        }
      }
      StepToPatch(patch, patch.GetSize(), BestInstructionSet(), lanes);
      for (int ray = 0; ray < lanes.Count && start.IsGentle; ++ray)
      {
        // Single precision rounds shares of the facet, of up to 1.
        constexpr double rounding = 4.0 * std::numeric_limits<float>::epsilon();
        const double slant = lanes.Slant[ray];
        const double product = steepest * slant * spread;
        EXPECT_LT(lanes.Move[ray], product * product * product / 3.0 + rounding * slant) << cells;
      }
    }
  }
  EXPECT_GT(gentle, 400);
  EXPECT_GT(others, 200);
}

TEST(RayBlock, InstructionSetsSeeTheSame)
{
  const Sheet sheet(Waves, 3);
  Random random(5);
  PatchIntersectionBatch lanes;
  RayBlock rays;
  for (int i = 0; i < PatchIntersectionBatch::Size - 3; ++i)
  {
    const glm::dvec3 start = random.Point(glm::dvec3(-0.4, -0.4, 1.0), glm::dvec3(0.4, 0.4, 2.0));
    const glm::dvec3 direction =
      random.Point(glm::dvec3(-0.5, -0.5, -1.2), glm::dvec3(0.5, 0.5, -0.8));
    lanes.Add(i, start, direction);
    rays.Add(start, direction, 0.0, -1.0);
  }
  const CurvedPatch patch = sheet.Patches.GetPatch(4);
  const glm::dvec3 u = patch.Corner[1] - patch.Corner[0];
  const glm::dvec3 v = patch.Corner[2] - patch.Corner[0];
  const glm::dvec3 normal = glm::cross(u, v);
  const double squared = glm::dot(normal, normal);
  const PatchReach reach{ { patch.Corner[0], normal, glm::cross(v, normal) / squared,
                            glm::cross(normal, u) / squared },
    std::sqrt(squared), -0.02, 0.03, 0.01, 1.0, 0.4 };
  const auto run = [&](InstructionSet set)
  {
    RayBlock block = rays;
    CompleteRays(set, block);
    MeetPatchReach(reach, { 0, rays.Count }, set, block);
    PatchIntersectionBatch result = lanes;
    for (int i = 0; i < result.Count; ++i)
    {
      result.Index[i] = static_cast<std::int32_t>(block.Meets[i]);
      result.Slant[i] = block.Slant[i];
      result.Depth[i] = block.Depth[i];
      result.X[i] = block.X[i];
      result.Y[i] = block.Y[i];
      result.PatchX[i] = block.X[i];
      result.PatchY[i] = block.Y[i];
      result.Behind[i] = 0.0;
    }
    StepToPatch(patch, 0.5, set, result);
    FindStates({ 0.1, 1e-8, 0.1 }, 0.5, set, result);
    Refract(1.5, set, result); // some beyond the critical angle
    return result;
  };
  const PatchIntersectionBatch expected = run(InstructionSet::Portable);
  for (const InstructionSet set : GetInstructionSets())
  {
    const PatchIntersectionBatch result = run(set);
    for (int i = 0; i < lanes.Count; ++i)
    {
      EXPECT_EQ(result.Index[i], expected.Index[i]) << NameOf(set);
      EXPECT_EQ(result.Slant[i], expected.Slant[i]);
      EXPECT_EQ(result.Depth[i], expected.Depth[i]);
      EXPECT_EQ(result.PatchX[i], expected.PatchX[i]);
      EXPECT_EQ(result.Behind[i], expected.Behind[i]);
      EXPECT_EQ(result.State[i], expected.State[i]);
      EXPECT_EQ(result.Refracted[i], expected.Refracted[i]);
      for (int axis = 0; axis < 3; ++axis)
      {
        EXPECT_EQ(result.Normal[axis][i], expected.Normal[axis][i]);
      }
    }
  }
}
