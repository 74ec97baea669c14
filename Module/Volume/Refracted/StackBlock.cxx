// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Refracted/StackBlock.h"

#include "Simd/LaneLoop.h"
#include "Volume/Refracted/PatchIntersectionBatch.h"

#include <cmath>
#include <numeric>

namespace meniscus
{
namespace
{

constexpr int Size = StackBlock::Size;
constexpr double Infinity = std::numeric_limits<double>::infinity();

// The arrays of each loop are members of one object: the compiler knows then that they are apart.

/** Sight rays of pixels, along the world's axes. */
struct SightLegs
{
  int Count;
  /** From the image's centre. */
  double Column[Size];
  double Row[Size];
  double Place[3][Size];
  double Step[3][Size];
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
      sight.Place[axis][i] = place[axis];
      sight.Step[axis][i] = step[axis];
    }
  }
};

/**
 * Completes the lanes of rays, which hold their places and steps, for the side of the interface on
 * which its medium is that of the ray.
 */
struct LaneKernel
{
  glm::dvec3 ToSurface;
  /** True if rays may come from either side, in any medium. */
  bool FromEitherSide;
  double FirstDepth;
  InterfaceMedia Media;

  void operator()(StackLanes& lanes, int i) const
  {
    const double medium = lanes.Medium[i];
    const bool isOutside = medium == this->Media.Exterior;
    const bool fits = this->FromEitherSide | isOutside | (medium == this->Media.Interior);
    const bool goesOn = (lanes.Direction[0][i] != 0.0) | (lanes.Direction[1][i] != 0.0) |
      (lanes.Direction[2][i] != 0.0);
    for (int axis = 0; axis < 3; ++axis)
    {
      lanes.Start[axis][i] += this->ToSurface[axis];
    }
    lanes.First[i] = this->FirstDepth;
    lanes.Last[i] = (goesOn & fits) ? Infinity : -Infinity;
    const double facing = isOutside ? -1.0 : 1.0;
    lanes.Facing[i] = this->FromEitherSide ? 0.0 : facing;
    lanes.IsOnWay[i] = (goesOn & fits) ? 1 : 0;
    lanes.IsMismatched[i] = (goesOn & !fits) ? 1 : 0;
  }
};

/**
 * Rays at an interface. Place and Drawn are those of the legs in front of it, and then of those
 * behind it, whose steps are in Normal.
 */
struct PassingLegs : PatchIntersectionBatch
{
  double Place[3][Size];
  double Drawn[Size];
  double Last[Size];
  double Medium[Size];
};

/** Begins the legs behind an interface. */
struct NextKernel
{
  InterfaceMedia Media;

  void operator()(PassingLegs& rays, int i) const
  {
    const bool isHit = (rays.Last[i] < Infinity) & (rays.Last[i] > -Infinity);
    const double depth = isHit ? rays.Last[i] : 0.0;
    const double refracted = rays.Refracted[i];
    const bool goesOn = isHit & (refracted != 0.0);
    for (int axis = 0; axis < 3; ++axis)
    {
      rays.Place[axis][i] += depth * rays.Direction[axis][i];
      rays.Normal[axis][i] = goesOn ? rays.Normal[axis][i] : 0.0;
    }
    rays.Drawn[i] = isHit ? rays.Drawn[i] + depth : Infinity;
    const double medium = refracted > 0.0 ? this->Media.Interior : this->Media.Exterior;
    rays.Medium[i] = goesOn ? medium : rays.Medium[i];
  }
};

/** Legs behind one interface. */
struct EndedLegs
{
  int Count;
  double Place[3][Size];
  double Step[3][Size];
  /** Length in steps; infinite if there is no next interface. */
  double Length[Size];
  /** Not 0 if a further leg of the ray may meet the mesh. */
  std::int64_t Stays[Size];
  /** Not 0 if this leg may meet it. */
  std::int64_t Meets[Size];
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

/** Steps of legs, which are turned to another frame. */
struct TurnedSteps
{
  int Count;
  double (&Step)[3][Size];
};

struct TurnKernel
{
  glm::dmat3 Turn;

