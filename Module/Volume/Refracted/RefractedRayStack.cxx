// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Refracted/RefractedRayStack.h"

#include "Simd/LaneLoop.h"
#include "Volume/Refracted/PatchIntersectionBatch.h"
#include "Volume/Refracted/RayBlock.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <array>
#include <bitset>
#include <cmath>
#include <limits>
#include <optional>

namespace meniscus
{
namespace
{

constexpr int TileSize = RefractedRayTiles::TileSize;
/** Side length, in pixels, of a block of rays that descend a tree together. */
constexpr int BlockSize = RefractedRayTiles::SquareSize;
constexpr int BlocksOfTile = RefractedRayTiles::SquaresOfTile;
constexpr int RaysOfBlock = BlockSize * BlockSize;
static_assert(RaysOfBlock == RayBlock::Size, "the rays of a block fill the lanes");

/** First pixel of a block of a tile, from the tile's. */
glm::ivec2 FirstOfBlock(int number)
{
  return { RefractedRayTiles::ColumnOfSquare(number), RefractedRayTiles::RowOfSquare(number) };
}

constexpr double Infinity = std::numeric_limits<double>::infinity();

/** Legs of the rays of a block along the world's axes, relative to the view's origin; see RayLeg.
 */
struct WorldLegs
{
  double Place[3][RaysOfBlock];
  /** 0 if the ray does not go on. */
  double Step[3][RaysOfBlock];
  /** Drawn depth of Place; infinite if the ray does not come to the interface of the leg. */
  double Depth[RaysOfBlock];
  /** False if no leg behind this interface meets the mesh before the next one. */
  bool MayShow = false;

  void Clear()
  {
    this->MayShow = false;
    std::fill_n(this->Step[0], 3 * RaysOfBlock, 0.0);
    std::fill_n(this->Depth, RaysOfBlock, Infinity);
  }
  glm::dvec3 GetPlace(std::size_t ray) const
  {
    return { this->Place[0][ray], this->Place[1][ray], this->Place[2][ray] };
  }
  glm::dvec3 GetStep(std::size_t ray) const
  {
    return { this->Step[0][ray], this->Step[1][ray], this->Step[2][ray] };
  }
  void SetStep(std::size_t ray, const glm::dvec3& step)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      this->Step[axis][ray] = step[axis];
    }
  }
  bool GoesOn(std::size_t ray) const
  {
    return (this->Step[0][ray] != 0.0) | (this->Step[1][ray] != 0.0) | (this->Step[2][ray] != 0.0);
  }
};

/** Sight rays of pixels. */
struct SightLegs
{
  int Count;
  /** From the image's centre. */
  double Column[RaysOfBlock];
  double Row[RaysOfBlock];
  WorldLegs& Legs;
};

/** Loop bodies, for one ray each. */
struct SightKernel
{
  AffinePixelMap Origin;
  AffinePixelMap Slope;
  glm::dmat3 ViewToWorld;

  void operator()(SightLegs& sight, int i) const
  {
    const double column = sight.Column[i];
    const double row = sight.Row[i];
    const glm::dvec3 place = this->ViewToWorld * glm::dvec3(this->Origin.At(column, row), 0.0);
    const glm::dvec3 step = this->ViewToWorld * glm::dvec3(this->Slope.At(column, row), 1.0);
    for (int axis = 0; axis < 3; ++axis)
    {
      sight.Legs.Place[axis][i] = place[axis];
      sight.Legs.Step[axis][i] = step[axis];
    }
    sight.Legs.Depth[i] = 0.0;
  }
};

/** Legs behind one interface. */
struct EndedLegs
{
  int Count;
  double Place[3][RaysOfBlock];
  double Step[3][RaysOfBlock];
  /** Length in steps; infinite if there is no next interface. */
  double Length[RaysOfBlock];
  /** Not 0 if a further leg of the ray may meet the mesh. */
  std::int64_t Stays[RaysOfBlock];
  /** Not 0 if this leg may meet it. */
  std::int64_t Meets[RaysOfBlock];
};

