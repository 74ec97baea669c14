// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Path of a ray in one tetrahedron in which the squared index of refraction is linear.
 *
 * With the ray parameter s of dx/ds = p and |p| = n, the ray equation is dp/ds = grad(n^2) / 2. The
 * gradient is constant, so that the path is the parabola x + p s + Force s^2 / 2, and each of the
 * four barycentric weights is a quadratic function of s.
 */
#ifndef meniscus_Volume_Graded_GradedCell_h
#define meniscus_Volume_Graded_GradedCell_h

#include "Volume/Mesh/TetrahedralMesh.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
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
  /** grad(n^2) / 2; 0 in a flat cell. */
  glm::dvec3 Force{ 0.0 };
  /** Squared length of the longest of the edges at the first vertex. */
  double SquaredSize = 0.0;
  /** The volume is 0 within the error of its computation: rays pass in no time. */
  bool IsFlat = false;
  /** The volume has another sign than the mesh's orientation: rays pass it backwards. */
  bool IsInverted = false;

  /** n^2 at barycentric weights. */
  double GetSquaredIndex(const std::array<double, 4>& weights) const
  {
    return (weights[0] * this->SquaredIndices[0] + weights[1] * this->SquaredIndices[1]) +
      (weights[2] * this->SquaredIndices[2] + weights[3] * this->SquaredIndices[3]);
  }
};

inline GradedCell MakeGradedCell(
  const TetrahedralMesh& mesh, const std::vector<double>& squaredIndices, std::int64_t cell)
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
  for (int i = 0; i < 4; ++i)
  {
    result.SquaredIndices[i] = squaredIndices[static_cast<std::size_t>(vertices[i])];
  }
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

#endif
