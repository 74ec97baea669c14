// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Refraction/Membrane/MismatchedNormals.h"

#include "Refraction/Membrane/CoincidentEdges.h"
#include "Refraction/Membrane/NormalFit.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
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
  std::vector<std::int32_t> Corners; ///< the other two of each facet
  double Rounding = 0.0;             ///< largest error of a facet's normal, in radians

  /** True if each neighbour is in two facets. */
  bool IsClosed() const
  {
    std::uint32_t all = 0;
    for (const std::int32_t corner : this->Corners)
    {
      all ^= static_cast<std::uint32_t>(corner);
    }
    return all == 0;
  }

  /** Unit vector along the sum of the facets' normals; zero if they cancel out. */
  glm::dvec3 GetMean() const
  {
    glm::dvec3 sum(0.0);
    for (const glm::dvec3& facet : this->FacetNormals)
    {
      sum += facet;
    }
    const double length = glm::length(sum);
    return length > 0.0 ? sum / length : glm::dvec3(0.0);
  }
};

using Fans = std::unordered_map<std::int32_t, Fan>;

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

/** Distance on the nearer side: normals define the eye's side, and facets need not agree with it.
 */
double DistanceOf(const glm::dvec3& normal, const glm::dvec3& other)
{
  return std::min(glm::length(normal - other), glm::length(normal + other));
}

bool IsForeign(const Fan& fan, const glm::dvec3& normal)
{
  const glm::dvec3 mean = fan.GetMean();
  if (mean == glm::dvec3(0.0))
  {
    return false; // they cancel out: any normal is possible
  }
  double spread = 0.0;
  for (const glm::dvec3& facet : fan.FacetNormals)
  {
    spread = std::max(spread, glm::length(facet - mean));
  }
  return DistanceOf(normal, mean) > 2.0 * (spread + fan.Rounding);
}

/** Collects the facets around the vertices that `isWanted` accepts. */
template <typename IsWanted>
Fans CollectFans(const std::vector<glm::dvec3>& positions, const std::vector<Facet>& facets,
  double coordinate, const IsWanted& isWanted)
{
  Fans fans;
  for (const Facet& facet : facets)
  {
    for (std::size_t i = 0; i < 3; ++i)
    {
      if (!isWanted(facet[i]))
      {
        continue;
      }
      const auto at = [&](std::size_t k) { return positions[static_cast<std::size_t>(facet[k])]; };
      const std::array<glm::dvec3, 3> corner{ at(0), at(1), at(2) };
      const glm::dvec3 area = glm::cross(corner[1] - corner[0], corner[2] - corner[0]);
      Fan& fan = fans[facet[i]];
      fan.FacetNormals.push_back(glm::normalize(area));
      fan.Corners.insert(fan.Corners.end(), { facet[(i + 1) % 3], facet[(i + 2) % 3] });
      fan.Rounding = std::max(fan.Rounding, RoundingOf(corner, glm::length(area), coordinate));
    }
  }
  return fans;
}

/**
 * Normal that continues the normals of a vertex's neighbours. Neighbours in one line, as around the
 * corner of a sliver at a border, say nothing about the slope across it: their mean counts there,
 * not the facets, which may lean far from the surface.
 */
glm::dvec3 ContinueNormal(const std::vector<glm::dvec3>& positions,
  const std::vector<glm::dvec3>& normals, std::int32_t vertex, const Fan& fan,
  const glm::dvec3& mean)
{
  glm::dvec3 sum(0.0);
  const auto fit = [&](const glm::dvec3& start)
  {
    NormalFit result(start);
    sum = glm::dvec3(0.0);
    for (const std::int32_t corner : fan.Corners)
    {
      const auto other = static_cast<std::size_t>(corner);
      result.Add(glm::normalize(positions[other] - positions[static_cast<std::size_t>(vertex)]),
        normals[other]);
      sum += glm::dot(normals[other], mean) < 0.0 ? -normals[other] : normals[other];
    }
    return result;
  };
  const NormalFit aboutFacets = fit(mean);
  const double length = glm::length(sum);
  return aboutFacets.IsDetermined() || !(length > 0.0) ? aboutFacets.Solve()
                                                       : fit(sum / length).Solve();
}

}

