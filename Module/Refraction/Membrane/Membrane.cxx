// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Refraction/Membrane/Membrane.h"

#include "Refraction/Membrane/MembraneNormals.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace meniscus
{
namespace
{

// Rounding of the cross product of two vectors a and b: each component is a difference of two
// rounded products, so its error is below 2u |a| |b|, and the length's below 2 sqrt(3) u |a| |b|
// with u = epsilon / 2. Doubled once for the rounding of the two edge vectors.
constexpr double CrossProductRounding = 4.0 * std::numeric_limits<double>::epsilon();

bool IsFinite(const glm::dvec3& v)
{
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

glm::dvec3 Load(const double* array, std::size_t index)
{
  return { array[3 * index], array[3 * index + 1], array[3 * index + 2] };
}

// Edges are scaled by the longest, so that neither tiny nor huge coordinates leave the range of
// double when squared.
bool HasArea(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c)
{
  glm::dvec3 first = b - a;
  glm::dvec3 second = c - a;
  const glm::dvec3 extent = glm::max(glm::abs(first), glm::abs(second));
  const double scale = std::max({ extent.x, extent.y, extent.z });
  if (!(scale > 0.0) || !std::isfinite(scale))
  {
    return false;
  }
  first /= scale;
  second /= scale;
  return glm::length(glm::cross(first, second)) >
    CrossProductRounding * glm::length(first) * glm::length(second);
}

}

//------------------------------------------------------------------------------
MembraneStatus Membrane::Build(const MembraneInput& input)
{
  Membrane last;
  std::swap(*this, last);
  this->WoundFacets = std::move(last.WoundFacets);
  this->OrientedFacets = std::move(last.OrientedFacets);
  this->Pieces = std::move(last.Pieces);
  constexpr auto limit = static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max());
  if (input.numberOfPoints > limit || input.numberOfTriangles > limit)
  {
    return MembraneStatus::TooLarge;
  }
  this->AcceptFacets(input);
  this->DropDuplicates();
  if (this->Facets.empty())
  {
    return MembraneStatus::Empty;
  }
  if (!this->OrientFacets(input.numberOfPoints))
  {
    *this = Membrane();
    return MembraneStatus::OneSided;
  }
  this->MoveToLocalOrigin(input);
  if (!std::isfinite(1.0 / this->Radius))
  {
    const std::size_t tooSmall = this->Facets.size();
    *this = Membrane();
    this->Report.zeroArea = tooSmall;
    return MembraneStatus::Empty;
  }
  this->TakeNormals(input);
  return MembraneStatus::Ready;
}

//------------------------------------------------------------------------------
void Membrane::AcceptFacets(const MembraneInput& input)
{
  const auto isPoint = [&input](std::int64_t index)
  { return index >= 0 && static_cast<std::size_t>(index) < input.numberOfPoints; };

  this->Facets.reserve(input.numberOfTriangles);
  this->CellIds.reserve(input.numberOfTriangles);
  for (std::size_t triangle = 0; triangle < input.numberOfTriangles; ++triangle)
  {
    const std::int64_t* ids = input.triangles + 3 * triangle;
    if (!std::all_of(ids, ids + 3, isPoint))
    {
      ++this->Report.outOfRange;
      continue;
    }
    const glm::dvec3 a = Load(input.points, static_cast<std::size_t>(ids[0]));
    const glm::dvec3 b = Load(input.points, static_cast<std::size_t>(ids[1]));
    const glm::dvec3 c = Load(input.points, static_cast<std::size_t>(ids[2]));
    if (!IsFinite(a) || !IsFinite(b) || !IsFinite(c))
    {
      ++this->Report.notFinite;
    }
    else if (!HasArea(a, b, c))
    {
      ++this->Report.zeroArea;
    }
    else
    {
      this->Facets.push_back({ static_cast<std::int32_t>(ids[0]), static_cast<std::int32_t>(ids[1]),
        static_cast<std::int32_t>(ids[2]) });
      this->CellIds.push_back(
        input.cellIds ? input.cellIds[triangle] : static_cast<std::int64_t>(triangle));
    }
  }
}

//------------------------------------------------------------------------------
void Membrane::DropDuplicates()
{
  struct Key
  {
    Facet sorted;
    std::int32_t facet;
    bool operator<(const Key& other) const
    {
      return this->sorted != other.sorted ? this->sorted < other.sorted : this->facet < other.facet;
    }
  };
  std::vector<Key> keys(this->Facets.size());
  for (std::size_t i = 0; i < keys.size(); ++i)
  {
    keys[i] = { this->Facets[i], static_cast<std::int32_t>(i) };
    std::sort(keys[i].sorted.begin(), keys[i].sorted.end());
  }
  std::sort(keys.begin(), keys.end());

  std::vector<bool> repeated(keys.size(), false);
  for (std::size_t i = 1; i < keys.size(); ++i)
  {
    repeated[static_cast<std::size_t>(keys[i].facet)] = keys[i].sorted == keys[i - 1].sorted;
  }
  std::size_t kept = 0;
  for (std::size_t i = 0; i < repeated.size(); ++i)
  {
    if (!repeated[i])
    {
      this->Facets[kept] = this->Facets[i];
      this->CellIds[kept] = this->CellIds[i];
      ++kept;
    }
  }
  this->Report.duplicated = this->Facets.size() - kept;
  this->Facets.resize(kept);
  this->CellIds.resize(kept);
}

//------------------------------------------------------------------------------
bool Membrane::OrientFacets(std::size_t points)
{
  if (this->Facets != this->WoundFacets)
  {
    this->WoundFacets = this->Facets;
    this->OrientedFacets = this->Facets;
    this->Pieces = meniscus::OrientFacets(this->OrientedFacets, points);
  }
  this->Facets = this->OrientedFacets;
  this->Report.turnedFacets = this->Pieces.turnedFacets;
  return !this->Pieces.isOneSided;
}

//------------------------------------------------------------------------------
void Membrane::MoveToLocalOrigin(const MembraneInput& input)
{
  glm::dvec3 low(std::numeric_limits<double>::max());
  glm::dvec3 high(std::numeric_limits<double>::lowest());
  for (const Facet& facet : this->Facets)
  {
    for (std::int32_t vertex : facet)
    {
      const glm::dvec3 point = Load(input.points, static_cast<std::size_t>(vertex));
      low = glm::min(low, point);
      high = glm::max(high, point);
    }
  }
  this->Origin = 0.5 * low + 0.5 * high;
  const glm::dvec3 half = glm::max(high - this->Origin, this->Origin - low);
  this->Radius = std::max({ half.x, half.y, half.z });

  this->Positions.resize(input.numberOfPoints);
  for (std::size_t i = 0; i < input.numberOfPoints; ++i)
  {
    this->Positions[i] = Load(input.points, i) - this->Origin;
  }
}

//------------------------------------------------------------------------------
void Membrane::TakeNormals(const MembraneInput& input)
{
  this->Normals.assign(this->Positions.size(), glm::dvec3(0.0));
  std::vector<bool> missing(this->Positions.size(), false);
  for (const Facet& facet : this->Facets)
  {
    for (std::int32_t vertex : facet)
    {
      missing[static_cast<std::size_t>(vertex)] = true;
    }
  }
  for (std::size_t i = 0; input.normals && i < this->Normals.size(); ++i)
  {
    const glm::dvec3 normal = Load(input.normals, i);
    const double length = std::hypot(normal.x, normal.y, normal.z);
    if (missing[i] && length > 0.0 && std::isfinite(length))
    {
      this->Normals[i] = glm::normalize(normal / length);
      missing[i] = false;
    }
  }
  this->Report.computedNormals =
    static_cast<std::size_t>(std::count(missing.begin(), missing.end(), true));
  if (this->Report.computedNormals > 0)
  {
    this->Report.nonManifoldFacets =
      ComputeVertexNormals(this->Positions, this->Facets, missing, this->Normals);
  }
  if (input.normals)
  {
    this->Report.turnedNormals =
      OrientNormals(this->Positions, this->Facets, this->Pieces, this->Normals);
    const glm::dvec3 origin = glm::abs(this->Origin);
    this->Report.normals = FindMismatchedNormals(this->Positions, this->Facets, this->Normals,
      std::max({ origin.x, origin.y, origin.z }) + this->Radius);
  }
}

}
