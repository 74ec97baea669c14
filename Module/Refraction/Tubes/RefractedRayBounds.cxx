// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Refraction/Tubes/RefractedRayBounds.h"

#include <glm/common.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace meniscus
{
namespace
{

// Maximum of |b_i b_j (b_i - b_j)|, 1 / (6 sqrt 3); the maximum of b_i b_j is 1 / 4.
constexpr double LargestAsymmetric = 0.0962250448649377;

// Bound of the part of |q| with the differences b_i - b_j.
double BoundAsymmetric(const CurvedPatch& patch)
{
  const double* d = patch.Asymmetric;
  return LargestAsymmetric * (std::fabs(d[0]) + std::fabs(d[1]) + std::fabs(d[2]));
}

// Largest sum of b_i b_j times these factors, which are not negative. The sum of all b_i b_j is at
// most 1 / 3.
double BoundSymmetric(double a, double b, double c)
{
  return std::min(0.25 * (a + b + c), std::max({ a, b, c }) / 3.0);
}

// Bound of 2 / (1 + |n|): |n| is no less than the least projection of its control points on one
// direction.
double ComputeBulgeFactor(const CurvedPatch& patch)
{
  const glm::dvec3 along = glm::normalize(patch.Normal[0] + patch.Normal[1] + patch.Normal[2]);
  double shortest = std::numeric_limits<double>::infinity();
  for (const glm::dvec3& control : ComputeNormalControls(patch))
  {
    shortest = std::min(shortest, glm::dot(control, along));
  }
  return 2.0 / (1.0 + std::max(CurvedPatch::ShortestNormal, shortest));
}

// Tube around rays along ratio D + g N, with g between two ends.
TubeBounds BoundCombinations(const DirectionBox& sight, const DirectionBox& normal, double ratio,
  const double (&ends)[2], const glm::dvec3* points, int count, double reach)
{
  const double g = 0.5 * (ends[0] + ends[1]);
  const double gHalf = 0.5 * std::fabs(ends[0] - ends[1]);
  const glm::dvec3 direction = ratio * sight.Middle + g * normal.Middle;
  const glm::dvec3 spread = ratio * sight.Half + std::fabs(g) * normal.Half +
    gHalf * (glm::abs(normal.Middle) + normal.Half);
  // The rays are unit vectors.
  const glm::dvec3 lowest = glm::max(direction - spread, glm::dvec3(-1.0));
  const glm::dvec3 highest = glm::min(direction + spread, glm::dvec3(1.0));
  return BoundRays(lowest, highest, points, count, reach);
}

// Bounds of the sight rays to a patch whose points are within `bulge` of its facet.
DirectionBox BoundSights(const CurvedPatch& patch, const glm::dvec3& eye, double bulge)
{
  const glm::dvec3 sights[3] = { patch.Corner[0] - eye, patch.Corner[1] - eye,
    patch.Corner[2] - eye };
  return BoundDirections((sights[0] + sights[1] + sights[2]) / 3.0, sights, 3, bulge);
}

}

//------------------------------------------------------------------------------
std::array<glm::dvec3, 6> ComputeNormalControls(const CurvedPatch& patch)
{
  std::array<glm::dvec3, 6> control;
  for (std::size_t k = 0; k < 3; ++k)
  {
    control[k] = patch.Normal[k];
    control[k + 3] = 0.5 * (patch.Normal[(k + 1) % 3] + patch.Normal[(k + 2) % 3] + patch.Bend[k]);
  }
  return control;
}

//------------------------------------------------------------------------------
double BoundBulge(const CurvedPatch& patch)
{
  const double* s = patch.Symmetric;
  return ComputeBulgeFactor(patch) *
    (BoundAsymmetric(patch) + BoundSymmetric(std::fabs(s[0]), std::fabs(s[1]), std::fabs(s[2])));
}

//------------------------------------------------------------------------------
BulgeBounds BoundBulges(const CurvedPatch& patch)
{
  const double* s = patch.Symmetric;
  const double factor = ComputeBulgeFactor(patch);
  const double asymmetric = BoundAsymmetric(patch);
  return { -factor *
      (asymmetric +
        BoundSymmetric(std::max(-s[0], 0.0), std::max(-s[1], 0.0), std::max(-s[2], 0.0))),
    factor *
      (asymmetric +
        BoundSymmetric(std::max(s[0], 0.0), std::max(s[1], 0.0), std::max(s[2], 0.0))) };
}

//------------------------------------------------------------------------------
// Unit vectors along n + d for |d| within `ball` and d within `half`: n / |n| + (d - u (u.d)) / |n|
// plus a remainder below (|d| / |n|)^2 as long as |d| < |n| / 2.
DirectionBox BoundDirections(
  const glm::dvec3& middle, const glm::dvec3* hull, int count, double reach)
{
  const double length = glm::length(middle);
  const glm::dvec3 direction = middle / length;
  glm::dvec3 half(0.0);
  double ball = 0.0;
  for (int i = 0; i < count; ++i)
  {
    const glm::dvec3 d = hull[i] - middle;
    half = glm::max(half, glm::abs(d - direction * glm::dot(d, direction)));
    ball = std::max(ball, glm::dot(d, d));
  }
  const double part = (std::sqrt(ball) + reach) / length;
  if (!(part < 0.5))
  {
    return DirectionBox();
  }
  return { direction, (half + glm::dvec3(reach)) / length + glm::dvec3(part * part) };
}

//------------------------------------------------------------------------------
// The normals are inside the hull of their control points.
DirectionBox BoundNormals(const CurvedPatch& patch)
{
  const std::array<glm::dvec3, 6> control = ComputeNormalControls(patch);
  glm::dvec3 low(std::numeric_limits<double>::max());
  glm::dvec3 high(std::numeric_limits<double>::lowest());
  for (const glm::dvec3& c : control)
  {
    low = glm::min(low, c);
    high = glm::max(high, c);
  }
  return BoundDirections(0.5 * (low + high), control.data(), 6, 0.0);
}

//------------------------------------------------------------------------------
CosineBounds BoundCosine(const DirectionBox& sight, const DirectionBox& normal)
{
  const double middle = glm::dot(sight.Middle, normal.Middle);
  const glm::dvec3 sightReach = glm::abs(sight.Middle) + sight.Half;
  const double half =
    glm::dot(glm::abs(normal.Middle), sight.Half) + glm::dot(sightReach, normal.Half);
  return { std::max(middle - half, -1.0), std::min(middle + half, 1.0) };
}

//------------------------------------------------------------------------------
TubeBounds BoundRays(const glm::dvec3& lowest, const glm::dvec3& highest, const glm::dvec3* points,
  int count, double reach)
{
  TubeBounds bounds;
  for (int i = 0; i < count; ++i)
  {
    bounds.StartLow = glm::min(bounds.StartLow, points[i] - glm::dvec3(reach));
    bounds.StartHigh = glm::max(bounds.StartHigh, points[i] + glm::dvec3(reach));
  }
  bounds.DirectionLow = lowest;
  bounds.DirectionHigh = highest;
  return bounds;
}

//------------------------------------------------------------------------------
TubeBounds BoundRefractedRays(const DirectionBox& sight, const DirectionBox& normal, double ratio,
  const glm::dvec3* points, int count, double reach)
{
  const CosineBounds cosine = BoundCosine(sight, normal);
  const double least = cosine.Least;
  const double most = std::min(cosine.Most, 0.0);
  const auto radicand = [ratio](double c) { return 1.0 - ratio * ratio * (1.0 - c * c); };
  if (!(least < 0.0) || !(radicand(least) > 0.0))
  {
    return TubeBounds();
  }
  const auto factor = [ratio, &radicand](double c)
  { return -ratio * c - std::sqrt(std::max(radicand(c), 0.0)); };
  // At the critical angle the root is zero and c = -sqrt(1 - 1 / ratio^2).
  const double last =
    radicand(most) > 0.0 ? most : -std::sqrt(std::max(1.0 - 1.0 / (ratio * ratio), 0.0));
  const double ends[2] = { factor(least), factor(last) };
  return BoundCombinations(sight, normal, ratio, ends, points, count, reach);
}

//------------------------------------------------------------------------------
TubeBounds BoundRefractedRays(const CurvedPatch& patch, const glm::dvec3& eye, double ratio)
{
  const double bulge = BoundBulge(patch);
  return BoundRefractedRays(
    BoundSights(patch, eye, bulge), BoundNormals(patch), ratio, patch.Corner, 3, bulge);
}

//------------------------------------------------------------------------------
TubeBounds BoundReflectedRays(const CurvedPatch& patch, const glm::dvec3& eye)
{
  const double bulge = BoundBulge(patch);
  const DirectionBox sight = BoundSights(patch, eye, bulge);
  const DirectionBox normal = BoundNormals(patch);
  const CosineBounds cosine = BoundCosine(sight, normal);
  if (!(cosine.Least < 0.0))
  {
    return TubeBounds();
  }
  const double ends[2] = { -2.0 * cosine.Least, -2.0 * std::min(cosine.Most, 0.0) };
  return BoundCombinations(sight, normal, 1.0, ends, patch.Corner, 3, bulge);
}

}
