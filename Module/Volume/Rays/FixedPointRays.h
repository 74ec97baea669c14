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
 * The rays of an image's pixels and where vertices lie about them, in whole grid units.
 *
 * Vertices are rounded once, to (x, y, depth) of the frame: depth in units of about 2^-30 of the
 * frame's, x and y in units of about 2^-29 times 1 + the steepest slope, so that |u| and |v| stay
 * below 2^30 where a ray meets the mesh. From there on all is integer arithmetic (PacketRay), the
 * same on every processor and for every user of a ray.
 */
class FixedPointRays
{
public:
  FixedPointRays() = default;
  FixedPointRays(const RayFrame& frame, int width, int height);

  /** Pixel (column, row) as RayFrame counts: from the image's centre to the pixel's centre. */
  glm::dvec2 FromCenter(int column, int row) const
  {
    return { column + 0.5 - 0.5 * this->Width, row + 0.5 - 0.5 * this->Height };
  }

  /** The ray of a pixel, without its entries, from the near plane on without end. */
  PacketRay RayOf(int column, int row) const;
  /**
   * The ray (x, y) = origin + depth * slope of the frame, without its entries and without ends.
   * @param slope  no steeper than the steepest of a pixel.
   */
  PacketRay RayAlong(const glm::dvec2& origin, const glm::dvec2& slope) const;

  /** Where a vertex lies in the grid. @param position  TetrahedralMesh::GetFixedPositions(). */
  glm::ivec3 Place(const glm::ivec3& position) const;
  /** Whether Place() is the same function. */
  bool PlacesAs(const FixedPointRays& other) const { return this->ToGrid == other.ToGrid; }
  /** Whether the rays of all pixels are the same, and vertices lie the same about them. */
  bool SeesAs(const FixedPointRays& other) const;

  /**
   * About the ray of pixel (i, j), counted from the image's centre, u = x - offset - slope * depth,
   * all in grid units; likewise v.
   */
  const AffinePixelMap& GetOffset() const { return this->Offset; }
  const AffinePixelMap& GetSlope() const { return this->Slope; }
  /**
   * Rows of the matrix from fixed-point positions to the grid, those of x and y in units of 2^-32,
   * that of depth in units of 2^-31.
   */
  std::array<std::int32_t, 9> GetFixedPointRows() const;

  /**
   * An affine function of the pixel for shaders, as whole numbers: three times (x, y, fractions of
   * x and y in units of 2^-15), the base, then per half column and per half row.
   */
  using FixedPointMap = std::array<std::int32_t, 12>;
  /**
   * Offset and slope, the latter in units of 2^-32, of pixels' rays as in PacketRay: to 2^-15 of
   * the image's width in pixels. The slope's holds half a unit more, so that rounding down gives
   * the nearest.
   */
  FixedPointMap GetFixedPointOffset() const;
  FixedPointMap GetFixedPointSlope() const;

  /** Of x and y, in units of the frame. */
  double GetGridUnit() const { return this->GridUnit; }
  int GetWidth() const { return this->Width; }
  int GetHeight() const { return this->Height; }
  const RayFrame& GetFrame() const { return this->Frame; }

  /** By what u or v of a ray differs from the affine function: rounding of it and of its slope. */
  static constexpr double RoundingOfRay = 0.625 + 0.0625;
  /** The largest magnitude of the offset of a ray that may meet the mesh. */
  static constexpr double LargestOffset = 536870912.0 + 2.0;
  /** Of a vertex in the grid, in units of the frame. */
  static double DepthOf(std::int32_t gridDepth) { return gridDepth / GridPerDepth; }

private:
  static constexpr double GridPerDepth = PacketVertex::GridPerDepth;

  PacketRay MakeRay(
    const glm::dvec2& offset, const glm::dvec2& slope, const glm::dvec2& perDepth) const;

  RayFrame Frame;
  int Width = 0;
  int Height = 0;
  double GridUnit = 1.0;
  /** Fixed-point positions to the grid. */
  glm::dmat3 ToGrid{ 0.0 };
  AffinePixelMap Offset;
  AffinePixelMap Slope;
};

}

#endif