  void operator()(TurnedSteps& steps, int i) const
  {
    const glm::dvec3 step =
      this->Turn * glm::dvec3(steps.Step[0][i], steps.Step[1][i], steps.Step[2][i]);
    for (int axis = 0; axis < 3; ++axis)
    {
      steps.Step[axis][i] = step[axis];
    }
  }
};

/** Sum of numbers that are 0 or 1. */
std::int64_t CountOnes(const std::int64_t* numbers, int count)
{
  return std::accumulate(numbers, numbers + count, std::int64_t{ 0 });
}

}

//------------------------------------------------------------------------------
void StackBlock::Start(
  const RayFrame& frame, const glm::ivec2& first, int side, int width, int height)
{
  constexpr int tileSize = RefractedRayTiles::TileSize;
  const int columns = std::min(side, width - first.x);
  const int rows = std::min(side, height - first.y);
  SightLegs sight;
  this->Count = 0;
  for (int row = 0; row < rows; ++row)
  {
    const int pixel = (first.y + row) % tileSize * tileSize + first.x % tileSize;
    for (int column = 0; column < columns; ++column)
    {
      const int ray = this->Count + column;
      this->Pixels[static_cast<std::size_t>(ray)] = pixel + column;
      sight.Column[ray] = first.x + column + 0.5 - 0.5 * width;
      sight.Row[ray] = first.y + row + 0.5 - 0.5 * height;
    }
    this->Count += std::max(columns, 0);
  }
  sight.Count = this->Count;
  RunLanes(SightKernel{ frame.Origin, frame.Slope, frame.ViewToWorld }, this->Set, sight);
  WorldLegs& legs = this->Legs.front();
  std::copy_n(sight.Place[0], 3 * Size, legs.Place[0]);
  std::copy_n(sight.Step[0], 3 * Size, legs.Step[0]);
  std::fill_n(legs.Depth, Size, 0.0);
  this->Facets.Clear();
}

//------------------------------------------------------------------------------
void StackBlock::SetLanes(
  std::size_t number, const Interface& interface, const glm::dvec3& toSurface, double first)
{
  const WorldLegs& legs = this->Legs[number];
  StackLanes& lanes = this->Lanes;
  std::copy_n(legs.Place[0], 3 * Size, lanes.Start[0]);
  std::copy_n(legs.Step[0], 3 * Size, lanes.Direction[0]);
  lanes.Count = this->Count;
  RunLanes(LaneKernel{ toSurface, number == 0, first, interface.Media }, this->Set, lanes);
  const std::int64_t onWay = CountOnes(lanes.IsOnWay, this->Count);
  if (onWay == 0)
  {
    lanes.Count = 0;
    return;
  }
  if (onWay < this->Count)
  {
    const auto instead = std::find(lanes.IsOnWay, lanes.IsOnWay + this->Count, 1) - lanes.IsOnWay;
    for (int ray = 0; ray < this->Count; ++ray)
    {
      for (int axis = 0; axis < 3 && lanes.IsOnWay[ray] == 0; ++axis)
      {
        lanes.Start[axis][ray] = lanes.Start[axis][instead];
        lanes.Direction[axis][ray] = lanes.Direction[axis][instead];
      }
    }
  }
  CompleteRays(this->Set, lanes);
  this->Tube = FindTube(first, this->Set, lanes);
}

