// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace meniscus
{

/** Sets of numbers that are joined pair by pair; a set is named after its lowest number. */
class DisjointSets
{
public:
  /** Each of the numbers from 0 to `count` - 1 is a set at first. */
  explicit DisjointSets(std::size_t count)
    : Parents(count)
  {
    std::iota(this->Parents.begin(), this->Parents.end(), std::size_t{ 0 });
  }

  std::size_t Find(std::size_t number)
  {
    while (this->Parents[number] != number)
    {
      this->Parents[number] = this->Parents[this->Parents[number]];
      number = this->Parents[number];
    }
    return number;
  }

  /** Returns false if the two numbers were in one set before. */
  bool Join(std::size_t a, std::size_t b)
  {
    a = this->Find(a);
    b = this->Find(b);
    this->Parents[std::max(a, b)] = std::min(a, b);
    return a != b;
  }

private:
  std::vector<std::size_t> Parents;
};

}
