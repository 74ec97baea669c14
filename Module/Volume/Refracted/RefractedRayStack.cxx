// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Refracted/RefractedRayStack.h"

#include "Volume/Refracted/PatchIntersectionBatch.h"
#include "Volume/Refracted/RayBlock.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace meniscus
{
namespace
{

constexpr int TileSize = RefractedRayTiles::TileSize;
/** Side length, in pixels, of a block of rays that descend a tree together. */
constexpr int BlockSize = 8;
constexpr int RaysOfBlock = BlockSize * BlockSize;
static_assert(RaysOfBlock == RayBlock::Size, "the rays of a block fill the lanes");

constexpr double Infinity = std::numeric_limits<double>::infinity();

/** A leg of a ray along the world's axes, relative to the view's origin; see RayLeg. */
struct WorldLeg
{
  glm::dvec3 Place{ 0.0 };
  /** 0 if the ray does not go on. */
  glm::dvec3 Step{ 0.0 };
  /** Drawn depth of Place; infinite if the ray does not come to the interface of the leg. */
  double Depth = Infinity;

  bool GoesOn() const { return this->Step != glm::dvec3(0.0); }
};

/** Side of a surface from which a ray can meet it. */
enum class Side : signed char
{
  Exterior, // against the normals
  Interior,
  Either,
  Neither
};

/** Side of an interface on which its medium is that of a ray. */
Side SideOf(const StackedInterface& interface, double medium)
{
  if (medium == interface.Exterior)
  {
    return Side::Exterior;
  }
  return medium == interface.Interior ? Side::Interior : Side::Neither;
}

/** The sign of the product of a ray's direction and the normal, for rays from that side. */
double FacingOf(Side side)
{
  return side == Side::Either ? 0.0 : (side == Side::Exterior ? -1.0 : 1.0);
}

/** True if a product of a ray's direction and the normal has the sign, or if that is 0. */
bool HasSign(double product, double sign)
{
  return sign == 0.0 || sign * product > 0.0;
}

}

/** Rays of a block of pixels, and all their legs. */
struct RefractedRayStack::Block
{
  explicit Block(std::size_t interfaces)
    : Legs(interfaces + 1)
  {
  }

  int Count = 0;
  /** Number of each ray's pixel in the tile. */
  std::array<int, RaysOfBlock> Pixels;
  std::vector<std::array<WorldLeg, RaysOfBlock>> Legs;
  /** Index of refraction of the medium that the ray is in, from leg 1 on. */
  std::array<double, RaysOfBlock> Media;

  /** Rays that may meet the present interface: their numbers and nearest intersections. */
  RayBlock Lanes;
  std::array<int, RaysOfBlock> Numbers;
  std::array<MembraneHit, RaysOfBlock> Hits;
};

//------------------------------------------------------------------------------
void RefractedRayStack::Clear()
{
  this->Interfaces.clear();
  this->Rays.clear();
  this->Sums = Counts();
  this->MeanDirection = glm::dvec3(0.0);
}

//------------------------------------------------------------------------------
std::int64_t RefractedRayStack::GetBytes() const
{
  std::int64_t bytes = 0;
  for (const RefractedRayTiles& tiles : this->Rays)
  {
    bytes += tiles.GetBytes();
  }
  return bytes;
}

//------------------------------------------------------------------------------
void RefractedRayStack::Build(
  const std::vector<StackedInterface>& interfaces, const View& view, const RangeLoop& loop)
{
  this->Interfaces = interfaces;
  this->Of = view;
  this->Columns = (view.Width + TileSize - 1) / TileSize;
  const int rows = (view.Height + TileSize - 1) / TileSize;
  const glm::dmat3& toWorld = view.Frame.ViewToWorld;
  this->WorldToFrame = glm::inverse(toWorld);
  const glm::dmat3 edges = toWorld * view.Mesh.HalfEdges;
  this->MeshCenter = toWorld * view.Mesh.Center;
  this->MeshHalf = SightMargin * (glm::abs(edges[0]) + glm::abs(edges[1]) + glm::abs(edges[2]));

  const auto tiles = static_cast<std::size_t>(this->Columns) * static_cast<std::size_t>(rows);
  this->Rays.resize(interfaces.size());
  for (RefractedRayTiles& rays : this->Rays)
  {
    rays.Resize(tiles);
  }
  std::vector<TileSum> sums(tiles);
  loop(tiles,
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t tile = begin; tile < end; ++tile)
      {
        sums[tile] = this->TraceTile(static_cast<int>(tile));
      }
    });
  this->Sums = Counts();
  glm::dvec3 sum(0.0);
  for (const TileSum& tile : sums)
  {
    sum += tile.Directions;
    this->Sums.Missing += tile.Rays.Missing;
    this->Sums.Mismatched += tile.Rays.Mismatched;
    this->Sums.Reflected += tile.Rays.Reflected;
    this->Sums.Undecided += tile.Rays.Undecided;
  }
  const double length = glm::length(sum);
  this->MeanDirection = length > 0.0 ? sum / length : glm::dvec3(0.0);
}