/** Ends rays behind which there is nothing of the mesh. */
struct EndKernel
{
  glm::dvec3 MeshCenter;
  glm::dvec3 MeshHalf;

  /** True if the line from `place` to `place` + `end` * `step` may meet the mesh. */
  bool MeetsMesh(const glm::dvec3& place, const glm::dvec3& step, double end) const
  {
    double first = 0.0;
    double last = end;
    bool isBeside = false;
    for (int axis = 0; axis < 3; ++axis)
    {
      const double offset = this->MeshCenter[axis] - place[axis];
      const double half = this->MeshHalf[axis];
      const bool isAlong = step[axis] != 0.0;
      const double inverse = 1.0 / step[axis];
      const double a = (offset - half) * inverse;
      const double b = (offset + half) * inverse;
      first = isAlong ? std::max(first, std::min(a, b)) : first;
      last = isAlong ? std::min(last, std::max(a, b)) : last;
      isBeside |= !isAlong & !(std::fabs(offset) <= half);
    }
    return !isBeside & (first <= last);
  }
  void operator()(EndedLegs& rays, int i) const
  {
    const glm::dvec3 place(rays.Place[0][i], rays.Place[1][i], rays.Place[2][i]);
    const glm::dvec3 step(rays.Step[0][i], rays.Step[1][i], rays.Step[2][i]);
    const bool goesOn = (step.x != 0.0) | (step.y != 0.0) | (step.z != 0.0);
    const bool meets = goesOn & this->MeetsMesh(place, step, rays.Length[i]);
    const bool stays = (rays.Stays[i] != 0) | meets;
    rays.Stays[i] = stays ? 1 : 0;
    rays.Meets[i] = meets ? 1 : 0;
    for (int axis = 0; axis < 3; ++axis)
    {
      rays.Step[axis][i] = stays ? step[axis] : 0.0;
    }
  }
};

/** True if the ray of a lane meets the interface. */
bool IsHit(const RayBlock& lanes, int lane)
{
  return (lanes.Last[lane] < Infinity) & (lanes.Last[lane] > -Infinity);
}

/** Rays that are refracted at an interface, and their legs in front of it and behind it. */
struct NextLegs
{
  int Count;
  const RayBlock& Lanes;
  const FreeRayBatch& Refracted;
  const WorldLegs& Before;
  WorldLegs& Behind;
  double (&Media)[RaysOfBlock];
};

/** Begins the legs behind an interface. */
struct NextKernel
{
  double Exterior;
  double Interior;

  void operator()(NextLegs& rays, int i) const
  {
    const bool isHit = IsHit(rays.Lanes, i);
    const double depth = isHit ? rays.Lanes.Last[i] : 0.0;
    const double refracted = rays.Refracted.Refracted[i];
    const bool goesOn = isHit & (refracted != 0.0);
    for (int axis = 0; axis < 3; ++axis)
    {
      rays.Behind.Place[axis][i] = rays.Before.Place[axis][i] + depth * rays.Before.Step[axis][i];
      rays.Behind.Step[axis][i] = goesOn ? rays.Refracted.Normal[axis][i] : 0.0;
    }
    rays.Behind.Depth[i] = isHit ? rays.Before.Depth[i] + depth : Infinity;
    const double medium = refracted > 0.0 ? this->Interior : this->Exterior;
    rays.Media[i] = goesOn ? medium : rays.Media[i];
  }
};

/** Rays on their way to an interface. */
struct ArrivingLegs
{
  int Count;
  RayBlock& Lanes;
  const WorldLegs& Legs;
  const double (&Media)[RaysOfBlock];
  /** Not 0 for rays in a medium that the interface does not have. */
  std::int64_t (&Mismatched)[RaysOfBlock];
};

/** Sets the lanes of rays, for the side of the interface on which its medium is that of the ray. */
struct LaneKernel
{
  glm::dvec3 ToSurface;
  /** True if rays may come from either side, in any medium. */
  bool FromEitherSide;
  double FirstDepth;
  double Exterior;
  double Interior;

