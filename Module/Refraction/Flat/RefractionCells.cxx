// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Refraction/Flat/RefractionCells.h"

#include <glm/geometric.hpp>

#include <atomic>
#include <cmath>
#include <limits>

namespace meniscus
{
namespace
{

constexpr double Epsilon = std::numeric_limits<double>::epsilon();

// A corner of the cross-section is w - r (w.m / r.m) with w = position - point. The subtraction,
// the two dot products, the quotient, the product and the last subtraction make fewer than 16
// roundings of at most |w| |m| / r.m each.
constexpr double CornerRounding = 16.0 * Epsilon;

// Cells with a ray more than 89.1 degrees from the mean of the rays hold no point: the
// cross-section and its rounding would grow without bound (by 1 / cosine). Unit rays that obey
// Snell's law stay far from this angle; only extrapolated ones (Eqs. 3.1, 3.2) reach it.
constexpr double SmallestCosine = 0x1p-6;

// A cross-section thinner than this (height over longest edge) belongs to a cell that is edge-on or
// at a focus; such a cell holds no point. The bound keeps the effect of wall rounding at a sharp
// corner, at most 2 CornerRounding / (SmallestCosine Thinnest) = 2^-21 of the reach, within the
// padding of the tree, 4 float epsilons = 2^-21 of the reach.
constexpr double Thinnest = 0x1p-20;

bool IsOpen(double cosine, double squaredMean)
{
  return cosine > 0.0 && cosine * cosine > SmallestCosine * SmallestCosine * squaredMean;
}

}

/** Triangle in which the plane through a point cuts the rays of a cell, relative to the point. */
struct RefractionCells::CrossSection
{
  glm::dvec3 ToCorner[3];
  glm::dvec3 Cut[3];
  double Depth[3];
  double Cosine[3];
  double SquaredMean = 0.0;
  /** Squares of the edges of the cuts, each opposite its corner; set by MayBeInside. */
  double SquaredEdge[3];

  /** Rounding error of a corner of the cross-section, times the length of the mean ray. */
  double GetTolerance() const
  {
    const double mean = std::sqrt(this->SquaredMean);
    double reach = 0.0;
    for (int i = 0; i < 3; ++i)
    {
      reach = std::max(reach, glm::length(this->ToCorner[i]) * (1.0 + mean / this->Cosine[i]));
    }
    return CornerRounding * reach * mean;
  }

  /**
   * First test for IsInside, which avoids the square root and overestimates the reach: almost every
   * tested cell already fails it.
   */
  bool MayBeInside(const glm::dvec3& area, double wallArea)
  {
    constexpr double factor = CornerRounding * (1.0 + 1.0 / SmallestCosine);
    double squaredReach = 0.0;
    for (const glm::dvec3& w : this->ToCorner)
    {
      squaredReach = std::max(squaredReach, glm::dot(w, w));
    }
    const double squaredTolerance = factor * factor * squaredReach * this->SquaredMean;
    for (int i = 0; i < 3; ++i)
    {
      const glm::dvec3 side = this->Cut[(i + 1) % 3] - this->Cut[(i + 2) % 3];
      this->SquaredEdge[i] = glm::dot(side, side);
      if (!(area[i] >= 0.0) &&
        !(area[i] * area[i] <=
          std::max(squaredTolerance * this->SquaredEdge[i], wallArea * wallArea)))
      {
        return false;
      }
    }
    return area.x + area.y + area.z > Thinnest * this->GetLongest() * std::sqrt(this->SquaredMean);
  }

