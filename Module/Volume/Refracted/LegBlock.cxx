// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Refracted/LegBlock.h"

#include "Simd/LaneLoop.h"

#include <algorithm>
#include <limits>

namespace meniscus
{
namespace
{

constexpr int TileSize = RefractedRayTiles::TileSize;

/**
 * Distance, in units of the frame, by which an entry may lie in front of the sight point if the leg
 * before reports that point outside of the mesh. Depths are rounded to 2^-24; along a ray that
 * leaves the boundary at an angle of 2^-12 this is 2^-12. A superfluous entry costs a few steps and
 * does not change the result.
 */
constexpr double StartMargin = 1.0 / 4096.0;

/** Loop bodies, for one ray each. */
struct SightKernel
{
  AffinePixelMap Origin;
  AffinePixelMap Slope;
  /** The square's first pixel, from the image's centre. */
  double Left;
  double Bottom;

  void operator()(LegBlock& block, int i) const
  {
    const double column = this->Left + LegBlock::ColumnOf(i);
    const double row = this->Bottom + LegBlock::RowOf(i);
    block.Set(i, RayLeg::OfSight(this->Origin, this->Slope, column, row));
    block.Exists[i] = 1;
  }
};

/** Refractions of the rays of a block. */
struct RefractionBlock
{
  double Depth[LegBlock::Size];
  double Step[3][LegBlock::Size];
};

struct LegKernel
{
  RefractionBlock Rays;

  void operator()(LegBlock& block, int i) const
  {
    const RefractedRay ray{ this->Rays.Depth[i],
      { this->Rays.Step[0][i], this->Rays.Step[1][i], this->Rays.Step[2][i] } };
    RayLeg leg = block.Get(i);
    leg.Refract(ray);
    block.Set(i, leg);
    const bool goesOn = (ray.Step.x != 0.0) | (ray.Step.y != 0.0) | (ray.Step.z != 0.0);
    block.Exists[i] = goesOn ? block.Exists[i] : 0;
  }
};

struct BoxKernel
{
  LegBox Box;

  void operator()(LegBlock& block, int i) const
  {
    const RayLeg leg = block.Get(i);
    block.MayMeet[i] = this->Box.MayMeet(leg) ? 1 : 0;
    block.IsBeside[i] = this->Box.IsBeside(leg) ? 1 : 0;
  }
};

struct FrameKernel
{
  const RefractionFrames& Frames;

  void operator()(LegBlock& block, int i) const
  {
    block.Frame[i] = this->Frames.IndexOf(block.Get(i).Step);
  }
};

/** Copy of the legs of which lines are computed, which stores to lines cannot change. */
struct LineParts
{
  explicit LineParts(const LegBlock& legs)
  {
    std::copy_n(legs.Begin[0], 3 * LegBlock::Size, this->Begin[0]);
    std::copy_n(legs.Step[0], 3 * LegBlock::Size, this->Step[0]);
    std::copy_n(legs.DrawnFrom, LegBlock::Size, this->DrawnFrom);
    std::copy_n(legs.DrawnTo, LegBlock::Size, this->DrawnTo);
  }

  double Begin[3][LegBlock::Size];
  double Step[3][LegBlock::Size];
  double DrawnFrom[LegBlock::Size];
  double DrawnTo[LegBlock::Size];
};

struct LineKernel
{
  LineParts Legs;
  glm::dmat3 FromView;
  FixedPointRays Rays;

