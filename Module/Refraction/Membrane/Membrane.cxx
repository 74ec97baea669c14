// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Refraction/Membrane/Membrane.h"

#include "Common/FiniteVector.h"
#include "Refraction/Membrane/CoincidentEdges.h"
#include "Refraction/Membrane/MembraneNormals.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace meniscus
{
namespace
{

// Rounding of the cross product of two vectors a and b: each component is a difference of two
// rounded products, so its error is below 2u |a| |b|, and the length's below 2 sqrt(3) u |a| |b|
// with u = epsilon / 2. Doubled once for the rounding of the two edge vectors.
constexpr double CrossProductRounding = 4.0 * std::numeric_limits<double>::epsilon();

glm::dvec3 Load(const double* array, std::size_t index)
{
  return { array[3 * index], array[3 * index + 1], array[3 * index + 2] };
}

// A facet whose height exceeds this share of the membrane's radius keeps its area in local
// coordinates. Each coordinate is rounded there by u = epsilon / 2 of the radius at most, each edge
// by 2 sqrt(3) u and the height by twice that, 4 epsilon; the area must exceed CrossProductRounding
// times the longest edges, at most 2 sqrt(3) radii, which takes another 14 epsilon of height.
constexpr double LocalRounding = 32.0 * std::numeric_limits<double>::epsilon();

// Lower bound of a triangle's height above its longest edge; 0 if its area is within rounding or an
// edge is too long for a double. Edges are scaled by the largest coordinate, so that the squares of
// tiny and huge ones stay within the range of double.
double GetHeight(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c)
{
  glm::dvec3 first = b - a;
  glm::dvec3 second = c - a;
  const glm::dvec3 extent = glm::max(glm::max(glm::abs(first), glm::abs(second)), glm::abs(c - b));
  const double scale = std::max({ extent.x, extent.y, extent.z });
  if (!(scale > 0.0) || !std::isfinite(scale))
  {
    return 0.0;
  }
  first /= scale;
  second /= scale;
  const double area = glm::length(glm::cross(first, second));
  const double product = glm::length(first) * glm::length(second);
  // The longest edge is at most sqrt(3) scales.
  return area > CrossProductRounding * product ? scale * area / std::sqrt(3.0) : 0.0;
}

template <typename Keep>
std::size_t Filter(
  std::vector<Membrane::Facet>& facets, std::vector<std::int64_t>& ids, const Keep& keep)
{
  std::size_t kept = 0;
  for (std::size_t i = 0; i < facets.size(); ++i)
  {
    if (keep(i))
    {
      facets[kept] = facets[i];
      ids[kept] = ids[i];
      ++kept;
    }
  }
  const std::size_t dropped = facets.size() - kept;
  facets.resize(kept);
  ids.resize(kept);
  return dropped;
}

}

//------------------------------------------------------------------------------
MembraneStatus Membrane::Build(const MembraneInput& input)
{
  Membrane last;
  std::swap(*this, last);
  this->Given = std::move(last.Given);
  this->Joined = std::move(last.Joined);
  constexpr auto limit = static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max());
  if (input.NumberOfPoints > limit || input.NumberOfTriangles > limit)
  {
    return MembraneStatus::TooLarge;
  }
  const double leastHeight = this->AcceptFacets(input);
  this->DropDuplicates();
  do
  {
    if (this->Facets.empty())
    {
      return MembraneStatus::Empty;
    }
    this->MoveToLocalOrigin(input);
  } while (this->DropFlattened(leastHeight));
  this->TakeGivenNormals(input);
  if (!this->OrientFacets(input.NumberOfPoints))
  {
    *this = Membrane();
    return MembraneStatus::OneSided;
  }
  if (!std::isfinite(1.0 / this->Radius))
  {
    const std::size_t tooSmall = this->Facets.size();
    *this = Membrane();
    this->Report.ZeroArea = tooSmall;
    return MembraneStatus::Empty;
  }
  this->CompleteNormals(input.Normals != nullptr);
  return MembraneStatus::Ready;
}

