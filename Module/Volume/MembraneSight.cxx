// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/MembraneSight.h"

#include "Refraction/MappingPlace.h"
#include "Refraction/Optics.h"
#include "Refraction/PatchTube.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_access.hpp>
#include <glm/matrix.hpp>
#include <glm/vec4.hpp>

#include <algorithm>
#include <cmath>

namespace meniscus
{
namespace
{

/** A ray through an edge meets both of its patches, up to what Newton's method leaves. */
constexpr double Border = 1e-8;

/** Of Newton's method, in facets. What is left is its square times how much a patch bends, below
 * 1e-9: the walk resolves 4e-9 of the mesh. */
constexpr double LastStep = 1e-4;

/** More than rounding can change a distance by, in a view that shows anything of the ball. */
constexpr double BallMargin = 1.0 + 1e-6;

/** A patch that is off its facet by no more than the rounding of its corners is flat. */
constexpr double FlatBulge = 8.0 * std::numeric_limits<double>::epsilon();

bool operator==(const AffinePixelMap& a, const AffinePixelMap& b)
{
  return a.Base == b.Base && a.PerColumn == b.PerColumn && a.PerRow == b.PerRow;
}

}

/** The nearest place where a pixel's ray meets the membrane. */
struct MembraneSight::Hit
{
  double Depth = std::numeric_limits<double>::infinity();
  /** 0 where the ray does not matter. */
  glm::dvec3 Normal{ 0.0 };
  /** Beside the facet of a patch that does not matter: counts if there is nothing else. */
  bool IsBeside = false;

  bool IsBetterThan(const Hit& other) const
  {
    const bool isOnly = !(other.Depth < std::numeric_limits<double>::infinity());
    return isOnly ||
      (this->IsBeside == other.IsBeside ? this->Depth < other.Depth : other.IsBeside);
  }
};

//------------------------------------------------------------------------------
bool MembraneSight::View::operator==(const View& o) const
{
  const RayFrame& a = this->Frame;
  const RayFrame& b = o.Frame;
  return a.RowX == b.RowX && a.RowY == b.RowY && a.RowDepth == b.RowDepth && a.Origin == b.Origin &&
    a.Slope == b.Slope && a.ViewToWorld == b.ViewToWorld && this->Width == o.Width &&
    this->Height == o.Height && this->Center == o.Center && this->EyeDepth == o.EyeDepth &&
    this->Exterior == o.Exterior && this->Interior == o.Interior &&
    this->Mesh.Center == o.Mesh.Center && this->Mesh.HalfEdges == o.Mesh.HalfEdges;
}

/** The rays of a tile, relative to the membrane's origin. */
class MembraneSight::TileRays
{
public:
  TileRays(const MembraneSight& sight, int tile)
    : Start(sight.Start)
    , Direction(sight.Direction)
  {
    this->Left = tile % sight.Columns * TileSize;
    this->Bottom = tile / sight.Columns * TileSize;
    this->ToCenter = glm::dvec2(0.5 - 0.5 * sight.Of.Width, 0.5 - 0.5 * sight.Of.Height);
    for (int corner = 0; corner < 4; ++corner)
    {
      // In turn around the tile.
      const int column = this->Left + (corner == 1 || corner == 2 ? TileSize - 1 : 0);
      const int row = this->Bottom + (corner >= 2 ? TileSize - 1 : 0);
      this->Starts[corner] = this->StartOf(column, row);
      this->Directions[corner] = this->DirectionOf(column, row);
    }
    // A place that the tile sees.
    const glm::dvec3 inside = 0.5 * (this->Starts[0] + this->Starts[2]) +
      0.5 * (sight.Of.EyeDepth + 1.0) * (this->Directions[0] + this->Directions[2]);
    for (int side = 0; side < 4; ++side)
    {
      // Through two rays, of one eye or parallel: of two points of the next ray the better one.
      const glm::dvec3& origin = this->Starts[side];
      const glm::dvec3 across = this->Starts[(side + 1) % 4] - origin;
      const glm::dvec3& along = this->Directions[side];
      const glm::dvec3 first = glm::cross(along, across);
      const glm::dvec3 second = glm::cross(along, across + this->Directions[(side + 1) % 4]);
      glm::dvec3 normal =
        glm::normalize(glm::dot(first, first) > glm::dot(second, second) ? first : second);
      normal = glm::dot(normal, inside - origin) < 0.0 ? -normal : normal;
      this->Sides[side] = glm::dvec4(normal, -glm::dot(normal, origin));
    }
  }

