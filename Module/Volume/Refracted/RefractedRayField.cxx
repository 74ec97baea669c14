// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Refracted/RefractedRayField.h"

#include "Refraction/Membrane/Optics.h"
#include "Refraction/Surface/CurveCrossings.h"
#include "Refraction/Tubes/RefractedRayBounds.h"

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

/** Side length in pixels of a block whose rays are bounded together. */
constexpr int BlockSize = 8;

bool operator==(const AffinePixelMap& a, const AffinePixelMap& b)
{
  return a.Base == b.Base && a.PerColumn == b.PerColumn && a.PerRow == b.PerRow;
}

}

//------------------------------------------------------------------------------
bool RefractedRayField::View::operator==(const View& o) const
{
  const RayFrame& a = this->Frame;
  const RayFrame& b = o.Frame;
  return a.RowX == b.RowX && a.RowY == b.RowY && a.RowDepth == b.RowDepth && a.Origin == b.Origin &&
    a.Slope == b.Slope && a.ViewToWorld == b.ViewToWorld && this->Width == o.Width &&
    this->Height == o.Height && this->Center == o.Center && this->EyeDepth == o.EyeDepth &&
    this->Mesh == o.Mesh;
}

/** Rays of a rectangle of pixels, relative to the membrane's origin. */
class RefractedRayField::PixelRays
{
public:
  /** Rays of a tile. */
  PixelRays(const RefractedRayField& sight, int tile)
    : PixelRays(sight,
        { tile % sight.Columns * TileSize, tile % sight.Columns * TileSize + TileSize,
          tile / sight.Columns * TileSize, tile / sight.Columns * TileSize + TileSize })
  {
  }
  PixelRays(const RefractedRayField& sight, const Box& box)
    : Left(box.Left)
    , Bottom(box.Bottom)
    , Rays(sight.Rays)
  {
    this->ToCenter = glm::dvec2(0.5 - 0.5 * sight.Of.Width, 0.5 - 0.5 * sight.Of.Height);
    const CornerRays corners = this->CornersOf(box.Left, box.Bottom, box.Right, box.Top);
    const auto& starts = corners.Starts;
    const auto& along = corners.Directions;
    // A place inside the frustum of the rays.
    const glm::dvec3 inside =
      0.5 * (starts[0] + starts[2]) + 0.5 * (sight.Of.EyeDepth + 1.0) * (along[0] + along[2]);
    for (int side = 0; side < 4; ++side)
    {
      // Plane through two rays, which meet in the eye or are parallel: of two points of the next
      // ray, the better conditioned one is used.
      const int next = (side + 1) % 4;
      const glm::dvec3 across = starts[next] - starts[side];
      const glm::dvec3 first = glm::cross(along[side], across);
      const glm::dvec3 second = glm::cross(along[side], across + along[next]);
      glm::dvec3 normal =
        glm::normalize(glm::dot(first, first) > glm::dot(second, second) ? first : second);
      normal = glm::dot(normal, inside - starts[side]) < 0.0 ? -normal : normal;
      this->Sides[side] = glm::dvec4(normal, -glm::dot(normal, starts[side]));
    }
  }

  /** Column and row from the image's centre. */
  double ColumnOf(int column) const { return column + this->ToCenter.x; }
  double RowOf(int row) const { return row + this->ToCenter.y; }

  /** Rays at the corners of a rectangle of pixels; right and top are exclusive. */
  CornerRays CornersOf(int left, int bottom, int right, int top) const
  {
    const int columns[4] = { left, right - 1, right - 1, left };
    const int rows[4] = { bottom, bottom, top - 1, top - 1 };
    CornerRays corners;
    for (int corner = 0; corner < 4; ++corner)
    {
      const double column = this->ColumnOf(columns[corner]);
      const double row = this->RowOf(rows[corner]);
      corners.Starts[corner] = this->Rays.StartOf(column, row);
      corners.Directions[corner] = this->Rays.DirectionOf(column, row);
    }
    return corners;
  }

  /** True if a ball is on the outer side of one of the rectangle's sides. */
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

private:
  const SightRays& Rays;
  glm::dvec2 ToCenter;
  glm::dvec4 Sides[4];
};

//------------------------------------------------------------------------------
std::int64_t RefractedRayField::GetBytes() const
{
  return static_cast<std::int64_t>(this->FacetsOfTiles.GetMemorySize());
}

