// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Refracted/LegBlock.h"

#include "Simd/LaneLoop.h"

#include <glm/geometric.hpp>

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

struct LegLines
{
  int Count;
  const LegBlock& Legs;
  LineBlock& Lines;
};

struct LineKernel
{
  glm::dmat3 FromView;
  FixedPointRays Rays;
  bool IsOutside;
  double Extent;

  void operator()(LegLines& block, int i) const
  {
    const RayLeg leg = block.Legs.Get(i);
    LineBlock& lines = block.Lines;
    const glm::dvec3 place = this->FromView * leg.Begin;
    const glm::dvec3 step = this->FromView * leg.Step;
    const FrameLine line = FrameLine::Through(place, step);
    for (int axis = 0; axis < 2; ++axis)
    {
      lines.Origin[axis][i] = line.Origin[axis];
      lines.Slope[axis][i] = line.Slope[axis];
    }
    PacketRay ray = this->Rays.RayAlong(line.Origin, line.Slope);
    ray.StartDepth = this->Rays.FromPivot(place.z + block.Legs.DrawnFrom[i] * step.z);
    ray.EndDepth = this->Rays.FromPivot(place.z + block.Legs.DrawnTo[i] * step.z);
    lines.SetRay(i, ray);
    lines.From[i] = this->IsOutside ? place.z - StartMargin : -this->Extent;
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
  RunLanes(FrameKernel{ frames }, set, block);
}

//------------------------------------------------------------------------------
void SetLines(const RefractionFrame& frame, LegBlock& legs, bool isOutside, InstructionSet set,
  LineBlock& lines)
{
  lines.Count = legs.Count;
  legs.FillLanes();
  LegLines block{ legs.Count, legs, lines };
  RunLanes(LineKernel{ frame.FromView, frame.Rays, isOutside, frame.Extent }, set, block);
}

}
