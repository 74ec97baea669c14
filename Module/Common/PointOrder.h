// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * A total order of points. Ends of edges are taken in this order where two cells or facets that
 * share an edge must calculate the same, bit by bit.
 */
#pragma once

#include <glm/vec3.hpp>

#include <tuple>

namespace meniscus
{

/** True if `a` comes before `b`: by x, at equal x by y, then by z. */
inline bool IsBefore(const glm::dvec3& a, const glm::dvec3& b)
{
  return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
}

}
