// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Points that are solved side by side: the same bits as one by one, with every instruction set.
#include "MembraneMeshes.h"
#include "ReadySolver.h"
#include "Refraction/Curved/CurvedMembraneSolver.h"
#include "Refraction/Curved/SightLanes.h"
#include "Refraction/Membrane/FacetWalk.h"
#include "RefractionTestRandom.h"
#include "Simd/InstructionSets.h"
#include "TestBasics.h"

namespace
{

using namespace meniscus;
using meniscus::reference::MembraneMesh;
using meniscus::test::Random;
using meniscus::test::ReadySolver;

void ExpectSame(const VirtualVertex& a, const VirtualVertex& b, std::size_t i)
{
  EXPECT_EQ(a.State, b.State) << i;
  EXPECT_EQ(a.Position, b.Position) << i;
  EXPECT_EQ(a.SightPoint, b.SightPoint) << i;
  EXPECT_EQ(a.Depth, b.Depth) << i;
  EXPECT_EQ(a.Reflectance, b.Reflectance) << i;
  EXPECT_EQ(a.Cosine, b.Cosine) << i;
  EXPECT_EQ(a.Facet, b.Facet) << i;
  EXPECT_EQ(a.Orientation, b.Orientation) << i;
}

//------------------------------------------------------------------------------
// The scalar method is the truth for the lanes: random patches of a rough membrane, with straight
// edges among them, and targets in and outside of the facet.
TEST(RefractionSightLanes, AgreeWithOnePointBitByBit)
{
  constexpr int steps = 8;
  constexpr double reach = 0.3;
  ReadySolver solver(meniscus::reference::MakeRandom(4.0, 12, 0.15, 0.9, 3), { 0.2, 3.0, -0.3 });
  ASSERT_GT(solver.GetPatches().GetNumberOfStraightEdges(), 0u);
  const auto facets = static_cast<double>(solver.GetMembrane().GetFacets().size());
  for (const auto set : meniscus::GetInstructionSets())
  {
    for (const bool reflects : { false, true })
    {
      Random random(11);
      const Media media{ { 0.2, 3.0, -0.3 }, 1.0, reflects ? 1.0 : 1.4, reflects };
      int ends[4] = {};
      for (int round = 0; round < 500; ++round)
      {
        SightLanes lanes;
        std::int32_t facet[SightLanes::Count];
        for (int lane = 0; lane < SightLanes::Count; ++lane)
        {
          facet[lane] = static_cast<std::int32_t>(random(0.0, facets - 0.5));
          const CurvedPatch patch = solver.GetPatches().GetPatch(facet[lane]);
          solver.GetPatches().LoadPatch(facet[lane], lane, lanes);
          const glm::dvec2 b(random(-0.5, 1.0), random(-0.3, 1.0));
          SightLanes::Set(lanes.Target, lane, patch.GetFlatPoint(b));
          // A point on a ray nearby.
          const auto at = patch.Evaluate(b + glm::dvec2(random(-0.2, 0.2), random(-0.2, 0.2)));
          const glm::dvec3 ray =
            media.GetRay(glm::normalize(at.Position - media.Eye), glm::normalize(at.Normal))
              .Direction;
          SightLanes::Set(lanes.Point, lane, at.Position + random(0.1, 2.0) * ray);
        }
        SightRoot roots[SightLanes::Count];
        meniscus::SolveLanes(media, steps, reach, set, lanes, roots);
        meniscus::ComputeVirtualPlaces(media, set, roots, lanes);
        for (int lane = 0; lane < SightLanes::Count; ++lane)
        {
          const CurvedPatch patch = solver.GetPatches().GetPatch(facet[lane]);
          const glm::dvec3 point = SightLanes::Get(lanes.Point, lane);
          const glm::dvec2 start = patch.ProjectToFacet(SightLanes::Get(lanes.Target, lane));
          if (FindOutside(start).Least < -reach)
          {
            EXPECT_EQ(roots[lane].End, SightRoot::End::Failed);
            continue;
          }
          const SightRoot root = media.MakeEquation(point).Solve(patch, start, steps, reach);
          const bool isOpen = roots[lane].End == SightRoot::End::Open;
          ASSERT_EQ(isOpen ? SightRoot::End::Failed : roots[lane].End, root.End);
          ++ends[static_cast<int>(root.End)];
          if (root.End != SightRoot::End::Converged)
          {
            continue;
          }
          EXPECT_EQ(roots[lane].B, root.B);
          EXPECT_EQ(roots[lane].At.Position, root.At.Position);
          EXPECT_EQ(roots[lane].At.Normal, root.At.Normal);
          EXPECT_EQ(roots[lane].Determinant, root.Determinant);
          const VirtualPlace place =
            meniscus::ComputeVirtualPlace(media, media.GetLaw(), point, root.At);
          EXPECT_EQ(SightLanes::Get(lanes.Position, lane), place.Position);
          EXPECT_EQ(lanes.Depth[lane], place.Depth);
          EXPECT_EQ(lanes.Reflectance[lane], place.Reflectance);
          EXPECT_EQ(lanes.Cosine[lane], place.Cosine);
          EXPECT_EQ(lanes.Orientation[lane],
            SightEquation::GetOrientation(patch, root.At.Normal, root.Determinant));
        }
      }
      EXPECT_GT(ends[static_cast<int>(SightRoot::End::Converged)], 300) << NameOf(set);
      EXPECT_GT(ends[static_cast<int>(SightRoot::End::Left)], 300) << NameOf(set);
    }
  }
}

//------------------------------------------------------------------------------
// Each chain of a range has the answers of SolvePoint for its points one after the other, for
// membranes with one image, with several and with none, refracting and reflecting.
TEST(RefractionSightLanes, ChainsSideBySideAreChainsOneByOne)
{
  constexpr std::size_t count = 20 * CurvedMembraneSolver::Chain + 37;
  const struct
  {
    MembraneMesh Mesh;
    double Interior;
    bool Reflects;
  } cases[] = { { meniscus::reference::MakeWaves(200.0, 40, 5.0, 3.0), 1.333, false },
    { meniscus::reference::MakeWaves(200.0, 200, 2.0, 4.0), 1.333, false },
    { meniscus::reference::MakeRandom(200.0, 30, 4.0, 0.4, 5), 0.7, false },
    { meniscus::reference::MakeSquare(200.0, 12, 0.0), 1.0, false },
    { meniscus::reference::MakeWaves(200.0, 40, 5.0, 3.0), 1.333, true } };
  for (const auto& each : cases)
  {
    ReadySolver solver(each.Mesh, { 20.0, 300.0, 10.0 }, 1.0, each.Interior, each.Reflects);
    std::vector<double> points;
    Random random(91);
    for (std::size_t i = 0; i < count; ++i)
    {
      // Rows of a grid, some of which are beyond the border, with random points between them.
      const auto place = static_cast<double>(i);
      const glm::dvec3 regular(4.0 * (static_cast<double>(i % 60) - 30.0),
        -20.0 - std::fmod(place, 7.0), place / 20.0 - 64.0);
      const glm::dvec3 any(random(-90.0, 90.0), random(-90.0, 90.0), random(-90.0, 90.0));
      glm::dvec3 point = i % 11 == 10 ? any : regular;
      point.y = each.Reflects ? -point.y : point.y;
      points.insert(points.end(), { point.x, i == 700 ? NAN : point.y, point.z });
    }
    std::vector<VirtualVertex> together(count);
    solver.Solve(points.data(), 0, count, together.data());
    CurvedMembraneSolver::Memory memory;
    std::size_t found = 0;
    for (std::size_t i = 0; i < count; ++i)
    {
      if (i % CurvedMembraneSolver::Chain == 0)
      {
        memory = CurvedMembraneSolver::Memory();
      }
      const double* p = points.data() + 3 * i;
      const VirtualVertex alone = solver.SolvePoint({ p[0], p[1], p[2] }, memory);
      if (i == 700)
      {
        EXPECT_EQ(together[i].State, ImageState::NotFinite);
        continue;
      }
      ExpectSame(together[i], alone, i);
      found += alone.State == ImageState::Found;
    }
    EXPECT_GT(found, count / 2);
  }
}

//------------------------------------------------------------------------------
// Facets may have any numbers: those of a mesh in random order give the same images, since the
// number of the next facet is no more than a guess.
TEST(RefractionSightLanes, NumbersOfFacetsDoNotMatter)
{
  const MembraneMesh mesh = meniscus::reference::MakeWaves(200.0, 100, 2.0, 3.0);
  MembraneMesh shuffled = mesh;
  std::vector<std::size_t> order(mesh.Triangles.size() / 3);
  std::iota(order.begin(), order.end(), std::size_t{ 0 });
  std::shuffle(order.begin(), order.end(), std::mt19937(5));
  for (std::size_t i = 0; i < order.size(); ++i)
  {
    std::copy_n(mesh.Triangles.begin() + static_cast<std::ptrdiff_t>(3 * order[i]), 3,
      shuffled.Triangles.begin() + static_cast<std::ptrdiff_t>(3 * i));
  }
  ReadySolver regular(mesh, { 20.0, 300.0, 10.0 });
  ReadySolver random(shuffled, { 20.0, 300.0, 10.0 });
  std::vector<double> points;
  constexpr std::size_t across = 40;
  for (std::size_t i = 0; i < across * across; ++i)
  {
    points.insert(points.end(),
      { 4.0 * static_cast<double>(i % across) - 78.0, -40.0,
        4.0 * static_cast<double>(i / across) - 78.0 });
  }
  std::vector<VirtualVertex> a(across * across);
  std::vector<VirtualVertex> b(across * across);
  regular.Solve(points.data(), 0, a.size(), a.data());
  random.Solve(points.data(), 0, b.size(), b.data());
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    ASSERT_EQ(a[i].State, b[i].State);
    // Newton's method leaves an error of 1e-10 of a facet.
    EXPECT_LT(glm::length(a[i].SightPoint - b[i].SightPoint), 1e-8) << i;
  }
}