//------------------------------------------------------------------------------
MismatchedNormals FindMismatchedNormals(const std::vector<glm::dvec3>& positions,
  const std::vector<Facet>& facets, const std::vector<glm::dvec3>& normals, double coordinate)
{
  constexpr std::uint32_t all = std::numeric_limits<std::uint32_t>::max();
  const std::uint32_t limit =
    positions.size() > Sample ? static_cast<std::uint32_t>(all / positions.size() * Sample) : all;
  const Fans fans = CollectFans(positions, facets, coordinate,
    [limit](std::int32_t vertex) { return IsSampled(vertex, limit); });
  MismatchedNormals found;
  for (const auto& fan : fans)
  {
    if (fan.second.IsClosed())
    {
      ++found.Examined;
      found.Foreign += IsForeign(fan.second, normals[static_cast<std::size_t>(fan.first)]) ? 1 : 0;
    }
  }
  return found;
}

//------------------------------------------------------------------------------
std::vector<std::int32_t> FindWildNormals(const std::vector<glm::dvec3>& positions,
  const std::vector<Facet>& facets, const std::vector<glm::dvec3>& normals, double coordinate)
{
  const double smooth = std::cos(CreaseAngle);
  const double most = 2.0 * std::sin(0.5 * CreaseAngle); // chord of the angle
  std::vector<bool> isUsed(normals.size(), false);
  // Exclusive or of the neighbours of each vertex: 0 if facets surround it.
  std::vector<std::uint32_t> border(normals.size(), 0);
  std::vector<bool> isSuspect(normals.size(), false);
  bool areSuspect = false;
  for (const Facet& facet : facets)
  {
    const auto at = [&](std::size_t k) { return positions[static_cast<std::size_t>(facet[k])]; };
    const glm::dvec3 area = glm::cross(at(1) - at(0), at(2) - at(0));
    const std::uint32_t others = static_cast<std::uint32_t>(facet[0]) ^
      static_cast<std::uint32_t>(facet[1]) ^ static_cast<std::uint32_t>(facet[2]);
    const double least = smooth * smooth * glm::dot(area, area);
    for (const std::int32_t vertex : facet)
    {
      const auto i = static_cast<std::size_t>(vertex);
      const double along = glm::dot(area, normals[i]);
      isUsed[i] = true;
      border[i] ^= others ^ static_cast<std::uint32_t>(vertex);
      if (along * along < least)
      {
        isSuspect[i] = areSuspect = true;
      }
    }
  }
  std::vector<std::int32_t> wild;
  if (!areSuspect)
  {
    return wild;
  }
  const Fans fans = CollectFans(positions, facets, coordinate,
    [&isSuspect](std::int32_t vertex) { return isSuspect[static_cast<std::size_t>(vertex)]; });
  for (const auto& [vertex, fan] : fans)
  {
    const glm::dvec3& normal = normals[static_cast<std::size_t>(vertex)];
    const glm::dvec3 mean = fan.GetMean();
    if (!IsForeign(fan, normal) || DistanceOf(normal, mean) <= most)
    {
      continue;
    }
    if (DistanceOf(normal, ContinueNormal(positions, normals, vertex, fan, mean)) > most)
    {
      wild.push_back(vertex);
    }
  }
  std::size_t inside = 0;
  std::size_t wildInside = 0;
  for (std::size_t i = 0; i < isUsed.size(); ++i)
  {
    inside += isUsed[i] && border[i] == 0 ? 1 : 0;
  }
  for (const std::int32_t vertex : wild)
  {
    wildInside += border[static_cast<std::size_t>(vertex)] == 0 ? 1 : 0;
  }
  const auto used = static_cast<std::size_t>(std::count(isUsed.begin(), isUsed.end(), true));
  if (2 * wildInside > inside || (inside == 0 && 2 * wild.size() > used))
  {
    wild.clear();
  }
  std::sort(wild.begin(), wild.end());
  return wild;
}

}
