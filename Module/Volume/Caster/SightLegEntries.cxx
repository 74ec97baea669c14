// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Caster/SightLegEntries.h"

#include "Volume/Caster/TileCurve.h"
#include "Volume/Refracted/RayBundleEntries.h"

#include <algorithm>
#include <cmath>

namespace meniscus
{
namespace
{

constexpr int TileSize = RefractedRayTiles::TileSize;

constexpr TileCurve Curve;
static_assert(TileSize == BoundaryRaster::TileSize, "the same tiles");

/** Depths of a frame at which opaque objects end the rays of pixels. */
class OpaqueEnds
{
public:
  /** @param windowDepths one per pixel; null for none. */
  OpaqueEnds(const RayFrame& frame, const float* windowDepths)
    : Frame(frame)
    , WindowDepths(windowDepths)
  {
  }

  double At(std::int64_t pixel)
  {
    // Consecutive pixels mostly have the same depth, the background's.
    if (this->WindowDepths && this->WindowDepths[pixel] != this->Window)
    {
      this->Window = this->WindowDepths[pixel];
      this->End = this->Frame.DepthAt(2.0 * this->Window - 1.0);
    }
    return this->End;
  }

private:
  const RayFrame& Frame;
  const float* WindowDepths;
  /** The last window depth, in [0, 1], and the frame's. */
  float Window = -1.0f;
  double End = 1.0e+30;
};

}

//------------------------------------------------------------------------------
SightLegEntries::SightLegEntries(const FixedPointRays& rays,
  const std::vector<PacketVertex>& vertices, const std::vector<BoundaryFace>& boundary,
  const BoundaryTree* tree, const std::vector<RayClippingPlane>& clippingPlanes,
  const RayLegs& legs, const FrameOptics& optics, InstructionSet set, const RangeLoop& loop,
  int pitch, const BoundaryRaster::Refinement& refinement)
  : Rays(rays)
  , ClippingPlanes(clippingPlanes)
  , Legs(legs)
{
  static const std::vector<BoundaryFace> none;
  const bool isHidden =
    legs.GetNumberOfLegs() > 1 && this->EndBefore(BoxOf(*tree, rays.GetFrame()));
  this->Raster.Build(vertices, isHidden ? none : boundary, rays, loop, set, pitch, refinement);
  this->Frame.Set(rays, vertices, optics);
}

//------------------------------------------------------------------------------
/**
 * Sets the depths between which a pixel's ray is cast, and its length per depth.
 * @param end largest depth at which the ray may end.
 */
void SightLegEntries::Limit(int column, int row, double end, PacketRay& ray) const
{
  const glm::dvec2 fromCenter = this->Rays.FromCenter(column, row);
  double start = this->Rays.GetFrame().NearDepth;
  for (const RayClippingPlane& plane : this->ClippingPlanes)
  {
    ClipRay(plane, fromCenter, start, end);
  }
  ray.StartDepth = this->Rays.FromPivot(start);
  ray.EndDepth = this->Rays.FromPivot(end);
  ray.LengthPerDepth = this->Rays.GetLengthPerDepth(fromCenter);
}

//------------------------------------------------------------------------------
/** True if all rays that may come to the mesh end at the first interface, in front of it. */
bool SightLegEntries::EndBefore(const BoundsInFrame& mesh) const
{
  // Larger than the relative rounding error of vertices by their grid.
  constexpr double margin = 1.0 + 1.0e-6;
  const glm::dmat3& edges = mesh.HalfEdges;
  const double nearest = mesh.Center.z -
    margin * (std::fabs(edges[0].z) + std::fabs(edges[1].z) + std::fabs(edges[2].z));
  for (int tile = 0; tile < this->Legs.GetNumberOfTiles(); ++tile)
  {
    if (this->ReachDepth(tile, nearest))
    {
      return false;
    }
  }
  return true;
}

//------------------------------------------------------------------------------
/** True if a ray of a tile that may come to the mesh reaches the depth before the interface. */
bool SightLegEntries::ReachDepth(int tile, double depth) const
{
  // An entry is used if it is before the end, both in single precision.
  return this->Rays.FromPivot(depth) < this->Rays.FromPivot(this->Legs.GetFarthestEnd(tile));
}

//------------------------------------------------------------------------------
bool SightLegEntries::MayShow(int tile) const
{
  return !this->Raster.IsEmpty(tile) &&
    (this->Legs.GetNumberOfLegs() == 1 || this->ReachDepth(tile, this->Raster.NearestDepth(tile)));
}

//------------------------------------------------------------------------------
/** Number, in the image, of the pixel of a ray of a tile; of the ray itself if a pixel has one. */
std::int64_t SightLegEntries::PixelOf(const TileLeg& leg, int column, int row) const
{
  const int across = leg.RaysAcross;
  return across == 1
    ? std::int64_t{ row } * this->Rays.GetWidth() + column
    : std::int64_t{ row / across } * (this->Rays.GetWidth() / across) + column / across;
}

//------------------------------------------------------------------------------
/** Sets up a ray for each pixel with an entry and a non-empty depth range. */
void SightLegEntries::TakeRays(
  const TileLeg& leg, const RefractedRay* next, JoinedRays& joined, Workspace& workspace) const
{
  const EntryLists& entries = workspace.Raster.Lists;
  LegBatch& batch = workspace.Batch;
  OpaqueEnds ends(this->Rays.GetFrame(), leg.OpaqueDepth);
  // The rays of a square are cast together: they cross the same cells for longer than the rays of a
  // row.
  const std::size_t count = leg.Selected ? leg.Selected->size() : TileSize * TileSize;
  for (std::size_t i = 0; i < count; ++i)
  {
    const std::int32_t pixel = leg.Selected ? (*leg.Selected)[i] : Curve[i];
    const std::size_t listed = leg.Selected && !leg.IsListed ? i : static_cast<std::size_t>(pixel);
    if (entries.GetBegin(listed) == entries.GetBegin(listed + 1))
    {
      continue;
    }
    // Filled where it stays: a copy would wait for each of its numbers to be stored.
    PacketRay& ray = batch.Rays.emplace_back();
    const int column = leg.Box.Left + pixel % TileSize;
    const int row = leg.Box.Bottom + pixel / TileSize;
    const double end = ends.At(this->PixelOf(leg, column, row));
    this->Limit(column, row, next ? std::min(end, double{ next[pixel].Depth }) : end, ray);
    if (ray.StartDepth < ray.EndDepth)
    {
      BoundaryRaster::SetLine(workspace.Raster, listed, ray);
      ray.FirstEntry = entries.GetBegin(listed);
      ray.EndEntry = entries.GetBegin(listed + 1);
      LegBatch::Origin& origin = batch.Origins.emplace_back();
      origin.Pixel = pixel;
      origin.ReachesInterface = next && ray.EndDepth == this->Rays.FromPivot(next[pixel].Depth);
    }
    else
    {
      batch.Rays.pop_back();
      // The sight point may be inside the mesh all the same.
      joined.SetEnd(pixel, PacketResult::Somewhere);
    }
  }
  batch.Entries = entries.GetEntries().data();
}

//------------------------------------------------------------------------------
void SightLegEntries::Collect(
  const TileLeg& leg, const PacketJob&, JoinedRays& joined, Workspace& workspace) const
{
  workspace.Batch.Clear();
  workspace.IsTaken = false;
  const RefractedRay* next =
    this->Legs.GetNumberOfLegs() > 1 ? this->Legs.GetTile(1, leg.Tile) : nullptr;
  if (this->MayShow(leg.Tile))
  {
    if (leg.Selected && !leg.IsListed)
    {
      this->Raster.CollectEntries(leg.Tile, *leg.Selected, workspace.Raster);
    }
    else if (!leg.IsListed)
    {
      this->Raster.CollectEntries(leg.Tile, workspace.Raster);
    }
    this->TakeRays(leg, next, joined, workspace);
  }
}

//------------------------------------------------------------------------------
const LegBatch* SightLegEntries::NextBatch(int, Workspace& workspace) const
{
  const bool isTaken = workspace.IsTaken;
  workspace.IsTaken = true;
  return isTaken || workspace.Batch.Rays.empty() ? nullptr : &workspace.Batch;
}

}
