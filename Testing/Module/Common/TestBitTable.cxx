// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Common/BitTable.h"
#include "TestBasics.h"

#include <thread>

using namespace meniscus;

TEST(BitTable, HoldsOneValuePerItem)
{
  constexpr std::size_t count = 1000;
  BitTable table;
  std::vector<bool> expected(count, true);
  table.Assign(count, true);
  std::mt19937 random(3);
  for (int i = 0; i < 3000; ++i)
  {
    const std::size_t item = random() % count;
    const bool value = random() % 2 == 0;
    table.Set(item, value);
    expected[item] = value;
  }
  for (std::size_t i = 0; i < count; ++i)
  {
    EXPECT_EQ(table[i], expected[i]) << i;
  }
  table.Assign(count, false);
  for (std::size_t i = 0; i < count; ++i)
  {
    EXPECT_FALSE(table[i]) << i;
  }
}

TEST(BitTable, TakesOneBitPerItem)
{
  BitTable table;
  EXPECT_EQ(table.GetBytes(), 0);
  table.Assign(64000, true);
  EXPECT_EQ(table.GetBytes(), 8000);
  table.Assign(65, false);
  EXPECT_EQ(table.GetBytes(), 16);
}

TEST(BitTable, ThreadsMayWriteDifferentBlocks)
{
  constexpr std::size_t count = 4 * BlockSize;
  BitTable table;
  table.Assign(count, false);
  const RangeLoop onTwoThreads = [](std::size_t blocks, const auto& body)
  {
    // Neighbouring blocks at the same time.
    const auto work = [&](std::size_t first)
    {
      for (std::size_t block = first; block < blocks; block += 2)
      {
        body(block, block + 1);
      }
    };
    std::thread other(work, 1);
    work(0);
    other.join();
  };
  ForEachBlock(count, onTwoThreads,
    [&table](std::size_t, std::size_t first, std::size_t last)
    {
      for (std::size_t i = first; i < last; ++i)
      {
        table.Set(i, i % 3 == 0);
      }
    });
  for (std::size_t i = 0; i < count; ++i)
  {
    ASSERT_EQ(table[i], i % 3 == 0) << i;
  }
}

//------------------------------------------------------------------------------
TEST(BitTable, OneIsWithinAnotherItemByItem)
{
  constexpr std::size_t count = 130; // words, and a part of one
  BitTable few;
  BitTable many;
  few.Assign(count, false);
  many.Assign(count, false);
  EXPECT_TRUE(few.IsWithin(many));
  for (const std::size_t item : { std::size_t{ 0 }, std::size_t{ 64 }, count - 1 })
  {
    few.Set(item, true);
    EXPECT_FALSE(few.IsWithin(many)) << item;
    many.Set(item, true);
    EXPECT_TRUE(few.IsWithin(many)) << item;
  }
  many.Set(7, true);
  EXPECT_TRUE(few.IsWithin(many));
  EXPECT_FALSE(many.IsWithin(few));
}
