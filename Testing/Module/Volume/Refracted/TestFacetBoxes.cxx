// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Lists of boxes clipped by a tube at once, compared with each box by itself.
#include "RefractionTestRandom.h"

#include "Refraction/Tubes/BoxTree.h"
#include "Simd/InstructionSets.h"
#include "TestBasics.h"
#include "Volume/Refracted/FacetBoxes.h"

using namespace meniscus;
using meniscus::test::Random;

namespace
{

constexpr double Infinity = std::numeric_limits<double>::infinity();

/** A tube; some of its directions are 0 along an axis, or have both signs. */
TubeBounds RandomTube(Random& random)
{
  TubeBounds tube;
  tube.StartLow = random.Point(glm::dvec3(-1.0), glm::dvec3(1.0));
  tube.StartHigh = tube.StartLow + random.Point(glm::dvec3(0.0), glm::dvec3(0.2));
  tube.DirectionLow = random.Point(glm::dvec3(-1.0), glm::dvec3(1.0));
  tube.DirectionHigh = tube.DirectionLow + random.Point(glm::dvec3(0.0), glm::dvec3(0.3));
  for (int axis = 0; axis < 3; ++axis)
  {
    const double kind = random(0.0, 1.0);
    tube.DirectionLow[axis] = kind < 0.2 ? 0.0 : tube.DirectionLow[axis];
    tube.DirectionHigh[axis] = kind < 0.1 ? 0.0 : tube.DirectionHigh[axis];
    tube.DirectionHigh[axis] = std::max(tube.DirectionLow[axis], tube.DirectionHigh[axis]);
  }
  return tube;
}

/** A list of `count` boxes, of which some are flat. */
std::vector<AxisBox> RandomBoxes(int count, Random& random)
{
  std::vector<AxisBox> boxes;
  for (int i = 0; i < count; ++i)
  {
    const glm::dvec3 low = random.Point(glm::dvec3(-2.0), glm::dvec3(2.0));
    glm::dvec3 high = low + random.Point(glm::dvec3(0.0), glm::dvec3(1.0));
    high[i % 3] = i % 4 == 0 ? low[i % 3] : high[i % 3];
    boxes.push_back({ low, high });
  }
  return boxes;
}

FacetBoxes ListOf(const std::vector<AxisBox>& boxes)
{
  FacetBoxes list;
  list.Add(0, { glm::dvec3(-9.0), glm::dvec3(9.0) }); // of an earlier list
  list.Clear();
  for (std::size_t i = 0; i < boxes.size(); ++i)
  {
    list.Add(100 + static_cast<std::int32_t>(i), boxes[i]);
  }
  return list;
}

}

TEST(FacetBoxes, RangesAreThoseOfEachBox)
{
  Random random(7);
  int met = 0;
  int missed = 0;
  for (int i = 0; i < 300; ++i)
  {
    const TubeBounds tube = RandomTube(random);
    const std::vector<AxisBox> boxes = RandomBoxes(1 + i % 512, random);
    FacetBoxes list = ListOf(boxes);
    const TubeClip clip(tube);
    for (const InstructionSet set : GetInstructionSets())
    {
      ClipBoxes(tube, set, list);
      for (std::size_t box = 0; box < boxes.size(); ++box)
      {
        const TubeRange expected = clip.Clip(boxes[box], Infinity);
        const BoxLanes& lanes = list.LanesOf(static_cast<int>(box));
        const std::size_t lane = box % BoxLanes::Size;
        EXPECT_TRUE(lanes.MayMeet || expected.From > expected.To);
        EXPECT_TRUE(!lanes.MayMeet || lanes.From[lane] == expected.From) << NameOf(set);
        EXPECT_TRUE(!lanes.MayMeet || lanes.To[lane] == expected.To) << NameOf(set);
        EXPECT_EQ(lanes.Facet[lane], 100 + static_cast<std::int32_t>(box));
        EXPECT_EQ(lanes.GetBox(static_cast<int>(lane)).Low, boxes[box].Low);
        EXPECT_EQ(lanes.GetBox(static_cast<int>(lane)).High, boxes[box].High);
        met += expected.From <= expected.To ? 1 : 0;
        missed += expected.From <= expected.To ? 0 : 1;
      }
    }
  }
  EXPECT_GT(met, 1000);
  EXPECT_GT(missed, 1000);
}

