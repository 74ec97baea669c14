// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Volume_MortonOrder_h
#define meniscus_Volume_MortonOrder_h

#include <glm/vec3.hpp>

#include <cstdint>
#include <vector>

namespace meniscus
{

/** Maps positions in a box to 30-bit Morton codes, 10 bits an axis. */
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

/** The permutation that sorts `codes` (at most 30 bits used) in ascending order, stably. */
std::vector<std::int64_t> SortedOrder(const std::vector<std::uint32_t>& codes);

}

#endif
