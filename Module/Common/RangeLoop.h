// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>

namespace meniscus
{

/**
 * Parallel loop over independent work, supplied by the caller: `loop(count, body)` calls
 * `body(begin, end)` for ranges that cover [0, count) once each, in any order and from any number
 * of threads.
 */
using RangeBody = std::function<void(std::size_t begin, std::size_t end)>;
using RangeLoop = std::function<void(std::size_t count, const RangeBody& body)>;

/** Runs the whole range at once on the calling thread. */
inline void SerialLoop(std::size_t count, const RangeBody& body)
{
  body(0, count);
}

/** Calls body(i) for each i in [0, count), in the ranges of `loop`. */
template <typename Body>
void ForEachItem(std::size_t count, const RangeLoop& loop, const Body& body)
{
  loop(count,
    [&body](std::size_t begin, std::size_t end)
    {
      for (std::size_t i = begin; i < end; ++i)
      {
        body(i);
      }
    });
}

}
