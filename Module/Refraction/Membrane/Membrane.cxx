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

// Edges are scaled by the longest one, so that the squares of tiny and huge coordinates stay within
// the range of double.
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
  if (input.NumberOfPoints > limit || input.NumberOfTriangles > limit)
  {
    return MembraneStatus::TooLarge;
  }
  this->AcceptFacets(input);
  this->DropDuplicates();
  if (this->Facets.empty())
  {
    return MembraneStatus::Empty;
  }
  if (!this->OrientFacets(input.NumberOfPoints))
  {
    *this = Membrane();
    return MembraneStatus::OneSided;
  }
  this->MoveToLocalOrigin(input);
  if (!std::isfinite(1.0 / this->Radius))
  {
    const std::size_t tooSmall = this->Facets.size();
    *this = Membrane();
    this->Report.ZeroArea = tooSmall;
    return MembraneStatus::Empty;
  }
  this->TakeNormals(input);
  return MembraneStatus::Ready;
}

//------------------------------------------------------------------------------
void Membrane::AcceptFacets(const MembraneInput& input)
{
  const auto isPoint = [&input](std::int64_t index)
  { return index >= 0 && static_cast<std::size_t>(index) < input.NumberOfPoints; };

  this->Facets.reserve(input.NumberOfTriangles);
  this->CellIds.reserve(input.NumberOfTriangles);
  for (std::size_t triangle = 0; triangle < input.NumberOfTriangles; ++triangle)
  {
    const std::int64_t* ids = input.Triangles + 3 * triangle;
    if (!std::all_of(ids, ids + 3, isPoint))
    {
      ++this->Report.OutOfRange;
      continue;
    }
    const glm::dvec3 a = Load(input.Points, static_cast<std::size_t>(ids[0]));
    const glm::dvec3 b = Load(input.Points, static_cast<std::size_t>(ids[1]));
    const glm::dvec3 c = Load(input.Points, static_cast<std::size_t>(ids[2]));
    if (!IsFinite(a) || !IsFinite(b) || !IsFinite(c))
    {
      ++this->Report.NotFinite;
    }
    else if (!HasArea(a, b, c))
    {
      ++this->Report.ZeroArea;
    }
    else
    {
      this->Facets.push_back({ static_cast<std::int32_t>(ids[0]), static_cast<std::int32_t>(ids[1]),
        static_cast<std::int32_t>(ids[2]) });
      this->CellIds.push_back(
        input.CellIds ? input.CellIds[triangle] : static_cast<std::int64_t>(triangle));
    }
  }
}

//------------------------------------------------------------------------------
void Membrane::DropDuplicates()
{
  struct Key
  {
    Facet Sorted;
    std::int32_t Id;
    bool operator<(const Key& other) const
    {
      return this->Sorted != other.Sorted ? this->Sorted < other.Sorted : this->Id < other.Id;
    }
  };
  std::vector<Key> keys(this->Facets.size());
  for (std::size_t i = 0; i < keys.size(); ++i)
  {
    keys[i] = { this->Facets[i], static_cast<std::int32_t>(i) };
    std::sort(keys[i].Sorted.begin(), keys[i].Sorted.end());
  }
  std::sort(keys.begin(), keys.end());

  std::vector<bool> repeated(keys.size(), false);
  for (std::size_t i = 1; i < keys.size(); ++i)
  {
    repeated[static_cast<std::size_t>(keys[i].Id)] = keys[i].Sorted == keys[i - 1].Sorted;
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
  this->Report.Duplicated = this->Facets.size() - kept;
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
  this->Report.TurnedFacets = this->Pieces.TurnedFacets;
  return !this->Pieces.IsOneSided;
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
      const glm::dvec3 point = Load(input.Points, static_cast<std::size_t>(vertex));
      low = glm::min(low, point);
      high = glm::max(high, point);
    }
  }
  this->Origin = 0.5 * low + 0.5 * high;
  const glm::dvec3 half = glm::max(high - this->Origin, this->Origin - low);
  this->Radius = std::max({ half.x, half.y, half.z });

  this->Positions.resize(input.NumberOfPoints);
  for (std::size_t i = 0; i < input.NumberOfPoints; ++i)
  {
    this->Positions[i] = Load(input.Points, i) - this->Origin;
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
  for (std::size_t i = 0; input.Normals && i < this->Normals.size(); ++i)
  {
    const glm::dvec3 normal = Load(input.Normals, i);
    const double length = std::hypot(normal.x, normal.y, normal.z);
    if (missing[i] && length > 0.0 && std::isfinite(length))
    {
      this->Normals[i] = glm::normalize(normal / length);
      missing[i] = false;
    }
  }
  this->Report.ComputedNormals =
    static_cast<std::size_t>(std::count(missing.begin(), missing.end(), true));
  if (this->Report.ComputedNormals > 0)
  {
    this->Report.NonManifoldFacets =
      ComputeVertexNormals(this->Positions, this->Facets, missing, this->Normals);
  }
  if (input.Normals)
  {
    this->Report.TurnedNormals =
      OrientNormals(this->Positions, this->Facets, this->Pieces, this->Normals);
    const glm::dvec3 origin = glm::abs(this->Origin);
    this->Report.Normals = FindMismatchedNormals(this->Positions, this->Facets, this->Normals,
      std::max({ origin.x, origin.y, origin.z }) + this->Radius);
  }
}

}