//------------------------------------------------------------------------------
void RefractedRayField::PrepareRays(const Membrane& surface, const InterfaceMedia& media)
{
  const RayFrame& frame = this->Of.Frame;
  const glm::dmat3& toWorld = frame.ViewToWorld;
  this->WorldToFrame = glm::inverse(toWorld);
  const auto across = [&toWorld](const glm::dvec2& v) { return toWorld * glm::dvec3(v, 0.0); };
  this->Rays.Start[0] = this->Of.Center - surface.GetOrigin() + across(frame.Origin.Base);
  this->Rays.Start[1] = across(frame.Origin.PerColumn);
  this->Rays.Start[2] = across(frame.Origin.PerRow);
  this->Rays.Direction[0] = toWorld * glm::dvec3(frame.Slope.Base, 1.0);
  this->Rays.Direction[1] = across(frame.Slope.PerColumn);
  this->Rays.Direction[2] = across(frame.Slope.PerRow);

  const BoundsInFrame& mesh = this->Of.Mesh;
  const glm::dmat3 edges = toWorld * mesh.HalfEdges;
  this->Mesh.Center = this->Of.Center - surface.GetOrigin() + toWorld * mesh.Center;
  this->Mesh.Half = SightMargin * (glm::abs(edges[0]) + glm::abs(edges[1]) + glm::abs(edges[2]));
  this->Mesh.Ratio = media.Exterior / media.Interior;
}

//------------------------------------------------------------------------------
/**
 * Computes the pixel at which a place of the frame is seen, counted from the image's centre.
 * Returns false for places not in front of the eye.
 */
bool RefractedRayField::PixelOf(const glm::dvec3& place, glm::dvec2& pixel) const
{
  const AffinePixelMap& origin = this->Of.Frame.Origin;
  const AffinePixelMap& slope = this->Of.Frame.Slope;
  const glm::dvec2 column = origin.PerColumn + place.z * slope.PerColumn;
  const glm::dvec2 row = origin.PerRow + place.z * slope.PerRow;
  const glm::dvec2 rest = glm::dvec2(place) - origin.Base - place.z * slope.Base;
  const double determinant = column.x * row.y - column.y * row.x;
  pixel = glm::dvec2(rest.x * row.y - rest.y * row.x, column.x * rest.y - column.y * rest.x) /
    determinant;
  // Far pixels are outside of any image and would not fit an integer.
  return std::fabs(pixel.x) < 1e9 && std::fabs(pixel.y) < 1e9;
}

//------------------------------------------------------------------------------
/** Direction of the sight ray to a place. */
glm::dvec3 RefractedRayField::SightTo(const glm::dvec3& place) const
{
  const bool isParallel =
    this->Rays.Direction[1] == glm::dvec3(0.0) && this->Rays.Direction[2] == glm::dvec3(0.0);
  return isParallel ? this->Rays.Direction[0]
                    : place - this->Rays.Start[0] - this->Of.EyeDepth * this->Rays.Direction[0];
}

//------------------------------------------------------------------------------
/** True if rays that meet the patch may reach the mesh, in front of the membrane or behind it. */
bool RefractedRayField::MayShowMesh(const CurvedPatch& patch, double bulge) const
{
  const glm::dvec3 sights[3] = { this->SightTo(patch.Corner[0]), this->SightTo(patch.Corner[1]),
    this->SightTo(patch.Corner[2]) };
  const DirectionBox sight =
    BoundDirections((sights[0] + sights[1] + sights[2]) / 3.0, sights, 3, bulge);
  return this->Mesh.MayBeSeen(sight, BoundNormals(patch), patch.Corner, 3, bulge);
}