  glm::dvec3 StartOf(int column, int row) const { return this->At(this->Start, column, row); }
  glm::dvec3 DirectionOf(int column, int row) const
  {
    return this->At(this->Direction, column, row);
  }

  /** Whether a ball is on the outer side of one of the tile's sides. */
  bool IsBeside(const glm::dvec3& center, double radius) const
  {
    for (const glm::dvec4& side : this->Sides)
    {
      if (glm::dot(side, glm::dvec4(center, 1.0)) < -radius)
      {
        return true;
      }
    }
    return false;
  }

  int Left;
  int Bottom;
  /** Of the corners. */
  glm::dvec3 Starts[4];
  glm::dvec3 Directions[4];

private:
  glm::dvec3 At(const glm::dvec3 (&ray)[3], int column, int row) const
  {
    return ray[0] + (column + this->ToCenter.x) * ray[1] + (row + this->ToCenter.y) * ray[2];
  }

  const glm::dvec3 (&Start)[3];
  const glm::dvec3 (&Direction)[3];
  glm::dvec2 ToCenter;
  glm::dvec4 Sides[4];
};

/** Cuts rays with one patch, row by row. */
class MembraneSight::FacetTracer
{
public:
  /** @param matters  else rays end on the flat facet: nothing of theirs is seen. */
  FacetTracer(const CurvedPatch& patch, bool matters)
    : Patch(patch)
    , Matters(matters)
  {
    const glm::dvec3 u = patch.corner[1] - patch.corner[0];
    const glm::dvec3 v = patch.corner[2] - patch.corner[0];
    this->Normal = glm::cross(u, v);
    const double squared = glm::dot(this->Normal, this->Normal);
    this->NormalLength = std::sqrt(squared);
    this->ByX = glm::cross(v, this->Normal) / squared;
    this->ByY = glm::cross(this->Normal, u) / squared;
    this->Size = std::sqrt(std::max({ glm::dot(u, u), glm::dot(v, v), glm::dot(u - v, u - v) }));
    // Barycentric coordinates change by 1 over an altitude.
    const double steepest = std::max(
      { glm::length(this->ByX), glm::length(this->ByY), glm::length(this->ByX + this->ByY) });
    const double bulge = BoundBulge(patch);
    this->IsFlat = bulge <= FlatBulge * this->Size;
    this->Overhang = bulge * steepest;
  }

  /** From where the row before began. @param direction  of the first ray. */
  void BeginRow(const glm::dvec3& direction)
  {
    this->Scale = this->Size / glm::length(direction);
    this->Correction = this->RowCorrection;
    this->Change = glm::dvec2(0.0);
    this->IsRowBegun = false;
  }

  /** Whether the ray meets the patch. */
  bool Meet(const glm::dvec3& start, const glm::dvec3& direction, Hit& hit)
  {
    const glm::dvec3 toCorner = this->Patch.corner[0] - start;
    const double along = glm::dot(this->Normal, direction);
    const double flat = glm::dot(this->Normal, toCorner) / along;
    const glm::dvec3 inPlane = flat * direction - toCorner;
    glm::dvec2 b(glm::dot(inPlane, this->ByX), glm::dot(inPlane, this->ByY));
    if (this->IsFlat)
    {
      hit.Depth = flat;
      hit.Normal = this->Matters ? this->Patch.GetNormal(b) : glm::dvec3(0.0);
      return FindOutside(b).least >= -Border;
    }
    // A point of the patch lies within the bulge of a point of the facet; the ray through it meets
    // the facet's plane within bulge (1 + tangent of the angle of incidence) of that.
    const double least = FindOutside(b).least;
    if (!(least >= -Border) &&
      !(least >=
        -this->Overhang * (1.0 + this->NormalLength * glm::length(direction) / std::fabs(along)) -
          Border))
    {
      return false;
    }
    if (!this->Matters)
    {
      // Flat, and so large that there is no gap to the curved ones about it.
      hit = { flat, glm::dvec3(0.0), least < -Border };
      return true;
    }
    const glm::dvec2 first = b;
    b += this->Correction + this->Change;
    double l = 0.0;
    if (!MeetPatch(this->Patch, { start + flat * direction, this->Scale * direction }, LastStep, b,
          l, hit.Normal) ||
      !(FindOutside(b).least >= -Border))
    {
      return false;
    }
    this->Change = this->IsRowBegun ? b - first - this->Correction : glm::dvec2(0.0);
    this->Correction = b - first;
    this->RowCorrection = this->IsRowBegun ? this->RowCorrection : this->Correction;
    this->IsRowBegun = true;
    hit.Depth = flat + l * this->Scale;
    return true;
  }