//------------------------------------------------------------------------------
RefractedRayStack::TileSum RefractedRayStack::TraceTile(int tile)
{
  TileSum sum;
  const int left = tile % this->Columns * TileSize;
  const int bottom = tile / this->Columns * TileSize;
  for (RefractedRayTiles& rays : this->Rays)
  {
    rays.ChangeTile(tile).assign(RefractedRayTiles::RaysOfTile, RefractedRay());
  }
  Block block(this->Interfaces.size());
  for (int row = 0; row < TileSize; row += BlockSize)
  {
    for (int column = 0; column < TileSize; column += BlockSize)
    {
      this->StartBlock(left + column, bottom + row, block);
      for (std::size_t k = 0; k < this->Interfaces.size(); ++k)
      {
        this->MeetInterface(k, block, sum.Rays);
        this->RefractBlock(k, block, sum.Rays);
      }
      this->EndRaysBesideMesh(block);
      this->StoreBlock(block, tile, sum.Directions);
    }
  }
  for (RefractedRayTiles& tiles : this->Rays)
  {
    std::vector<RefractedRay>& rays = tiles.ChangeTile(tile);
    if (std::none_of(
          rays.begin(), rays.end(), [](const RefractedRay& ray) { return ray.MeetsInterface(); }))
    {
      rays = std::vector<RefractedRay>();
    }
  }
  return sum;
}

//------------------------------------------------------------------------------
/** Sets leg 0 of the rays of a block; left and bottom are its first pixel. */
void RefractedRayStack::StartBlock(int left, int bottom, Block& block) const
{
  const RayFrame& frame = this->Of.Frame;
  for (auto& legs : block.Legs)
  {
    legs.fill(WorldLeg());
  }
  block.Count = 0;
  for (int row = bottom; row < std::min(bottom + BlockSize, this->Of.Height); ++row)
  {
    for (int column = left; column < std::min(left + BlockSize, this->Of.Width); ++column)
    {
      const double i = column + 0.5 - 0.5 * this->Of.Width;
      const double j = row + 0.5 - 0.5 * this->Of.Height;
      const auto ray = static_cast<std::size_t>(block.Count++);
      block.Pixels[ray] = row % TileSize * TileSize + column % TileSize;
      block.Legs[0][ray] = { frame.ViewToWorld * glm::dvec3(frame.Origin.At(i, j), 0.0),
        frame.ViewToWorld * glm::dvec3(frame.Slope.At(i, j), 1.0), 0.0 };
    }
  }
}

//------------------------------------------------------------------------------
/** Adds the rays of a block that may meet interface `number`, and ends those that cannot. */
void RefractedRayStack::AddLanes(std::size_t number, Block& block, Counts& sums) const
{
  const StackedInterface& interface = this->Interfaces[number];
  const bool isFirst = number == 0;
  const glm::dvec3 toSurface = this->Of.Center - interface.Surface->GetOrigin();
  RayBlock& lanes = block.Lanes;
  lanes.Count = 0;
  for (int ray = 0; ray < block.Count; ++ray)
  {
    const auto r = static_cast<std::size_t>(ray);
    WorldLeg& leg = block.Legs[number][r];
    const Side side = isFirst ? Side::Either : SideOf(interface, block.Media[r]);
    if (leg.GoesOn() && side == Side::Neither)
    {
      leg.Step = glm::dvec3(0.0);
      ++sums.Missing;
      ++sums.Mismatched;
    }
    if (leg.GoesOn())
    {
      const auto lane = static_cast<std::size_t>(lanes.Count);
      block.Numbers[lane] = ray;
      block.Hits[lane] = MembraneHit();
      lanes.Add(leg.Place + toSurface, leg.Step, isFirst ? this->Of.EyeDepth : 0.0, FacingOf(side));
    }
  }
  CompleteRays(this->Set, lanes);
}

//------------------------------------------------------------------------------
/** Intersects leg `number` of the rays with interface `number`, and ends legs that miss it. */
void RefractedRayStack::MeetInterface(std::size_t number, Block& block, Counts& sums) const
{
  this->AddLanes(number, block, sums);
  RayBlock& lanes = block.Lanes;
  if (lanes.Count == 0)
  {
    return;
  }
  const StackedInterface& interface = this->Interfaces[number];
  const double rayLength = lanes.Length[0];
  const double first = lanes.First[0];
  bool isNearer = false;
  const auto keepNearest = [&](std::int32_t index, const MembraneHit& hit)
  {
    const auto lane = static_cast<std::size_t>(index);
    const double facing = glm::dot(lanes.GetDirection(index), hit.Normal);
    if (HasSign(facing, lanes.Facing[lane]) && hit.Depth > lanes.First[lane] &&
      hit.Depth < lanes.Last[lane])
    {
      block.Hits[lane] = hit;
      lanes.Last[lane] = hit.Depth;
      isNearer = true;
    }
  };
  double farthest = Infinity;
  interface.Tree->GetBoxes().Visit(
    lanes.GetTube(first), farthest,
    [this, &lanes](const AxisBox& box) { return MeetsBox(box, this->Set, lanes); },
    [&](std::int32_t facet, const TubeRange&)
    {
      const PatchIntersector tracer(interface.Patches->GetPatch(facet), rayLength, this->Set);
      isNearer = false;
      tracer.Meet(lanes, keepNearest);
      sums.Undecided += tracer.GetNumberOfUndecidedRays();
      // Parameters of the tube count from its beginning.
      farthest = isNearer ? lanes.GetFarthest() - first : farthest;
      return farthest;
    });
  for (int lane = 0; lane < lanes.Count && number > 0; ++lane)
  {
    if (lanes.Last[lane] == Infinity)
    {
      const auto ray = static_cast<std::size_t>(block.Numbers[static_cast<std::size_t>(lane)]);
      block.Legs[number][ray].Step = glm::dvec3(0.0);
      ++sums.Missing;
    }
  }
}

