// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Common/GroupedItems.h"
#include "TestBasics.h"

using namespace meniscus;

namespace
{

std::vector<std::int32_t> ListGroup(const GroupedItems& items, std::size_t group)
{
  return { items[group].begin(), items[group].end() };
}

}

/** A group has its items in the order in which they were given; some groups have none. */
TEST(GroupedItems, AreTheGivenPairs)
{
  constexpr std::size_t groups = 50;
  std::mt19937 random(7);
  std::vector<std::vector<std::int32_t>> expected(groups);
  std::vector<std::pair<std::size_t, std::int32_t>> pairs;
  for (std::int32_t item = 0; item < 200; ++item)
  {
    const std::size_t group = random() % groups / 2 * 2;
    expected[group].push_back(item);
    pairs.emplace_back(group, item);
  }
  GroupedItems items;
  items.Set(groups,
    [&pairs](const auto& visit)
    {
      for (const auto& [group, item] : pairs)
      {
        visit(group, item);
      }
    });
  ASSERT_EQ(items.GetNumberOfGroups(), groups);
  for (std::size_t group = 0; group < groups; ++group)
  {
    EXPECT_EQ(ListGroup(items, group), expected[group]) << group;
    EXPECT_EQ(items.IsEmpty(group), expected[group].empty()) << group;
  }
}

/** Nothing remains of earlier contents. */
TEST(GroupedItems, MayBeNone)
{
  GroupedItems items;
  EXPECT_EQ(items.GetNumberOfGroups(), 0u);
  items.Set(3, [](const auto& visit) { visit(1, 5); });
  EXPECT_EQ(ListGroup(items, 1), std::vector<std::int32_t>{ 5 });
  items.Set(2, [](const auto&) {});
  EXPECT_EQ(items.GetNumberOfGroups(), 2u);
  EXPECT_TRUE(items.IsEmpty(0) && items.IsEmpty(1));
  items.Set(0, [](const auto&) {});
  EXPECT_EQ(items.GetNumberOfGroups(), 0u);
}
