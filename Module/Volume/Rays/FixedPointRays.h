// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Volume/Packet/Data/PacketRays.h"
#include "Volume/Rays/RayFrame.h"

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace meniscus
{

/**
 * The rays of an image's pixels, and the positions of vertices relative to them, in integer grid
 * units.
 *
 * Vertices are rounded once, to (x, y, depth) of the frame: depth in units of about 2^-30 of the
 * frame's, x and y in units of about 2^-30 times 1 + the steepest slope, so that |u| and |v| stay
 * below 2^31 where a ray meets the mesh. Coordinates relative to a ray are floats that are defined
 * to the last bit (PacketRay), the same on every processor and for every user of a ray.
 *
 * Rays pass through their offsets at a depth called pivot, and depths about a ray count from it.
 * Floats near it are small and precise: rounding errors are at most 2^-24 of the distance from the
 * pivot. FindPivot() chooses it so that this is a fixed small share of a pixel's width, wherever
 * the eye is.
 */
class FixedPointRays
{
public:
  FixedPointRays() = default;
  /**
   * The pivot is at the near clipping plane, or at the end of the unit about the mesh that is next
   * to it.
   */
  FixedPointRays(const RayFrame& frame, int width, int height);
  /** @param pivot depth of the pivot in units of the frame. */
  FixedPointRays(const RayFrame& frame, int width, int height, double pivot);
  /**
   * @param spacing smallest distance of rays of neighbouring pixels at the pivot, in units of the
   *   frame.
   */
  FixedPointRays(const RayFrame& frame, int width, int height, double pivot, double spacing);

  /** Smallest distance of rays of neighbouring pixels at a depth, in units of the frame. */
  static double SpacingAt(const RayFrame& frame, double depth)
  {
    return std::min(glm::length(frame.Origin.PerColumn + depth * frame.Slope.PerColumn),
      glm::length(frame.Origin.PerRow + depth * frame.Slope.PerRow));
  }
  /**
   * True if rays are fine (PacketRay). They are where coordinates about other rays would not be
   * precise enough: if rays of neighbouring pixels are less than 2^15 grid units apart at the
   * pivot, since offsets without fractions displace a ray by 1/2, or if the longest edge of a cell
   * is less than 2^18 grid units, since coordinates are rounded by up to RoundingOfRay.
   */
  bool AreFine() const { return this->Fine; }

  /**
   * Vector from the image's centre to the centre of pixel (column, row), in pixels, as RayFrame
   * counts.
   */
  glm::dvec2 FromCenter(int column, int row) const
  {
    return { column + 0.5 - 0.5 * this->Width, row + 0.5 - 0.5 * this->Height };
  }

  /** Lines of rays, as in PacketRay. */
  struct RowOfRays
  {
    std::int32_t* Offset[2];
    float* Slope[2];
    /** Set only if rays are fine. */
    float* Fraction[2];
    float* SlopeRest[2];
  };
  /** Sets the rays of consecutive pixels of a row. */
  void FillRow(int column, int row, int count, const RowOfRays& rays) const;
  /** Sets the rays of any pixels; `pixelAt(i)` is the vector to pixel i, see FromCenter(). */
  template <class PixelAt>
  void FillRays(const PixelAt& pixelAt, int count, const RowOfRays& rays) const;
  /**
   * PacketRay::LengthPerDepth of a pixel's ray.
   * @param fromCenter the pixel, see FromCenter().
   */
  float GetLengthPerDepth(const glm::dvec2& fromCenter) const
  {
    return LimitedLength(glm::length(
      this->Along + fromCenter.x * this->AlongPerColumn + fromCenter.y * this->AlongPerRow));
  }
  /**
   * The ray (x, y) = origin + depth * slope of the frame, without ends and without entries.
   * @param slope no steeper than the steepest ray of a pixel.
   */
  PacketRay RayAlong(const glm::dvec2& origin, const glm::dvec2& slope) const;

  /**
   * Position of a vertex in the grid.
   * @param position TetrahedralMesh::GetFixedPositions().
   */
  glm::ivec3 Place(const glm::ivec3& position) const
  {
    const glm::dvec3 place = this->ToGrid * glm::dvec3(position);
    return { static_cast<int>(std::lrint(place.x)), static_cast<int>(std::lrint(place.y)),
      static_cast<int>(std::lrint(place.z)) };
  }
  /** True if Place() is the same function for both. */
  bool PlacesAs(const FixedPointRays& other) const { return this->ToGrid == other.ToGrid; }
  /**
   * True if the rays of all pixels, and the positions of vertices relative to them, are the same.
   */
  bool SeesAs(const FixedPointRays& other) const;

  /**
   * Offset and slope of the ray of pixel (i, j), counted from the image's centre: u = x - offset -
   * slope * depth, all in grid units; likewise v.
   */
  const AffinePixelMap& GetOffset() const { return this->Offset; }
  const AffinePixelMap& GetSlope() const { return this->Slope; }
  /** Coefficients of a matrix as integers, and the remainders, at most 1/2. */
  struct FixedPointRows
  {
    std::array<std::int32_t, 9> Whole;
    std::array<float, 9> Rests;
    bool operator==(const FixedPointRows& other) const
    {
      return this->Whole == other.Whole && this->Rests == other.Rests;
    }
  };
  /**
   * Rows of the matrix from fixed-point positions to the grid for shaders, in units of 2^-31.
   */
  FixedPointRows GetFixedPointRows() const;

  /**
   * An affine function of the pixel for shaders, as integers: three times (x, y, fractions of x and
   * y in units of 2^-15), for the base, per half column and per half row.
   */
  using FixedPointMap = std::array<std::int32_t, 12>;
  /**
   * Offset at depth 0 and slope of pixels' rays, the slope in units of ShaderSlopeUnit. Their error
   * is 2^-15 of the image's width in pixels.
   */
  FixedPointMap GetFixedPointOffset() const;
  FixedPointMap GetFixedPointSlope() const;
  /** Offset at depth 0 and slope of a line of the frame for shaders, as integers in these units. */
  void GetFixedPointLine(const glm::dvec2& origin, const glm::dvec2& slope,
    std::int32_t (&gridOffset)[2], std::int32_t (&gridSlope)[2]) const;

  /** Unit of slopes for shaders, in grid units across per grid unit of depth: 2^-31. */
  static constexpr double ShaderSlopeUnit = 4.656612873077393e-10;

  /** Grid unit of x and y, in units of the frame. */
  double GetGridUnit() const { return this->GridUnit; }
  /** Pivot in grid units of depth. */
  std::int32_t GetPivot() const { return this->Pivot; }
  /** A depth of the frame as PacketRay and PacketEntry count, and the other way round. */
  float FromPivot(double depth) const
  {
    return static_cast<float>(depth * GridPerDepth - this->Pivot);
  }
  double ToFrame(double fromPivot) const { return (fromPivot + this->Pivot) / GridPerDepth; }
  int GetWidth() const { return this->Width; }
  int GetHeight() const { return this->Height; }
  const RayFrame& GetFrame() const { return this->Frame; }

  /**
   * Largest deviation of u or v of a ray that may meet the mesh from the affine function, in grid
   * units. The offset is rounded by 1/2. The integer x - offset, below 2^31, is rounded to float by
   * up to 64, and so is u, which is below 2^31. The slope is below 1 and depth below 2^31: rounding
   * the depth to float changes their product by up to 64, and rounding the slope by up to 2^31 *
   * 2^-25 = 64. The sum is 256.5. The coordinates of fine rays are rounded twice, by up to 64 each,
   * and by less than 1 in all other places.
   */
  static constexpr double RoundingOfRay = 257.0;
  /**
   * Largest length per grid unit of depth. Depths differ by less than 2^32, so that a sum of
   * lengths stays below 2^127, a finite float; larger scenes look as if they had this size.
   */
  static constexpr float LargestLengthPerDepth = 39614081257132168796771975168.0f; // 2^95
  /** Depth of a vertex in the grid, in units of the frame. */
  static double DepthOf(std::int32_t gridDepth) { return gridDepth / GridPerDepth; }
  /** Grid units of depth per unit of the frame. */
  static constexpr double GridPerDepth = PacketVertex::GridPerDepth;

private:
  static float LimitedLength(double length)
  {
    return static_cast<float>(std::min(length, double{ LargestLengthPerDepth }));
  }
  /** Whole and rest of a ray's offset at the pivot and of its slope, along one axis. */
  struct AxisOfRay
  {
    std::int32_t Offset;
    double Fraction;
    float Slope;
    double SlopeRest;
  };
  AxisOfRay MakeAxis(double offset, double slope) const;
  static float FractionOf(double rest);
  static float SlopeRestOf(double rest);

  /** Units of PacketRay::Fraction in a grid unit. */
  static constexpr double FractionsOfRay = 65536.0;
  /** Slopes and their rests below are 0: coordinates are multiples of 2^-63 (ExactEdgeTest). */
  static constexpr double SmallestSlope = 9.094947017729282e-13; // 2^-40

  RayFrame Frame;
  int Width = 0;
  int Height = 0;
  double GridUnit = 1.0;
  bool Fine = false;
  /** Bound of the offsets of rays at the pivot. */
  double LargestOffset = 0.0;
  std::int32_t Pivot = 0;
  /** Matrix from fixed-point positions to the grid. */
  glm::dmat3 ToGrid{ 0.0 };
  AffinePixelMap Offset;
  AffinePixelMap Slope;
  /** World vector along a ray per grid unit of depth, an affine function of the pixel. */
  glm::dvec3 Along{ 0.0 };
  glm::dvec3 AlongPerColumn{ 0.0 };
  glm::dvec3 AlongPerRow{ 0.0 };
};

//------------------------------------------------------------------------------
/** @param offset,slope in grid units; the offset is at depth 0. */
inline auto FixedPointRays::MakeAxis(double offset, double slope) const -> AxisOfRay
{
  const double atPivot = offset + slope * this->Pivot;
  const double limited = std::min(std::max(atPivot, -this->LargestOffset), this->LargestOffset);
  // A ray that is too far away to meet the mesh is replaced by one that is parallel to the depth
  // axis, and as far away.
  const bool keepsSlope =
    (std::fabs(atPivot) <= this->LargestOffset) & (std::fabs(slope) >= SmallestSlope);
  const double kept = slope * (keepsSlope ? 1.0 : 0.0);
  AxisOfRay axis;
  axis.Offset = static_cast<std::int32_t>(limited + std::copysign(0.5, limited));
  axis.Fraction = limited - axis.Offset;
  axis.Slope = static_cast<float>(kept);
  axis.SlopeRest = kept - static_cast<double>(axis.Slope);
  return axis;
}

//------------------------------------------------------------------------------
/** PacketRay::Fraction. Truncated: twice as many fractions have the error of rounding. */
inline float FixedPointRays::FractionOf(double rest)
{
  const auto fraction = static_cast<std::int32_t>(rest * FractionsOfRay);
  return static_cast<float>(fraction) * static_cast<float>(1.0 / FractionsOfRay);
}

//------------------------------------------------------------------------------
template <class PixelAt>
void FixedPointRays::FillRays(const PixelAt& pixelAt, int count, const RowOfRays& rays) const
{
  for (int axis = 0; axis < 2; ++axis)
  {
    const auto make = [&](int i)
    {
      const glm::dvec2 pixel = pixelAt(i);
      return this->MakeAxis(
        this->Offset.At(pixel.x, pixel.y)[axis], this->Slope.At(pixel.x, pixel.y)[axis]);
    };
    for (int i = 0; i < count; ++i)
    {
      const AxisOfRay made = make(i);
      rays.Offset[axis][i] = made.Offset;
      rays.Slope[axis][i] = made.Slope;
    }
    for (int i = 0; this->Fine && i < count; ++i)
    {
      const AxisOfRay made = make(i);
      rays.Fraction[axis][i] = FractionOf(made.Fraction);
      rays.SlopeRest[axis][i] = SlopeRestOf(made.SlopeRest);
    }
  }
}

//------------------------------------------------------------------------------
/** PacketRay::SlopeRest. */
inline float FixedPointRays::SlopeRestOf(double rest)
{
  return static_cast<float>(rest * (std::fabs(rest) >= SmallestSlope ? 1.0 : 0.0));
}

//------------------------------------------------------------------------------
inline PacketRay FixedPointRays::RayAlong(const glm::dvec2& origin, const glm::dvec2& slope) const
{
  PacketRay ray;
  const double fine = this->Fine ? 1.0 : 0.0;
  // In loops over rays, products by the same factors.
  const double perUnit = 1.0 / this->GridUnit;
  const double slopePerUnit = perUnit / GridPerDepth;
  for (int axis = 0; axis < 2; ++axis)
  {
    const AxisOfRay made = this->MakeAxis(origin[axis] * perUnit, slope[axis] * slopePerUnit);
    ray.Offset[axis] = made.Offset;
    ray.Slope[axis] = made.Slope;
    ray.Fraction[axis] = FractionOf(fine * made.Fraction);
    ray.SlopeRest[axis] = SlopeRestOf(fine * made.SlopeRest);
  }
  ray.LengthPerDepth =
    LimitedLength(glm::length(this->Frame.ViewToWorld * glm::dvec3(slope, 1.0)) / GridPerDepth);
  ray.StartDepth = -1.0e+30f;
  ray.EndDepth = 1.0e+30f;
  ray.FirstEntry = 0;
  ray.EndEntry = 0;
  return ray;
}

}