  void operator()(ArrivingLegs& rays, int i) const
  {
    const auto ray = static_cast<std::size_t>(i);
    const double medium = rays.Media[i];
    const bool isOutside = medium == this->Exterior;
    const bool fits = this->FromEitherSide | isOutside | (medium == this->Interior);
    const bool goesOn = rays.Legs.GoesOn(ray);
    for (int axis = 0; axis < 3; ++axis)
    {
      rays.Lanes.Start[axis][i] = rays.Legs.Place[axis][i] + this->ToSurface[axis];
      rays.Lanes.Direction[axis][i] = rays.Legs.Step[axis][i];
    }
    rays.Lanes.First[i] = this->FirstDepth;
    rays.Lanes.Last[i] = (goesOn & fits) ? Infinity : -Infinity;
    const double facing = isOutside ? -1.0 : 1.0;
    rays.Lanes.Facing[i] = this->FromEitherSide ? 0.0 : facing;
    rays.Mismatched[i] = (goesOn & !fits) ? 1 : 0;
  }
};

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
  std::vector<WorldLegs> Legs;
  /** Index of refraction of the medium that the ray is in, from leg 1 on. */
  double Media[RaysOfBlock] = {};

  /**
   * The rays on their way to the present interface, each up to its nearest intersection. Rays that
   * do not go there are replaced by one that does, and end in front of everything.
   */
  RayBlock Lanes;
  /** Normals at these intersections. */
  double Normals[3][RaysOfBlock] = {};
  /** Facets that the rays may meet. */
  BundleFacets Facets;

  /** Patches that earlier blocks of the tile met; a new patch takes the place of an older one. */
  struct KeptPatch
  {
    std::size_t Interface;
    std::int32_t Facet;
    PatchIntersector Tracer;
  };
  static constexpr std::uint32_t KeptPatches = 64;
  std::vector<std::optional<KeptPatch>> Kept{ KeptPatches };

  /** Intersector of a patch, for rays of that length. */
  const PatchIntersector& GetTracer(const StackedInterface& interface, std::size_t number,
    std::int32_t facet, double rayLength, InstructionSet set)
  {
    const auto place = static_cast<std::uint32_t>(facet) + 17u * static_cast<std::uint32_t>(number);
    std::optional<KeptPatch>& kept = this->Kept[place % KeptPatches];
    if (kept && kept->Interface == number && kept->Facet == facet)
    {
      kept->Tracer.SetRayLength(rayLength);
    }
    else
    {
      kept.emplace(KeptPatch{
        number, facet, PatchIntersector(interface.Patches->GetPatch(facet), rayLength, set) });
    }
    return kept->Tracer;
  }
};

//------------------------------------------------------------------------------
void RefractedRayStack::Clear()
{
  this->Interfaces.clear();
  this->Rays.clear();
  this->Untraced.clear();
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
  this->Untraced.resize(tiles);
  const StackVisibility sight(
    this->Interfaces, { this->MeshCenter, this->MeshHalf }, this->Of.Center, this->Set);
  std::vector<TileSum> sums(tiles);
  loop(tiles,
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t tile = begin; tile < end; ++tile)
      {
        sums[tile] = this->TraceTile(static_cast<int>(tile), sight);
      }
    });
  this->Sums = Counts();
  glm::dvec3 sum(0.0);
  for (const TileSum& tile : sums)
  {
    sum += tile.Directions;
    this->Sums.Add(tile.Rays);
  }
  const double length = glm::length(sum);
  this->MeanDirection = length > 0.0 ? sum / length : glm::dvec3(0.0);
}

//------------------------------------------------------------------------------
std::int64_t RefractedRayStack::GetNumberOfUntracedBlocks() const
{
  std::int64_t number = 0;
  for (const TileSquares blocks : this->Untraced)
  {
    number += static_cast<std::int64_t>(std::bitset<BlocksOfTile>(blocks).count());
  }
  return number;
}

