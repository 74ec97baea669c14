// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Refraction/Membrane/MembraneNormals.h"

#include "Refraction/Membrane/CoincidentEdges.h"
#include "Refraction/Membrane/NormalFit.h"

// OpenMesh fills new properties with default-constructed vectors, which it leaves uninitialised on
// purpose: gcc 12 warns at -O2 and above. All of them are set before they are read.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Core/System/omstream.hh>
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic pop
#endif

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <utility>

namespace meniscus
{
namespace
{

struct MeshTraits : OpenMesh::DefaultTraits
{
  using Point = OpenMesh::Vec3d;
  using Normal = OpenMesh::Vec3d;
};
using Mesh = OpenMesh::TriMesh_ArrayKernelT<MeshTraits>;

// A sum of vectors that is shorter than its own rounding error, relative to the sum of their
// lengths, has no direction. The constant allows for 16 facets around a vertex.
constexpr double CancellationRounding = 16.0 * std::numeric_limits<double>::epsilon();

glm::dvec3 ToVector(const OpenMesh::Vec3d& v)
{
  return { v[0], v[1], v[2] };
}

/** The vector times a power of two. */
glm::dvec3 Scale(const glm::dvec3& v, int exponent)
{
  constexpr int bias = std::numeric_limits<double>::max_exponent - 1;
  if (std::abs(exponent) < bias)
  {
    // The factor is a normal number: one product is rounded as std::scalbn() rounds.
    const std::uint64_t bits = static_cast<std::uint64_t>(bias + exponent)
      << (std::numeric_limits<double>::digits - 1);
    double factor;
    std::memcpy(&factor, &bits, sizeof(factor));
    return v * factor;
  }
  return { std::scalbn(v.x, exponent), std::scalbn(v.y, exponent), std::scalbn(v.z, exponent) };
}

/** Exponent of the largest component, which is not 0. */
int GetExponent(const glm::dvec3& v)
{
  const glm::dvec3 extent = glm::abs(v);
  return std::ilogb(std::max({ extent.x, extent.y, extent.z }));
}

/** Unit vector; one along an axis has no rounding error. */
glm::dvec3 Normalize(const glm::dvec3& v)
{
  return v / glm::length(v);
}

/**
 * Unit vector from one point to another, whose squared distance may be out of the range of double.
 * The scale is a power of two, which changes no digit.
 */
glm::dvec3 DirectionBetween(const glm::dvec3& from, const glm::dvec3& to)
{
  const glm::dvec3 away = to - from;
  return Normalize(Scale(away, -GetExponent(away)));
}

/** Normal of a facet in one of its corners, with the weight of N. Max; times 2^(-2 Exponent). */
struct WeightedNormal
{
  glm::dvec3 Normal;
  int Exponent; ///< of the facet's size
};

WeightedNormal WeighNormal(const glm::dvec3& corner, const glm::dvec3& next, const glm::dvec3& last)
{
  const int exponent = std::max(GetExponent(next - corner), GetExponent(last - corner));
  const glm::dvec3 first = Scale(next - corner, -exponent);
  const glm::dvec3 second = Scale(last - corner, -exponent);
  // The cross product comes first: it would lose its last digits to other roundings.
  return { glm::cross(first, second) / glm::dot(first, first) / glm::dot(second, second),
    exponent };
}

// Silences OpenMesh's message about every complex edge; complex edges are counted instead.
class QuietOpenMesh
{
public:
  QuietOpenMesh()
    : WasEnabled(omerr().is_enabled())
  {
    omerr().disable();
  }
  ~QuietOpenMesh()
  {
    if (this->WasEnabled)
    {
      omerr().enable();
    }
  }
  QuietOpenMesh(const QuietOpenMesh&) = delete;
  QuietOpenMesh& operator=(const QuietOpenMesh&) = delete;

private:
  bool WasEnabled;
};

/**
 * The half-edge mesh and, for each of its vertices, the vertex of the membrane that it represents.
 */
struct Topology
{
  Mesh Surface;
  std::vector<std::size_t> Source;
  std::vector<bool> IsComplex; ///< per vertex of the membrane: a facet has a copy of it

