// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Volume/Rays/RayFrame.h"

#include <glm/mat2x2.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace meniscus
{

/** A vector per pixel, as an affine function. */
struct AffinePixelVector
{
  glm::dvec3 Base{ 0.0 };
  glm::dvec3 PerColumn{ 0.0 };
  glm::dvec3 PerRow{ 0.0 };

  glm::dvec3 At(const glm::dvec2& pixel) const
  {
    return this->Base + (pixel.x * this->PerColumn + pixel.y * this->PerRow);
  }
};

/**
 * Rays of an image: parallel rays, rays of one eye, or any that are affine in the pixel. Places
 * are in the units of the mesh. Pixels are numbered from 0 on.
 */
class RayImage
{
public:
  /** @param beginDepth depth in the frame at which the rays begin. */
  RayImage(const RayFrame& frame, double beginDepth, const glm::ivec2& size);

  const glm::ivec2& GetSize() const { return this->Size; }
  glm::dvec3 GetOrigin(const glm::dvec2& pixel) const { return this->Origins.At(pixel); }
  /** Direction of any length. */
  glm::dvec3 GetDirection(const glm::dvec2& pixel) const { return this->Directions.At(pixel); }
  /** Change of x and y in the frame per unit of depth. */
  glm::dvec2 GetSlope(const glm::dvec2& pixel) const
  {
    const glm::dvec2 p = pixel - this->Middle;
    return this->SlopeMap.At(p.x, p.y);
  }
  /** Direction in which depths are measured; all rays go forward along it. */
  glm::dvec3 GetAxis() const
  {
    return { this->ToFrame[0].z, this->ToFrame[1].z, this->ToFrame[2].z };
  }
  /** x, y and depth in the frame. */
  const glm::dmat3& GetToFrame() const { return this->ToFrame; }
  /** Pixel in the middle of the image. */
  const glm::dvec2& GetMiddle() const { return this->Middle; }
  /** Steps between the rays of neighbouring columns and rows, at a depth in the frame. */
  glm::dmat2 GetSteps(double depth) const
  {
    return { this->PlaceMap.PerColumn + depth * this->SlopeMap.PerColumn,
      this->PlaceMap.PerRow + depth * this->SlopeMap.PerRow };
  }
  /** Place in the frame, at a depth, of the ray through the middle of the image. */
  glm::dvec2 GetMiddleAt(double depth) const
  {
    return this->PlaceMap.Base + depth * this->SlopeMap.Base;
  }

  /**
   * Pixel of the ray through a place, with an error of up to 2^-22; NaN if the error may be larger
   * or the place is not before the beginnings of the rays.
   */
  glm::dvec2 Project(const glm::dvec3& place) const;
  /**
   * True if a direction and the direction of a pixel's ray, both of unit length, differ by less
   * than a length, which is below 1.
   */
  bool IsNearRay(const glm::dvec2& pixel, const glm::dvec3& direction, double length) const;

private:
  glm::ivec2 Size;
  glm::dvec2 Middle;
  double BeginDepth;
  AffinePixelMap PlaceMap;
  AffinePixelMap SlopeMap;
  glm::dmat3 ToFrame;
  AffinePixelVector Origins;
  AffinePixelVector Directions;
};

}