//------------------------------------------------------------------------------
std::vector<glm::dvec3> Membrane::ComputeCentroids() const
{
  std::vector<glm::dvec3> centroids;
  centroids.reserve(this->Facets.size());
  for (const Facet& facet : this->Facets)
  {
    glm::dvec3 sum(0.0);
    for (const std::int32_t vertex : facet)
    {
      sum += this->Positions[static_cast<std::size_t>(vertex)];
    }
    centroids.push_back(sum / 3.0);
  }
  return centroids;
}

//------------------------------------------------------------------------------
bool Membrane::ShowsSide(const glm::dvec3& local, double side) const
{
  const auto shows = [this, &local, side](std::int32_t vertex)
  {
    const auto i = static_cast<std::size_t>(vertex);
    return side * glm::dot(local - this->Positions[i], this->Normals[i]) > 0.0;
  };
  return std::any_of(this->Facets.begin(), this->Facets.end(),
    [&shows](const Facet& facet) { return std::any_of(facet.begin(), facet.end(), shows); });
}

//------------------------------------------------------------------------------
/** Returns the least of GetHeight() of the accepted facets. */
double Membrane::AcceptFacets(const MembraneInput& input)
{
  const auto isPoint = [&input](std::int64_t index)
  { return index >= 0 && static_cast<std::size_t>(index) < input.NumberOfPoints; };

  double leastHeight = std::numeric_limits<double>::infinity();
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
    else if (const double height = GetHeight(a, b, c); !(height > 0.0))
    {
      ++this->Report.ZeroArea;
    }
    else
    {
      leastHeight = std::min(leastHeight, height);
      this->Facets.push_back({ static_cast<std::int32_t>(ids[0]), static_cast<std::int32_t>(ids[1]),
        static_cast<std::int32_t>(ids[2]) });
      this->CellIds.push_back(
        input.CellIds ? input.CellIds[triangle] : static_cast<std::int64_t>(triangle));
    }
  }
  return leastHeight;
}

//------------------------------------------------------------------------------
void Membrane::DropDuplicates()
{
  // Vertices in ascending order and the facet's number, in words that compare in one step each.
  struct Key
  {
    std::uint64_t LowerTwo;
    std::uint64_t HighestAndId;
    bool operator<(const Key& other) const
    {
      return this->LowerTwo != other.LowerTwo ? this->LowerTwo < other.LowerTwo
                                              : this->HighestAndId < other.HighestAndId;
    }
    bool HasVerticesOf(const Key& other) const
    {
      return this->LowerTwo == other.LowerTwo &&
        this->HighestAndId >> 32 == other.HighestAndId >> 32;
    }
  };
  // Neither number is negative.
  const auto join = [](std::int32_t high, std::int32_t low)
  { return static_cast<std::uint64_t>(high) << 32 | static_cast<std::uint64_t>(low); };
  std::vector<Key> keys(this->Facets.size());
  for (std::size_t i = 0; i < keys.size(); ++i)
  {
    const Facet& v = this->Facets[i];
    const auto [low, high] = std::minmax({ v[0], v[1], v[2] });
    const std::int32_t middle =
      std::max(std::min(v[0], v[1]), std::min(std::max(v[0], v[1]), v[2]));
    keys[i] = { join(low, middle), join(high, static_cast<std::int32_t>(i)) };
  }
  std::sort(keys.begin(), keys.end());

  std::vector<bool> repeated(keys.size(), false);
  for (std::size_t i = 1; i < keys.size(); ++i)
  {
    repeated[static_cast<std::uint32_t>(keys[i].HighestAndId)] = keys[i].HasVerticesOf(keys[i - 1]);
  }
  this->Report.Duplicated +=
    Filter(this->Facets, this->CellIds, [&repeated](std::size_t i) { return !repeated[i]; });
}

