// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Common/RangeLoop.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace meniscus
{

/** Maps positions in a box to 30-bit Morton codes with 10 bits per axis. */
class MortonCurve
{
public:
  /** The box may be flat in any direction. */
  MortonCurve(const glm::dvec3& lower, const glm::dvec3& upper);

  std::uint32_t Code(const glm::dvec3& position) const;

private:
  glm::dvec3 Lower;
  glm::dvec3 Scale;
};

/**
 * Morton code of integers within +-2^(bits - 1): 30 bits, from the 10 uppermost bits of each axis.
 */
std::uint32_t MortonCode(const std::int64_t position[3], int bits);

/** A Morton code in the upper 32 bits and an index in the lower 32. */
using MortonKey = std::uint64_t;

inline MortonKey MakeMortonKey(std::uint32_t code, std::size_t index)
{
  return (MortonKey{ code } << 32) | static_cast<std::uint32_t>(index);
}

inline std::size_t IndexOf(MortonKey key)
{
  return static_cast<std::uint32_t>(key);
}

/** Sorts keys by their codes (30 bits), stably. */
void SortByCode(std::vector<MortonKey>& keys, const RangeLoop& loop = SerialLoop);

}
