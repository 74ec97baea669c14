// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Geometry and index of refraction of one tetrahedron.
 *
 * With the ray parameter s of dx/ds = p and |p| = n, the ray equation is dp/ds = grad(n^2) / 2, the
 * force. n^2 is linear or quadratic (QuadraticIndex.h); the force is constant or linear.
 */
#pragma once

#include "Volume/Graded/QuadraticIndex.h"
#include "Volume/Mesh/TetrahedralMesh.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace meniscus
{

/** Geometry and field of one cell, in units of the mesh's radius. */
struct GradedCell
{
  /**
   * Gradients of the barycentric weights. In a flat cell, they are multiplied by six times the
   * volume, which leaves the four normals, positive on the side that the mesh's orientation says.
   */
  std::array<glm::dvec3, 4> Gradients;
  /** n^2 at the vertices. */
  std::array<double, 4> SquaredIndices;
  /** grad(n^2) / 2 without the terms of the edges; 0 in a flat cell. */
  glm::dvec3 Force{ 0.0 };
  /** Terms of the edges; all 0 unless the cell is curved. */
  std::array<double, 6> Edges{};
  bool IsCurved = false;
  /** Squared length of the longest of the edges at the first vertex. */
  double SquaredSize = 0.0;
  /** The volume is 0 within the error of its computation: rays pass in no time. */
  bool IsFlat = false;
  /** The volume has another sign than the mesh's orientation: rays pass it backwards. */
  bool IsInverted = false;

  /** Sum over the edges at each vertex of their terms times the weight at the other end. */
  std::array<double, 4> ApplyEdges(const std::array<double, 4>& w) const
  {
    const auto& e = this->Edges;
    return { e[0] * w[1] + e[1] * w[2] + e[2] * w[3], e[0] * w[0] + e[3] * w[2] + e[4] * w[3],
      e[1] * w[0] + e[3] * w[1] + e[5] * w[3], e[2] * w[0] + e[4] * w[1] + e[5] * w[2] };
  }
  /** Sum of the gradients of the weights times factors. */
  glm::dvec3 AddGradients(const std::array<double, 4>& factors) const
  {
    return (factors[0] * this->Gradients[0] + factors[1] * this->Gradients[1]) +
      (factors[2] * this->Gradients[2] + factors[3] * this->Gradients[3]);
  }
  /** n^2 at barycentric weights. */
  double GetSquaredIndex(const std::array<double, 4>& w) const
  {
    const auto& f = this->SquaredIndices;
    const double linear = (w[0] * f[0] + w[1] * f[1]) + (w[2] * f[2] + w[3] * f[3]);
    if (!this->IsCurved)
    {
      return linear;
    }
    const auto products = this->ApplyEdges(w);
    return linear +
      0.5 * ((w[0] * products[0] + w[1] * products[1]) + (w[2] * products[2] + w[3] * products[3]));
  }
  /** Longest of the gradients: in a flat cell, the normal of its plane, or 0 if it has no area. */
  glm::dvec3 GetWidestNormal() const
  {
    glm::dvec3 widest = this->Gradients[0];
    for (const glm::dvec3& gradient : this->Gradients)
    {
      widest = glm::dot(gradient, gradient) > glm::dot(widest, widest) ? gradient : widest;
    }
    return widest;
  }
  /** Derivative of the force: a symmetric matrix. */
  glm::dmat3 GetForceDerivative() const
  {
    const auto& g = this->Gradients;
    glm::dmat3 result;
    for (int axis = 0; axis < 3; ++axis)
    {
      result[axis] = 0.5 *
        this->AddGradients(this->ApplyEdges({ g[0][axis], g[1][axis], g[2][axis], g[3][axis] }));
    }
    return result;
  }
  /** grad(n^2) / 2 at barycentric weights. */
  glm::dvec3 GetForce(const std::array<double, 4>& weights) const
  {
    return this->IsCurved && !this->IsFlat
      ? this->Force + 0.5 * this->AddGradients(this->ApplyEdges(weights))
      : this->Force;
  }
};

/**
 * Reads the field of a cell without its geometry, which suffices for GetSquaredIndex().
 * @param edgeTerms terms of all cells; null for a linear n^2.
 */
inline void ReadField(const TetrahedralMesh& mesh, const std::vector<double>& squaredIndices,
  const std::vector<EdgeTerms>* edgeTerms, std::int64_t cell, GradedCell& result)
{
  const auto& vertices = mesh.GetCells()[static_cast<std::size_t>(cell)].Vertices;
  for (std::size_t i = 0; i < vertices.size(); ++i)
  {
    result.SquaredIndices[i] = squaredIndices[static_cast<std::size_t>(vertices[i])];
  }
  for (std::size_t i = 0; edgeTerms && i < result.Edges.size(); ++i)
  {
    result.Edges[i] = (*edgeTerms)[static_cast<std::size_t>(cell)][i];
    result.IsCurved |= result.Edges[i] != 0.0;
  }
}

/** @param edgeTerms terms of all cells; null for a linear n^2. */
inline GradedCell MakeGradedCell(const TetrahedralMesh& mesh,
  const std::vector<double>& squaredIndices, const std::vector<EdgeTerms>* edgeTerms,
  std::int64_t cell)
{
  const auto& vertices = mesh.GetCells()[static_cast<std::size_t>(cell)].Vertices;
  const glm::dvec3 first = mesh.GetPosition(vertices[0]);
  const glm::dvec3 e1 = mesh.GetPosition(vertices[1]) - first;
  const glm::dvec3 e2 = mesh.GetPosition(vertices[2]) - first;
  const glm::dvec3 e3 = mesh.GetPosition(vertices[3]) - first;
  const glm::dvec3 normals[3] = { glm::cross(e2, e3), glm::cross(e3, e1), glm::cross(e1, e2) };
  const double volume = glm::dot(e1, normals[0]);
  const double lengths[3] = { glm::dot(e1, e1), glm::dot(e2, e2), glm::dot(e3, e3) };
  // Positions are integers of at most 31 bits times a power of two: edges are exact. Each of the
  // six terms of the determinant is rounded at most five times, by 2^-53: twice in products, once
  // in the difference, twice in sums. The sum of their sizes is at most 6 / sqrt(27) times the
  // product of the lengths (Carlen, Lieb and Loss 2006). Eight roundings cover the higher orders.
  constexpr double rounding = 4.0 * std::numeric_limits<double>::epsilon() * 1.1548;
  GradedCell result;
  result.SquaredSize = std::max(lengths[0], std::max(lengths[1], lengths[2]));
  result.IsFlat = !(volume * volume > rounding * rounding * (lengths[0] * lengths[1] * lengths[2]));
  const bool positive = mesh.IsPositivelyOriented(cell);
  const double scale = result.IsFlat ? (positive ? 1.0 : -1.0) : 1.0 / volume;
  result.IsInverted = !result.IsFlat && (volume > 0.0) != positive;
  ReadField(mesh, squaredIndices, edgeTerms, cell, result);
  for (int i = 0; i < 3; ++i)
  {
    result.Gradients[i + 1] = scale * normals[i];
    const double change = result.SquaredIndices[i + 1] - result.SquaredIndices[0];
    result.Force += 0.5 * change * result.Gradients[i + 1];
  }
  result.Gradients[0] = -(result.Gradients[1] + result.Gradients[2] + result.Gradients[3]);
  if (result.IsFlat)
  {
    result.Force = glm::dvec3(0.0);
  }
  return result;
}

/**
 * Smallest s >= 0 at which weight + rate s + curvature s^2 / 2 falls below 0; infinity if it never
 * does. Neither formula subtracts nearly equal numbers.
 * @pre weight >= 0
 */
inline double TimeToZero(double weight, double rate, double curvature)
{
  const double discriminant = rate * rate - 2.0 * weight * curvature;
  if (rate < 0.0)
  {
    // Without a root, a weight that bends upwards turns before it reaches 0.
    return discriminant >= 0.0 ? 2.0 * weight / (std::sqrt(discriminant) - rate)
                               : std::numeric_limits<double>::infinity();
  }
  return curvature < 0.0 ? (rate + std::sqrt(discriminant)) / -curvature
                         : std::numeric_limits<double>::infinity();
}

}
