// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * One curved patch of the membrane over a facet with corners P_i and unit normals N_i, in
 * barycentric coordinates b_i of the facet:
 *
 *   n(b) = sum_i b_i N_i + 4 sum_ij b_i b_j m_ij                     (not normalised)
 *   q(b) = sum_ij b_i b_j (s_ij + d_ij (b_i - b_j))
 *   S(b) = sum_i b_i P_i + n / |n| * 2 q / (1 + |n|)
 *
 * m_ij bends the normal at the middle of an edge (CurvedPatches fits it). s and d follow from the
 * ends: the edge, a cubic, meets both normals at right angles. All of it belongs to an edge and its
 * two ends alone, so patches that share an edge share its points and its normals.
 *
 * Planes and spheres are reproduced exactly. On a sphere of centre C and radius R with the normals
 * N = (C - P) / R, m is 0 and n = (C - L) / R at the flat point L, so that |n|^2 = 1 + 2 q / R and
 * S = L + n / |n| R (|n| - 1) = C - R n / |n|.
 */
#ifndef meniscus_Refraction_Membrane_CurvedPatch_h
#define meniscus_Refraction_Membrane_CurvedPatch_h

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace meniscus
{

/// A point of a patch and its normal, which is not normalised.
struct PatchPoint
{
  glm::dvec3 position;
  glm::dvec3 normal;
};

/// The same with derivatives by the second and the third barycentric coordinate.
struct PatchJet : PatchPoint
{
  glm::dvec3 positionBy[2];
  glm::dvec3 normalBy[2];
};

/// Edge k is opposite to corner k; it runs from corner k + 1 to corner k + 2.
struct CurvedPatch
{
  /// Shorter normals have no direction to rely on; lengths below it are raised to it.
  static constexpr double ShortestNormal = 0.25;

  glm::dvec3 corner[3];
  glm::dvec3 normal[3];
  glm::dvec3 bend[3];   ///< 4 m
  double symmetric[3];  ///< s, 0 on a straight edge
  double asymmetric[3]; ///< d

  /// Sets s and d of edge k from its ends.
  void FitEdge(int k)
  {
    const int i = (k + 1) % 3;
    const int j = (k + 2) % 3;
    const glm::dvec3 edge = this->corner[j] - this->corner[i];
    const double first = glm::dot(edge, this->normal[i]);
    const double second = glm::dot(edge, this->normal[j]);
    this->symmetric[k] = 0.5 * (second - first);
    this->asymmetric[k] = -0.5 * (second + first);
  }

  glm::dvec3 GetFlatPoint(const glm::dvec2& b) const
  {
    return (1.0 - b.x - b.y) * this->corner[0] + b.x * this->corner[1] + b.y * this->corner[2];
  }

  /// Not normalised.
  glm::dvec3 GetNormal(const glm::dvec2& b) const
  {
    const double c = 1.0 - b.x - b.y;
    return c * this->normal[0] + b.x * this->normal[1] + b.y * this->normal[2] +
      b.x * b.y * this->bend[0] + b.y * c * this->bend[1] + c * b.x * this->bend[2];
  }

  PatchPoint Evaluate(const glm::dvec2& b) const
  {
    const double c = 1.0 - b.x - b.y;
    const double bc[3] = { b.x * b.y, b.y * c, c * b.x };
    PatchPoint result;
    result.normal = this->GetNormal(b);
    const double q = bc[0] * (this->symmetric[0] + this->asymmetric[0] * (b.x - b.y)) +
      bc[1] * (this->symmetric[1] + this->asymmetric[1] * (b.y - c)) +
      bc[2] * (this->symmetric[2] + this->asymmetric[2] * (c - b.x));
    const double length = std::max(glm::length(result.normal), ShortestNormal);
    result.position = this->GetFlatPoint(b) + (2.0 * q / (length * (1.0 + length))) * result.normal;
    return result;
  }

  /// The point of edge k with the weights of its ends: the same bit by bit in both patches that
  /// share the edge, and the same as Evaluate where the weights are exact.
  PatchPoint EvaluateEdge(int k, double first, double second) const
  {
    const int i = (k + 1) % 3;
    const int j = (k + 2) % 3;
    const double product = first * second;
    PatchPoint result;
    result.normal = first * this->normal[i] + second * this->normal[j] + product * this->bend[k];
    const double q = product * (this->symmetric[k] + this->asymmetric[k] * (first - second));
    const double length = std::max(glm::length(result.normal), ShortestNormal);
    result.position = first * this->corner[i] + second * this->corner[j] +
      (2.0 * q / (length * (1.0 + length))) * result.normal;
    return result;
  }

  void Evaluate(const glm::dvec2& b, PatchJet& jet) const
  {
    const double c = 1.0 - b.x - b.y;
    const double bc[3] = { b.x * b.y, b.y * c, c * b.x };
    jet.normal = c * this->normal[0] + b.x * this->normal[1] + b.y * this->normal[2] +
      bc[0] * this->bend[0] + bc[1] * this->bend[1] + bc[2] * this->bend[2];
    jet.normalBy[0] = this->normal[1] - this->normal[0] + b.y * (this->bend[0] - this->bend[1]) +
      (c - b.x) * this->bend[2];
    jet.normalBy[1] = this->normal[2] - this->normal[0] + b.x * (this->bend[0] - this->bend[2]) +
      (c - b.y) * this->bend[1];

    const double form[3] = { this->symmetric[0] + this->asymmetric[0] * (b.x - b.y),
      this->symmetric[1] + this->asymmetric[1] * (b.y - c),
      this->symmetric[2] + this->asymmetric[2] * (c - b.x) };
    const double q = bc[0] * form[0] + bc[1] * form[1] + bc[2] * form[2];
    const double qBy[2] = { b.y * (form[0] - form[1]) + (c - b.x) * form[2] +
        bc[0] * this->asymmetric[0] + bc[1] * this->asymmetric[1] -
        2.0 * bc[2] * this->asymmetric[2],
      b.x * (form[0] - form[2]) + (c - b.y) * form[1] - bc[0] * this->asymmetric[0] +
        2.0 * bc[1] * this->asymmetric[1] - bc[2] * this->asymmetric[2] };

    const double length = std::max(glm::length(jet.normal), ShortestNormal);
    const double product = length * (1.0 + length);
    const double inverse = 1.0 / product;
    const double factor = 2.0 * inverse;
    const double shift = q * factor;
    // d factor = -factor (1 + 2 length) / product dlength, dlength = n.dn / length.
    const double byLength = -shift * (1.0 + 2.0 * length) * inverse * (1.0 + length) * inverse;
    jet.position = this->GetFlatPoint(b) + shift * jet.normal;
    for (int k = 0; k < 2; ++k)
    {
      const double shiftBy = factor * qBy[k] + byLength * glm::dot(jet.normal, jet.normalBy[k]);
      jet.positionBy[k] =
        this->corner[k + 1] - this->corner[0] + shiftBy * jet.normal + shift * jet.normalBy[k];
    }
  }
};

/// How far outside its facet a point is: the smallest barycentric coordinate and its corner.
struct Outside
{
  double least;
  int corner;
};

inline Outside FindOutside(const glm::dvec2& b)
{
  Outside result{ 1.0 - b.x - b.y, 0 };
  if (b.x < result.least)
  {
    result = { b.x, 1 };
  }
  if (b.y < result.least)
  {
    result = { b.y, 2 };
  }
  return result;
}

}

#endif