//------------------------------------------------------------------------------
void Membrane::OrientedFacets::Update(const std::vector<Facet>& wound, std::size_t points)
{
  if (wound != this->Wound)
  {
    this->Wound = wound;
    this->Facets = wound;
    this->Pieces = meniscus::OrientFacets(this->Facets, points);
  }
}

//------------------------------------------------------------------------------
/** Joins coincident vertices and makes the winding consistent. Returns false if it cannot be. */
bool Membrane::OrientFacets(std::size_t points)
{
  this->Given.Update(this->Facets, points);
  const std::vector<std::int32_t> target =
    JoinCoincidentEdges(this->Positions, this->Given.Pieces.Borders, this->Normals, this->Facets);
  this->HasJoined = !target.empty();
  if (this->HasJoined)
  {
    this->JoinNormals(target);
    this->DropDuplicates();
    this->Joined.Update(this->Facets, points);
  }
  else
  {
    this->Joined = OrientedFacets();
  }
  const SurfacePieces& pieces = this->GetPieces();
  this->Facets = this->HasJoined ? this->Joined.Facets : this->Given.Facets;
  this->Report.TurnedFacets = pieces.TurnedFacets;
  this->Report.NonManifoldFacets = pieces.NonManifoldFacets;
  return !pieces.IsOneSided;
}

//------------------------------------------------------------------------------
/**
 * Removes given normals that differ between joined vertices, so that they are computed. Where there
 * are any, the surface may have a normal per facet: the normals of other corners are then removed
 * as well if only one facet has them and they are that facet's.
 */
