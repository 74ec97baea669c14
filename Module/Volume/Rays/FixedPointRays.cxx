// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Twin: Rendering/glsl/vtkTetrahedraPlaceFS.glsl (place of a vertex)
#include "Volume/Rays/FixedPointRays.h"

#include "Volume/Mesh/TetrahedralMesh.h"
#include "Volume/Packet/Data/PacketRays.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>

namespace meniscus
{
namespace
{

// 2^29 - 2^12: slopes per grid unit of depth stay below 1/2, up to views of nearly 180 degrees.
constexpr double GridRadius = 536866816.0;
constexpr double FractionOfGrid = 4294967296.0; // 2^32, the factor that PacketRay shifts out
constexpr double LargestSlope = 2147483647.0;

AffinePixelMap Scaled(const AffinePixelMap& map, double scale)
{
  return { map.Base * scale, map.PerColumn * scale, map.PerRow * scale };
}

/** Converts a map to integers and fractions of 2^-15, with `more` added to its base. */
FixedPointRays::FixedPointMap FixedPoint(const AffinePixelMap& map, const glm::dvec2& more)
{
  constexpr double fractions = 32768.0;
  // Integers are computed modulo 2^32: where a ray meets the mesh, their sum is in range.
  constexpr double largest = 70368744177664.0; // 2^46
  const glm::dvec2 values[3] = { map.Base + more, 0.5 * map.PerColumn, 0.5 * map.PerRow };
  FixedPointRays::FixedPointMap fixed{};
  for (int i = 0; i < 3; ++i)
  {
    for (int axis = 0; axis < 2; ++axis)
    {
      const std::int64_t value =
        std::llrint(std::clamp(values[i][axis], -largest, largest) * fractions);
      fixed[4 * i + axis] = static_cast<std::int32_t>(static_cast<std::uint32_t>(value >> 15));
      fixed[4 * i + 2 + axis] = static_cast<std::int32_t>(value & 32767);
    }
  }
  return fixed;
}

}

//------------------------------------------------------------------------------
FixedPointRays::FixedPointRays(const RayFrame& frame, int width, int height)
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
glm::ivec3 FixedPointRays::Place(const glm::ivec3& position) const
{
  const glm::dvec3 place = this->ToGrid * glm::dvec3(position);
  return { static_cast<int>(std::lrint(place.x)), static_cast<int>(std::lrint(place.y)),
    static_cast<int>(std::lrint(place.z)) };
}

//------------------------------------------------------------------------------
bool FixedPointRays::SeesAs(const FixedPointRays& other) const
{
  const auto same = [](const AffinePixelMap& a, const AffinePixelMap& b)
  { return a.Base == b.Base && a.PerColumn == b.PerColumn && a.PerRow == b.PerRow; };
  return this->PlacesAs(other) && this->Width == other.Width && this->Height == other.Height &&
    same(this->Offset, other.Offset) && same(this->Slope, other.Slope) &&
    this->Frame.Handedness == other.Frame.Handedness;
}

//------------------------------------------------------------------------------
std::array<std::int32_t, 9> FixedPointRays::GetFixedPointRows() const
{
  // Coefficients of x and y are below 1/2, those of depth below 1.
  std::array<std::int32_t, 9> rows{};
  for (int i = 0; i < 9; ++i)
  {
    const double scaled =
      this->ToGrid[i % 3][i / 3] * (i < 6 ? FractionOfGrid : 0.5 * FractionOfGrid);
    rows[static_cast<std::size_t>(i)] =
      static_cast<std::int32_t>(std::clamp(std::rint(scaled), -LargestSlope, LargestSlope));
  }
  return rows;
}

//------------------------------------------------------------------------------
FixedPointRays::FixedPointMap FixedPointRays::GetFixedPointOffset() const
{
  return FixedPoint(this->Offset, glm::dvec2(0.0));
}

//------------------------------------------------------------------------------
FixedPointRays::FixedPointMap FixedPointRays::GetFixedPointSlope() const
{
  return FixedPoint(Scaled(this->Slope, FractionOfGrid), glm::dvec2(0.5));
}

//------------------------------------------------------------------------------
/** @param perDepth slope in units of the frame; the other arguments are in grid units. */
PacketRay FixedPointRays::MakeRay(
  const glm::dvec2& offset, const glm::dvec2& slope, const glm::dvec2& perDepth) const
{
  PacketRay ray;
  for (int axis = 0; axis < 2; ++axis)
  {
    // Half a unit is added because shifting out the fraction rounds down.
    ray.Offset[axis] =
      std::llrint((std::clamp(offset[axis], -LargestOffset, LargestOffset) + 0.5) * FractionOfGrid);
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
PacketRay FixedPointRays::RayOf(int column, int row) const
{
  const glm::dvec2 pixel = this->FromCenter(column, row);
  PacketRay ray = this->MakeRay(this->Offset.At(pixel.x, pixel.y), this->Slope.At(pixel.x, pixel.y),
    this->Frame.Slope.At(pixel.x, pixel.y));
  ray.StartDepth = static_cast<float>(this->Frame.NearDepth);
  return ray;
}

//------------------------------------------------------------------------------
PacketRay FixedPointRays::RayAlong(const glm::dvec2& origin, const glm::dvec2& slope) const
{
  return this->MakeRay(
    origin / this->GridUnit, slope * (1.0 / (this->GridUnit * GridPerDepth)), slope);
}

}
