// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Refraction/Membrane/CoincidentEdges.h"

#include "Common/DisjointSets.h"
#include "Common/PointOrder.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace meniscus
{
namespace
{

using Facet = std::array<std::int32_t, 3>;

/** An edge at the border, from the place First to the place Second, with First < Second. */
struct PlacedEdge
{
  std::int32_t First;
  std::int32_t Second;
  std::array<std::int32_t, 2> Vertex; ///< at First and at Second
  std::int32_t Opposite;              ///< third corner of the facet

  bool IsAtPlaceOf(const PlacedEdge& other) const
  {
    return this->First == other.First && this->Second == other.Second;
  }
};

/** Numbers of the different places of vertices. */
class Places
{
public:
  Places(const std::vector<glm::dvec3>& positions, std::vector<std::int32_t> vertices)
    : Of(positions.size(), -1)
  {
    const auto at = [&positions](std::int32_t vertex) -> const glm::dvec3&
    { return positions[static_cast<std::size_t>(vertex)]; };
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    std::sort(vertices.begin(), vertices.end(),
      [&at](std::int32_t a, std::int32_t b) { return IsBefore(at(a), at(b)); });
    std::int32_t count = 0;
    for (std::size_t i = 0; i < vertices.size(); ++i)
    {
      count += i > 0 && at(vertices[i]) != at(vertices[i - 1]) ? 1 : 0;
      this->Of[static_cast<std::size_t>(vertices[i])] = count;
    }
    this->HasShared = !vertices.empty() && static_cast<std::size_t>(count) + 1 < vertices.size();
  }

  /** True if two vertices are at the same place. */
  bool HasShared = false;
  std::vector<std::int32_t> Of; ///< per vertex
};

std::vector<PlacedEdge> ListEdges(
  const std::vector<SurfaceEdge>& borders, const std::vector<std::int32_t>& places)
{
  std::vector<PlacedEdge> edges;
  edges.reserve(borders.size());
  for (const SurfaceEdge& border : borders)
  {
    std::array<std::int32_t, 2> vertex = border.Ends;
    if (places[static_cast<std::size_t>(vertex[0])] > places[static_cast<std::size_t>(vertex[1])])
    {
      std::swap(vertex[0], vertex[1]);
    }
    edges.push_back({ places[static_cast<std::size_t>(vertex[0])],
      places[static_cast<std::size_t>(vertex[1])], vertex, border.Opposite });
  }
  std::stable_sort(edges.begin(), edges.end(),
    [](const PlacedEdge& a, const PlacedEdge& b)
    { return a.First != b.First ? a.First < b.First : a.Second < b.Second; });
  return edges;
}

/** Component of `vector` across the unit vector `along`, of unit length. */
glm::dvec3 Across(const glm::dvec3& vector, const glm::dvec3& along)
{
  return glm::normalize(vector - glm::dot(vector, along) * along);
}

/** Cosine of the angle by which two facets are turned against a plane, for any winding. */
double GetFold(const std::vector<glm::dvec3>& positions, const PlacedEdge& a, const PlacedEdge& b)
{
  const auto at = [&positions](std::int32_t vertex) -> const glm::dvec3&
  { return positions[static_cast<std::size_t>(vertex)]; };
  const glm::dvec3& start = at(a.Vertex[0]);
  const glm::dvec3 along = glm::normalize(at(a.Vertex[1]) - start);
  return -glm::dot(Across(at(a.Opposite) - start, along), Across(at(b.Opposite) - start, along));
}

/** Replaces the vertices of the facets by the first of their set. Returns it for each vertex. */
std::vector<std::int32_t> ReplaceJoined(
  DisjointSets& joined, std::size_t vertices, std::vector<Facet>& facets)
{
  std::vector<std::int32_t> target(vertices);
  for (std::size_t i = 0; i < target.size(); ++i)
  {
    target[i] = static_cast<std::int32_t>(joined.Find(i));
  }
  for (Facet& facet : facets)
  {
    for (std::int32_t& vertex : facet)
    {
      vertex = target[static_cast<std::size_t>(vertex)];
    }
  }
  return target;
}

}

//------------------------------------------------------------------------------
std::vector<std::int32_t> JoinCoincidentEdges(const std::vector<glm::dvec3>& positions,
  const std::vector<SurfaceEdge>& borders, const std::vector<glm::dvec3>& normals,
  std::vector<Facet>& facets)
{
  std::vector<std::int32_t> ends;
  ends.reserve(2 * borders.size());
  for (const SurfaceEdge& border : borders)
  {
    ends.insert(ends.end(), border.Ends.begin(), border.Ends.end());
  }
  const Places places(positions, std::move(ends));
  if (!places.HasShared)
  {
    return {};
  }
  const std::vector<PlacedEdge> edges = ListEdges(borders, places.Of);
  const double smooth = std::cos(CreaseAngle);
  DisjointSets joined(positions.size());
  bool hasJoined = false;
  for (std::size_t i = 0, next = 0; i < edges.size(); i = next)
  {
    next = i + 1;
    while (next < edges.size() && edges[next].IsAtPlaceOf(edges[i]))
    {
      ++next;
    }
    if (next != i + 2)
    {
      continue;
    }
    const PlacedEdge& a = edges[i];
    const PlacedEdge& b = edges[i + 1];
    const double fold = GetFold(positions, a, b);
    for (std::size_t end = 0; end < 2; ++end)
    {
      const glm::dvec3& first = normals[static_cast<std::size_t>(a.Vertex[end])];
      const glm::dvec3& second = normals[static_cast<std::size_t>(b.Vertex[end])];
      const bool areGiven = first != glm::dvec3(0.0) && second != glm::dvec3(0.0);
      if (areGiven ? fold > 0.0 && glm::dot(first, second) >= smooth : fold >= smooth)
      {
        hasJoined = joined.Join(static_cast<std::size_t>(a.Vertex[end]),
                      static_cast<std::size_t>(b.Vertex[end])) ||
          hasJoined;
      }
    }
  }
  return hasJoined ? ReplaceJoined(joined, positions.size(), facets) : std::vector<std::int32_t>();
}

}