  Mesh::VertexHandle AddVertex(const std::vector<glm::dvec3>& positions, std::size_t vertex)
  {
    const glm::dvec3& p = positions[vertex];
    this->Source.push_back(vertex);
    return this->Surface.add_vertex(Mesh::Point(p.x, p.y, p.z));
  }
  std::size_t SourceOf(Mesh::VertexHandle vertex) const
  {
    return this->Source[static_cast<std::size_t>(vertex.idx())];
  }
  glm::dvec3 PointOf(Mesh::VertexHandle vertex) const
  {
    return ToVector(this->Surface.point(vertex));
  }
};

void BuildTopology(Topology& topology, const std::vector<glm::dvec3>& positions,
  const std::vector<std::array<std::int32_t, 3>>& facets)
{
  const QuietOpenMesh quiet;
  topology.IsComplex.assign(positions.size(), false);
  topology.Surface.reserve(positions.size(), positions.size() + facets.size(), facets.size());
  std::vector<Mesh::VertexHandle> handles(positions.size());
  for (const auto& facet : facets)
  {
    for (std::int32_t corner : facet)
    {
      const auto vertex = static_cast<std::size_t>(corner);
      if (!handles[vertex].is_valid())
      {
        handles[vertex] = topology.AddVertex(positions, vertex);
      }
    }
    const auto handle = [&handles, &facet](std::size_t i)
    { return handles[static_cast<std::size_t>(facet[i])]; };
    if (!topology.Surface.add_face(handle(0), handle(1), handle(2)).is_valid())
    {
      const auto own = [&topology, &positions, &facet](std::size_t i)
      {
        topology.IsComplex[static_cast<std::size_t>(facet[i])] = true;
        return topology.AddVertex(positions, static_cast<std::size_t>(facet[i]));
      };
      const Mesh::VertexHandle a = own(0);
      const Mesh::VertexHandle b = own(1);
      const Mesh::VertexHandle c = own(2);
      topology.Surface.add_face(a, b, c);
    }
  }
}

/** Calls `visit(vertex, normal)` for every corner of every facet. */
template <typename Visit>
void VisitCorners(const Topology& topology, const Visit& visit)
{
  for (const Mesh::FaceHandle face : topology.Surface.faces())
  {
    std::array<std::size_t, 3> vertex{};
    std::array<glm::dvec3, 3> corner{};
    std::size_t count = 0;
    for (const Mesh::VertexHandle v : topology.Surface.fv_range(face))
    {
      vertex[count] = topology.SourceOf(v);
      corner[count++] = topology.PointOf(v);
    }
    for (std::size_t i = 0; i < 3; ++i)
    {
      visit(vertex[i], WeighNormal(corner[i], corner[(i + 1) % 3], corner[(i + 2) % 3]));
    }
  }
}

/** Weighted sums of the facets' normals, of unit length. */
void AddFacetNormals(const Topology& topology, std::vector<glm::dvec3>& normals)
{
  // Facets around a vertex may differ in size by more than the range of double, squared.
  std::vector<int> least(normals.size(), std::numeric_limits<int>::max());
  VisitCorners(topology,
    [&least](std::size_t vertex, const WeightedNormal& facet)
    { least[vertex] = std::min(least[vertex], facet.Exponent); });
  std::vector<glm::dvec3> fallback(normals.size(), glm::dvec3(0.0));
  std::vector<double> weights(normals.size(), 0.0);
  VisitCorners(topology,
    [&](std::size_t vertex, const WeightedNormal& facet)
    {
      const glm::dvec3 normal = Scale(facet.Normal, 2 * (least[vertex] - facet.Exponent));
      normals[vertex] += normal;
      weights[vertex] += glm::length(normal);
      if (fallback[vertex] == glm::dvec3(0.0))
      {
        fallback[vertex] = Normalize(facet.Normal);
      }
    });
  for (std::size_t i = 0; i < normals.size(); ++i)
  {
    normals[i] = glm::length(normals[i]) > CancellationRounding * weights[i] ? Normalize(normals[i])
                                                                             : fallback[i];
  }
}

/**
 * Replaces the normals at borders, which the facets of one side give, by normals that continue
 * those of their neighbours. Vertices with two known neighbours in different directions
 * become known at the same time, then those next to them; others are turned as far as they are
 * determined.
 */
void ContinueNormals(const Topology& topology, std::vector<glm::dvec3>& normals)
{
  // A continued normal turns by half the angle between the normals on both sides of its neighbour,
  // which CreaseAngle limits.
  const double most = 2.0 * std::sin(0.25 * CreaseAngle);
  std::vector<Mesh::VertexHandle> open;
  std::vector<bool> isKnown(normals.size(), true);
  for (const Mesh::VertexHandle vertex : topology.Surface.vertices())
  {
    const std::size_t source = topology.SourceOf(vertex);
    if (!topology.IsComplex[source] && topology.Surface.is_boundary(vertex))
    {
      open.push_back(vertex);
      isKnown[source] = false;
    }
  }
  for (bool isLast = false; !open.empty() && !isLast;)
  {
    std::vector<Mesh::VertexHandle> rest;
    std::vector<std::pair<std::size_t, glm::dvec3>> found;
    const auto fit = [&](Mesh::VertexHandle vertex)
    {
      NormalFit result(normals[topology.SourceOf(vertex)]);
      for (const Mesh::VertexHandle other : topology.Surface.vv_range(vertex))
      {
        const std::size_t source = topology.SourceOf(other);
        if (isKnown[source])
        {
          result.Add(
            DirectionBetween(topology.PointOf(vertex), topology.PointOf(other)), normals[source]);
        }
      }
      return result;
    };
    for (const Mesh::VertexHandle vertex : open)
    {
      const NormalFit normal = fit(vertex);
      if (normal.IsDetermined())
      {
        found.emplace_back(topology.SourceOf(vertex), normal.Solve());
      }
      else
      {
        rest.push_back(vertex);
      }
    }
    isLast = found.empty();
    for (const Mesh::VertexHandle vertex : rest)
    {
      if (isLast)
      {
        found.emplace_back(topology.SourceOf(vertex), fit(vertex).Solve());
      }
    }
    for (const auto& [source, normal] : found)
    {
      normals[source] = glm::length(normal - normals[source]) <= most ? normal : normals[source];
      isKnown[source] = true;
    }
    open = std::move(rest);
  }
}

}

//------------------------------------------------------------------------------
void ComputeVertexNormals(const std::vector<glm::dvec3>& positions,
  const std::vector<std::array<std::int32_t, 3>>& facets, const std::vector<bool>& wanted,
  std::vector<glm::dvec3>& normals)
{
  Topology topology;
  BuildTopology(topology, positions, facets);
  std::vector<glm::dvec3> computed(normals.size(), glm::dvec3(0.0));
  AddFacetNormals(topology, computed);
  ContinueNormals(topology, computed);
  for (std::size_t i = 0; i < normals.size(); ++i)
  {
    normals[i] = wanted[i] ? computed[i] : normals[i];
  }
}

}