  /**
   * True if no area is more negative than rounding or `wallArea` explains. A cross-section that is
   * no higher than the rounding error of its corners has no shape, and holds no point: the cell is
   * at a focus there.
   * @param tolerance  GetTolerance()
   */
  bool IsInside(const glm::dvec3& area, double wallArea, double tolerance) const
  {
    if (!(area.x + area.y + area.z > tolerance * std::sqrt(this->GetLongest())))
    {
      return false;
    }
    if (area.x >= 0.0 && area.y >= 0.0 && area.z >= 0.0)
    {
      return true;
    }
    return area.x >= -std::max(tolerance * std::sqrt(this->SquaredEdge[0]), wallArea) &&
      area.y >= -std::max(tolerance * std::sqrt(this->SquaredEdge[1]), wallArea) &&
      area.z >= -std::max(tolerance * std::sqrt(this->SquaredEdge[2]), wallArea);
  }

private:
  double GetLongest() const
  {
    return std::max({ this->SquaredEdge[0], this->SquaredEdge[1], this->SquaredEdge[2] });
  }
};

//------------------------------------------------------------------------------
EyeStatus RefractionCells::Update(const Membrane& membrane, const glm::dvec3& eye, double exterior,
  double interior, const RangeLoop& loop)
{
  const EyeStatus status = CheckEye(eye, exterior, interior);
  if (status != EyeStatus::Ready)
  {
    return status;
  }
  this->Surface = &membrane;
  this->Eye = eye;

  std::atomic<bool> touched{ false };
  const auto& facets = membrane.GetFacets();
  loop(facets.size(),
    [this, &facets, &touched](std::size_t begin, std::size_t end)
    {
      for (std::size_t i = begin; i < end && !touched; ++i)
      {
        if (this->IsEyeOnFacet(facets[i]))
        {
          touched = true;
        }
      }
    });
  if (touched)
  {
    return EyeStatus::OnTheMembrane;
  }

  const auto& positions = membrane.GetPositions();
  const auto& normals = membrane.GetNormals();
  const double ratio = exterior / interior;
  std::vector<RayKind> kinds(positions.size());
  this->Corners.resize(positions.size());
  ForEachItem(positions.size(), loop,
    [this, &positions, &normals, &kinds, ratio](std::size_t i)
    {
      const RefractionRay ray =
        ComputeRefractionRay(glm::normalize(positions[i] - this->Eye), normals[i], ratio);
      this->Corners[i] = { positions[i], ray.Direction };
      kinds[i] = ray.Kind;
    });
  this->CountRays(kinds);
  return EyeStatus::Ready;
}

//------------------------------------------------------------------------------
RefractionCells::CornerTriple RefractionCells::GetCorners(std::int32_t facet) const
{
  const Membrane::Facet& ids = this->Surface->GetFacets()[static_cast<std::size_t>(facet)];
  return { &this->Corners[static_cast<std::size_t>(ids[0])],
    &this->Corners[static_cast<std::size_t>(ids[1])],
    &this->Corners[static_cast<std::size_t>(ids[2])] };
}

//------------------------------------------------------------------------------
bool RefractionCells::IsEyeOnFacet(const Membrane::Facet& facet) const
{
  const auto& positions = this->Surface->GetPositions();
  const glm::dvec3 a = positions[static_cast<std::size_t>(facet[0])] - this->Eye;
  const glm::dvec3 b = positions[static_cast<std::size_t>(facet[1])] - this->Eye;
  const glm::dvec3 c = positions[static_cast<std::size_t>(facet[2])] - this->Eye;
  const glm::dvec3 normal = glm::cross(b - a, c - a);
  // Six times the volume of the tetrahedron of eye and facet, and its rounding error: three
  // products of three lengths, each within a few roundings of the local coordinates.
  const double size = std::max({ glm::length(a), glm::length(b), glm::length(c) });
  const double reach = std::max(size, this->Surface->GetRadius());
  const double volume = glm::dot(a, normal);
  if (std::fabs(volume) > CornerRounding * reach * glm::length(normal))
  {
    return false;
  }
  const double slack = CornerRounding * reach * size * glm::length(normal);
  return glm::dot(normal, glm::cross(b, c)) >= -slack &&
    glm::dot(normal, glm::cross(c, a)) >= -slack && glm::dot(normal, glm::cross(a, b)) >= -slack;
}

//------------------------------------------------------------------------------
double RefractionCells::GetLargestStretch()
{
  return 1.0 + 1.0 / SmallestCosine;
}

//------------------------------------------------------------------------------
void RefractionCells::CountRays(const std::vector<RayKind>& kinds)
{
  this->Report = RayReport();
  std::vector<bool> counted(kinds.size(), false);
  for (const Membrane::Facet& facet : this->Surface->GetFacets())
  {
    for (const std::int32_t corner : facet)
    {
      const auto vertex = static_cast<std::size_t>(corner);
      if (!counted[vertex])
      {
        counted[vertex] = true;
        this->Report.Refracted += kinds[vertex] == RayKind::Refracted;
        this->Report.BackFacing += kinds[vertex] == RayKind::BackFacing;
        this->Report.TotallyReflected += kinds[vertex] == RayKind::TotallyReflected;
      }
    }
  }
}

//------------------------------------------------------------------------------
bool RefractionCells::Contains(
  std::int32_t facet, const glm::dvec3& point, double wall, CellHit& hit) const
{
  const CornerTriple corner = this->GetCorners(facet);
  const glm::dvec3 mean = corner[0]->Ray + corner[1]->Ray + corner[2]->Ray;
  CrossSection cross;
  cross.SquaredMean = glm::dot(mean, mean);
  for (std::size_t i = 0; i < 3; ++i)
  {
    cross.Cosine[i] = glm::dot(corner[i]->Ray, mean);
    if (!IsOpen(cross.Cosine[i], cross.SquaredMean))
    {
      return false;
    }
    cross.ToCorner[i] = corner[i]->Position - point;
    cross.Depth[i] = -glm::dot(cross.ToCorner[i], mean);
    cross.Cut[i] = cross.ToCorner[i] + corner[i]->Ray * (cross.Depth[i] / cross.Cosine[i]);
  }

  // Twice the signed areas, times the length of the mean ray.
  glm::dvec3 area(glm::dot(mean, glm::cross(cross.Cut[1], cross.Cut[2])),
    glm::dot(mean, glm::cross(cross.Cut[2], cross.Cut[0])),
    glm::dot(mean, glm::cross(cross.Cut[0], cross.Cut[1])));
  const double sum = area.x + area.y + area.z;
  const double sign = sum < 0.0 ? -1.0 : 1.0;
  area *= sign;
  if (!cross.MayBeInside(area, wall * sign * sum))
  {
    return false;
  }
  const double tolerance = cross.GetTolerance();
  if (!cross.IsInside(area, wall * sign * sum, tolerance))
  {
    return false;
  }
  hit.Weights = area / (sign * sum);
  if (!this->IsBehind(corner, cross, hit.Weights, tolerance))
  {
    return false;
  }
  const double upright = glm::dot(mean,
    glm::cross(
      corner[1]->Position - corner[0]->Position, corner[2]->Position - corner[0]->Position));
  hit.Orientation = upright * sign >= 0.0 ? 1 : -1;
  return true;
}

//------------------------------------------------------------------------------
bool RefractionCells::IsBehind(const CornerTriple& corner, const CrossSection& cross,
  const glm::dvec3& weights, double tolerance) const
{
  const glm::dvec3 depth(cross.Depth[0], cross.Depth[1], cross.Depth[2]);
  // A plane in front of all corners is in front of the facet, whatever the weights.
  if (!(std::max({ depth.x, depth.y, depth.z }) >= -tolerance))
  {
    return false;
  }
  if (glm::dot(weights, depth) >= -tolerance)
  {
    return true;
  }
  // Just behind a facet the plane cuts some rays in front of their corners, and the resulting sight
  // point may lie behind the point by a second-order amount. In that case the facet itself decides.
  const glm::dvec3 normal = glm::cross(
    corner[1]->Position - corner[0]->Position, corner[2]->Position - corner[0]->Position);
  const double eyeSide = glm::dot(this->Eye - corner[0]->Position, normal);
  const double pointSide = -glm::dot(cross.ToCorner[0], normal);
  return (eyeSide < 0.0 ? -pointSide : pointSide) <=
    CornerRounding * glm::length(cross.ToCorner[0]) * glm::length(normal);
}

//------------------------------------------------------------------------------
TubeBounds RefractionCells::GetBounds(std::int32_t facet) const
{
  const CornerTriple corner = this->GetCorners(facet);
  const glm::dvec3 mean = corner[0]->Ray + corner[1]->Ray + corner[2]->Ray;
  double height[3];
  double cosine[3];
  for (std::size_t i = 0; i < 3; ++i)
  {
    height[i] = glm::dot(corner[i]->Position, mean);
    cosine[i] = glm::dot(corner[i]->Ray, mean);
    if (!IsOpen(cosine[i], glm::dot(mean, mean)))
    {
      return TubeBounds();
    }
  }
  // A plane through a point just behind the facet may cut a ray in front of its corner, but never
  // in front of the highest corner, so the tube starts there. Behind it all three cuts are at
  // non-negative distances, and the point is a mean of starts plus a mean of directions.
  const double highest = std::min({ height[0], height[1], height[2] });
  TubeBounds bounds;
  for (std::size_t i = 0; i < 3; ++i)
  {
    bounds.Add(
      corner[i]->Position - corner[i]->Ray * ((height[i] - highest) / cosine[i]), corner[i]->Ray);
  }
  return bounds;
}

}
