// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Refraction/Membrane/MembraneNormals.h"

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
#include <limits>

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

// A sum of k unit vectors with weights below pi each: if it is shorter than its own rounding error
// it has no direction. The constant allows for 16 facets around a vertex.
constexpr double CancellationRounding = 16.0 * std::numeric_limits<double>::epsilon();

glm::dvec3 ToVector(const OpenMesh::Vec3d& v)
{
  return { v[0], v[1], v[2] };
}

// Unit vector from one point to another, whose squared distance may be out of the range of double.
// The scale is a power of two, which changes no digit.
glm::dvec3 DirectionBetween(const glm::dvec3& from, const glm::dvec3& to)
{
  const glm::dvec3 away = to - from;
  const glm::dvec3 extent = glm::abs(away);
  const int exponent = std::ilogb(std::max({ extent.x, extent.y, extent.z }));
  return glm::normalize(glm::dvec3(std::scalbn(away.x, -exponent), std::scalbn(away.y, -exponent),
    std::scalbn(away.z, -exponent)));
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
  std::size_t NonManifoldFacets = 0;

  Mesh::VertexHandle AddVertex(const std::vector<glm::dvec3>& positions, std::size_t vertex)
  {
    const glm::dvec3& p = positions[vertex];
    this->Source.push_back(vertex);
    return this->Surface.add_vertex(Mesh::Point(p.x, p.y, p.z));
  }
};

void BuildTopology(Topology& topology, const std::vector<glm::dvec3>& positions,
  const std::vector<std::array<std::int32_t, 3>>& facets)
{
  const QuietOpenMesh quiet;
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
      ++topology.NonManifoldFacets;
      const auto own = [&topology, &positions, &facet](std::size_t i)
      { return topology.AddVertex(positions, static_cast<std::size_t>(facet[i])); };
      const Mesh::VertexHandle a = own(0);
      const Mesh::VertexHandle b = own(1);
      const Mesh::VertexHandle c = own(2);
      topology.Surface.add_face(a, b, c);
    }
  }
}

}

//------------------------------------------------------------------------------
std::size_t ComputeVertexNormals(const std::vector<glm::dvec3>& positions,
  const std::vector<std::array<std::int32_t, 3>>& facets, const std::vector<bool>& wanted,
  std::vector<glm::dvec3>& normals)
{
  Topology topology;
  BuildTopology(topology, positions, facets);

  std::vector<glm::dvec3> fallback(positions.size(), glm::dvec3(0.0));
  for (const Mesh::FaceHandle face : topology.Surface.faces())
  {
    std::array<std::size_t, 3> vertex{};
    std::array<glm::dvec3, 3> corner{};
    std::size_t count = 0;
    for (const Mesh::VertexHandle v : topology.Surface.fv_range(face))
    {
      vertex[count] = topology.Source[static_cast<std::size_t>(v.idx())];
      corner[count++] = ToVector(topology.Surface.point(v));
    }
    const glm::dvec3 unit = glm::normalize(
      glm::cross(DirectionBetween(corner[0], corner[1]), DirectionBetween(corner[0], corner[2])));
    for (std::size_t i = 0; i < 3; ++i)
    {
      if (wanted[vertex[i]])
      {
        const glm::dvec3 first = DirectionBetween(corner[i], corner[(i + 1) % 3]);
        const glm::dvec3 second = DirectionBetween(corner[i], corner[(i + 2) % 3]);
        const double angle =
          std::atan2(glm::length(glm::cross(first, second)), glm::dot(first, second));
        normals[vertex[i]] += angle * unit;
        if (fallback[vertex[i]] == glm::dvec3(0.0))
        {
          fallback[vertex[i]] = unit;
        }
      }
    }
  }
  for (std::size_t i = 0; i < normals.size(); ++i)
  {
    if (wanted[i])
    {
      normals[i] =
        glm::length(normals[i]) > CancellationRounding ? glm::normalize(normals[i]) : fallback[i];
    }
  }
  return topology.NonManifoldFacets;
}

}
