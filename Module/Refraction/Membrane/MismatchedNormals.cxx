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

/**
 * The facets around some of the vertices. Those of all vertices are in one array, since memory for
 * each vertex would take longer than the rest of the work.
 */
class Fans
{
public:
  struct Fan
  {
    std::int32_t LastCorner = -1;
    double Rounding = 0.0; ///< largest error of a facet's normal, in radians
  };

  /** Adds a facet: its unit normal, the normal's error, and the vertices at its other corners. */
  void Add(std::int32_t vertex, const glm::dvec3& normal, double rounding,
    const std::array<std::int32_t, 2>& others)
  {
    Fan& fan = this->OfVertex[vertex];
    this->Corners.push_back({ normal, others, fan.LastCorner });
    fan.LastCorner = static_cast<std::int32_t>(this->Corners.size() - 1);
    fan.Rounding = std::max(fan.Rounding, rounding);
  }

  const std::unordered_map<std::int32_t, Fan>& List() const { return this->OfVertex; }

  /** Calls `visit(normal, others)` for each facet of a fan. */
  template <typename Visit>
  void ForEachFacet(const Fan& fan, const Visit& visit) const
  {
    for (std::int32_t i = fan.LastCorner; i >= 0;)
    {
      const Corner& corner = this->Corners[static_cast<std::size_t>(i)];
      visit(corner.Normal, corner.Others);
      i = corner.Previous;
    }
  }

  /** True if each neighbour is in two facets. */
  bool IsClosed(const Fan& fan) const
  {
    std::uint32_t all = 0;
    this->ForEachFacet(fan,
      [&all](const glm::dvec3&, const std::array<std::int32_t, 2>& others)
      { all ^= static_cast<std::uint32_t>(others[0]) ^ static_cast<std::uint32_t>(others[1]); });
    return all == 0;
  }

  /** Unit vector along the sum of the facets' normals; zero if they cancel out. */
  glm::dvec3 GetMean(const Fan& fan) const
  {
    glm::dvec3 sum(0.0);
    this->ForEachFacet(fan, [&sum](const glm::dvec3& facet, const auto&) { sum += facet; });
    const double length = glm::length(sum);
    return length > 0.0 ? sum / length : glm::dvec3(0.0);
  }

private:
  struct Corner
  {
    glm::dvec3 Normal;
    std::array<std::int32_t, 2> Others;
    std::int32_t Previous; ///< of the same fan; -1 for none
  };