//------------------------------------------------------------------------------
/** Pixels whose rays may meet the facet's patch. */
RefractedRayField::SeenFacet RefractedRayField::See(const Membrane& surface,
  const CurvedPatches& patches, std::int32_t facet, const PixelRays& image) const
{
  const CurvedPatch patch = patches.GetPatch(facet);
  const double bulge = BoundBulge(patch);
  const glm::dvec3 center = (patch.Corner[0] + patch.Corner[1] + patch.Corner[2]) / 3.0;
  double radius = 0.0;
  for (const glm::dvec3& corner : patch.Corner)
  {
    radius = std::max(radius, bulge + glm::length(corner - center));
  }
  radius *= SightMargin;
  if (image.IsBeside(center, radius))
  {
    return SeenFacet();
  }
  bool isAtBorder = false;
  for (int corner = 0; corner < 3; ++corner)
  {
    isAtBorder = isAtBorder || patches.GetNeighbour(facet, corner) == CurvedPatches::NoFacet;
  }
  const double facing = glm::dot(this->SightTo(patch.Corner[0]),
    glm::cross(patch.Corner[1] - patch.Corner[0], patch.Corner[2] - patch.Corner[0]));
  SeenFacet seen{ { 0, this->Of.Width, 0, this->Of.Height }, true, isAtBorder,
    (facing > 0.0 ? 1 : 0) - (facing < 0.0 ? 1 : 0), false, center, radius };
  // Extents, in the frame, of a unit ball in world coordinates.
  glm::dvec3 reach(0.0);
  for (int axis = 0; axis < 3; ++axis)
  {
    reach[axis] = bulge * glm::length(glm::row(this->WorldToFrame, axis));
  }
  glm::dvec3 low(std::numeric_limits<double>::max());
  glm::dvec3 high(std::numeric_limits<double>::lowest());
  for (const glm::dvec3& corner : patch.Corner)
  {
    const glm::dvec3 place =
      this->WorldToFrame * (corner + (surface.GetOrigin() - this->Of.Center));
    low = glm::min(low, place - reach);
    high = glm::max(high, place + reach);
  }
  const bool isBehind = high.z <= this->Of.EyeDepth;
  seen.Unbounded = !(low.z > this->Of.EyeDepth);
  glm::dvec2 lower(std::numeric_limits<double>::max());
  glm::dvec2 upper(std::numeric_limits<double>::lowest());
  for (int c = 0; c < 8 && !seen.Unbounded; ++c)
  {
    glm::dvec2 pixel;
    seen.Unbounded = !this->PixelOf(
      glm::dvec3((c & 1 ? low : high).x, (c & 2 ? low : high).y, (c & 4 ? low : high).z), pixel);
    lower = glm::min(lower, pixel);
    upper = glm::max(upper, pixel);
  }
  if (isBehind)
  {
    seen.Pixels = { 0, 0, 0, 0 };
    return seen;
  }
  if (seen.Unbounded)
  {
    return seen;
  }
  const auto clamped = [](double value, int size)
  { return static_cast<int>(std::min(std::max(value, 0.0), static_cast<double>(size))); };
  const glm::dvec2 middle(0.5 * this->Of.Width, 0.5 * this->Of.Height);
  // Pixel p has its centre at p + 0.5; one more pixel on each side covers rounding.
  seen.Pixels = { clamped(lower.x + middle.x - 1.5, this->Of.Width),
    clamped(upper.x + middle.x + 1.5, this->Of.Width),
    clamped(lower.y + middle.y - 1.5, this->Of.Height),
    clamped(upper.y + middle.y + 1.5, this->Of.Height) };
  if (!seen.Pixels.IsEmpty())
  {
    seen.Matters = this->MayShowMesh(patch, bulge);
  }
  return seen;
}

//------------------------------------------------------------------------------
void RefractedRayField::SortFacets(const std::vector<SeenFacet>& facets)
{
  this->FacetsOfTiles.Set(static_cast<std::size_t>(this->Columns) * this->Rows,
    [this, &facets](const auto& visit)
    {
      for (std::size_t f = 0; f < facets.size(); ++f)
      {
        const Box& box = facets[f].Pixels;
        if (box.IsEmpty())
        {
          continue;
        }
        for (int row = box.Bottom / TileSize; row <= (box.Top - 1) / TileSize; ++row)
        {
          for (int column = box.Left / TileSize; column <= (box.Right - 1) / TileSize; ++column)
          {
            visit(
              static_cast<std::size_t>(row) * this->Columns + column, static_cast<std::int32_t>(f));
          }
        }
      }
    });
}