//------------------------------------------------------------------------------
RefractedRayStack::Counts RefractedRayStack::GetCounts() const
{
  Counts counts = this->Sums;
  Block block(this->Interfaces.size());
  for (std::size_t tile = 0; tile < this->Untraced.size(); ++tile)
  {
    for (int number = 0; number < BlocksOfTile; ++number)
    {
      if ((this->Untraced[tile] >> number & 1u) != 0)
      {
        this->StartBlock(this->FirstPixel(static_cast<int>(tile)) + FirstOfBlock(number), block);
        this->TraceBlock(this->Interfaces.size(), block, counts);
      }
    }
  }
  return counts;
}

//------------------------------------------------------------------------------
/** Traces the rays of a block through the first interfaces. */
void RefractedRayStack::TraceBlock(std::size_t interfaces, Block& block, Counts& sums) const
{
  for (std::size_t k = 0; k < interfaces; ++k)
  {
    this->MeetInterface(k, block, sums);
    this->RefractBlock(k, block, sums);
  }
}

//------------------------------------------------------------------------------
/** Rays at the corners of a square of pixels, from the depth of the eye on. */
CornerRays RefractedRayStack::CornersOf(const glm::ivec2& first, int size) const
{
  const RayFrame& frame = this->Of.Frame;
  const glm::dvec2 toCenter(0.5 - 0.5 * this->Of.Width, 0.5 - 0.5 * this->Of.Height);
  const int last = size - 1;
  const glm::ivec2 corners[4] = { { 0, 0 }, { last, 0 }, { last, last }, { 0, last } };
  CornerRays rays;
  for (int i = 0; i < 4; ++i)
  {
    const glm::dvec2 pixel = glm::dvec2(first + corners[i]) + toCenter;
    const glm::dvec3 place(frame.Origin.At(pixel.x, pixel.y), 0.0);
    const glm::dvec3 step(frame.Slope.At(pixel.x, pixel.y), 1.0);
    rays.Starts[i] = frame.ViewToWorld * (place + this->Of.EyeDepth * step);
    rays.Directions[i] = frame.ViewToWorld * step;
  }
  return rays;
}