  /**
   * Whether a flat facet is beside all rays of a rectangle, given those of its corners: which side
   * of an edge a ray passes is the sign of an affine function of the pixel, about one eye.
   */
  bool IsBeside(const glm::dvec3 (&starts)[4], const glm::dvec3 (&directions)[4]) const
  {
    int outside[3] = { 0, 0, 0 };
    int front = 0;
    for (int corner = 0; corner < 4; ++corner)
    {
      const glm::dvec3 toCorner = this->Patch.corner[0] - starts[corner];
      const double along = glm::dot(this->Normal, directions[corner]);
      const glm::dvec3 inPlane =
        glm::dot(this->Normal, toCorner) / along * directions[corner] - toCorner;
      const double x = glm::dot(inPlane, this->ByX);
      const double y = glm::dot(inPlane, this->ByY);
      front += along > 0.0 ? 1 : 0;
      outside[0] += x < -Border ? 1 : 0;
      outside[1] += y < -Border ? 1 : 0;
      outside[2] += 1.0 - x - y < -Border ? 1 : 0;
    }
    return this->IsFlat && (front == 0 || front == 4) &&
      (outside[0] == 4 || outside[1] == 4 || outside[2] == 4);
  }

private:
  CurvedPatch Patch;
  bool Matters;
  glm::dvec3 Normal;
  /** Gradients of the barycentric coordinates in the facet's plane. */
  glm::dvec3 ByX;
  glm::dvec3 ByY;
  double Size;
  /** What is about as long along a ray as the facet. */
  double Scale = 1.0;
  double NormalLength;
  double Overhang;
  bool IsFlat;
  /** By how much patch and facet were met apart in the last pixel, and more so than before it. */
  glm::dvec2 Correction{ 0.0 };
  glm::dvec2 Change{ 0.0 };
  glm::dvec2 RowCorrection{ 0.0 };
  bool IsRowBegun = false;
};

//------------------------------------------------------------------------------
void MembraneSight::Clear()
{
  this->Seen = false;
  this->Tiles.clear();
}

//------------------------------------------------------------------------------
std::int64_t MembraneSight::GetBytes() const
{
  std::size_t bytes = (this->TileBegin.capacity() + this->FacetOfSlot.capacity()) * 4;
  for (const std::vector<BentRay>& tile : this->Tiles)
  {
    bytes += tile.capacity() * sizeof(BentRay);
  }
  return static_cast<std::int64_t>(bytes);
}

//------------------------------------------------------------------------------
void MembraneSight::PrepareRays(const Membrane& surface)
{
  const RayFrame& frame = this->Of.Frame;
  const glm::dmat3& toWorld = frame.ViewToWorld;
  this->WorldToFrame = glm::inverse(toWorld);
  const auto across = [&toWorld](const glm::dvec2& v) { return toWorld * glm::dvec3(v, 0.0); };
  this->Start[0] = this->Of.Center - surface.GetOrigin() + across(frame.Origin.Base);
  this->Start[1] = across(frame.Origin.PerColumn);
  this->Start[2] = across(frame.Origin.PerRow);
  this->Direction[0] = toWorld * glm::dvec3(frame.Slope.Base, 1.0);
  this->Direction[1] = across(frame.Slope.PerColumn);
  this->Direction[2] = across(frame.Slope.PerRow);

  const SeenBox& mesh = this->Of.Mesh;
  const glm::dmat3 edges = toWorld * mesh.HalfEdges;
  this->MeshCenter = this->Of.Center - surface.GetOrigin() + toWorld * mesh.Center;
  this->MeshHalf = BallMargin * (glm::abs(edges[0]) + glm::abs(edges[1]) + glm::abs(edges[2]));
}

//------------------------------------------------------------------------------
/** Where a place of the frame is seen, counted from the image's centre; false beside the eye. */
bool MembraneSight::PixelOf(const glm::dvec3& place, glm::dvec2& pixel) const
{
  const AffinePixelMap& origin = this->Of.Frame.Origin;
  const AffinePixelMap& slope = this->Of.Frame.Slope;
  const glm::dvec2 column = origin.PerColumn + place.z * slope.PerColumn;
  const glm::dvec2 row = origin.PerRow + place.z * slope.PerRow;
  const glm::dvec2 rest = glm::dvec2(place) - origin.Base - place.z * slope.Base;
  const double determinant = column.x * row.y - column.y * row.x;
  pixel = glm::dvec2(rest.x * row.y - rest.y * row.x, column.x * rest.y - column.y * rest.x) /
    determinant;
  // Far pixels are no pixels, and would not fit an integer.
  return std::fabs(pixel.x) < 1e9 && std::fabs(pixel.y) < 1e9;
}

//------------------------------------------------------------------------------
/** Whether the box about the mesh has a place of the tube: at some way along it, on all axes. */
bool MembraneSight::MeetsMesh(const TubeBounds& tube) const
{
  double first = 0.0;
  double last = std::numeric_limits<double>::infinity();
  const auto constrain = [&first, &last](double offset, double rate)
  {
    // offset + t rate >= 0
    first = rate > 0.0 ? std::max(first, -offset / rate) : first;
    last = rate < 0.0 ? std::min(last, -offset / rate) : last;
    last = rate == 0.0 && offset < 0.0 ? -1.0 : last;
  };
  for (int axis = 0; axis < 3; ++axis)
  {
    const double center = this->MeshCenter[axis];
    const double half = this->MeshHalf[axis];
    constrain(tube.startHigh[axis] + half - center, tube.directionHigh[axis]);
    constrain(center - tube.startLow[axis] + half, -tube.directionLow[axis]);
  }
  return first <= last;
}

//------------------------------------------------------------------------------
/**
 * Whether rays that meet the patch may come to the mesh, before it or behind it, by tubes around
 * them; true where there are none: without one eye, or where the patch does not face it.
 */
bool MembraneSight::MayShowMesh(const CurvedPatch& patch, double bulge) const
{
  if (this->Direction[1] == glm::dvec3(0.0) || this->Direction[2] == glm::dvec3(0.0))
  {
    return true;
  }
  const glm::dvec3 eye = this->Start[0] + this->Of.EyeDepth * this->Direction[0];
  double bends = 0.0;
  for (const glm::dvec3& bend : patch.bend)
  {
    bends += 0.25 * glm::length(bend); // b_i b_j is at most 1 / 4
  }
  TubeBounds toEye;
  for (const glm::dvec3& corner : patch.corner)
  {
    const glm::dvec3 sight = corner - eye;
    const double distance = glm::length(sight) + bulge;
    for (const glm::dvec3& normal : patch.normal)
    {
      if (!(glm::dot(sight, normal) + bulge * glm::length(normal) + bends * distance < 0.0))
      {
        return true;
      }
    }
    toEye.Add(corner - glm::dvec3(bulge), -sight - glm::dvec3(bulge));
    toEye.Add(corner + glm::dvec3(bulge), -sight + glm::dvec3(bulge));
  }
  const TubeBounds refracted =
    BoundRefractedRays(patch, eye, this->Of.Exterior / this->Of.Interior);
  return this->MeetsMesh(toEye) || !refracted.IsValid() || this->MeetsMesh(refracted);
}

//------------------------------------------------------------------------------
/** Pixels whose rays may meet the facet's patch. */
MembraneSight::SeenFacet MembraneSight::See(
  const Membrane& surface, const CurvedPatches& patches, std::int32_t facet) const
{
  const CurvedPatch patch = patches.GetPatch(facet);
  bool isAtBorder = false;
  for (int corner = 0; corner < 3; ++corner)
  {
    isAtBorder = isAtBorder || patches.GetNeighbour(facet, corner) == CurvedPatches::NoFacet;
  }
  const double bulge = BoundBulge(patch);
  SeenFacet seen{ { 0, this->Of.Width, 0, this->Of.Height }, true, false, glm::dvec3(0.0), 0.0 };
  // What a ball of the world may be in the frame.
  glm::dvec3 reach(0.0);
  for (int axis = 0; axis < 3; ++axis)
  {
    reach[axis] = bulge * glm::length(glm::row(this->WorldToFrame, axis));
  }
  glm::dvec2 lower(std::numeric_limits<double>::max());
  glm::dvec2 upper(-std::numeric_limits<double>::max());
  int behind = 0;
  for (const glm::dvec3& corner : patch.corner)
  {
    const glm::dvec3 place =
      this->WorldToFrame * (corner + (surface.GetOrigin() - this->Of.Center));
    behind += place.z + reach.z <= this->Of.EyeDepth ? 1 : 0;
    seen.Unbounded = seen.Unbounded || !(place.z - reach.z > this->Of.EyeDepth);
    for (int c = 0; c < (bulge > 0.0 ? 8 : 1) && !seen.Unbounded; ++c)
    {
      const glm::dvec3 sign(c & 1 ? 1.0 : -1.0, c & 2 ? 1.0 : -1.0, c & 4 ? 1.0 : -1.0);
      glm::dvec2 pixel;
      seen.Unbounded = !this->PixelOf(place + sign * reach, pixel);
      lower = glm::min(lower, pixel);
      upper = glm::max(upper, pixel);
    }
  }
  if (behind == 3)
  {
    seen.Pixels = { 0, 0, 0, 0 };
    return seen;
  }
  if (seen.Unbounded)
  {
    seen.Center = (patch.corner[0] + patch.corner[1] + patch.corner[2]) / 3.0;
    for (const glm::dvec3& corner : patch.corner)
    {
      seen.Radius = std::max(seen.Radius, bulge + glm::length(corner - seen.Center));
    }
    seen.Radius *= BallMargin;
    return seen;
  }
  seen.Matters = isAtBorder || this->MayShowMesh(patch, bulge);
  const auto clamped = [](double value, int size)
  { return static_cast<int>(std::min(std::max(value, 0.0), static_cast<double>(size))); };
  const glm::dvec2 center(0.5 * this->Of.Width, 0.5 * this->Of.Height);
  // Pixel p has its centre at p + 0.5; one more on each side for rounding.
  seen.Pixels = { clamped(lower.x + center.x - 1.5, this->Of.Width),
    clamped(upper.x + center.x + 1.5, this->Of.Width),
    clamped(lower.y + center.y - 1.5, this->Of.Height),
    clamped(upper.y + center.y + 1.5, this->Of.Height) };
  return seen;
}

//------------------------------------------------------------------------------
void MembraneSight::SortFacets(const std::vector<SeenFacet>& facets)
{
  const auto forTilesOf = [this](const Box& box, const auto& body)
  {
    if (box.Left >= box.Right || box.Bottom >= box.Top)
    {
      return;
    }
    for (int row = box.Bottom / TileSize; row <= (box.Top - 1) / TileSize; ++row)
    {
      for (int column = box.Left / TileSize; column <= (box.Right - 1) / TileSize; ++column)
      {
        body(static_cast<std::size_t>(row) * this->Columns + column);
      }
    }
  };
  this->TileBegin.assign(static_cast<std::size_t>(this->Columns) * this->Rows + 1, 0);
  for (const SeenFacet& facet : facets)
  {
    forTilesOf(facet.Pixels, [this](std::size_t tile) { ++this->TileBegin[tile + 1]; });
  }
  for (std::size_t tile = 0; tile + 1 < this->TileBegin.size(); ++tile)
  {
    this->TileBegin[tile + 1] += this->TileBegin[tile];
  }
  this->FacetOfSlot.resize(static_cast<std::size_t>(this->TileBegin.back()));
  std::vector<std::int32_t> next(this->TileBegin.begin(), this->TileBegin.end() - 1);
  for (std::size_t f = 0; f < facets.size(); ++f)
  {
    forTilesOf(facets[f].Pixels,
      [&](std::size_t tile) {
        this->FacetOfSlot[static_cast<std::size_t>(next[tile]++)] = static_cast<std::int32_t>(f);
      });
  }
}

//------------------------------------------------------------------------------
void MembraneSight::Build(
  const Membrane& surface, const CurvedPatches& patches, const View& view, const RangeLoop& loop)
{
  this->Of = view;
  this->Columns = (view.Width + TileSize - 1) / TileSize;
  this->Rows = (view.Height + TileSize - 1) / TileSize;
  this->PrepareRays(surface);
  std::vector<SeenFacet> facets(surface.GetFacets().size());
  loop(facets.size(),
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t f = begin; f < end; ++f)
      {
        facets[f] = this->See(surface, patches, static_cast<std::int32_t>(f));
      }
    });
  this->SortFacets(facets);

  const std::size_t tiles = this->TileBegin.size() - 1;
  std::vector<glm::dvec3> directions(tiles, glm::dvec3(0.0));
  this->Tiles.resize(tiles);
  loop(tiles,
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t tile = begin; tile < end; ++tile)
      {
        this->TraceTile(patches, facets, static_cast<int>(tile), directions[tile]);
      }
    });
  this->Seen = std::any_of(this->Tiles.begin(), this->Tiles.end(),
    [](const std::vector<BentRay>& tile) { return !tile.empty(); });
  glm::dvec3 sum(0.0);
  for (const glm::dvec3& direction : directions)
  {
    sum += direction;
  }
  sum = this->WorldToFrame * sum;
  const double length = glm::length(sum);
  this->MeanDirection = length > 0.0 ? sum / length : glm::dvec3(0.0);
}