//------------------------------------------------------------------------------
/** Begins the next leg of the rays that meet interface `number`. */
void RefractedRayStack::RefractBlock(std::size_t number, Block& block, Counts& sums) const
{
  const StackedInterface& interface = this->Interfaces[number];
  const RayBlock& lanes = block.Lanes;
  FreeRayBatch batch;
  for (int lane = 0; lane < lanes.Count; ++lane)
  {
    const MembraneHit& hit = block.Hits[static_cast<std::size_t>(lane)];
    if (hit.Depth < Infinity)
    {
      for (int axis = 0; axis < 3; ++axis)
      {
        batch.Normal[axis][batch.Count] = hit.Normal[axis];
      }
      batch.Add(lane, lanes.GetStart(lane), lanes.GetDirection(lane));
    }
  }
  Refract(FreeRays(), interface.Exterior / interface.Interior, this->Set, batch);
  for (int i = 0; i < batch.Count; ++i)
  {
    const auto lane = static_cast<std::size_t>(batch.Index[i]);
    const auto ray = static_cast<std::size_t>(block.Numbers[lane]);
    const WorldLeg& before = block.Legs[number][ray];
    WorldLeg& leg = block.Legs[number + 1][ray];
    const double depth = block.Hits[lane].Depth;
    leg.Place = before.Place + depth * before.Step;
    leg.Depth = before.Depth + depth;
    if (batch.Refracted[i] != 0.0)
    {
      leg.Step = { batch.Normal[0][i], batch.Normal[1][i], batch.Normal[2][i] };
      block.Media[ray] = batch.Refracted[i] > 0.0 ? interface.Interior : interface.Exterior;
    }
    else
    {
      sums.Reflected += number > 0 ? 1 : 0;
    }
  }
}

//------------------------------------------------------------------------------
/** True if the line from `place` to `place` + `end` * `step` may meet the mesh. */
bool RefractedRayStack::MeetsMesh(const glm::dvec3& place, const glm::dvec3& step, double end) const
{
  double first = 0.0;
  double last = end;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double offset = this->MeshCenter[axis] - place[axis];
    const double half = this->MeshHalf[axis];
    if (step[axis] == 0.0)
    {
      last = std::fabs(offset) <= half ? last : -1.0;
      continue;
    }
    const double inverse = 1.0 / step[axis];
    const double a = (offset - half) * inverse;
    const double b = (offset + half) * inverse;
    first = std::max(first, std::min(a, b));
    last = std::min(last, std::max(a, b));
  }
  return first <= last;
}

//------------------------------------------------------------------------------
/** Ends rays at the last interface behind which they may meet the mesh. */
void RefractedRayStack::EndRaysBesideMesh(Block& block) const
{
  for (std::size_t ray = 0; ray < static_cast<std::size_t>(block.Count); ++ray)
  {
    for (std::size_t k = block.Legs.size() - 1; k > 0; --k)
    {
      WorldLeg& leg = block.Legs[k][ray];
      const double end = k + 1 < block.Legs.size() ? block.Legs[k + 1][ray].Depth : Infinity;
      if (leg.GoesOn() && this->MeetsMesh(leg.Place, leg.Step, end - leg.Depth))
      {
        break;
      }
      leg.Step = glm::dvec3(0.0);
    }
  }
}

//------------------------------------------------------------------------------
/** @param directions sum to which the steps of the legs are added, in the frame of the view. */
void RefractedRayStack::StoreBlock(const Block& block, int tile, glm::dvec3& directions)
{
  for (std::size_t k = 0; k < this->Rays.size(); ++k)
  {
    std::vector<RefractedRay>& rays = this->Rays[k].ChangeTile(tile);
    for (std::size_t ray = 0; ray < static_cast<std::size_t>(block.Count); ++ray)
    {
      if (block.Legs[k][ray].GoesOn())
      {
        const WorldLeg& leg = block.Legs[k + 1][ray];
        const glm::dvec3 step = this->WorldToFrame * leg.Step;
        rays[static_cast<std::size_t>(block.Pixels[ray])] = { leg.Depth, step };
        directions += step;
      }
    }
  }
}

}
