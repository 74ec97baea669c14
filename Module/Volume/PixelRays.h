// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Volume_PixelRays_h
#define meniscus_Volume_PixelRays_h

#include "Volume/Packet/Packet.h"
#include "Volume/RayFrame.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace meniscus
{

/**
 * The frames about the rays of an image's pixels (PacketRay), which are affine functions of the
 * pixel: only the difference of two vertices' depths enters them with the slope of the ray.
 *
 * (u, v) are in grid units of 2^-29 of the mesh's radius or a little more. All rays of an image
 * have the same unit, which is such that |u| and |v| stay below 2^30 where a ray meets the mesh.
 */
class PixelRays
{
public:
  /** base + i * PerColumn + j * PerRow; a row of PacketRay. */
  struct AffineRow
  {
    glm::dvec4 Base{ 0.0 };
    glm::dvec4 PerColumn{ 0.0 };
    glm::dvec4 PerRow{ 0.0 };

    glm::dvec4 At(double i, double j) const { return this->Base + i * PerColumn + j * PerRow; }
  };

  PixelRays() = default;
  PixelRays(const RayFrame& frame, int width, int height);

  /** Pixel (column, row) as RayFrame counts: from the image's centre to the pixel's centre. */
  glm::dvec2 FromCenter(int column, int row) const
  {
    return { column + 0.5 - 0.5 * this->Width, row + 0.5 - 0.5 * this->Height };
  }

  /** The ray of a pixel, without its entries, from the near plane on without end. */
  PacketRay RayOf(int column, int row) const;

  const AffineRow& GetU() const { return this->U; }
  const AffineRow& GetV() const { return this->V; }
  const glm::dvec4& GetDepth() const { return this->Depth; }
  int GetWidth() const { return this->Width; }
  int GetHeight() const { return this->Height; }
  const RayFrame& GetFrame() const { return this->Frame; }

  /** Of u or v of a ray that may meet the mesh: the largest magnitude of the constant term. */
  static constexpr double LargestOffset = 536870912.0 + 2.0;

private:
  RayFrame Frame;
  int Width = 0;
  int Height = 0;
  AffineRow U;
  AffineRow V;
  glm::dvec4 Depth{ 0.0 };
};

}

#endif