//------------------------------------------------------------------------------
/** Puts in where a facet is met before what is there. */
void MembraneSight::TraceFacet(const CurvedPatch& patch, const SeenFacet& seen,
  const TileRays& rays, std::vector<Hit>& hits) const
{
  const Box& box = seen.Pixels;
  FacetTracer tracer(patch, seen.Matters);
  if (tracer.IsBeside(rays.Starts, rays.Directions))
  {
    return;
  }
  const int left = std::max(rays.Left, box.Left);
  const int right = std::min(rays.Left + TileSize, box.Right);
  for (int row = std::max(rays.Bottom, box.Bottom); row < std::min(rays.Bottom + TileSize, box.Top);
       ++row)
  {
    const glm::dvec3 start = rays.StartOf(left, row);
    const glm::dvec3 direction = rays.DirectionOf(left, row);
    tracer.BeginRow(direction);
    for (int column = left; column < right; ++column)
    {
      Hit hit;
      const double step = column - left;
      if (tracer.Meet(start + step * this->Start[1], direction + step * this->Direction[1], hit) &&
        hit.Depth > this->Of.EyeDepth)
      {
        hits.resize(RaysOfTile);
        Hit& nearest =
          hits[static_cast<std::size_t>((row - rays.Bottom) * TileSize + column - rays.Left)];
        nearest = hit.IsBetterThan(nearest) ? hit : nearest;
      }
    }
  }
}

