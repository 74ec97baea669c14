// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/PixelRays.h"

#include "Volume/TetrahedralMesh.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>

namespace meniscus
{
namespace
{

constexpr double GridRadius = 536870912.0;      // 2^29
constexpr double FractionOfGrid = 4294967296.0; // 2^32, what PacketRay shifts out
constexpr double LargestSlope = 2147483647.0;

AffinePixelMap Scaled(const AffinePixelMap& map, double scale)
{
  return { map.Base * scale, map.PerColumn * scale, map.PerRow * scale };
}

}

//------------------------------------------------------------------------------
PixelRays::PixelRays(const RayFrame& frame, int width, int height)
  : Frame(frame)
  , Width(width)
  , Height(height)
{
  // The magnitude of an affine function is largest at a corner.
  double steepest = 0.0;
  for (const int column : { 0, width - 1 })
  {
    for (const int row : { 0, height - 1 })
    {
      const glm::dvec2 pixel = this->FromCenter(column, row);
      const glm::dvec2 slope = glm::abs(frame.Slope.At(pixel.x, pixel.y));
      steepest = std::max({ steepest, slope.x, slope.y });
    }
  }
  const double perUnit = GridRadius / (1.0 + steepest);
  this->GridUnit = 1.0 / perUnit;
  this->Offset = Scaled(frame.Origin, perUnit);
  this->Slope = Scaled(frame.Slope, perUnit / GridPerDepth);
  const double unit = TetrahedralMesh::PositionUnit;
  this->ToGrid = glm::transpose(glm::dmat3(perUnit * unit * frame.RowX, perUnit * unit * frame.RowY,
    GridPerDepth * unit * frame.RowDepth));
}

//------------------------------------------------------------------------------
glm::ivec3 PixelRays::Place(const glm::ivec3& position) const
{
  const glm::dvec3 place = this->ToGrid * glm::dvec3(position);
  return { static_cast<int>(std::lrint(place.x)), static_cast<int>(std::lrint(place.y)),
    static_cast<int>(std::lrint(place.z)) };
}

//------------------------------------------------------------------------------
bool PixelRays::SeesAs(const PixelRays& other) const
{
  const auto same = [](const AffinePixelMap& a, const AffinePixelMap& b)
  { return a.Base == b.Base && a.PerColumn == b.PerColumn && a.PerRow == b.PerRow; };
  return this->PlacesAs(other) && this->Width == other.Width && this->Height == other.Height &&
    same(this->Offset, other.Offset) && same(this->Slope, other.Slope) &&
    this->Frame.Handedness == other.Frame.Handedness;
}

//------------------------------------------------------------------------------
/** @param perDepth  the slope in the frame; the others are in grid units. */
PacketRay PixelRays::MakeRay(
  const glm::dvec2& offset, const glm::dvec2& slope, const glm::dvec2& perDepth) const
{
  PacketRay ray;
  for (int axis = 0; axis < 2; ++axis)
  {
    // Half a unit more, for what is shifted out is rounded down.
    ray.Offset[axis] =
      std::llrint((std::clamp(offset[axis], -LargestOffset, LargestOffset) + 0.5) * FractionOfGrid);
    // Below 1/2 in theory, and not to be rounded up to it for views of nearly 180 degrees.
    ray.Slope[axis] = static_cast<std::int32_t>(
      std::clamp(std::rint(slope[axis] * FractionOfGrid), -LargestSlope, LargestSlope));
  }
  ray.LengthPerDepth = static_cast<float>(
    glm::length(this->Frame.ViewToWorld * glm::dvec3(perDepth.x, perDepth.y, 1.0)));
  ray.StartDepth = -1.0e+30f;
  ray.EndDepth = 1.0e+30f;
  ray.FirstEntry = 0;
  ray.EndEntry = 0;
  return ray;
}

//------------------------------------------------------------------------------
PacketRay PixelRays::RayOf(int column, int row) const
{
  const glm::dvec2 pixel = this->FromCenter(column, row);
  PacketRay ray = this->MakeRay(this->Offset.At(pixel.x, pixel.y), this->Slope.At(pixel.x, pixel.y),
    this->Frame.Slope.At(pixel.x, pixel.y));
  ray.StartDepth = static_cast<float>(this->Frame.NearDepth);
  return ray;
}

//------------------------------------------------------------------------------
PacketRay PixelRays::RayAlong(const glm::dvec2& origin, const glm::dvec2& slope) const
{
  return this->MakeRay(
    origin / this->GridUnit, slope * (1.0 / (this->GridUnit * GridPerDepth)), slope);
}

}