//------------------------------------------------------------------------------
RefractedRayStack::TileSum RefractedRayStack::TraceTile(int tile, const StackVisibility& sight)
{
  TileSum sum;
  const glm::ivec2 first = this->FirstPixel(tile);
  BundleFacets all;
  BundleFacets ofTile;
  const bool mayShow = sight.MayShowMesh(this->CornersOf(first, TileSize), all, ofTile);
  for (std::size_t k = 0; k < this->Rays.size(); ++k)
  {
    this->Rays[k].ChangeTile(tile).assign(
      k == 0 || mayShow ? RefractedRayTiles::RaysOfTile : 0, RefractedRay());
    this->Rays[k].SetSquares(tile, 0, 0);
  }
  TileSquares& untraced = this->Untraced[static_cast<std::size_t>(tile)];
  untraced = 0;
  Block block(this->Interfaces.size());
  block.Facets = ofTile;
  for (int number = 0; number < BlocksOfTile; ++number)
  {
    const glm::ivec2 pixel = first + FirstOfBlock(number);
    this->StartBlock(pixel, block);
    if (mayShow && sight.MayShowMesh(this->CornersOf(pixel, BlockSize), ofTile, block.Facets))
    {
      this->TraceBlock(this->Interfaces.size(), block, sum.Rays);
      this->EndRaysBesideMesh(block);
      this->StoreBlock(block, tile, number, sum.Directions);
    }
    else
    {
      untraced = static_cast<TileSquares>(untraced | 1u << number);
      Counts ofUntraced; // counted by GetCounts()
      this->MeetInterface(0, block, ofUntraced);
      this->StoreSights(block, tile);
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
/** Sets leg 0 of the rays of a block, which begins at the pixel `first`. */
void RefractedRayStack::StartBlock(const glm::ivec2& first, Block& block) const
{
  for (WorldLegs& legs : block.Legs)
  {
    legs.Clear();
  }
  block.Count = 0;
  SightLegs sight{ 0, {}, {}, block.Legs[0] };
  for (int row = first.y; row < std::min(first.y + BlockSize, this->Of.Height); ++row)
  {
    for (int column = first.x; column < std::min(first.x + BlockSize, this->Of.Width); ++column)
    {
      const auto ray = static_cast<std::size_t>(block.Count++);
      block.Pixels[ray] = row % TileSize * TileSize + column % TileSize;
      sight.Column[ray] = column + 0.5 - 0.5 * this->Of.Width;
      sight.Row[ray] = row + 0.5 - 0.5 * this->Of.Height;
    }
  }
  sight.Count = block.Count;
  const RayFrame& frame = this->Of.Frame;
  RunLanes(SightKernel{ frame.Origin, frame.Slope, frame.ViewToWorld }, this->Set, sight);
}

//------------------------------------------------------------------------------
/**
 * Sets the lanes to the rays of a block that may meet interface `number`, and ends those that
 * cannot. Leaves no lanes if there is no such ray.
 */
void RefractedRayStack::SetLanes(std::size_t number, Block& block, Counts& sums) const
{
  const StackedInterface& interface = this->Interfaces[number];
  const bool isFirst = number == 0;
  const glm::dvec3 toSurface = this->Of.Center - interface.Surface->GetOrigin();
  WorldLegs& legs = block.Legs[number];
  RayBlock& lanes = block.Lanes;
  std::int64_t mismatched[RaysOfBlock];
  ArrivingLegs arriving{ block.Count, lanes, legs, block.Media, mismatched };
  RunLanes(LaneKernel{ toSurface, isFirst, isFirst ? this->Of.EyeDepth : 0.0, interface.Exterior,
             interface.Interior },
    this->Set, arriving);
  lanes.Count = block.Count;
  int instead = -1;
  for (int ray = 0; ray < block.Count; ++ray)
  {
    instead = lanes.Last[ray] > 0.0 && instead < 0 ? ray : instead;
    if (mismatched[ray] != 0)
    {
      legs.SetStep(static_cast<std::size_t>(ray), glm::dvec3(0.0));
      ++sums.Missing;
      ++sums.Mismatched;
    }
  }
  lanes.Count = instead < 0 ? 0 : lanes.Count;
  for (int ray = 0; ray < lanes.Count; ++ray)
  {
    for (int axis = 0; axis < 3 && lanes.Last[ray] < 0.0; ++axis)
    {
      lanes.Start[axis][ray] = lanes.Start[axis][instead];
      lanes.Direction[axis][ray] = lanes.Direction[axis][instead];
    }
  }
  CompleteRays(this->Set, lanes);
}

//------------------------------------------------------------------------------
/** Intersects leg `number` of the rays with interface `number`, and ends legs that miss it. */
void RefractedRayStack::MeetInterface(std::size_t number, Block& block, Counts& sums) const
{
  this->SetLanes(number, block, sums);
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
      for (int axis = 0; axis < 3; ++axis)
      {
        block.Normals[axis][lane] = hit.Normal[axis];
      }
      lanes.Last[lane] = hit.Depth;
      isNearer = true;
    }
  };
  double farthest = Infinity;
  const auto meet = [&](std::int32_t facet, const TubeRange&)
  {
    const PatchIntersector& tracer =
      block.GetTracer(interface, number, facet, rayLength, this->Set);
    isNearer = false;
    sums.Undecided -= tracer.GetNumberOfUndecidedRays();
    tracer.Meet(lanes, keepNearest);
    sums.Undecided += tracer.GetNumberOfUndecidedRays();
    // Parameters of the tube count from its beginning.
    farthest = isNearer ? lanes.GetFarthest() - first : farthest;
    return farthest;
  };
  if (FacetBoxes* facets = block.Facets.Find(number))
  {
    VisitBoxesNearFirst(lanes.GetTube(first), this->Set, *facets, meet);
  }
  else
  {
    InvertDirections(this->Set, lanes);
    interface.Tree->GetBoxes().Visit(
      lanes.GetTube(first), farthest,
      [this, &lanes](const AxisBox& box) { return MeetsBox(box, this->Set, lanes); }, meet);
  }
  for (int lane = 0; lane < lanes.Count && number > 0; ++lane)
  {
    if (lanes.Last[lane] == Infinity)
    {
      block.Legs[number].SetStep(static_cast<std::size_t>(lane), glm::dvec3(0.0));
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
  batch.Take(lanes.Count, lanes.Start, lanes.Direction);
  for (int axis = 0; axis < 3; ++axis)
  {
    std::copy_n(block.Normals[axis], lanes.Count, batch.Normal[axis]);
  }
  Refract(FreeRays(), interface.Exterior / interface.Interior, this->Set, batch);
  NextLegs next{ lanes.Count, lanes, batch, block.Legs[number], block.Legs[number + 1],
    block.Media };
  RunLanes(NextKernel{ interface.Exterior, interface.Interior }, this->Set, next);
  for (int ray = 0; ray < lanes.Count && number > 0; ++ray)
  {
    sums.Reflected += IsHit(lanes, ray) && batch.Refracted[ray] == 0.0 ? 1 : 0;
  }
}

//------------------------------------------------------------------------------
/** Ends rays at the last interface behind which they may meet the mesh. */
void RefractedRayStack::EndRaysBesideMesh(Block& block) const
{
  const EndKernel kernel{ this->MeshCenter, this->MeshHalf };
  EndedLegs rays;
  rays.Count = block.Count;
  std::fill_n(rays.Stays, RaysOfBlock, 0);
  for (std::size_t k = block.Legs.size() - 1; k > 0; --k)
  {
    WorldLegs& legs = block.Legs[k];
    const double* next = k + 1 < block.Legs.size() ? block.Legs[k + 1].Depth : nullptr;
    for (std::size_t ray = 0; ray < RaysOfBlock; ++ray)
    {
      rays.Length[ray] = next ? next[ray] - legs.Depth[ray] : Infinity;
    }
    std::copy_n(legs.Place[0], 3 * RaysOfBlock, rays.Place[0]);
    std::copy_n(legs.Step[0], 3 * RaysOfBlock, rays.Step[0]);
    RunLanes(kernel, this->Set, rays);
    std::copy_n(rays.Step[0], 3 * RaysOfBlock, legs.Step[0]);
    legs.MayShow =
      std::any_of(rays.Meets, rays.Meets + block.Count, [](std::int64_t ray) { return ray != 0; });
  }
}

//------------------------------------------------------------------------------
/** @param directions sum to which the steps of the legs are added, in the frame of the view. */
void RefractedRayStack::StoreBlock(const Block& block, int tile, int number, glm::dvec3& directions)
{
  for (std::size_t k = 0; k < this->Rays.size(); ++k)
  {
    std::vector<RefractedRay>& rays = this->Rays[k].ChangeTile(tile);
    const WorldLegs& legs = block.Legs[k + 1];
    bool goesOn = false;
    for (std::size_t ray = 0; ray < static_cast<std::size_t>(block.Count); ++ray)
    {
      if (block.Legs[k].GoesOn(ray))
      {
        const glm::dvec3 step = this->WorldToFrame * legs.GetStep(ray);
        rays[static_cast<std::size_t>(block.Pixels[ray])] = { legs.Depth[ray], step };
        directions += step;
        goesOn |= legs.GoesOn(ray);
      }
    }
    this->Rays[k].AddSquare(tile, number, goesOn, legs.MayShow);
  }
}

//------------------------------------------------------------------------------
/** Stores the intersections of a block's rays with the first interface, where they end. */
void RefractedRayStack::StoreSights(const Block& block, int tile)
{
  std::vector<RefractedRay>& rays = this->Rays.front().ChangeTile(tile);
  for (int ray = 0; ray < block.Count; ++ray)
  {
    if (IsHit(block.Lanes, ray))
    {
      const int pixel = block.Pixels[static_cast<std::size_t>(ray)];
      rays[static_cast<std::size_t>(pixel)].Depth = block.Lanes.Last[ray];
    }
  }
}

}
