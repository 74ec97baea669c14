// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Rays/RayFrame.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vec4.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace meniscus
{
namespace
{

/** Element of a column-vector matrix by row and column. */
double At(const glm::dmat4& m, int row, int column)
{
  return m[column][row];
}

/**
 * View coordinates (x, y), in the plane at view z, of the ray at clip position `clip`: the solution
 * of the two linear equations clip_i * w(z) = P_i (x, y, z, 1), where w does not depend on x and y.
 */
glm::dvec2 RayPoint(const glm::dmat4& p, const glm::dvec2& clip, double z)
{
  const double w = At(p, 3, 2) * z + At(p, 3, 3);
  const glm::dvec2 right(
    clip.x * w - At(p, 0, 2) * z - At(p, 0, 3), clip.y * w - At(p, 1, 2) * z - At(p, 1, 3));
  const double determinant = At(p, 0, 0) * At(p, 1, 1) - At(p, 0, 1) * At(p, 1, 0);
  return glm::dvec2(At(p, 1, 1) * right.x - At(p, 0, 1) * right.y,
           At(p, 0, 0) * right.y - At(p, 1, 0) * right.x) /
    determinant;
}

/** Slope d(x, y) / d(depth) of the ray; depth is -z. */
glm::dvec2 RaySlope(const glm::dmat4& p, const glm::dvec2& clip)
{
  // RayPoint is linear in z: the difference over one unit does not depend on the point itself.
  const double determinant = At(p, 0, 0) * At(p, 1, 1) - At(p, 0, 1) * At(p, 1, 0);
  const glm::dvec2 right(clip.x * At(p, 3, 2) - At(p, 0, 2), clip.y * At(p, 3, 2) - At(p, 1, 2));
  return -glm::dvec2(At(p, 1, 1) * right.x - At(p, 0, 1) * right.y,
           At(p, 0, 0) * right.y - At(p, 1, 0) * right.x) /
    determinant;
}

/** The affine map through its values at the image's centre, right edge and top edge. */
template <typename Function>
AffinePixelMap MapOfPixels(const glm::dvec2& imageSize, const Function& valueAt)
{
  AffinePixelMap map;
  map.Base = valueAt(glm::dvec2(0.0, 0.0));
  map.PerColumn = (valueAt(glm::dvec2(1.0, 0.0)) - map.Base) * (2.0 / imageSize.x);
  map.PerRow = (valueAt(glm::dvec2(0.0, 1.0)) - map.Base) * (2.0 / imageSize.y);
  return map;
}

bool IsFinite(const AffinePixelMap& map)
{
  const glm::dvec2 sum = map.Base + map.PerColumn + map.PerRow;
  return std::isfinite(sum.x) && std::isfinite(sum.y);
}

/** Bound of the rounding error of a - b, where both were computed by three roundings, as VTK does.
 */
double DifferenceError(double a, double b)
{
  return 1.5 * std::numeric_limits<double>::epsilon() * std::max(std::abs(a), std::abs(b));
}

/**
 * The planes at the clip depths d = 1 and d = -1. With the distance -z from the eye, d * w = P_2 is
 * -z = (d P_33 - P_23) / (d P_32 - P_22), and depth = (center.z - z) / unit. If the ratio of the
 * planes' distances is large, the denominator of the far plane is the small difference of two
 * rounded numbers; in a parallel projection the numerator of the near plane is.
 */
void SetClippingPlanes(const glm::dmat4& p, double center, double unit, RayFrame& frame)
{
  const double sign = At(p, 3, 2) + At(p, 2, 2) > 0.0 ? -1.0 : 1.0;
  const double ofNear = sign * (-At(p, 3, 2) - At(p, 2, 2));
  double ofFar = sign * (At(p, 3, 2) - At(p, 2, 2)) / ofNear;
  ofFar =
    ofFar < 0.0 ? ofFar : std::max(0.0, ofFar - DifferenceError(At(p, 3, 2), At(p, 2, 2)) / ofNear);
  const double nearest =
    (sign * (-At(p, 3, 3) - At(p, 2, 3)) - DifferenceError(At(p, 3, 3), At(p, 2, 3))) / ofNear;
  const double farthest = sign * (At(p, 3, 3) - At(p, 2, 3)) / ofNear;
  frame.DepthDenominator = { ofFar, 1.0 };
  frame.DepthNumerator = glm::dvec2(center * ofFar + farthest, center + nearest) / unit;
  frame.NearDepth = frame.DepthNumerator.y;
  frame.FarDepth = ofFar == 0.0 ? RayFrame::FarthestDepth
                                : std::min(frame.DepthNumerator.x / ofFar, RayFrame::FarthestDepth);
}

/** True if all but the clipping planes is equal. */
bool HaveSameLines(const RayFrame& a, const RayFrame& b)
{
  const auto mapOf = [](const AffinePixelMap& map)
  { return std::tie(map.Base, map.PerColumn, map.PerRow); };
  const auto rest = [](const RayFrame& frame)
  {
    return std::tie(frame.RowX, frame.RowY, frame.RowDepth, frame.ViewToWorld, frame.Handedness,
      frame.Reach, frame.SmallestCell);
  };
  return mapOf(a.Origin) == mapOf(b.Origin) && mapOf(a.Slope) == mapOf(b.Slope) &&
    rest(a) == rest(b);
}

/**
 * Room for rounding at the ends of the mesh, in units of the frame: vertices are moved by 2^-30 at
 * most, and depths about the pivot, below 2, are floats.
 */
constexpr double ReachMargin = 9.5367431640625e-07; // 2^-20

}

//------------------------------------------------------------------------------
bool operator==(const RayFrame& a, const RayFrame& b)
{
  const auto planes = [](const RayFrame& frame) {
    return std::tie(frame.NearDepth, frame.FarDepth, frame.DepthNumerator, frame.DepthDenominator);
  };
  return HaveSameLines(a, b) && planes(a) == planes(b);
}

//------------------------------------------------------------------------------
bool DifferInClippingRange(const RayFrame& a, const RayFrame& b)
{
  return HaveSameLines(a, b) && a.ShowsWholeDepth() && b.ShowsWholeDepth();
}

//------------------------------------------------------------------------------
RayFrame Refined(const RayFrame& frame, int across)
{
  RayFrame refined = frame;
  for (AffinePixelMap* map : { &refined.Origin, &refined.Slope })
  {
    map->PerColumn /= static_cast<double>(across);
    map->PerRow /= static_cast<double>(across);
  }
  return refined;
}

//------------------------------------------------------------------------------
RayFrame Shifted(const RayFrame& frame, const glm::dvec2& fromCenter)
{
  RayFrame shifted = frame;
  for (AffinePixelMap* map : { &shifted.Origin, &shifted.Slope })
  {
    map->Base = map->At(fromCenter.x, fromCenter.y);
  }
  return shifted;
}

//------------------------------------------------------------------------------
RayFrameStatus ComputeRayFrame(const RayFrameInput& input, RayFrame& frame)
{
  const glm::dmat4& p = input.ViewToClip;
  if (At(p, 3, 0) != 0.0 || At(p, 3, 1) != 0.0)
  {
    return RayFrameStatus::NotACamera;
  }
  const glm::dmat4 modelToView = input.WorldToView * input.ModelToWorld;
  const glm::dmat3 linear(modelToView);
  const double determinant = glm::determinant(linear);
  const double worldDeterminant = glm::determinant(glm::dmat3(input.WorldToView));
  if (!(std::abs(determinant) > 0.0) || !std::isfinite(determinant) ||
    !(std::abs(worldDeterminant) > 0.0) || !std::isfinite(worldDeterminant))
  {
    return RayFrameStatus::Singular;
  }

  const auto row = [&](int i)
  {
    return input.Radius *
      glm::dvec3(At(modelToView, i, 0), At(modelToView, i, 1), At(modelToView, i, 2));
  };
  // Bound of the stretch of the matrix in any direction (the largest sum of a row of M M^T), so
  // that the mesh is within the unit also along the axes of rotated frames. For a similarity it is
  // the scale.
  double stretch = 0.0;
  for (int i = 0; i < 3; ++i)
  {
    stretch = std::max(stretch,
      std::abs(glm::dot(row(i), row(0))) + std::abs(glm::dot(row(i), row(1))) +
        std::abs(glm::dot(row(i), row(2))));
  }
  const double unit = std::sqrt(stretch);
  frame.RowX = row(0) / unit;
  frame.RowY = row(1) / unit;
  frame.RowDepth = -row(2) / unit;
  frame.Reach = ReachMargin + std::min(glm::dot(glm::abs(frame.RowDepth), input.HalfSize), 1.0);
  frame.Handedness = determinant > 0.0 ? 1 : -1;
  frame.SmallestCell = input.SmallestCell;
  frame.ViewToWorld = unit * glm::inverse(glm::dmat3(input.WorldToView));
  frame.ViewToWorld[2] = -frame.ViewToWorld[2]; // depth counts along -z

  const glm::dvec3 center(modelToView * glm::dvec4(input.Center, 1.0));
  const glm::dvec2 centerXY(center);
  frame.Origin = MapOfPixels(input.ImageSize,
    [&](const glm::dvec2& clip) { return (RayPoint(p, clip, center.z) - centerXY) / unit; });
  frame.Slope =
    MapOfPixels(input.ImageSize, [&](const glm::dvec2& clip) { return RaySlope(p, clip); });
  if (!IsFinite(frame.Origin) || !IsFinite(frame.Slope))
  {
    return RayFrameStatus::Singular;
  }

  SetClippingPlanes(p, center.z, unit, frame);
  return std::isfinite(frame.NearDepth) ? RayFrameStatus::Ok : RayFrameStatus::Singular;
}

}