//------------------------------------------------------------------------------
void RefractedRayField::Build(
  const Interface& interface, const View& view, RefractedRayTiles& rays, const RangeLoop& loop)
{
  const Membrane& surface = interface.Surface->GetMembrane();
  const CurvedPatches& patches = interface.Surface->GetPatches();
  this->Of = view;
  this->Columns = (view.Width + TileSize - 1) / TileSize;
  this->Rows = (view.Height + TileSize - 1) / TileSize;
  this->PrepareRays(surface, interface.Media);
  std::vector<SeenFacet> facets(surface.GetFacets().size());
  const PixelRays image(*this, Box{ 0, this->Columns * TileSize, 0, this->Rows * TileSize });
  loop(facets.size(),
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t f = begin; f < end; ++f)
      {
        facets[f] = this->See(surface, patches, static_cast<std::int32_t>(f), image);
      }
    });
  this->SortFacets(facets);

  const std::size_t tiles = this->FacetsOfTiles.GetNumberOfGroups();
  std::vector<TileSum> sums(tiles);
  rays.Resize(tiles);
  loop(tiles,
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t tile = begin; tile < end; ++tile)
      {
        sums[tile] = this->TraceTile(patches, facets, static_cast<int>(tile), rays);
      }
    });
  glm::dvec3 sum(0.0);
  this->UndecidedRays = 0;
  this->StepBounds = AxisBox();
  for (const TileSum& tile : sums)
  {
    sum += tile.Directions;
    this->StepBounds.Add(tile.Steps);
    this->UndecidedRays += tile.Undecided;
  }
  sum = this->WorldToFrame * sum;
  const double length = glm::length(sum);
  this->MeanDirection = length > 0.0 ? sum / length : glm::dvec3(0.0);
}

//------------------------------------------------------------------------------
/**
 * Replaces the hits of rays that meet this facet before the facet found so far. Returns the number
 * of undecided rays.
 */
std::int64_t RefractedRayField::TraceFacet(const CurvedPatch& patch, const SeenFacet& seen,
  const PixelRays& rays, std::vector<MembraneHit>& hits) const
{
  const Box box{ std::max(rays.Left, seen.Pixels.Left),
    std::min(rays.Left + TileSize, seen.Pixels.Right), std::max(rays.Bottom, seen.Pixels.Bottom),
    std::min(rays.Bottom + TileSize, seen.Pixels.Top) };
  const PatchIntersector tracer(patch, glm::length(this->Rays.Direction[0]), this->Set);
  const bool isSmall = box.Right - box.Left <= BlockSize && box.Top - box.Bottom <= BlockSize;
  const int step = seen.Matters && !isSmall ? BlockSize : TileSize;
  for (int bottom = box.Bottom; bottom < box.Top; bottom += step)
  {
    for (int left = box.Left; left < box.Right; left += step)
    {
      const Box block{ left, std::min(left + step, box.Right), bottom,
        std::min(bottom + step, box.Top) };
      const CornerRays corners = rays.CornersOf(block.Left, block.Bottom, block.Right, block.Top);
      const PatchIntersector::FlatHits flat = tracer.MeetPlane(corners);
      if (!tracer.IsBeside(flat))
      {
        const bool matters = seen.Matters && (isSmall || tracer.Matters(flat, corners, this->Mesh));
        this->TraceBox(tracer, flat, block, matters, rays, hits);
      }
    }
  }
  return tracer.GetNumberOfUndecidedRays();
}

//------------------------------------------------------------------------------
void RefractedRayField::TraceBox(const PatchIntersector& tracer,
  const PatchIntersector::FlatHits& flat, const Box& box, bool matters, const PixelRays& rays,
  std::vector<MembraneHit>& hits) const
{
  const auto meet = [&](PatchIntersectionBatch& lanes)
  {
    tracer.Meet(this->Rays, matters, lanes,
      [&](std::int32_t index, const MembraneHit& hit)
      {
        hits.resize(RaysOfTile);
        MembraneHit& nearest = hits[static_cast<std::size_t>(index)];
        if (hit.Depth > this->Of.EyeDepth && hit.Depth < nearest.Depth)
        {
          nearest = hit;
        }
      });
    lanes.Count = 0;
  };
  PatchIntersectionBatch lanes;
  const PatchCoverage cover(flat, box.Right - box.Left, box.Top - box.Bottom);
  for (int row = box.Bottom; row < box.Top; ++row)
  {
    const PatchCoverage::Span span = cover.OfRow(row - box.Bottom);
    for (int column = box.Left + span.First; column < box.Left + span.End; ++column)
    {
      lanes.Add((row - rays.Bottom) * TileSize + column - rays.Left, rays.ColumnOf(column),
        rays.RowOf(row));
      if (lanes.Count == PatchIntersectionBatch::Size)
      {
        meet(lanes);
      }
    }
  }
  meet(lanes);
}

//------------------------------------------------------------------------------
/**
 * True if all rays of a tile meet the membrane before they reach the mesh. Facets seen from one
 * side, without an edge of the membrane among them, cover the whole tile if they cover any part of
 * it.
 */
