// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Refraction/Membrane/MismatchedNormals.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <limits>
#include <unordered_map>

namespace meniscus
{
namespace
{

using Facet = std::array<std::int32_t, 3>;

/**
 * Approximate number of vertices that are examined: enough for a majority, at a negligible cost
 * compared to the other work for a moving membrane.
 */
constexpr std::size_t Sample = 64;

/** Data about a vertex from the facets around it. */
struct Fan
{
  std::vector<glm::dvec3> FacetNormals;
  std::uint32_t Neighbours = 0; ///< exclusive or of all neighbours: 0 if each is in two facets
  double Rounding = 0.0;        ///< largest error of a facet's normal, in radians
};

/**
 * True if a vertex is examined. A hash decides, since a stride would alias with vertices in rows.
 */
bool IsSampled(std::int32_t vertex, std::uint32_t limit)
{
  return static_cast<std::uint32_t>(vertex) * 2654435761U <= limit; // Knuth's multiplicative hash:
                                                                    // 2^32 over the golden ratio
}

/**
 * The corners in single precision have errors of sqrt(3) / 2 units in the last place of the largest
 * coordinate; two of them, divided by the smallest height, turn a facet by less than two such
 * units.
 */
double RoundingOf(const std::array<glm::dvec3, 3>& corner, double doubleArea, double coordinate)
{
  double longest = 0.0;
  for (std::size_t i = 0; i < 3; ++i)
  {
    longest = std::max(longest, glm::length(corner[(i + 1) % 3] - corner[i]));
  }
  const double height = doubleArea / longest;
  return 2.0 * static_cast<double>(std::numeric_limits<float>::epsilon()) * coordinate / height;
}

bool IsForeign(const Fan& fan, const glm::dvec3& normal)
{
  glm::dvec3 sum(0.0);
  for (const glm::dvec3& facet : fan.FacetNormals)
  {
    sum += facet;
  }
  const double length = glm::length(sum);
  if (!(length > 0.0))
  {
    return false; // they cancel out: any normal is possible
  }
  const glm::dvec3 mean = sum / length;
  double spread = 0.0;
  for (const glm::dvec3& facet : fan.FacetNormals)
  {
    spread = std::max(spread, glm::length(facet - mean));
  }
  // The nearer side counts: normals define the eye's side, and facets need not agree with it.
  const double off = std::min(glm::length(normal - mean), glm::length(normal + mean));
  return off > 2.0 * (spread + fan.Rounding);
}

}

//------------------------------------------------------------------------------
MismatchedNormals FindMismatchedNormals(const std::vector<glm::dvec3>& positions,
  const std::vector<Facet>& facets, const std::vector<glm::dvec3>& normals, double coordinate)
{
  constexpr std::uint32_t all = std::numeric_limits<std::uint32_t>::max();
  const std::uint32_t limit =
    positions.size() > Sample ? static_cast<std::uint32_t>(all / positions.size() * Sample) : all;
  std::unordered_map<std::int32_t, Fan> fans;
  fans.reserve(2 * Sample);
  for (const Facet& facet : facets)
  {
    for (std::size_t i = 0; i < 3; ++i)
    {
      if (!IsSampled(facet[i], limit))
      {
        continue;
      }
      const auto at = [&](std::size_t k) { return positions[static_cast<std::size_t>(facet[k])]; };
      const std::array<glm::dvec3, 3> corner{ at(0), at(1), at(2) };
      const glm::dvec3 area = glm::cross(corner[1] - corner[0], corner[2] - corner[0]);
      Fan& fan = fans[facet[i]];
      fan.FacetNormals.push_back(glm::normalize(area));
      fan.Neighbours ^= static_cast<std::uint32_t>(facet[(i + 1) % 3]) ^
        static_cast<std::uint32_t>(facet[(i + 2) % 3]);
      fan.Rounding = std::max(fan.Rounding, RoundingOf(corner, glm::length(area), coordinate));
    }
  }
  MismatchedNormals found;
  for (const auto& fan : fans)
  {
    if (fan.second.Neighbours == 0)
    {
      ++found.Examined;
      found.Foreign += IsForeign(fan.second, normals[static_cast<std::size_t>(fan.first)]) ? 1 : 0;
    }
  }
  return found;
}

}
