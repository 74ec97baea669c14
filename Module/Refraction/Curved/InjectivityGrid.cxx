// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Refraction/Curved/InjectivityGrid.h"

#include "Refraction/Curved/PatchRoots.h"
#include "Refraction/Curved/TriangleMap.h"

#include <glm/common.hpp>
#include <glm/mat2x2.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

namespace meniscus
{
namespace
{

// The grid has about one cell for every two facets, so that it needs no more memory than the
// facets.
constexpr int LargestWidth = 512;

// The iteration ends when a box of sight points is not smaller than this fraction of the previous
// one.
constexpr double Shrinks = 0.9;
constexpr int MostSteps = 12;

// Largest number of cells along an axis that are examined one by one; a larger box is looked up in
// a coarser level.
constexpr int MostCells = 3;

/**
 * Derivatives along the plane's axes of a Bezier triangle of second degree, at its three corners.
 */
using CornerDerivatives = std::array<glm::dmat2, 3>;

// `f` holds the values at the corners and in the middles of the edges opposite to them.
CornerDerivatives Differentiate(const std::array<glm::dvec2, 6>& f, const glm::dmat2& inverse)
{
  std::array<glm::dvec2, 6> c = f;
  for (std::size_t k = 0; k < 3; ++k)
  {
    c[k + 3] = 2.0 * f[k + 3] - 0.5 * (f[(k + 1) % 3] + f[(k + 2) % 3]);
  }
  return { 2.0 * glm::dmat2(c[5] - c[0], c[4] - c[0]) * inverse,
    2.0 * glm::dmat2(c[1] - c[5], c[3] - c[5]) * inverse,
    2.0 * glm::dmat2(c[3] - c[4], c[2] - c[4]) * inverse };
}

// Smaller eigenvalue of the symmetric part.
double FindLeastStretch(const glm::dmat2& m)
{
  const double difference = 0.5 * (m[0][0] - m[1][1]);
  const double shear = 0.5 * (m[0][1] + m[1][0]);
  return 0.5 * (m[0][0] + m[1][1]) - std::sqrt(difference * difference + shear * shear);
}

double SquareOf(const glm::dmat2& m)
{
  return glm::dot(m[0], m[0]) + glm::dot(m[1], m[1]);
}

// Lower bound of the stretch at a height. It is concave in the height: the smallest eigenvalue of
// an affine function, less a norm of one.
double FindMargin(const CornerDerivatives& base, const CornerDerivatives& slope, double height)
{
  CornerDerivatives m;
  double least = std::numeric_limits<double>::max();
  for (std::size_t k = 0; k < 3; ++k)
  {
    m[k] = base[k] - height * slope[k];
    least = std::min(least, FindLeastStretch(m[k]));
  }
  const double varies =
    std::sqrt(std::max({ SquareOf(m[1] - m[0]), SquareOf(m[2] - m[1]), SquareOf(m[0] - m[2]) }));
  return least - PatchRoots::HigherDegree * varies;
}

// Rounds to a float that is no farther from zero than `value`.
float RoundDown(double value)
{
  return std::nextafter(static_cast<float>(value), std::numeric_limits<float>::lowest());
}
float RoundUp(double value)
{
  return std::nextafter(static_cast<float>(value), std::numeric_limits<float>::max());
}

std::array<glm::dvec2, 3> ProjectFacet(
  const Membrane& membrane, std::size_t facet, const HeightFrame& frame)
{
  const Membrane::Facet& f = membrane.GetFacets()[facet];
  const auto at = [&membrane, &frame, &f](std::size_t k)
  { return frame.Project(membrane.GetPositions()[static_cast<std::size_t>(f[k])]); };
  return { at(0), at(1), at(2) };
}

// Twice the area, positive if the corners are in counter-clockwise order.
double FindArea(const std::array<glm::dvec2, 3>& at)
{
  return Cross(at[1] - at[0], at[2] - at[0]);
}

// Rounding error of a coordinate: positions are rounded as local coordinates, and once more by the
// projection, a sum of three products.
double FindRounding(const Membrane& membrane)
{
  return 8.0 * std::numeric_limits<double>::epsilon() * membrane.GetRadius();
}

// True if a triangle with this winding covers the place, or might do so within rounding.
bool Covers(
  const std::array<glm::dvec2, 3>& at, const glm::dvec2& place, double winding, double rounding)
{
  bool covers = true;
  for (std::size_t k = 0; k < 3; ++k)
  {
    const glm::dvec2 side = at[(k + 1) % 3] - at[k];
    const glm::dvec2 way = place - at[k];
    // The sides of the cross product are off by two roundings each.
    const double slack = 4.0 * rounding * (glm::length(side) + glm::length(way));
    covers = covers && winding * Cross(side, way) >= -slack;
  }
  return covers;
}

// Extends a range to the slopes along an axis in a patch: those at corners and middles of its
// sides, and the bulge of higher degree between them.
void AddSlopes(const std::array<glm::dvec2, 6>& slope, int axis, double& lowest, double& highest)
{
  for (std::size_t k = 0; k < 3; ++k)
  {
    const double mean = 0.5 * (slope[(k + 1) % 3][axis] + slope[(k + 2) % 3][axis]);
    const double bend = slope[k + 3][axis] - mean;
    const double rest = (1.0 + PatchRoots::HigherDegree) * std::fabs(bend);
    lowest = std::min(lowest, std::min(slope[k][axis], mean + bend) - rest);
    highest = std::max(highest, std::max(slope[k][axis], mean + bend) + rest);
  }
}

}

/** Refracted ray at a place of a patch. It meets the plane at height z in base - z slope. */
struct InjectivityGrid::SlopedRay
{
  glm::dvec2 Base;
  glm::dvec2 Slope;
  double Height;
  bool IsThere; ///< false: no ray, or one that does not go down; the other members are not set
};

//------------------------------------------------------------------------------
InjectivityGrid::SlopedRay InjectivityGrid::MakeRay(const PatchPoint& at, const Media& media) const
{
  SlopedRay ray;
  const double length = glm::length(at.Normal);
  const RefractionRay refracted =
    media.GetRay(glm::normalize(at.Position - media.Eye), at.Normal / length);
  const double drop = -this->Frame.GetHeight(refracted.Direction);
  ray.IsThere =
    length > CurvedPatch::ShortestNormal && refracted.Kind == RayKind::Refracted && drop > 0.0;
  if (ray.IsThere)
  {
    ray.Height = this->Frame.GetHeight(at.Position);
    ray.Slope = this->Frame.Project(refracted.Direction) / drop;
    ray.Base = this->Frame.Project(at.Position) + ray.Height * ray.Slope;
  }
  return ray;
}

//------------------------------------------------------------------------------
InjectivityGrid::Cell InjectivityGrid::MakeEmpty()
{
  Cell cell;
  cell.Low.fill(std::numeric_limits<float>::max());
  cell.High.fill(std::numeric_limits<float>::lowest());
  cell.Slabs = AllSlabs;
  return cell;
}

//------------------------------------------------------------------------------
void InjectivityGrid::Merge(Cell& cell, const Cell& other)
{
  for (std::size_t i = 0; i < 3; ++i)
  {
    cell.Low[i] = std::min(cell.Low[i], other.Low[i]);
    cell.High[i] = std::max(cell.High[i], other.High[i]);
  }
  cell.Slabs = cell.Slabs & other.Slabs;
}

//------------------------------------------------------------------------------
// Where a place of the patch has no refracted ray, slopes are unbounded and the cell proves
// nothing.
InjectivityGrid::Cell InjectivityGrid::Judge(
  const std::array<glm::dvec3, 3>& corners, const std::array<const SlopedRay*, 6>& rays) const
{
  std::array<glm::dvec2, 6> base;
  std::array<glm::dvec2, 6> slope;
  Cell cell = MakeEmpty();
  glm::dvec3 least(std::numeric_limits<double>::max());
  glm::dvec3 most(std::numeric_limits<double>::lowest());
  for (std::size_t i = 0; i < 6; ++i)
  {
    if (!rays[i]->IsThere)
    {
      cell.Low.fill(std::numeric_limits<float>::lowest());
      cell.High.fill(std::numeric_limits<float>::max());
      cell.Slabs = 0;
      return cell;
    }
    base[i] = rays[i]->Base;
    slope[i] = rays[i]->Slope;
    least.z = std::min(least.z, rays[i]->Height - this->Bulge);
    most.z = std::max(most.z, rays[i]->Height + this->Bulge);
  }
  for (int axis = 0; axis < 2; ++axis)
  {
    AddSlopes(slope, axis, least[axis], most[axis]);
  }
  for (int i = 0; i < 3; ++i)
  {
    cell.Low[static_cast<std::size_t>(i)] = RoundDown(least[i]);
    cell.High[static_cast<std::size_t>(i)] = RoundUp(most[i]);
  }
  const glm::dmat2 sides(
    this->Frame.Project(corners[1] - corners[0]), this->Frame.Project(corners[2] - corners[0]));
  const glm::dmat2 inverse = glm::inverse(sides);
  const CornerDerivatives baseBy = Differentiate(base, inverse);
  const CornerDerivatives slopeBy = Differentiate(slope, inverse);
  const auto holdsAt = [this, &baseBy, &slopeBy](int border)
  { return FindMargin(baseBy, slopeBy, this->LowHeight + border * this->SlabHeight) > 0.0; };
  const bool holdsBelow = holdsAt(0);
  const bool holdsAbove = holdsAt(Slabs);
  if (holdsBelow && holdsAbove)
  {
    return cell; // and in all slabs between, since the margin is concave
  }
  // The borders at which it holds are consecutive, and begin to hold where the rays do.
  const double own =
    this->SlabHeight > 0.0 ? (rays[0]->Height - this->LowHeight) / this->SlabHeight : 0.0;
  const int first = static_cast<int>(std::lround(std::clamp(own, 0.0, double{ Slabs })));
  if (!holdsAt(first))
  {
    cell.Slabs = 0;
    return cell;
  }
  // The last border on the way from `holds` to `fails` at which it holds.
  const auto findEnd = [&holdsAt](int holds, int fails)
  {
    while (std::abs(fails - holds) > 1)
    {
      const int middle = (holds + fails) / 2;
      (holdsAt(middle) ? holds : fails) = middle;
    }
    return holds;
  };
  cell.Slabs = MakeSlabs(
    holdsBelow ? 0 : findEnd(first, 0), holdsAbove ? int{ Slabs } : findEnd(first, Slabs));
  return cell;
}

//------------------------------------------------------------------------------
// Slabs between two borders, as bits.
std::uint64_t InjectivityGrid::MakeSlabs(int low, int high)
{
  const auto below = [](int border)
  { return border == Slabs ? AllSlabs : (std::uint64_t{ 1 } << border) - 1u; };
  return below(high) & ~below(low);
}

//------------------------------------------------------------------------------
void InjectivityGrid::FitGrid(const Membrane& membrane)
{
  Box bounds{ glm::dvec2(std::numeric_limits<double>::max()),
    glm::dvec2(std::numeric_limits<double>::lowest()) };
  for (std::size_t i = 0; i < membrane.GetFacets().size(); ++i)
  {
    for (const glm::dvec2& place : ProjectFacet(membrane, i, this->Frame))
    {
      bounds.Low = glm::min(bounds.Low, place);
      bounds.High = glm::max(bounds.High, place);
    }
  }
  const auto facets = static_cast<double>(membrane.GetFacets().size());
  this->Width = 1;
  while (this->Width < LargestWidth && 2.0 * this->Width * this->Width < facets)
  {
    this->Width *= 2;
  }
  this->Corner = bounds.Low;
  this->Far = bounds.High;
  this->Scale = double(this->Width) / (bounds.High - bounds.Low);
}

//------------------------------------------------------------------------------
// The index is monotonic in the place, so that a place within bounds has an index between those of
// the bounds.
int InjectivityGrid::FindIndex(double place, int axis) const
{
  const double cells = (place - this->Corner[axis]) * this->Scale[axis];
  return static_cast<int>(std::clamp(cells, 0.0, this->Width - 1.0));
}

//------------------------------------------------------------------------------
template <std::size_t N, typename Visitor>
void InjectivityGrid::VisitCells(const std::array<glm::dvec2, N>& places, Visitor&& visit)
{
  glm::dvec2 low = places[0];
  glm::dvec2 high = places[0];
  for (const glm::dvec2& place : places)
  {
    low = glm::min(low, place);
    high = glm::max(high, place);
  }
  for (int y = this->FindIndex(low.y, 1); y <= this->FindIndex(high.y, 1); ++y)
  {
    for (int x = this->FindIndex(low.x, 0); x <= this->FindIndex(high.x, 0); ++x)
    {
      visit(x, y, this->Levels[0][static_cast<std::size_t>(y) * this->Width + x]);
    }
  }
}

//------------------------------------------------------------------------------
void InjectivityGrid::Build(const Membrane& membrane, const CurvedPatches& patches,
  const HeightFrame& frame, bool isConvexField, double bulge, const Media& media, double low,
  double high, const RangeLoop& loop)
{
  this->Frame = frame;
  this->Bulge = bulge;
  this->LowHeight = low;
  this->SlabHeight = (high - low) / Slabs;
  this->Levels.clear();
  this->FitGrid(membrane);
  if (!(this->Corner.x < this->Far.x && this->Corner.y < this->Far.y))
  {
    return; // seen along its surface
  }
  this->CollectFacets(membrane, this->JudgeAll(membrane, patches, media, loop));
  if (!isConvexField)
  {
    this->RejectBorders(membrane, patches);
    this->RejectFolds(membrane);
  }
  this->BuildCoarserLevels();
}

//------------------------------------------------------------------------------
// Rays in the middles of the edges, three for each facet. Of two facets that share an edge, only
// the first has it.
std::vector<InjectivityGrid::SlopedRay> InjectivityGrid::MakeEdgeRays(
  const CurvedPatches& patches, const Media& media, const RangeLoop& loop) const
{
  std::vector<SlopedRay> rays(3 * patches.GetSize());
  ForEachItem(patches.GetSize(), loop,
    [this, &patches, &media, &rays](std::size_t i)
    {
      const auto facet = static_cast<std::int32_t>(i);
      const CurvedPatch patch = patches.GetPatch(facet);
      for (int k = 0; k < 3; ++k)
      {
        const std::int32_t neighbour = patches.GetNeighbour(facet, k);
        if (neighbour == CurvedPatches::NoFacet || neighbour > facet)
        {
          rays[3 * i + static_cast<std::size_t>(k)] =
            this->MakeRay(patch.EvaluateEdge(k, 0.5, 0.5), media);
        }
      }
    });
  return rays;
}

//------------------------------------------------------------------------------
// The rays at the vertices are those at the corners of all patches that meet there, and patches
// that share an edge have the same ray in its middle.
std::vector<InjectivityGrid::Cell> InjectivityGrid::JudgeAll(const Membrane& membrane,
  const CurvedPatches& patches, const Media& media, const RangeLoop& loop) const
{
  std::vector<SlopedRay> atVertices(membrane.GetPositions().size());
  ForEachItem(atVertices.size(), loop,
    [this, &membrane, &media, &atVertices](std::size_t i)
    {
      atVertices[i] =
        this->MakeRay({ membrane.GetPositions()[i], membrane.GetNormals()[i] }, media);
    });
  const std::vector<SlopedRay> onEdges = this->MakeEdgeRays(patches, media, loop);
  std::vector<Cell> judged(membrane.GetFacets().size());
  ForEachItem(judged.size(), loop,
    [this, &membrane, &patches, &atVertices, &onEdges, &judged](std::size_t i)
    {
      const Membrane::Facet& f = membrane.GetFacets()[i];
      std::array<glm::dvec3, 3> corners;
      std::array<const SlopedRay*, 6> rays;
      for (std::size_t k = 0; k < 3; ++k)
      {
        const auto vertex = static_cast<std::size_t>(f[k]);
        corners[k] = membrane.GetPositions()[vertex];
        rays[k] = &atVertices[vertex];
        rays[k + 3] =
          &onEdges[patches.FindFirstEdge(static_cast<std::int32_t>(i), static_cast<int>(k))];
      }
      judged[i] = this->Judge(corners, rays);
    });
  return judged;
}

//------------------------------------------------------------------------------
void InjectivityGrid::CollectFacets(const Membrane& membrane, const std::vector<Cell>& judged)
{
  this->Levels.assign(1, Level(static_cast<std::size_t>(this->Width) * this->Width, MakeEmpty()));
  for (std::size_t i = 0; i < judged.size(); ++i)
  {
    this->VisitCells(ProjectFacet(membrane, i, this->Frame),
      [&judged, i](int, int, Cell& cell) { Merge(cell, judged[i]); });
  }
}

//------------------------------------------------------------------------------
void InjectivityGrid::RejectBorders(const Membrane& membrane, const CurvedPatches& patches)
{
  for (std::size_t i = 0; i < membrane.GetFacets().size(); ++i)
  {
    const std::array<glm::dvec2, 3> at = ProjectFacet(membrane, i, this->Frame);
    for (std::size_t k = 0; k < 3; ++k)
    {
      if (patches.GetNeighbour(static_cast<std::int32_t>(i), static_cast<int>(k)) ==
        CurvedPatches::NoFacet)
      {
        this->VisitCells(std::array<glm::dvec2, 2>{ at[(k + 1) % 3], at[(k + 2) % 3] },
          [](int, int, Cell& cell) { cell.Slabs = 0; });
      }
    }
  }
}

//------------------------------------------------------------------------------
// Rejects cells with facets of the other winding than most have, and cells in which several facets
// lie over the same place: one place of each cell is tested.
void InjectivityGrid::RejectFolds(const Membrane& membrane)
{
  double area = 0.0;
  for (std::size_t i = 0; i < membrane.GetFacets().size(); ++i)
  {
    area += FindArea(ProjectFacet(membrane, i, this->Frame));
  }
  const double winding = area < 0.0 ? -1.0 : 1.0;
  const double slack = FindRounding(membrane);
  // Off the middle, where edges of regular meshes often are.
  const glm::dvec2 tested(0.382, 0.618);
  std::vector<bool> isCovered(this->Levels[0].size());
  for (std::size_t i = 0; i < membrane.GetFacets().size(); ++i)
  {
    const std::array<glm::dvec2, 3> at = ProjectFacet(membrane, i, this->Frame);
    const bool isTurned = !(winding * FindArea(at) > 0.0);
    this->VisitCells(at,
      [&](int x, int y, Cell& cell)
      {
        const glm::dvec2 place = this->Corner + (glm::dvec2(x, y) + tested) / this->Scale;
        const bool covers = isTurned || Covers(at, place, winding, slack);
        const std::size_t index = static_cast<std::size_t>(y) * this->Width + x;
        cell.Slabs = isTurned || (covers && isCovered[index]) ? 0 : cell.Slabs;
        isCovered[index] = isCovered[index] || covers;
      });
  }
}

//------------------------------------------------------------------------------
void InjectivityGrid::BuildCoarserLevels()
{
  for (int width = this->Width / 2; width >= 1; width /= 2)
  {
    Level level(static_cast<std::size_t>(width) * width, MakeEmpty());
    const Level& finer = this->Levels.back();
    for (int y = 0; y < 2 * width; ++y)
    {
      for (int x = 0; x < 2 * width; ++x)
      {
        Merge(level[static_cast<std::size_t>(y / 2) * width + x / 2],
          finer[static_cast<std::size_t>(y) * 2 * width + x]);
      }
    }
    this->Levels.push_back(std::move(level));
  }
}

//------------------------------------------------------------------------------
InjectivityGrid::Cell InjectivityGrid::Collect(const Box& box) const
{
  int x0 = this->FindIndex(box.Low.x, 0);
  int x1 = this->FindIndex(box.High.x, 0);
  int y0 = this->FindIndex(box.Low.y, 1);
  int y1 = this->FindIndex(box.High.y, 1);
  std::size_t level = 0;
  while (x1 - x0 >= MostCells || y1 - y0 >= MostCells)
  {
    x0 /= 2;
    x1 /= 2;
    y0 /= 2;
    y1 /= 2;
    ++level;
  }
  const std::size_t width = static_cast<std::size_t>(this->Width) >> level;
  Cell cell = MakeEmpty();
  for (int y = y0; y <= y1; ++y)
  {
    for (int x = x0; x <= x1; ++x)
    {
      Merge(cell, this->Levels[level][static_cast<std::size_t>(y) * width + x]);
    }
  }
  return cell;
}

//------------------------------------------------------------------------------
// Slabs that the heights touch, as bits; 0 if some of the heights lie in no slab.
std::uint64_t InjectivityGrid::FindSlabs(double low, double high) const
{
  const double top = this->LowHeight + Slabs * this->SlabHeight;
  if (!(low >= this->LowHeight && high <= top))
  {
    return 0;
  }
  const auto index = [this](double height)
  {
    const double slab =
      this->SlabHeight > 0.0 ? (height - this->LowHeight) / this->SlabHeight : 0.0;
    return static_cast<int>(std::clamp(slab, 0.0, Slabs - 1.0));
  };
  return MakeSlabs(index(low), index(high) + 1);
}

//------------------------------------------------------------------------------
bool InjectivityGrid::HoldsAtMostOne(const glm::dvec3& low, const glm::dvec3& high) const
{
  if (this->IsEmpty())
  {
    return false;
  }
  const glm::dvec3 middle = 0.5 * (low + high);
  const glm::dvec3 half = 0.5 * (high - low);
  const glm::dvec2 at = this->Frame.Project(middle);
  const glm::dvec2 reach(
    glm::dot(glm::abs(this->Frame.First), half), glm::dot(glm::abs(this->Frame.Second), half));
  const double height = this->Frame.GetHeight(middle);
  const double rise = glm::dot(glm::abs(this->Frame.Axis), half);
  const std::uint64_t slabs = this->FindSlabs(height - rise, height + rise);
  if (slabs == 0)
  {
    return false;
  }
  Box box{ this->Corner, this->Far };
  for (int step = 0; step < MostSteps; ++step)
  {
    const Cell cell = this->Collect(box);
    if ((cell.Slabs & slabs) == slabs)
    {
      return true;
    }
    // S(u) = P - (h - z) m, with 0 < h - z for an image, and u within a bulge of S.
    const double least = std::max(cell.Low[2] - (height + rise), 0.0);
    const double most = cell.High[2] - (height - rise);
    if (!(most > 0.0))
    {
      return true; // the whole box is in front
    }
    Box next;
    for (int axis = 0; axis < 2; ++axis)
    {
      const double m0 = cell.Low[static_cast<std::size_t>(axis)];
      const double m1 = cell.High[static_cast<std::size_t>(axis)];
      const double pad = reach[axis] + this->Bulge;
      next.Low[axis] = at[axis] - pad - std::max(least * m1, most * m1);
      next.High[axis] = at[axis] + pad - std::min(least * m0, most * m0);
    }
    next.Low = glm::max(next.Low, box.Low);
    next.High = glm::min(next.High, box.High);
    if (!(next.Low.x <= next.High.x && next.Low.y <= next.High.y))
    {
      return true; // there is no sight point anywhere
    }
    const glm::dvec2 before = box.High - box.Low;
    const glm::dvec2 after = next.High - next.Low;
    if (!(after.x < Shrinks * before.x || after.y < Shrinks * before.y))
    {
      return false;
    }
    box = next;
  }
  return false;
}

}