  void operator()(LineBlock& lines, int i) const
  {
    const LineParts& legs = this->Legs;
    const glm::dvec3 place =
      this->FromView * glm::dvec3(legs.Begin[0][i], legs.Begin[1][i], legs.Begin[2][i]);
    const glm::dvec3 step =
      this->FromView * glm::dvec3(legs.Step[0][i], legs.Step[1][i], legs.Step[2][i]);
    // A FrameLine would be copied as a whole, which ends the use of lanes.
    const glm::dvec2 slope(step.x / step.z, step.y / step.z);
    const glm::dvec2 origin(place.x - place.z * slope.x, place.y - place.z * slope.y);
    for (int axis = 0; axis < 2; ++axis)
    {
      lines.Origin[axis][i] = origin[axis];
      lines.Slope[axis][i] = slope[axis];
    }
    PacketRay ray = this->Rays.RayAlong(origin, slope);
    ray.StartDepth = this->Rays.FromPivot(place.z + legs.DrawnFrom[i] * step.z);
    ray.EndDepth = this->Rays.FromPivot(place.z + legs.DrawnTo[i] * step.z);
    lines.SetRay(i, ray);
    lines.From[i] = place.z - StartMargin;
  }
};

/** Depths and steps of the rays of a square of a tile. */
void Copy(const RefractedRay* rays, const LegBlock& block, RefractionBlock& copy)
{
  for (int i = 0; i < LegBlock::Size; ++i)
  {
    const RefractedRay& ray = rays[block.Pixel[i]];
    copy.Depth[i] = ray.Depth;
    for (int axis = 0; axis < 3; ++axis)
    {
      copy.Step[axis][i] = ray.Step[axis];
    }
  }
}

}

//------------------------------------------------------------------------------
void LegBlock::Copy(int to, const LegBlock& block, int from)
{
  this->Pixel[to] = block.Pixel[from];
  for (int axis = 0; axis < 3; ++axis)
  {
    this->Begin[axis][to] = block.Begin[axis][from];
    this->Step[axis][to] = block.Step[axis][from];
  }
  this->Depth[to] = block.Depth[from];
  this->End[to] = block.End[from];
  this->DrawnFrom[to] = block.DrawnFrom[from];
  this->DrawnTo[to] = block.DrawnTo[from];
  this->Frame[to] = block.Frame[from];
}

//------------------------------------------------------------------------------
void LegBlock::FillLanes()
{
  for (int i = this->Count; i % LaneGroup != 0; ++i)
  {
    this->Copy(i, *this, this->Count - 1);
  }
}

//------------------------------------------------------------------------------
void FindLegs(
  const RayLegs& legs, int tile, int corner, int number, InstructionSet set, LegBlock& block)
{
  block.Count = LegBlock::Size;
  for (int i = 0; i < LegBlock::Size; ++i)
  {
    block.Pixel[i] = corner + LegBlock::RowOf(i) * TileSize + LegBlock::ColumnOf(i);
  }
  const RayFrame& sight = legs.GetSight();
  RunLanes(SightKernel{ sight.Origin, sight.Slope,
             legs.GetLeft(tile) + corner % TileSize + 0.5 - 0.5 * legs.GetWidth(),
             legs.GetBottom(tile) + corner / TileSize + 0.5 - 0.5 * legs.GetHeight() },
    set, block);
  LegKernel kernel;
  for (int k = 1; k <= number; ++k)
  {
    Copy(legs.GetTile(k, tile), block, kernel.Rays);
    RunLanes(kernel, set, block);
  }
  const RefractedRay* next =
    number + 1 < legs.GetNumberOfLegs() ? legs.GetTile(number + 1, tile) : nullptr;
  for (int i = 0; i < LegBlock::Size; ++i)
  {
    block.End[i] = next ? next[block.Pixel[i]].Depth : std::numeric_limits<double>::infinity();
  }
}

//------------------------------------------------------------------------------
void TestLegs(const LegBox& box, InstructionSet set, LegBlock& block)
{
  RunLanes(BoxKernel{ box }, set, block);
}

//------------------------------------------------------------------------------
void FindFrames(const RefractionFrames& frames, InstructionSet set, LegBlock& block)
{
  if (frames.IsFirstEnough())
  {
    std::fill_n(block.Frame, block.Count, 0);
    return;
  }
  RunLanes(FrameKernel{ frames }, set, block);
}

//------------------------------------------------------------------------------
void SetLines(const RefractionFrame& frame, LegBlock& legs, bool isOutside, InstructionSet set,
  LineBlock& lines)
{
  lines.Count = legs.Count;
  legs.FillLanes();
  RunLanes(LineKernel{ LineParts(legs), frame.FromView, frame.Rays }, set, lines);
  if (!isOutside)
  {
    std::fill_n(lines.From, lines.Count, -frame.Extent);
  }
}

}