  std::unordered_map<std::int32_t, Fan> OfVertex;
  std::vector<Corner> Corners;
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

/** Distance on the nearer side: normals define the eye's side, and facets need not agree with it.
 */
double DistanceOf(const glm::dvec3& normal, const glm::dvec3& other)
{
  return std::min(glm::length(normal - other), glm::length(normal + other));
}

bool IsForeign(const Fans& fans, const Fans::Fan& fan, const glm::dvec3& normal)
{
  const glm::dvec3 mean = fans.GetMean(fan);
  if (mean == glm::dvec3(0.0))
  {
    return false; // they cancel out: any normal is possible
  }
  double spread = 0.0;
  fans.ForEachFacet(fan,
    [&mean, &spread](const glm::dvec3& facet, const auto&)
    { spread = std::max(spread, glm::length(facet - mean)); });
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
    const bool wanted[3] = { isWanted(facet[0]), isWanted(facet[1]), isWanted(facet[2]) };
    if (!wanted[0] && !wanted[1] && !wanted[2])
    {
      continue;
    }
    const auto at = [&](std::size_t k) { return positions[static_cast<std::size_t>(facet[k])]; };
    const std::array<glm::dvec3, 3> corner{ at(0), at(1), at(2) };
    const glm::dvec3 area = glm::cross(corner[1] - corner[0], corner[2] - corner[0]);
    const glm::dvec3 normal = glm::normalize(area);
    const double rounding = RoundingOf(corner, glm::length(area), coordinate);
    for (std::size_t i = 0; i < 3; ++i)
    {
      if (wanted[i])
      {
        fans.Add(facet[i], normal, rounding, { facet[(i + 1) % 3], facet[(i + 2) % 3] });
      }
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
  const std::vector<glm::dvec3>& normals, std::int32_t vertex, const Fans& fans,
  const Fans::Fan& fan, const glm::dvec3& mean)
{
  glm::dvec3 sum(0.0);
  const auto fit = [&](const glm::dvec3& start)
  {
    NormalFit result(start);
    sum = glm::dvec3(0.0);
    const auto add = [&](std::int32_t corner)
    {
      const auto other = static_cast<std::size_t>(corner);
      result.Add(glm::normalize(positions[other] - positions[static_cast<std::size_t>(vertex)]),
        normals[other]);
      sum += glm::dot(normals[other], mean) < 0.0 ? -normals[other] : normals[other];
    };
    fans.ForEachFacet(fan,
      [&add](const glm::dvec3&, const std::array<std::int32_t, 2>& others)
      {
        add(others[0]);
        add(others[1]);
      });
    return result;
  };
  const NormalFit aboutFacets = fit(mean);
  const double length = glm::length(sum);
  return aboutFacets.IsDetermined() || !(length > 0.0) ? aboutFacets.Solve()
                                                       : fit(sum / length).Solve();
}

/**
 * Per vertex, true if its normal is turned by more than CreaseAngle against one of its facets;
 * empty if there is none.
 */
std::vector<bool> FindSuspects(const std::vector<glm::dvec3>& positions,
  const std::vector<Facet>& facets, const std::vector<glm::dvec3>& normals)
{
  const double smooth = std::cos(CreaseAngle);
  std::vector<bool> isSuspect;
  for (const Facet& facet : facets)
  {
    const auto at = [&](std::size_t k) { return positions[static_cast<std::size_t>(facet[k])]; };
    const glm::dvec3 area = glm::cross(at(1) - at(0), at(2) - at(0));
    const double least = smooth * smooth * glm::dot(area, area);
    for (const std::int32_t vertex : facet)
    {
      const double along = glm::dot(area, normals[static_cast<std::size_t>(vertex)]);
      if (along * along < least)
      {
        isSuspect.resize(normals.size(), false);
        isSuspect[static_cast<std::size_t>(vertex)] = true;
      }
    }
  }
  return isSuspect;
}

/**
 * True if vertices are more than half of those that facets surround, or of all that facets have if
 * none are surrounded.
 */
bool AreMost(const std::vector<std::int32_t>& some, const std::vector<Facet>& facets,
  std::size_t numberOfVertices)
{
  if (some.empty())
  {
    return false;
  }
  std::vector<bool> isUsed(numberOfVertices, false);
  // Exclusive or of the neighbours of each vertex: 0 if facets surround it.
  std::vector<std::uint32_t> border(numberOfVertices, 0);
  for (const Facet& facet : facets)
  {
    const std::uint32_t all = static_cast<std::uint32_t>(facet[0]) ^
      static_cast<std::uint32_t>(facet[1]) ^ static_cast<std::uint32_t>(facet[2]);
    for (const std::int32_t vertex : facet)
    {
      isUsed[static_cast<std::size_t>(vertex)] = true;
      border[static_cast<std::size_t>(vertex)] ^= all ^ static_cast<std::uint32_t>(vertex);
    }
  }
  std::size_t inside = 0;
  for (std::size_t i = 0; i < isUsed.size(); ++i)
  {
    inside += isUsed[i] && border[i] == 0 ? 1 : 0;
  }
  const auto someInside = static_cast<std::size_t>(std::count_if(some.begin(), some.end(),
    [&border](std::int32_t vertex) { return border[static_cast<std::size_t>(vertex)] == 0; }));
  const auto used = static_cast<std::size_t>(std::count(isUsed.begin(), isUsed.end(), true));
  return 2 * someInside > inside || (inside == 0 && 2 * some.size() > used);
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
  for (const auto& [vertex, fan] : fans.List())
  {
    if (fans.IsClosed(fan))
    {
      ++found.Examined;
      found.Foreign += IsForeign(fans, fan, normals[static_cast<std::size_t>(vertex)]) ? 1 : 0;
    }
  }
  return found;
}

//------------------------------------------------------------------------------
std::vector<std::int32_t> FindWildNormals(const std::vector<glm::dvec3>& positions,
  const std::vector<Facet>& facets, const std::vector<glm::dvec3>& normals, double coordinate)
{
  std::vector<std::int32_t> wild;
  const std::vector<bool> isSuspect = FindSuspects(positions, facets, normals);
  if (isSuspect.empty())
  {
    return wild;
  }
  const double most = 2.0 * std::sin(0.5 * CreaseAngle); // chord of the angle
  const Fans fans = CollectFans(positions, facets, coordinate,
    [&isSuspect](std::int32_t vertex) { return isSuspect[static_cast<std::size_t>(vertex)]; });
  for (const auto& [vertex, fan] : fans.List())
  {
    const glm::dvec3& normal = normals[static_cast<std::size_t>(vertex)];
    const glm::dvec3 mean = fans.GetMean(fan);
    if (IsForeign(fans, fan, normal) && DistanceOf(normal, mean) > most &&
      DistanceOf(normal, ContinueNormal(positions, normals, vertex, fans, fan, mean)) > most)
    {
      wild.push_back(vertex);
    }
  }
  if (AreMost(wild, facets, normals.size()))
  {
    wild.clear();
  }
  std::sort(wild.begin(), wild.end());
  return wild;
}

}