bool RefractedRayField::HidesTile(const CurvedPatches& patches,
  const std::vector<SeenFacet>& facets, int tile, const PixelRays& rays) const
{
  const GroupedItems::Group own = this->FacetsOfTiles[static_cast<std::size_t>(tile)];
  int side = 0; // of the first facet
  for (const std::int32_t facet : own)
  {
    const SeenFacet& seen = facets[static_cast<std::size_t>(facet)];
    side = side == 0 ? seen.Side : side;
    if (seen.Matters || seen.IsAtBorder || seen.Unbounded || seen.Side == 0 || seen.Side != side)
    {
      return false;
    }
  }
  std::vector<MembraneHit> hits;
  for (const std::int32_t* facet = own.begin(); facet != own.end() && hits.empty(); ++facet)
  {
    this->TraceFacet(
      patches.GetPatch(*facet), facets[static_cast<std::size_t>(*facet)], rays, hits);
  }
  return !hits.empty();
}

//------------------------------------------------------------------------------
RefractedRayField::TileSum RefractedRayField::TraceTile(const CurvedPatches& patches,
  const std::vector<SeenFacet>& facets, int tile, RefractedRayTiles& all) const
{
  TileSum sum;
  const PixelRays tileRays(*this, tile);
  if (this->HidesTile(patches, facets, tile, tileRays))
  {
    all.ChangeTile(tile).assign(RaysOfTile, RefractedRay{ this->Of.EyeDepth, glm::dvec3(0.0) });
    all.SetSquares(tile, 0, 0);
    return sum;
  }
  std::vector<MembraneHit> hits;
  for (const std::int32_t facet : this->FacetsOfTiles[static_cast<std::size_t>(tile)])
  {
    const SeenFacet& seen = facets[static_cast<std::size_t>(facet)];
    if (!seen.Unbounded || !tileRays.IsBeside(seen.Center, seen.Radius))
    {
      sum.Undecided += this->TraceFacet(patches.GetPatch(facet), seen, tileRays, hits);
    }
  }
  const TileSquares goingOn = this->RefractTile(tileRays, hits, all.ChangeTile(tile), sum);
  all.SetSquares(tile, goingOn, goingOn);
  return sum;
}

//------------------------------------------------------------------------------
/**
 * Returns the squares with refracted rays.
 * @param sum gets the steps along the refracted rays.
 */
TileSquares RefractedRayField::RefractTile(const PixelRays& tile,
  const std::vector<MembraneHit>& hits, std::vector<RefractedRay>& rays, TileSum& sum) const
{
  TileSquares goingOn = 0;
  const auto bend = [&](PatchIntersectionBatch& lanes)
  {
    Refract(this->Rays, this->Mesh.Ratio, this->Set, lanes);
    for (int i = 0; i < lanes.Count; ++i)
    {
      if (lanes.Refracted[i] != 0.0)
      {
        const glm::dvec3 step(lanes.Normal[0][i], lanes.Normal[1][i], lanes.Normal[2][i]);
        const glm::dvec3 inFrame = this->WorldToFrame * step;
        rays[static_cast<std::size_t>(lanes.Index[i])].Step = inFrame;
        goingOn = static_cast<TileSquares>(goingOn | RefractedRayTiles::SquareOf(lanes.Index[i]));
        sum.Directions += step;
        sum.Steps.Add({ inFrame, inFrame });
      }
    }
    lanes.Count = 0;
  };
  rays.assign(hits.size(), RefractedRay());
  PatchIntersectionBatch lanes;
  for (std::size_t i = 0; i < hits.size(); ++i)
  {
    const MembraneHit& hit = hits[i];
    rays[i].Depth = hit.Depth;
    if (hit.Normal == glm::dvec3(0.0))
    {
      continue;
    }
    const int last = lanes.Count;
    const auto pixel = static_cast<int>(i);
    lanes.Add(pixel, tile.ColumnOf(tile.Left + pixel % TileSize),
      tile.RowOf(tile.Bottom + pixel / TileSize));
    for (int axis = 0; axis < 3; ++axis)
    {
      lanes.Normal[axis][last] = hit.Normal[axis];
    }
    if (lanes.Count == PatchIntersectionBatch::Size)
    {
      bend(lanes);
    }
  }
  bend(lanes);
  if (rays.empty())
  {
    rays.shrink_to_fit();
  }
  return goingOn;
}

}
