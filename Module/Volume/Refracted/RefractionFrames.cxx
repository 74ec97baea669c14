// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Refracted/RefractionFrames.h"

#include "Refraction/Membrane/HeightField.h"
#include "Simd/InstructionSets.h"
#include "Simd/LaneLoop.h"
#include "Volume/Packet/Data/PacketRays.h"
#include "Volume/Rays/PlacedVertices.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <numeric>

namespace meniscus
{
namespace
{

/** Steps of the rays of a square of pixels. */
struct SquareSteps
{
  static constexpr int Size = RefractedRayTiles::SquareSize * RefractedRayTiles::SquareSize;

  int Count;
  double Step[3][Size];
  /** Index of the ray's frame. */
  std::int64_t Frame[Size];
};

/** Loop body for one ray. */
struct FrameKernel
{
  glm::dmat3 Axes;

  void operator()(SquareSteps& steps, int i) const
  {
    const glm::dvec3 step(steps.Step[0][i], steps.Step[1][i], steps.Step[2][i]);
    steps.Frame[i] = RefractionFrames::IndexAlong(this->Axes, step);
  }
};

/** Mean of the points where rays of the tiles' middles are refracted, in the view. */
glm::dvec3 MeanSightPoint(const RayLegs& legs)
{
  constexpr int size = RefractedRayTiles::TileSize;
  constexpr int middle = (size / 2) * size + size / 2;
  glm::dvec3 sum(0.0);
  int count = 0;
  for (int tile = 0; tile < legs.GetNumberOfTiles(); ++tile)
  {
    for (int number = 1; number < legs.GetNumberOfLegs(tile); ++number)
    {
      RayLeg leg;
      if (legs.Find(tile, middle, number, leg))
      {
        sum += leg.Begin;
        ++count;
      }
    }
  }
  return count > 0 ? sum / static_cast<double>(count) : sum;
}

}

//------------------------------------------------------------------------------
RefractionFrame RefractionFrame::Make(
  const RayFrame& view, const glm::dmat3& rotation, double steepest, double pivot, double spacing)
{
  RefractionFrame frame;
  frame.FromView = rotation;
  RayFrame turned;
  const glm::dmat3 rows =
    glm::transpose(rotation * glm::transpose(glm::dmat3(view.RowX, view.RowY, view.RowDepth)));
  turned.RowX = rows[0];
  turned.RowY = rows[1];
  turned.RowDepth = rows[2];
  turned.ViewToWorld = view.ViewToWorld * glm::transpose(rotation);
  turned.Handedness = view.Handedness;
  turned.SmallestCell = view.SmallestCell;
  frame.Extent = std::max({ glm::length(rows[0]), glm::length(rows[1]), glm::length(rows[2]) });
  // FixedPointRays reserves range for 1 + the steepest slope; a ray of slope 1 that meets the mesh
  // passes the origin within 2 extents.
  turned.Slope.Base = glm::dvec2(std::max((1.0 + steepest) * frame.Extent - 1.0, 0.0));
  frame.Rays =
    FixedPointRays(turned, 1, 1, std::clamp(pivot, -frame.Extent, frame.Extent), spacing);
  return frame;
}

//------------------------------------------------------------------------------
glm::dmat3 RefractionFrames::RotationTo(const glm::dmat3& axes, int index)
{
  const int axis = (2 + index / 2) % 3;
  const double sign = index % 2 == 0 ? 1.0 : -1.0;
  return glm::transpose(
    glm::dmat3(sign * axes[(axis + 1) % 3], axes[(axis + 2) % 3], sign * axes[axis]));
}

//------------------------------------------------------------------------------
SurfaceLighting RefractionFrame::Turn(const SurfaceLighting& lighting) const
{
  SurfaceLighting turned = lighting;
  const auto turn = [this](glm::dvec4& vector)
  { vector = glm::dvec4(this->FromView * glm::dvec3(vector), vector.w); };
  for (RayCastLight& light : turned.Lights)
  {
    turn(light.Position);
    turn(light.Cone);
  }
  return turned;
}

//------------------------------------------------------------------------------
/** Returns a bit per frame that a ray of the square needs. */
unsigned int RefractionFrames::FindNeeded(const RefractedRay* rays, int square) const
{
  constexpr int size = RefractedRayTiles::SquareSize;
  const RefractedRay* first = rays +
    RefractedRayTiles::RowOfSquare(square) * RefractedRayTiles::TileSize +
    RefractedRayTiles::ColumnOfSquare(square);
  SquareSteps steps;
  steps.Count = SquareSteps::Size;
  for (int i = 0; i < SquareSteps::Size; ++i)
  {
    const RefractedRay& ray = first[i / size * RefractedRayTiles::TileSize + i % size];
    for (int axis = 0; axis < 3; ++axis)
    {
      steps.Step[axis][i] = ray.Step[axis];
    }
  }
  RunLanes(FrameKernel{ this->Axes }, BestInstructionSet(), steps);
  unsigned int needed = 0;
  for (int i = 0; i < SquareSteps::Size; ++i)
  {
    const bool goesOn =
      (steps.Step[0][i] != 0.0) | (steps.Step[1][i] != 0.0) | (steps.Step[2][i] != 0.0);
    needed |= (goesOn ? 1u : 0u) << steps.Frame[i];
  }
  return needed;
}

//------------------------------------------------------------------------------
/** Returns a bit per frame that a ray of the tile needs. */
unsigned int RefractionFrames::FindNeeded(const RayLegs& legs, int tile) const
{
  unsigned int needed = 0;
  for (int leg = 1; leg < legs.GetNumberOfLegs(tile); ++leg)
  {
    const RefractedRay* rays = legs.GetTile(leg, tile);
    for (int square = 0; square < RefractedRayTiles::SquaresOfTile; ++square)
    {
      needed |= legs.HasLegs(leg, tile, square) ? this->FindNeeded(rays, square) : 0u;
    }
  }
  return needed;
}

//------------------------------------------------------------------------------
/** Returns a bit per frame that a ray needs. */
unsigned int RefractionFrames::FindNeeded(const RayLegs& legs, const RangeLoop& loop) const
{
  std::vector<unsigned int> needed(static_cast<std::size_t>(legs.GetNumberOfTiles()), 0);
  ForEachItem(needed.size(), loop,
    [&](std::size_t tile) { needed[tile] = this->FindNeeded(legs, static_cast<int>(tile)); });
  return std::accumulate(needed.begin(), needed.end(), 0u, std::bit_or<unsigned int>());
}

//------------------------------------------------------------------------------
/**
 * True if all rays whose steps are in a box belong to the first frame. Their slopes are then within
 * 1/2, far from the limit of 1 as compared with rounding.
 */
bool RefractionFrames::IsAlongMean(const AxisBox& steps) const
{
  const glm::dvec3 middle = 0.5 * (steps.Low + steps.High) * this->Axes;
  const glm::dvec3 half = 0.5 * (steps.High - steps.Low) *
    glm::dmat3(glm::abs(this->Axes[0]), glm::abs(this->Axes[1]), glm::abs(this->Axes[2]));
  const glm::dvec3 most = glm::abs(middle) + half;
  return steps.Low.x <= steps.High.x && middle.z - half.z > 2.0 * std::max(most.x, most.y);
}

//------------------------------------------------------------------------------
void RefractionFrames::Turn(
  const RayLegs& legs, const glm::dvec3& mean, const RangeLoop& loop, const AxisBox& steps)
{
  const HeightFrame along(mean == glm::dvec3(0.0) ? glm::dvec3(0.0, 0.0, 1.0) : mean);
  this->Axes = glm::dmat3(along.First, along.Second, along.Axis);
  this->Needed = this->IsAlongMean(steps) ? 1u : this->FindNeeded(legs, loop);
  const glm::dvec3 sightPoint = MeanSightPoint(legs);
  for (int index = 0; index < Number; ++index)
  {
    std::vector<PacketVertex> room = std::move(this->Frames[index].Vertices);
    this->Frames[index] = RefractionFrame();
    if (this->Needed >> index & 1u)
    {
      const glm::dmat3 rotation = RotationTo(this->Axes, index);
      this->Frames[index] = RefractionFrame::Make(legs.GetSight(), rotation, 1.0,
        (rotation * sightPoint).z, FixedPointRays::SpacingAt(legs.GetSight(), sightPoint.z));
      this->Frames[index].Vertices = std::move(room);
    }
  }
}

//------------------------------------------------------------------------------
void RefractionFrames::Place(
  const TetrahedralMesh& mesh, const std::vector<float>& scalars, const RangeLoop& loop)
{
  for (int index = 0; index < Number; ++index)
  {
    if (this->Needed >> index & 1u)
    {
      PlaceVertices(mesh, scalars, this->Frames[index].Rays, loop, this->Frames[index].Vertices);
    }
  }
}

//------------------------------------------------------------------------------
std::int64_t RefractionFrames::GetBytes() const
{
  std::int64_t bytes = 0;
  for (const RefractionFrame& frame : this->Frames)
  {
    bytes += BytesOf(frame.Vertices);
  }
  return bytes;
}

}
