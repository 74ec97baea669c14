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

#include <algorithm>
#include <cmath>

namespace meniscus
{
namespace
{

/** A ray through an edge meets both of its patches, up to what Newton's method leaves. */
constexpr double Border = 1e-8;

/** Of Newton's method, in facets: what is left, its square, is far below what the walk resolves. */
constexpr double LastStep = 1e-5;

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
  glm::dvec3 Normal{ 0.0 };
};

//------------------------------------------------------------------------------
bool MembraneSight::View::operator==(const View& o) const
{
  const RayFrame& a = this->Frame;
  const RayFrame& b = o.Frame;
  return a.RowX == b.RowX && a.RowY == b.RowY && a.RowDepth == b.RowDepth && a.Origin == b.Origin &&
    a.Slope == b.Slope && a.ViewToWorld == b.ViewToWorld && this->Width == o.Width &&
    this->Height == o.Height && this->Center == o.Center && this->EyeDepth == o.EyeDepth &&
    this->Exterior == o.Exterior && this->Interior == o.Interior;
}

/** Cuts rays with one patch, row by row. */
class MembraneSight::FacetTracer
{
public:
  explicit FacetTracer(const CurvedPatch& patch)
    : Patch(patch)
  {
    const glm::dvec3 u = patch.corner[1] - patch.corner[0];
    const glm::dvec3 v = patch.corner[2] - patch.corner[0];
    this->Normal = glm::cross(u, v);
    const double squared = glm::dot(this->Normal, this->Normal);
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

  void BeginRow() { this->Correction = glm::dvec2(0.0); }

  /** Whether the ray meets the patch; `depth` along it, and the normal, not normalised. */
  bool Meet(const glm::dvec3& start, const glm::dvec3& direction, double& depth, glm::dvec3& normal)
  {
    const glm::dvec3 toCorner = this->Patch.corner[0] - start;
    const double along = glm::dot(this->Normal, direction);
    const double flat = glm::dot(this->Normal, toCorner) / along;
    const glm::dvec3 inPlane = flat * direction - toCorner;
    glm::dvec2 b(glm::dot(inPlane, this->ByX), glm::dot(inPlane, this->ByY));
    if (this->IsFlat)
    {
      depth = flat;
      normal = this->Patch.GetNormal(b);
      return FindOutside(b).least >= -Border;
    }
    // A point of the patch lies within the bulge of a point of the facet; the ray through it meets
    // the facet's plane within bulge (1 + tangent of the angle of incidence) of that.
    const double length = glm::length(direction);
    const double secant = glm::length(this->Normal) * length / std::fabs(along);
    if (!(FindOutside(b).least >= -this->Overhang * (1.0 + secant) - Border))
    {
      return false;
    }
    const glm::dvec2 first = b;
    b += this->Correction;
    const double scale = this->Size / length;
    double l = 0.0;
    if (!MeetPatch(
          this->Patch, { start + flat * direction, scale * direction }, LastStep, b, l, normal) ||
      !(FindOutside(b).least >= -Border))
    {
      return false;
    }
    this->Correction = b - first;
    depth = flat + l * scale;
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
  glm::dvec3 Normal;
  /** Gradients of the barycentric coordinates in the facet's plane. */
  glm::dvec3 ByX;
  glm::dvec3 ByY;
  double Size;
  double Overhang;
  bool IsFlat;
  /** By how much patch and facet were met apart in the last pixel. */
  glm::dvec2 Correction{ 0.0 };
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
/** Pixels whose rays may meet the facet's patch. */
MembraneSight::Box MembraneSight::BoxOf(
  const Membrane& surface, const CurvedPatches& patches, std::int32_t facet) const
{
  const CurvedPatch patch = patches.GetPatch(facet);
  const double bulge = BoundBulge(patch);
  const Box whole{ 0, this->Of.Width, 0, this->Of.Height };
  const Box none{ 0, 0, 0, 0 };
  glm::dvec2 lower(1e30);
  glm::dvec2 upper(-1e30);
  int behind = 0;
  for (const glm::dvec3& corner : patch.corner)
  {
    const glm::dvec3 place =
      this->WorldToFrame * (corner + (surface.GetOrigin() - this->Of.Center));
    // What a ball of the world may be in the frame; two opposite corners of its cube, and the rest.
    glm::dvec3 reach(0.0);
    for (int axis = 0; axis < 3; ++axis)
    {
      reach[axis] = bulge * glm::length(glm::row(this->WorldToFrame, axis));
    }
    behind += place.z + reach.z <= this->Of.EyeDepth ? 1 : 0;
    if (!(place.z - reach.z > this->Of.EyeDepth))
    {
      lower = glm::dvec2(-1e30); // seen without bounds
      continue;
    }
    for (int c = 0; c < (bulge > 0.0 ? 8 : 1); ++c)
    {
      const glm::dvec3 sign(c & 1 ? 1.0 : -1.0, c & 2 ? 1.0 : -1.0, c & 4 ? 1.0 : -1.0);
      glm::dvec2 pixel;
      if (!this->PixelOf(place + sign * reach, pixel))
      {
        lower = glm::dvec2(-1e30);
        continue;
      }
      lower = glm::min(lower, pixel);
      upper = glm::max(upper, pixel);
    }
  }
  if (behind == 3)
  {
    return none;
  }
  if (lower.x <= -1e30)
  {
    return whole;
  }
  const auto clamped = [](double value, int size)
  { return static_cast<int>(std::min(std::max(value, 0.0), static_cast<double>(size))); };
  const glm::dvec2 center(0.5 * whole.Right, 0.5 * whole.Top);
  // Pixel p has its centre at p + 0.5; one more on each side for rounding.
  return { clamped(lower.x + center.x - 1.5, whole.Right),
    clamped(upper.x + center.x + 1.5, whole.Right), clamped(lower.y + center.y - 1.5, whole.Top),
    clamped(upper.y + center.y + 1.5, whole.Top) };
}

//------------------------------------------------------------------------------
void MembraneSight::SortFacets(const std::vector<Box>& boxes)
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
  for (const Box& box : boxes)
  {
    forTilesOf(box, [this](std::size_t tile) { ++this->TileBegin[tile + 1]; });
  }
  for (std::size_t tile = 0; tile + 1 < this->TileBegin.size(); ++tile)
  {
    this->TileBegin[tile + 1] += this->TileBegin[tile];
  }
  this->FacetOfSlot.resize(static_cast<std::size_t>(this->TileBegin.back()));
  std::vector<std::int32_t> next(this->TileBegin.begin(), this->TileBegin.end() - 1);
  for (std::size_t f = 0; f < boxes.size(); ++f)
  {
    forTilesOf(boxes[f],
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
  std::vector<Box> boxes(surface.GetFacets().size());
  loop(boxes.size(),
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t f = begin; f < end; ++f)
      {
        boxes[f] = this->BoxOf(surface, patches, static_cast<std::int32_t>(f));
      }
    });
  this->SortFacets(boxes);

  const std::size_t tiles = this->TileBegin.size() - 1;
  std::vector<glm::dvec3> directions(tiles, glm::dvec3(0.0));
  this->Tiles.resize(tiles);
  loop(tiles,
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t tile = begin; tile < end; ++tile)
      {
        this->TraceTile(patches, boxes, static_cast<int>(tile), directions[tile]);
      }
    });
  this->Seen = std::any_of(this->Tiles.begin(), this->Tiles.end(),
    [](const std::vector<BentRay>& tile) { return !tile.empty(); });
  glm::dvec3 sum(0.0);
  for (const glm::dvec3& direction : directions)
  {
    sum += direction;
  }
  const double length = glm::length(sum);
  this->MeanDirection = length > 0.0 ? sum / length : glm::dvec3(0.0);
}

//------------------------------------------------------------------------------
void MembraneSight::TraceTile(
  const CurvedPatches& patches, const std::vector<Box>& boxes, int tile, glm::dvec3& directions)
{
  std::vector<BentRay>& rays = this->Tiles[static_cast<std::size_t>(tile)];
  const int left = tile % this->Columns * TileSize;
  const int bottom = tile / this->Columns * TileSize;
  const glm::dvec2 toCenter(0.5 - 0.5 * this->Of.Width, 0.5 - 0.5 * this->Of.Height);
  const auto at = [&toCenter](const glm::dvec3(&ray)[3], int column, int row)
  { return ray[0] + (column + toCenter.x) * ray[1] + (row + toCenter.y) * ray[2]; };

  glm::dvec3 cornerStarts[4];
  glm::dvec3 cornerDirections[4];
  for (int corner = 0; corner < 4; ++corner)
  {
    const int column = left + (corner & 1 ? TileSize - 1 : 0);
    const int row = bottom + (corner & 2 ? TileSize - 1 : 0);
    cornerStarts[corner] = at(this->Start, column, row);
    cornerDirections[corner] = at(this->Direction, column, row);
  }

  std::vector<Hit> hits;
  const auto first = static_cast<std::size_t>(this->TileBegin[static_cast<std::size_t>(tile)]);
  const auto last = static_cast<std::size_t>(this->TileBegin[static_cast<std::size_t>(tile) + 1]);
  for (std::size_t slot = first; slot < last; ++slot)
  {
    const std::int32_t facet = this->FacetOfSlot[slot];
    const Box& box = boxes[static_cast<std::size_t>(facet)];
    FacetTracer tracer(patches.GetPatch(facet));
    if (tracer.IsBeside(cornerStarts, cornerDirections))
    {
      continue;
    }
    for (int row = std::max(bottom, box.Bottom); row < std::min(bottom + TileSize, box.Top); ++row)
    {
      tracer.BeginRow();
      for (int column = std::max(left, box.Left); column < std::min(left + TileSize, box.Right);
           ++column)
      {
        Hit hit;
        if (!tracer.Meet(at(this->Start, column, row), at(this->Direction, column, row), hit.Depth,
              hit.Normal) ||
          !(hit.Depth > this->Of.EyeDepth))
        {
          continue;
        }
        hits.resize(std::size_t{ TileSize } * TileSize);
        Hit& nearest = hits[static_cast<std::size_t>((row - bottom) * TileSize + column - left)];
        nearest = hit.Depth < nearest.Depth ? hit : nearest;
      }
    }
  }
  rays.assign(hits.size(), BentRay());
  for (std::size_t i = 0; i < hits.size(); ++i)
  {
    if (hits[i].Depth < std::numeric_limits<double>::infinity())
    {
      const auto pixel = static_cast<int>(i);
      rays[i] = this->Bend(
        at(this->Direction, left + pixel % TileSize, bottom + pixel / TileSize), hits[i]);
      directions += rays[i].GoesOn() ? glm::normalize(rays[i].Step) : glm::dvec3(0.0);
    }
  }
  if (rays.empty())
  {
    rays.shrink_to_fit();
  }
}

//------------------------------------------------------------------------------
/** @param direction  of the sight ray, world length per depth. */
BentRay MembraneSight::Bend(const glm::dvec3& direction, const Hit& hit) const
{
  const double length = glm::length(direction);
  const glm::dvec3 sight = direction / length;
  glm::dvec3 normal = glm::normalize(hit.Normal);
  // From behind, light goes from the interior into the exterior.
  const bool fromBehind = glm::dot(sight, normal) > 0.0;
  normal = fromBehind ? -normal : normal;
  const double ratio =
    fromBehind ? this->Of.Interior / this->Of.Exterior : this->Of.Exterior / this->Of.Interior;
  const RefractionRay refracted = ComputeRefractionRay(sight, normal, ratio);
  BentRay ray;
  ray.Depth = hit.Depth;
  if (refracted.kind != RayKind::TotallyReflected)
  {
    // What is drawn at a distance behind the sight point is that times n2 / n1 away (Eq. 2.4).
    ray.Step = this->WorldToFrame * (length / ratio * refracted.direction);
  }
  return ray;
}

}
