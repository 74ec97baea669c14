// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Sorting of indices by codes.
#include "Common/CodeOrder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <vector>

using namespace meniscus;

TEST(CodeOrder, SortsStably)
{
  const std::vector<std::uint32_t> codes = { 5, 1u << 29, 5, 0, 40000 };
  std::vector<CodeKey> keys;
  for (std::size_t i = 0; i < codes.size(); ++i)
  {
    keys.push_back(MakeCodeKey(codes[i], i));
  }
  SortByCode(keys);
  std::vector<std::size_t> order;
  std::transform(keys.begin(), keys.end(), std::back_inserter(order), IndexOf);
  EXPECT_EQ(order, (std::vector<std::size_t>{ 3, 0, 2, 4, 1 }));
}
