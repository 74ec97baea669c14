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

/**
 * Grid units of x and y per unit of the frame, times 1 + the steepest slope: 2^30 - 2^13.
 *
 * In packets, u and v are differences of places and offsets, integers of 32 bits, at the pivot.
 * Where a ray meets the mesh they are below twice this number: places are within r = GridRadius /
 * (1 + s) of the centre, for the steepest slope s, and the pivot is within twice the unit of depth
 * from any part of the mesh, so that offsets are within r (1 + 2 s).
 *
 * In shaders, u and v are such differences at the depth of a vertex, within r (2 + 2 s). Slopes per
 * grid unit of depth are below 1, up to views of nearly 180 degrees.
 */
constexpr double GridRadius = 1073733632.0;

/** 2^31 - 2^12: bound of differences of places and offsets, before these are rounded. */
constexpr double LargestDifference = 2147479552.0;
static_assert(2.0 * GridRadius + 1.0 < LargestDifference, "rays are kept");
static_assert(GridRadius < PacketVertex::GridPerDepth, "slopes are below 1");

/** Slopes and coefficients for shaders per unit. */
constexpr double ShaderSlopes = 1.0 / FixedPointRays::ShaderSlopeUnit;
constexpr double LargestSlope = 2147483647.0;
/** Bound of the offset at depth 0 of a line for shaders that may meet the mesh. */
constexpr double LargestLineOffset = 1073741824.0; // 2^30
/** Spacing of rays, in grid units, below which they are fine. */
constexpr double FineSpacing = 32768.0; // 2^15
/** Size of the smallest cell, in grid units, below which rays are fine. */
constexpr double FineCell = 262144.0; // 2^18

AffinePixelMap Scaled(const AffinePixelMap& map, double scale)
{
  return { map.Base * scale, map.PerColumn * scale, map.PerRow * scale };
}

/** Converts a map to integers and fractions of 2^-15. */
FixedPointRays::FixedPointMap FixedPoint(const AffinePixelMap& map)
{
  constexpr double fractions = 32768.0;
  // Integers are computed modulo 2^32: where a ray meets the mesh, their sum is in range.
  constexpr double largest = 70368744177664.0; // 2^46
  const glm::dvec2 values[3] = { map.Base, 0.5 * map.PerColumn, 0.5 * map.PerRow };
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
  : FixedPointRays(frame, width, height, std::clamp(frame.NearDepth, -1.0, 1.0))
{
}

//------------------------------------------------------------------------------
FixedPointRays::FixedPointRays(const RayFrame& frame, int width, int height, double pivot)
  : FixedPointRays(frame, width, height, pivot, SpacingAt(frame, pivot))
{
}

//------------------------------------------------------------------------------
FixedPointRays::FixedPointRays(
  const RayFrame& frame, int width, int height, double pivot, double spacing)
  : Frame(frame)
  , Width(width)
  , Height(height)
  , Pivot(static_cast<std::int32_t>(std::lrint(pivot * GridPerDepth)))
{
  // The magnitude of an affine function is largest at a corner: of the image, not of its rays, so
  // that vertices have the same places for an image of the same view with more pixels.
  double steepest = 0.0;
  for (const double column : { -0.5 * width, 0.5 * width })
  {
    for (const double row : { -0.5 * height, 0.5 * height })
    {
      const glm::dvec2 slope = glm::abs(frame.Slope.At(column, row));
      steepest = std::max({ steepest, slope.x, slope.y });
    }
  }
  const double perUnit = GridRadius / (1.0 + steepest);
  this->GridUnit = 1.0 / perUnit;
  this->Fine = spacing * perUnit < FineSpacing || frame.SmallestCell * perUnit < FineCell;
  this->LargestOffset =
    LargestDifference - perUnit * std::max(glm::length(frame.RowX), glm::length(frame.RowY));
  this->Offset = Scaled(frame.Origin, perUnit);
  this->Slope = Scaled(frame.Slope, perUnit / GridPerDepth);
  const glm::dmat3 perDepth = frame.ViewToWorld * (1.0 / GridPerDepth);
  this->Along = perDepth * glm::dvec3(frame.Slope.Base, 1.0);
  this->AlongPerColumn = perDepth * glm::dvec3(frame.Slope.PerColumn, 0.0);
  this->AlongPerRow = perDepth * glm::dvec3(frame.Slope.PerRow, 0.0);
  const double unit = TetrahedralMesh::PositionUnit;
  this->ToGrid = glm::transpose(glm::dmat3(perUnit * unit * frame.RowX, perUnit * unit * frame.RowY,
    GridPerDepth * unit * frame.RowDepth));
}

//------------------------------------------------------------------------------
bool FixedPointRays::SeesAs(const FixedPointRays& other) const
{
  const auto same = [](const AffinePixelMap& a, const AffinePixelMap& b)
  { return a.Base == b.Base && a.PerColumn == b.PerColumn && a.PerRow == b.PerRow; };
  return this->PlacesAs(other) && this->Width == other.Width && this->Height == other.Height &&
    same(this->Offset, other.Offset) && same(this->Slope, other.Slope) &&
    this->Pivot == other.Pivot && this->Frame.Handedness == other.Frame.Handedness;
}

//------------------------------------------------------------------------------
FixedPointRays::FixedPointRows FixedPointRays::GetFixedPointRows() const
{
  // Coefficients are below 1.
  FixedPointRows rows{};
  for (int i = 0; i < 9; ++i)
  {
    const double scaled = this->ToGrid[i % 3][i / 3] * ShaderSlopes;
    const double whole = std::clamp(std::rint(scaled), -LargestSlope, LargestSlope);
    rows.Whole[static_cast<std::size_t>(i)] = static_cast<std::int32_t>(whole);
    rows.Rests[static_cast<std::size_t>(i)] =
      static_cast<float>(std::clamp(scaled - whole, -0.5, 0.5));
  }
  return rows;
}

//------------------------------------------------------------------------------
FixedPointRays::FixedPointMap FixedPointRays::GetFixedPointOffset() const
{
  return FixedPoint(this->Offset);
}

//------------------------------------------------------------------------------
FixedPointRays::FixedPointMap FixedPointRays::GetFixedPointSlope() const
{
  return FixedPoint(Scaled(this->Slope, ShaderSlopes));
}

//------------------------------------------------------------------------------
void FixedPointRays::GetFixedPointLine(const glm::dvec2& origin, const glm::dvec2& slope,
  std::int32_t (&gridOffset)[2], std::int32_t (&gridSlope)[2]) const
{
  for (int axis = 0; axis < 2; ++axis)
  {
    gridOffset[axis] = static_cast<std::int32_t>(
      std::lrint(std::clamp(origin[axis] / this->GridUnit, -LargestLineOffset, LargestLineOffset)));
    const double perDepth = slope[axis] / (this->GridUnit * GridPerDepth);
    gridSlope[axis] = static_cast<std::int32_t>(
      std::clamp(std::rint(perDepth * ShaderSlopes), -LargestSlope, LargestSlope));
  }
}

//------------------------------------------------------------------------------
void FixedPointRays::FillRow(int column, int row, int count, const RowOfRays& rays) const
{
  this->FillRays([&](int i) { return this->FromCenter(column + i, row); }, count, rays);
}

}