//------------------------------------------------------------------------------
// A walk over a height field ends in the facet below the target, also in turns with other walks.
TEST(RefractionSightLanes, WalksEndAtTheirTargets)
{
  ReadySolver solver(meniscus::reference::MakeWaves(200.0, 60, 4.0, 3.0), { 20.0, 300.0, 10.0 });
  const auto& patches = solver.GetPatches();
  const glm::dvec3 up(0.1, 1.0, -0.05);
  Random random(3);
  const auto facets = static_cast<double>(patches.GetSize());
  constexpr int most = 1000;
  for (int round = 0; round < 200; ++round)
  {
    FacetWalk walks[4];
    std::int32_t start[4];
    glm::dvec3 target[4];
    for (int k = 0; k < 4; ++k)
    {
      start[k] = static_cast<std::int32_t>(random(0.0, facets - 0.5));
      const auto facet = static_cast<std::int32_t>(random(0.0, facets - 0.5));
      // Above the facet, along the direction of the walk.
      const double x = random(0.1, 0.4);
      target[k] = patches.GetPatch(facet).GetFlatPoint({ x, random(0.1, 0.4) }) + 5.0 * up;
      walks[k] = FacetWalk(patches, start[k], target[k], up, most);
    }
    for (bool isOpen = true; isOpen;)
    {
      isOpen = false;
      for (FacetWalk& walk : walks)
      {
        isOpen = walk.Advance() || isOpen;
      }
    }
    for (int k = 0; k < 4; ++k)
    {
      EXPECT_EQ(walks[k].GetFacet(), patches.Walk(start[k], target[k], up, most));
      const CurvedPatch patch = patches.GetPatch(walks[k].GetFacet());
      const glm::dvec3 normal =
        glm::cross(patch.Corner[1] - patch.Corner[0], patch.Corner[2] - patch.Corner[0]);
      const double way = glm::dot(patch.Corner[0] - target[k], normal) / glm::dot(up, normal);
      EXPECT_GE(FindOutside(patch.ProjectToFacet(target[k] + way * up)).Least, -1e-9) << round;
    }
  }
}

}