//------------------------------------------------------------------------------
void MembraneSight::TraceTile(const CurvedPatches& patches, const std::vector<SeenFacet>& facets,
  int tile, glm::dvec3& directions)
{
  const TileRays tileRays(*this, tile);
  std::vector<Hit> hits;
  const auto first = static_cast<std::size_t>(this->TileBegin[static_cast<std::size_t>(tile)]);
  const auto last = static_cast<std::size_t>(this->TileBegin[static_cast<std::size_t>(tile) + 1]);
  for (std::size_t slot = first; slot < last; ++slot)
  {
    const std::int32_t facet = this->FacetOfSlot[slot];
    const SeenFacet& seen = facets[static_cast<std::size_t>(facet)];
    if (!seen.Unbounded || !tileRays.IsBeside(seen.Center, seen.Radius))
    {
      this->TraceFacet(patches.GetPatch(facet), seen, tileRays, hits);
    }
  }
  std::vector<BentRay>& rays = this->Tiles[static_cast<std::size_t>(tile)];
  rays.assign(hits.size(), BentRay());
  for (std::size_t i = 0; i < hits.size(); ++i)
  {
    if (hits[i].Depth < std::numeric_limits<double>::infinity())
    {
      const auto pixel = static_cast<int>(i);
      rays[i] = this->Bend(
        tileRays.DirectionOf(tileRays.Left + pixel % TileSize, tileRays.Bottom + pixel / TileSize),
        hits[i], directions);
    }
  }
  if (rays.empty())
  {
    rays.shrink_to_fit();
  }
}

