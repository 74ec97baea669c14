// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Common/RangeLoop.h"

#include <algorithm>
#include <cstddef>

namespace meniscus
{

/**
 * Number of items in a block. It leaves many blocks for each thread of any machine, each with tens
 * of microseconds of work.
 */
constexpr std::size_t BlockSize = 8192;

inline std::size_t NumberOfBlocks(std::size_t count)
{
  return (count + BlockSize - 1) / BlockSize;
}

/**
 * Calls body(block, first, last) for blocks that cover [0, count). The blocks do not depend on the
 * number of threads, so neither does a result that is assembled from them in order.
 */
template <typename Body>
void ForEachBlock(std::size_t count, const RangeLoop& loop, Body&& body)
{
  loop(NumberOfBlocks(count),
    [&body, count](std::size_t firstBlock, std::size_t lastBlock)
    {
      for (std::size_t block = firstBlock; block < lastBlock; ++block)
      {
        body(block, block * BlockSize, std::min(count, (block + 1) * BlockSize));
      }
    });
}

/** Calls body(i) for each i in [0, count), in the blocks of ForEachBlock(). */
template <typename Body>
void ForEachInBlocks(std::size_t count, const RangeLoop& loop, const Body& body)
{
  ForEachBlock(count, loop,
    [&body](std::size_t, std::size_t first, std::size_t last)
    {
      for (std::size_t i = first; i < last; ++i)
      {
        body(i);
      }
    });
}

}