//------------------------------------------------------------------------------
void StackBlock::Refract(std::size_t number, const Interface& interface)
{
  const WorldLegs& before = this->Legs[number];
  WorldLegs& behind = this->Legs[number + 1];
  StackLanes& lanes = this->Lanes;
  if (lanes.Count == 0)
  {
    behind.Clear();
    return;
  }
  PassingLegs rays;
  rays.Count = lanes.Count;
  std::copy_n(lanes.Direction[0], 3 * Size, rays.Direction[0]);
  std::copy_n(this->Normals[0], 3 * Size, rays.Normal[0]);
  std::copy_n(before.Place[0], 3 * Size, rays.Place[0]);
  std::copy_n(before.Depth, Size, rays.Drawn);
  std::copy_n(lanes.Last, Size, rays.Last);
  std::copy_n(lanes.Medium, Size, rays.Medium);
  PatchIntersectionBatch& batch = rays;
  meniscus::Refract(interface.Media.Exterior / interface.Media.Interior, this->Set, batch);
  RunLanes(NextKernel{ interface.Media }, this->Set, rays);
  std::copy_n(rays.Place[0], 3 * Size, behind.Place[0]);
  std::copy_n(rays.Normal[0], 3 * Size, behind.Step[0]);
  std::copy_n(rays.Drawn, Size, behind.Depth);
  std::copy_n(rays.Medium, Size, lanes.Medium);
  std::copy_n(rays.Refracted, Size, this->Refracted);
}

//------------------------------------------------------------------------------
bool StackBlock::EndBeside(const glm::dvec3& meshCenter, const glm::dvec3& meshHalf)
{
  const EndKernel kernel{ meshCenter, meshHalf };
  EndedLegs rays;
  rays.Count = this->Count;
  std::fill_n(rays.Stays, Size, 0);
  bool mayShow = false;
  for (std::size_t k = this->Legs.size() - 1; k > 0; --k)
  {
    WorldLegs& legs = this->Legs[k];
    const double* next = k + 1 < this->Legs.size() ? this->Legs[k + 1].Depth : nullptr;
    for (int ray = 0; ray < Size; ++ray)
    {
      rays.Length[ray] = next ? next[ray] - legs.Depth[ray] : Infinity;
    }
    std::copy_n(legs.Place[0], 3 * Size, rays.Place[0]);
    std::copy_n(legs.Step[0], 3 * Size, rays.Step[0]);
    RunLanes(kernel, this->Set, rays);
    std::copy_n(rays.Step[0], 3 * Size, legs.Step[0]);
    legs.MayShow = CountOnes(rays.Meets, this->Count) > 0;
    mayShow = mayShow || legs.MayShow;
  }
  return mayShow;
}

//------------------------------------------------------------------------------
void StackBlock::FindFrameSteps(
  std::size_t number, const glm::dmat3& worldToFrame, double (&steps)[3][Size]) const
{
  std::copy_n(this->Legs[number].Step[0], 3 * Size, steps[0]);
  TurnedSteps turned{ this->Count, steps };
  RunLanes(TurnKernel{ worldToFrame }, this->Set, turned);
}

//------------------------------------------------------------------------------
const PatchIntersector& StackBlock::GetTracer(
  const RefractingSurface& surface, std::int32_t facet, double rayLength)
{
  const std::int64_t shape = surface.GetShape();
  // The upper bits of this product differ for facets that are close to each other.
  const std::uint32_t key =
    static_cast<std::uint32_t>(facet) + 7919u * static_cast<std::uint32_t>(shape);
  std::uint16_t& place = this->Places[key * 2654435769u >> (32 - PlaceBits)];
  if (place < this->Kept.size())
  {
    KeptPatch& kept = this->Kept[place];
    if (kept.Shape == shape && kept.Facet == facet)
    {
      kept.Tracer.SetRayLength(rayLength);
      return kept.Tracer;
    }
  }
  const KeptPatch added{ shape, facet,
    PatchIntersector(surface.GetPatches().GetPatch(facet), rayLength, this->Set) };
  place = static_cast<std::uint16_t>(this->NextPlace);
  this->NextPlace = (this->NextPlace + 1) % KeptPatches;
  if (this->Kept.size() < KeptPatches)
  {
    this->Kept.push_back(added);
  }
  else
  {
    this->Kept[place] = added;
  }
  return this->Kept[place].Tracer;
}

}