//------------------------------------------------------------------------------
/**
 * @param direction   of the sight ray, world length per depth.
 * @param directions  the refracted unit direction is added, in the world.
 */
BentRay MembraneSight::Bend(
  const glm::dvec3& direction, const Hit& hit, glm::dvec3& directions) const
{
  BentRay ray;
  ray.Depth = hit.Depth;
  if (hit.Normal == glm::dvec3(0.0))
  {
    return ray;
  }
  const double length = glm::length(direction);
  const glm::dvec3 sight = direction / length;
  glm::dvec3 normal = glm::normalize(hit.Normal);
  // From behind, light goes from the interior into the exterior.
  const bool fromBehind = glm::dot(sight, normal) > 0.0;
  normal = fromBehind ? -normal : normal;
  const double ratio =
    fromBehind ? this->Of.Interior / this->Of.Exterior : this->Of.Exterior / this->Of.Interior;
  const RefractionRay refracted = ComputeRefractionRay(sight, normal, ratio);
  if (refracted.kind != RayKind::TotallyReflected)
  {
    // What is drawn at a distance behind the sight point is that times n2 / n1 away (Eq. 2.4).
    ray.Step = this->WorldToFrame * (length / ratio * refracted.direction);
    directions += refracted.direction;
  }
  return ray;
}

}