/** Boxes are visited from near to far, up to the limit that the visitor sets. */
TEST(FacetBoxes, NearBoxesComeFirst)
{
  Random random(11);
  int visited = 0;
  int leftOut = 0;
  for (int i = 0; i < 100; ++i)
  {
    const TubeBounds tube = RandomTube(random);
    FacetBoxes list = ListOf(RandomBoxes(512, random));
    std::vector<std::int32_t> all;
    VisitBoxes(tube, BestInstructionSet(), list,
      [&all](std::int32_t facet, const TubeRange&) { all.push_back(facet); });
    double last = 0.0;
    const double limit = random(0.5, 3.0);
    std::vector<std::int32_t> near;
    std::vector<std::int32_t> requested;
    VisitBoxesNearFirst(
      tube, BestInstructionSet(), list, [&](std::int32_t facet) { requested.push_back(facet); },
      [&](std::int32_t facet, const TubeRange& range, const AxisBox&)
      {
        EXPECT_LE(last, range.From);
        last = range.From;
        near.push_back(facet);
        return limit;
      });
    const auto isVisited = [&near](std::int32_t facet)
    { return std::find(near.begin(), near.end(), facet) != near.end(); };
    for (const std::int32_t facet : all)
    {
      const int box = facet - 100;
      const double from = list.LanesOf(box).From[box % BoxLanes::Size];
      // The limit is known after the first visit.
      EXPECT_TRUE(isVisited(facet) == (from <= limit) || facet == near.front());
      leftOut += isVisited(facet) ? 0 : 1;
    }
    visited += static_cast<int>(near.size());
    // All but the first few are requested, in the same order.
    const std::size_t first = near.size() - std::min(near.size(), requested.size());
    EXPECT_LE(first, 4u);
    for (std::size_t k = 4; k < near.size(); ++k)
    {
      EXPECT_EQ(requested[k - 4], near[k]);
    }
  }
  EXPECT_GT(visited, 100);
  EXPECT_GT(leftOut, 100);
}

TEST(FacetBoxes, ListsBeginWithAnInterface)
{
  BundleFacets facets;
  EXPECT_EQ(facets.Find(0), nullptr);
  facets.Clear(1);
  EXPECT_EQ(facets.Find(1), nullptr);
  facets.Append().Add(5, { glm::dvec3(0.0), glm::dvec3(1.0) });
  FacetBoxes& full = facets.Append();
  for (int i = 0; i <= FacetBoxes::Size; ++i)
  {
    full.Add(i, { glm::dvec3(0.0), glm::dvec3(1.0) });
  }
  EXPECT_EQ(facets.Find(0), nullptr);
  ASSERT_NE(facets.Find(1), nullptr);
  EXPECT_EQ(facets.Find(1)->Lanes[0].Facet[0], 5);
  EXPECT_EQ(facets.Find(2), nullptr); // too many
  EXPECT_EQ(facets.Find(3), nullptr);
  facets.Clear();
  facets.Append();
  ASSERT_NE(facets.Find(0), nullptr);
  EXPECT_EQ(facets.Find(0)->Count, 0);
  EXPECT_EQ(facets.Find(1), nullptr);
}

/** No ray of a block is left out that meets a box. */
TEST(FacetBoxes, GroupsOfRaysThatMeetABox)
{
  Random random(13);
  int left = 0;
  int met = 0;
  for (int i = 0; i < 200; ++i)
  {
    RayBlock rays;
    const int count = 1 + i % RayBlock::Size;
    const double first = random(-1.0, 1.0);
    const glm::dvec3 middle = random.Point(glm::dvec3(-2.0), glm::dvec3(2.0));
    for (int ray = 0; ray < count; ++ray)
    {
      // Directions along an axis among them.
      glm::dvec3 direction = random.Point(glm::dvec3(-0.1), glm::dvec3(0.1));
      direction[i % 3] = 1.0;
      direction[(i + 1) % 3] = i % 4 == 0 ? 0.0 : direction[(i + 1) % 3];
      const glm::dvec3 start = middle + random.Point(glm::dvec3(-0.3), glm::dvec3(0.3));
      rays.Add(start + 0.1 * glm::dvec3(ray / 8), direction, first, 0.0);
    }
    CompleteRays(BestInstructionSet(), rays);
    for (const InstructionSet set : GetInstructionSets())
    {
      GroupTubes groups(first, rays);
      for (const AxisBox& box : RandomBoxes(20, random))
      {
        const RayRange range = groups.FindRays(box, set);
        EXPECT_TRUE(range.First % GroupTubes::GroupSize == 0 && range.End <= count);
        left += count - (range.End - range.First);
        for (int ray = 0; ray < count; ++ray)
        {
          const glm::dvec3 start = rays.GetStart(ray) + first * rays.GetDirection(ray);
          const TubeRange own =
            TubeClip({ start, start, rays.GetDirection(ray), rays.GetDirection(ray) })
              .Clip(box, Infinity);
          const bool meets = own.From <= own.To;
          met += meets ? 1 : 0;
          EXPECT_TRUE(!meets || (ray >= range.First && ray < range.End)) << NameOf(set);
        }
      }
    }
  }
  EXPECT_GT(met, 1000);
  EXPECT_GT(left, 1000);
}
