// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Twin: Rendering/glsl/vtkTetrahedraPreIntegrated.glsl (look-up in the table)
#include "Volume/Packet/Models/PacketSegmentTable.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace meniscus
{
namespace
{

/** A position between two samples. */
struct TablePlace
{
  std::int64_t Low;
  std::int64_t High;
  float Share;

  TablePlace(float at, std::int32_t size)
  {
    // A NaN is mapped to the first sample.
    const float last = static_cast<float>(size - 1);
    const float within = at > 0.0f ? std::min(at, last) : 0.0f;
    this->Low = static_cast<std::int64_t>(within);
    this->High = std::min<std::int64_t>(this->Low + 1, size - 1);
    this->Share = within - static_cast<float>(this->Low);
  }
};

using Quad = float[4];

void Mix(const Quad& a, const Quad& b, float share, Quad& result)
{
  for (int i = 0; i < 4; ++i)
  {
    result[i] = a[i] + share * (b[i] - a[i]);
  }
}

}

//------------------------------------------------------------------------------
void LookUpSegment(
  const PacketSegmentTable& table, float from, float to, float length, float (&mean)[4])
{
  // The lengths are 0, then a geometric sequence.
  const float relative = length * table.ShortestReciprocal;
  const float at = relative < 1.0f ? relative : 1.0f + table.LengthsPerOctave * std::log2(relative);
  const float scale = 0.5f * static_cast<float>(table.Scalars - 1);
  const TablePlace front(scale * (from + 1.0f), table.Scalars);
  const TablePlace back(scale * (to + 1.0f), table.Scalars);
  const TablePlace along(at, table.Lengths);
  const auto slice = [&](std::int64_t number, Quad& result)
  {
    const std::int64_t size = table.Scalars;
    const float* const first = table.Values + 4 * size * size * number;
    const auto row = [&](std::int64_t of, Quad& mixed)
    {
      const float* const values = first + 4 * size * of;
      Quad ends[2];
      std::copy_n(values + 4 * front.Low, 4, ends[0]);
      std::copy_n(values + 4 * front.High, 4, ends[1]);
      Mix(ends[0], ends[1], front.Share, mixed);
    };
    Quad low;
    Quad high;
    row(back.Low, low);
    row(back.High, high);
    Mix(low, high, back.Share, result);
  };
  slice(along.Low, mean);
  if (along.Share > 0.0f)
  {
    Quad longer;
    slice(along.High, longer);
    Mix(mean, longer, along.Share, mean);
  }
}

}
