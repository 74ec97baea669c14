// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Graded/RayImage.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace meniscus
{

//------------------------------------------------------------------------------
RayImage::RayImage(const RayFrame& frame, double beginDepth, const glm::ivec2& size)
  : Size(size)
  , Middle(0.5 * (glm::dvec2(size) - 1.0))
  , BeginDepth(beginDepth)
  , PlaceMap(frame.Origin)
  , SlopeMap(frame.Slope)
  , ToFrame(glm::transpose(glm::dmat3(frame.RowX, frame.RowY, frame.RowDepth)))
{
  const glm::dmat3 fromFrame = glm::inverse(this->ToFrame);
  const auto inMesh = [&fromFrame, this](
                        const glm::dmat2& steps, const glm::dvec2& middle, double depth)
  {
    return AffinePixelVector{ fromFrame * glm::dvec3(middle - steps * this->Middle, depth),
      fromFrame * glm::dvec3(steps[0], 0.0), fromFrame * glm::dvec3(steps[1], 0.0) };
  };
  this->Origins = inMesh(this->GetSteps(beginDepth), this->GetMiddleAt(beginDepth), beginDepth);
  this->Directions =
    inMesh({ this->SlopeMap.PerColumn, this->SlopeMap.PerRow }, this->SlopeMap.Base, 1.0);
}

//------------------------------------------------------------------------------
glm::dvec2 RayImage::Project(const glm::dvec3& place) const
{
  // Places have a size of about 1, and with their frame an error of some 2^-50: of less than 2^-22
  // pixels, if pixels are not smaller than this.
  constexpr double smallestStep = 0x1p-28;
  // Beyond this, rounding would count.
  constexpr double mostPixels = 0x1p24;
  const glm::dvec3 there = this->ToFrame * place;
  const glm::dmat2 steps = this->GetSteps(there.z);
  const double area = steps[0].x * steps[1].y - steps[0].y * steps[1].x;
  const double longest = std::max(glm::dot(steps[0], steps[0]), glm::dot(steps[1], steps[1]));
  const glm::dvec2 way = glm::dvec2(there) - this->GetMiddleAt(there.z);
  const glm::dvec2 pixel = this->Middle +
    glm::dvec2(way.x * steps[1].y - way.y * steps[1].x, way.y * steps[0].x - way.x * steps[0].y) /
      area;
  const bool isExact = there.z > this->BeginDepth &&
    area * area > smallestStep * smallestStep * longest &&
    std::max(std::abs(pixel.x), std::abs(pixel.y)) < mostPixels;
  return isExact ? pixel : glm::dvec2(std::numeric_limits<double>::quiet_NaN());
}

//------------------------------------------------------------------------------
bool RayImage::IsNearRay(const glm::dvec2& pixel, const glm::dvec3& direction, double length) const
{
  // The square of the difference is 2 - 2 cos.
  const double cosine = 1.0 - 0.5 * length * length;
  const glm::dvec3 ray = this->GetDirection(pixel);
  const double along = glm::dot(ray, direction);
  return along > 0.0 && along * along > cosine * cosine * glm::dot(ray, ray);
}

}
