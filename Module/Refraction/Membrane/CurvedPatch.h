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
 * m_ij is the deviation of the normal from linear interpolation at the middle of an edge (fitted by
 * CurvedPatches). s and d follow from the ends: the edge is a cubic at right angles to both
 * normals. These coefficients depend on the edge and its two ends alone, so patches that share an
 * edge share its points and its normals.
 *
 * Planes and spheres are reproduced exactly. On a sphere of centre C and radius R with the normals
 * N = (C - P) / R, m is 0 and n = (C - L) / R at the flat point L, so that |n|^2 = 1 + 2 q / R and
 * S = L + n / |n| R (|n| - 1) = C - R n / |n|.
 */
#pragma once

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace meniscus
{

/** A point of a patch and its normal, which is not normalised. */
struct PatchPoint
{
  glm::dvec3 Position;
  glm::dvec3 Normal;
};

/** A point of a patch with derivatives by the second and the third barycentric coordinate. */
struct PatchJet : PatchPoint
{
  glm::dvec3 PositionBy[2];
  glm::dvec3 NormalBy[2];
};

/** One patch. Edge k is opposite corner k; it runs from corner k + 1 to corner k + 2. */
struct CurvedPatch
{
  /** Smallest length that is used for a normal: shorter normals have no reliable direction. */
  static constexpr double ShortestNormal = 0.25;

  glm::dvec3 Corner[3];
  glm::dvec3 Normal[3];
  glm::dvec3 Bend[3];   ///< 4 m
  double Symmetric[3];  ///< s, 0 on a straight edge
  double Asymmetric[3]; ///< d

  /** Sets s and d of edge k from its ends. */
  void FitEdge(int k)
  {
    const int i = (k + 1) % 3;
    const int j = (k + 2) % 3;
    const glm::dvec3 edge = this->Corner[j] - this->Corner[i];
    const double first = glm::dot(edge, this->Normal[i]);
    const double second = glm::dot(edge, this->Normal[j]);
    this->Symmetric[k] = 0.5 * (second - first);
    this->Asymmetric[k] = -0.5 * (second + first);
  }

  glm::dvec3 GetFlatPoint(const glm::dvec2& b) const
  {
    return (1.0 - b.x - b.y) * this->Corner[0] + b.x * this->Corner[1] + b.y * this->Corner[2];
  }

  /** Barycentric coordinates of the foot of `point` in the facet's plane. */
  glm::dvec2 ProjectToFacet(const glm::dvec3& point) const
  {
    const glm::dvec3 u = this->Corner[1] - this->Corner[0];
    const glm::dvec3 v = this->Corner[2] - this->Corner[0];
    const glm::dvec3 w = point - this->Corner[0];
    const glm::dvec3 normal = glm::cross(u, v);
    const double squared = glm::dot(normal, normal);
    return { glm::dot(glm::cross(w, v), normal) / squared,
      glm::dot(glm::cross(u, w), normal) / squared };
  }

  /** Length of the facet's longest edge. */
  double GetSize() const
  {
    const auto squared = [this](int i, int j)
    {
      const glm::dvec3 edge = this->Corner[j] - this->Corner[i];
      return glm::dot(edge, edge);
    };
    return std::sqrt(std::max({ squared(0, 1), squared(1, 2), squared(2, 0) }));
  }

  /** Normal at `b`, not normalised. */
  glm::dvec3 GetNormal(const glm::dvec2& b) const
  {
    const double c = 1.0 - b.x - b.y;
    return c * this->Normal[0] + b.x * this->Normal[1] + b.y * this->Normal[2] +
      b.x * b.y * this->Bend[0] + b.y * c * this->Bend[1] + c * b.x * this->Bend[2];
  }

  PatchPoint Evaluate(const glm::dvec2& b) const
  {
    const double c = 1.0 - b.x - b.y;
    const double bc[3] = { b.x * b.y, b.y * c, c * b.x };
    PatchPoint result;
    result.Normal = this->GetNormal(b);
    const double q = bc[0] * (this->Symmetric[0] + this->Asymmetric[0] * (b.x - b.y)) +
      bc[1] * (this->Symmetric[1] + this->Asymmetric[1] * (b.y - c)) +
      bc[2] * (this->Symmetric[2] + this->Asymmetric[2] * (c - b.x));
    const double length = std::max(glm::length(result.Normal), ShortestNormal);
    result.Position = this->GetFlatPoint(b) + (2.0 * q / (length * (1.0 + length))) * result.Normal;
    return result;
  }

  /**
   * Point of edge k with the given weights of its ends: the same bit by bit in both patches that
   * share the edge, and the same as Evaluate where the weights are exact.
   */
  PatchPoint EvaluateEdge(int k, double first, double second) const
  {
    const int i = (k + 1) % 3;
    const int j = (k + 2) % 3;
    const double product = first * second;
    PatchPoint result;
    result.Normal = first * this->Normal[i] + second * this->Normal[j] + product * this->Bend[k];
    const double q = product * (this->Symmetric[k] + this->Asymmetric[k] * (first - second));
    const double length = std::max(glm::length(result.Normal), ShortestNormal);
    result.Position = first * this->Corner[i] + second * this->Corner[j] +
      (2.0 * q / (length * (1.0 + length))) * result.Normal;
    return result;
  }

  void Evaluate(const glm::dvec2& b, PatchJet& jet) const
  {
    const double c = 1.0 - b.x - b.y;
    const double bc[3] = { b.x * b.y, b.y * c, c * b.x };
    jet.Normal = c * this->Normal[0] + b.x * this->Normal[1] + b.y * this->Normal[2] +
      bc[0] * this->Bend[0] + bc[1] * this->Bend[1] + bc[2] * this->Bend[2];
    jet.NormalBy[0] = this->Normal[1] - this->Normal[0] + b.y * (this->Bend[0] - this->Bend[1]) +
      (c - b.x) * this->Bend[2];
    jet.NormalBy[1] = this->Normal[2] - this->Normal[0] + b.x * (this->Bend[0] - this->Bend[2]) +
      (c - b.y) * this->Bend[1];

    const double form[3] = { this->Symmetric[0] + this->Asymmetric[0] * (b.x - b.y),
      this->Symmetric[1] + this->Asymmetric[1] * (b.y - c),
      this->Symmetric[2] + this->Asymmetric[2] * (c - b.x) };
    const double q = bc[0] * form[0] + bc[1] * form[1] + bc[2] * form[2];
    const double qBy[2] = { b.y * (form[0] - form[1]) + (c - b.x) * form[2] +
        bc[0] * this->Asymmetric[0] + bc[1] * this->Asymmetric[1] -
        2.0 * bc[2] * this->Asymmetric[2],
      b.x * (form[0] - form[2]) + (c - b.y) * form[1] - bc[0] * this->Asymmetric[0] +
        2.0 * bc[1] * this->Asymmetric[1] - bc[2] * this->Asymmetric[2] };

    const double length = std::max(glm::length(jet.Normal), ShortestNormal);
    const double product = length * (1.0 + length);
    const double inverse = 1.0 / product;
    const double factor = 2.0 * inverse;
    const double shift = q * factor;
    // d factor = -factor (1 + 2 length) / product dlength, dlength = n.dn / length.
    const double byLength = -shift * (1.0 + 2.0 * length) * inverse * (1.0 + length) * inverse;
    jet.Position = this->GetFlatPoint(b) + shift * jet.Normal;
    for (int k = 0; k < 2; ++k)
    {
      const double shiftBy = factor * qBy[k] + byLength * glm::dot(jet.Normal, jet.NormalBy[k]);
      jet.PositionBy[k] =
        this->Corner[k + 1] - this->Corner[0] + shiftBy * jet.Normal + shift * jet.NormalBy[k];
    }
  }
};

/**
 * Distance by which a point is outside its facet: the smallest barycentric coordinate and its
 * corner.
 */
struct Outside
{
  double Least;
  int Corner;
};

inline Outside FindOutside(const glm::dvec2& b)
{
  Outside result{ 1.0 - b.x - b.y, 0 };
  if (b.x < result.Least)
  {
    result = { b.x, 1 };
  }
  if (b.y < result.Least)
  {
    result = { b.y, 2 };
  }
  return result;
}

}
