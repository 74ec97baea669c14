// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Volume_Rays_FixedPointRays_h
#define meniscus_Volume_Rays_FixedPointRays_h

#include "Volume/Packet/Data/PacketRays.h"
#include "Volume/Rays/RayFrame.h"

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstdint>

namespace meniscus
{

/**
 * The rays of an image's pixels, and the positions of vertices relative to them, in integer grid
 * units.
 *
 * Vertices are rounded once, to (x, y, depth) of the frame: depth in units of about 2^-30 of the
 * frame's, x and y in units of about 2^-29 times 1 + the steepest slope, so that |u| and |v| stay
 * below 2^30 where a ray meets the mesh. All further arithmetic is in integers (PacketRay), the
 * same on every processor and for every user of a ray.
 */
class FixedPointRays
{
public:
  FixedPointRays() = default;
  FixedPointRays(const RayFrame& frame, int width, int height);

  /**
   * Vector from the image's centre to the centre of pixel (column, row), in pixels, as RayFrame
   * counts.
   */
  glm::dvec2 FromCenter(int column, int row) const
  {
    return { column + 0.5 - 0.5 * this->Width, row + 0.5 - 0.5 * this->Height };
  }

  /** Ray of a pixel from the near plane on, without a far end and without entries. */
  PacketRay RayOf(int column, int row) const;
  /**
   * The ray (x, y) = origin + depth * slope of the frame, without ends and without entries.
   * @param slope no steeper than the steepest ray of a pixel.
   */
  PacketRay RayAlong(const glm::dvec2& origin, const glm::dvec2& slope) const;

  /**
   * Position of a vertex in the grid.
   * @param position TetrahedralMesh::GetFixedPositions().
   */
  glm::ivec3 Place(const glm::ivec3& position) const;
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
  /**
   * Rows of the matrix from fixed-point positions to the grid. Those of x and y are in units of
   * 2^-32, that of depth in units of 2^-31.
   */
  std::array<std::int32_t, 9> GetFixedPointRows() const;

  /**
   * An affine function of the pixel for shaders, as integers: three times (x, y, fractions of x and
   * y in units of 2^-15), for the base, per half column and per half row.
   */
  using FixedPointMap = std::array<std::int32_t, 12>;
  /**
   * Offset and slope of pixels' rays as in PacketRay, the slope in units of 2^-32. Their error is
   * 2^-15 of the image's width in pixels. The slope is half a unit larger, so that rounding down
   * gives the nearest value.
   */
  FixedPointMap GetFixedPointOffset() const;
  FixedPointMap GetFixedPointSlope() const;

  /** Grid unit of x and y, in units of the frame. */
  double GetGridUnit() const { return this->GridUnit; }
  int GetWidth() const { return this->Width; }
  int GetHeight() const { return this->Height; }
  const RayFrame& GetFrame() const { return this->Frame; }

  /**
   * Largest deviation of u or v of a ray from the affine function: rounding of the value and of its
   * slope.
   */
  static constexpr double RoundingOfRay = 0.625 + 0.0625;
  /** Largest magnitude of the offset of a ray that may meet the mesh. */
  static constexpr double LargestOffset = 536870912.0 + 2.0;
  /** Depth of a vertex in the grid, in units of the frame. */
  static double DepthOf(std::int32_t gridDepth) { return gridDepth / GridPerDepth; }
  /** Grid units of depth per unit of the frame. */
  static constexpr double GridPerDepth = PacketVertex::GridPerDepth;

private:
  PacketRay MakeRay(
    const glm::dvec2& offset, const glm::dvec2& slope, const glm::dvec2& perDepth) const;

  RayFrame Frame;
  int Width = 0;
  int Height = 0;
  double GridUnit = 1.0;
  /** Matrix from fixed-point positions to the grid. */
  glm::dmat3 ToGrid{ 0.0 };
  AffinePixelMap Offset;
  AffinePixelMap Slope;
};

}

#endif
