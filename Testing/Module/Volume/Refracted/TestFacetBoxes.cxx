// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Lists of boxes clipped by a tube at once, compared with each box by itself.
#include "RefractionTestRandom.h"

#include "Refraction/Tubes/BoxTree.h"
#include "Simd/InstructionSets.h"
#include "Volume/Refracted/FacetBoxes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

using namespace meniscus;
using meniscus::testing::Random;

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
    const std::vector<AxisBox> boxes = RandomBoxes(1 + i % FacetBoxes::Size, random);
    FacetBoxes list = ListOf(boxes);
    const TubeClip clip(tube);
    for (const InstructionSet set : GetInstructionSets())
    {
      ClipBoxes(tube, set, list);
      for (std::size_t box = 0; box < boxes.size(); ++box)
      {
        const TubeRange expected = clip.Clip(boxes[box], Infinity);
        EXPECT_EQ(list.From[box], expected.From) << NameOf(set);
        EXPECT_EQ(list.To[box], expected.To) << NameOf(set);
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
    FacetBoxes list = ListOf(RandomBoxes(FacetBoxes::Size, random));
    std::vector<std::int32_t> all;
    VisitBoxes(tube, BestInstructionSet(), list,
      [&all](std::int32_t facet, const TubeRange&) { all.push_back(facet); });
    double last = 0.0;
    const double limit = random(0.5, 3.0);
    std::vector<std::int32_t> near;
    VisitBoxesNearFirst(tube, BestInstructionSet(), list,
      [&](std::int32_t facet, const TubeRange& range)
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
      const double from = list.From[facet - 100];
      // The limit is known after the first visit.
      EXPECT_TRUE(isVisited(facet) == (from <= limit) || facet == near.front());
      leftOut += isVisited(facet) ? 0 : 1;
    }
    visited += static_cast<int>(near.size());
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
  EXPECT_EQ(facets.Find(1)->Facet[0], 5);
  EXPECT_EQ(facets.Find(2), nullptr); // too many
  EXPECT_EQ(facets.Find(3), nullptr);
  facets.Clear();
  facets.Append();
  ASSERT_NE(facets.Find(0), nullptr);
  EXPECT_EQ(facets.Find(0)->Count, 0);
  EXPECT_EQ(facets.Find(1), nullptr);
}