void Membrane::JoinNormals(const std::vector<std::int32_t>& target)
{
  // Normals in single precision, which were computed from the same values, differ by a few units in
  // the last place.
  constexpr double same = 8.0 * static_cast<double>(std::numeric_limits<float>::epsilon());
  // Normals of facets with corners in single precision are off by more only if a facet's height is
  // a thousandth of the coordinates, or less.
  const double facets = std::sqrt(static_cast<double>(std::numeric_limits<float>::epsilon()));
  std::vector<bool> isJoined(target.size(), false);
  std::vector<bool> differs(target.size(), false);
  bool differ = false;
  for (std::size_t i = 0; i < target.size(); ++i)
  {
    const auto to = static_cast<std::size_t>(target[i]);
    if (to == i)
    {
      continue;
    }
    ++this->Report.JoinedVertices;
    isJoined[i] = isJoined[to] = true;
    const bool areGiven =
      this->Normals[i] != glm::dvec3(0.0) && this->Normals[to] != glm::dvec3(0.0);
    if (areGiven && glm::length(this->Normals[i] - this->Normals[to]) > same)
    {
      differs[to] = differ = true;
    }
    else if (!areGiven)
    {
      this->Normals[to] += this->Normals[i]; // one of them, or both, are zero
    }
  }
  std::vector<unsigned char> uses(target.size(), 0);
  for (const Facet& facet : this->Given.Facets)
  {
    for (const std::int32_t vertex : facet)
    {
      unsigned char& count = uses[static_cast<std::size_t>(vertex)];
      count = static_cast<unsigned char>(std::min(count + 1, 2));
    }
  }
  for (std::size_t i = 0; differ && i < this->Given.Facets.size(); ++i)
  {
    const Facet& facet = this->Given.Facets[i];
    const auto at = [this, &facet](std::size_t k)
    { return this->Positions[static_cast<std::size_t>(facet[k])] / this->Radius; };
    const glm::dvec3 area = glm::cross(at(1) - at(0), at(2) - at(0));
    for (const std::int32_t corner : facet)
    {
      const auto vertex = static_cast<std::size_t>(corner);
      const bool isOfFacet =
        glm::length(glm::cross(area, this->Normals[vertex])) <= facets * glm::length(area);
      differs[vertex] = differs[vertex] || (!isJoined[vertex] && uses[vertex] == 1 && isOfFacet);
    }
  }
  for (std::size_t i = 0; i < differs.size(); ++i)
  {
    const bool isRemoved = differs[i] && this->Normals[i] != glm::dvec3(0.0);
    this->Report.DifferentNormals += isRemoved ? 1 : 0;
    this->Normals[i] = isRemoved ? glm::dvec3(0.0) : this->Normals[i];
  }
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
/**
 * Leaves out facets that are so small, compared with the whole membrane, that they have no area in
 * local coordinates. Returns true if there are any: the others may have another centre.
 * @param leastHeight  the smallest height of all facets
 */
bool Membrane::DropFlattened(double leastHeight)
{
  if (leastHeight > LocalRounding * this->Radius)
  {
    return false;
  }
  const auto hasArea = [this](std::size_t i)
  {
    const Facet& facet = this->Facets[i];
    return GetHeight(this->Positions[static_cast<std::size_t>(facet[0])],
             this->Positions[static_cast<std::size_t>(facet[1])],
             this->Positions[static_cast<std::size_t>(facet[2])]) > 0.0;
  };
  const std::size_t dropped = Filter(this->Facets, this->CellIds, hasArea);
  this->Report.ZeroArea += dropped;
  return dropped > 0;
}

//------------------------------------------------------------------------------
/** Takes the given normals with unit length; others are zero. */
void Membrane::TakeGivenNormals(const MembraneInput& input)
{
  this->Normals.assign(this->Positions.size(), glm::dvec3(0.0));
  for (std::size_t i = 0; input.Normals && i < this->Normals.size(); ++i)
  {
    const glm::dvec3 normal = Load(input.Normals, i);
    const double length = std::hypot(normal.x, normal.y, normal.z);
    if (length > 0.0 && std::isfinite(length))
    {
      this->Normals[i] = glm::normalize(normal / length);
    }
  }
}

//------------------------------------------------------------------------------
/** Computes the normals that are zero. Returns their number. */
std::size_t Membrane::ComputeMissingNormals()
{
  std::vector<bool> missing(this->Positions.size(), false);
  for (const Facet& facet : this->Facets)
  {
    for (const std::int32_t vertex : facet)
    {
      const auto i = static_cast<std::size_t>(vertex);
      missing[i] = this->Normals[i] == glm::dvec3(0.0);
    }
  }
  const auto count = static_cast<std::size_t>(std::count(missing.begin(), missing.end(), true));
  if (count > 0)
  {
    ComputeVertexNormals(this->Positions, this->Facets, missing, this->Normals);
  }
  return count;
}

//------------------------------------------------------------------------------
/** @param areGiven  true if the input has normals, which need not fit the surface. */
void Membrane::CompleteNormals(bool areGiven)
{
  this->Report.ComputedNormals = this->ComputeMissingNormals();
  if (!areGiven)
  {
    return;
  }
  const SurfacePieces& pieces = this->GetPieces();
  this->Report.TurnedNormals = OrientNormals(this->Positions, this->Facets, pieces, this->Normals);
  const glm::dvec3 origin = glm::abs(this->Origin);
  const double coordinate = std::max({ origin.x, origin.y, origin.z }) + this->Radius;
  const std::vector<std::int32_t> wild =
    FindWildNormals(this->Positions, this->Facets, this->Normals, coordinate);
  for (const std::int32_t vertex : wild)
  {
    this->Normals[static_cast<std::size_t>(vertex)] = glm::dvec3(0.0);
  }
  if (!wild.empty())
  {
    this->Report.WildNormals = this->ComputeMissingNormals();
    OrientNormals(this->Positions, this->Facets, pieces, this->Normals);
  }
  this->Report.Normals =
    FindMismatchedNormals(this->Positions, this->Facets, this->Normals, coordinate);
}

}
