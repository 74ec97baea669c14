// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Common/CodeOrder.h"

#include <algorithm>

namespace meniscus
{
namespace
{

constexpr int RadixBits = 10;
constexpr std::size_t RadixSize = std::size_t{ 1 } << RadixBits;
/** Number of keys per histogram; many times RadixSize, so that the histograms are cheap. */
constexpr std::size_t Chunk = 32768;

std::size_t Digit(CodeKey key, int shift)
{
  return (key >> shift) & (RadixSize - 1);
}

/** One stable counting pass over the digit at `shift`. */
void RadixPass(const std::vector<CodeKey>& from, int shift, const RangeLoop& loop,
  std::vector<std::size_t>& starts, std::vector<CodeKey>& to)
{
  const std::size_t chunks = (from.size() + Chunk - 1) / Chunk;
  starts.assign(chunks * RadixSize, 0);
  const auto forEachKey = [&](std::size_t first, std::size_t last, auto&& body)
  {
    for (std::size_t chunk = first; chunk < last; ++chunk)
    {
      std::size_t* const ofChunk = starts.data() + chunk * RadixSize;
      const std::size_t end = std::min(from.size(), (chunk + 1) * Chunk);
      for (std::size_t i = chunk * Chunk; i < end; ++i)
      {
        body(ofChunk[Digit(from[i], shift)], from[i]);
      }
    }
  };
  loop(chunks,
    [&](std::size_t first, std::size_t last)
    { forEachKey(first, last, [](std::size_t& count, CodeKey) { ++count; }); });
  std::size_t next = 0;
  for (std::size_t digit = 0; digit < RadixSize; ++digit)
  {
    for (std::size_t chunk = 0; chunk < chunks; ++chunk)
    {
      const std::size_t count = starts[chunk * RadixSize + digit];
      starts[chunk * RadixSize + digit] = next;
      next += count;
    }
  }
  loop(chunks,
    [&](std::size_t first, std::size_t last)
    { forEachKey(first, last, [&to](std::size_t& at, CodeKey key) { to[at++] = key; }); });
}

}

//------------------------------------------------------------------------------
void SortByCode(std::vector<CodeKey>& keys, const RangeLoop& loop)
{
  std::vector<CodeKey> scratch(keys.size());
  std::vector<std::size_t> starts;
  for (int shift = 32; shift < 62; shift += RadixBits)
  {
    RadixPass(keys, shift, loop, starts, scratch);
    keys.swap(scratch);
  }
}

}
