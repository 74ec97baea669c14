// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * The rays of an image in the frame of the view, as affine functions of the pixel.
 *
 * Frame: x to the right, y up, depth away from the viewer, all in view coordinates relative to the
 * mesh's centre and in units of about the mesh's radius. The ray of a pixel is (x, y) = Origin +
 * depth * Slope. With p a model position relative to the mesh's centre in units of its radius, the
 * ray-aligned projection of a vertex is u = RowX p - Origin_x - Slope_x * depth, likewise v, and
 * depth = RowDepth p. All numbers are of the order of 1, whatever the distance of the camera or of
 * the origin of coordinates and the size of the mesh; they are computed in double precision and
 * rounded once.
 */
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <algorithm>

namespace meniscus
{

struct RayFrameInput
{
  /** Model to world, world to view and view to clip coordinates; column vectors. */
  glm::dmat4 ModelToWorld{ 1.0 };
  glm::dmat4 WorldToView{ 1.0 };
  glm::dmat4 ViewToClip{ 1.0 };
  /** Centre of the mesh, model coordinates. */
  glm::dvec3 Center{ 0.0 };
  /** Radius of the mesh about its centre, model coordinates, > 0. */
  double Radius = 1.0;
  /** Half of the sides of the mesh's box over that radius. */
  glm::dvec3 HalfSize{ 1.0 };
  /** Size of the mesh's smallest cell over that radius (TetrahedralMesh::GetSmallestCell()). */
  double SmallestCell = 1.0;
  /** Number of pixels in the image, which the clip coordinates [-1, 1] span. */
  glm::dvec2 ImageSize{ 1.0 };
};

/** base + i * PerColumn + j * PerRow, (i, j) counted from the image's centre to a pixel's centre.
 */
struct AffinePixelMap
{
  glm::dvec2 Base{ 0.0 };
  glm::dvec2 PerColumn{ 0.0 };
  glm::dvec2 PerRow{ 0.0 };

  glm::dvec2 At(double i, double j) const { return this->Base + i * PerColumn + j * PerRow; }
};

struct RayFrame
{
  /** Rows of the map from a normalised model position to x, y and depth. */
  glm::dvec3 RowX{ 0.0 };
  glm::dvec3 RowY{ 0.0 };
  glm::dvec3 RowDepth{ 0.0 };
  AffinePixelMap Origin;
  AffinePixelMap Slope;
  /** The world length of a vector (x, y, depth) is the length of this matrix times the vector. */
  glm::dmat3 ViewToWorld{ 1.0 };
  /**
   * -1 if the map from model to view mirrors, which exchanges entering and leaving faces; otherwise
   * 1.
   */
  int Handedness = 1;
  /**
   * Depths of the clipping planes. Where the rounding of the matrix leaves a plane open, it is the
   * outermost place, which is FarthestDepth for a far plane that may be at infinity.
   */
  double NearDepth = 0.0;
  double FarDepth = FarthestDepth;
  /** The mesh is between the depths -Reach and Reach, with room for rounding. */
  double Reach = 1.0;
  /** RayFrameInput::SmallestCell. */
  double SmallestCell = 1.0;
  /**
   * Depth = dot(share, DepthNumerator) / dot(share, DepthDenominator) between the planes, where the
   * share of the far plane, x, is the window depth in [0, 1], and the share of the near plane, y,
   * the rest of 1. The denominator of the near plane is 1.
   */
  glm::dvec2 DepthNumerator{ 0.0 };
  glm::dvec2 DepthDenominator{ 1.0 };

  static constexpr double FarthestDepth = 1.0e+30;

  /** True if the clipping planes do not cut the mesh. */
  bool ShowsWholeDepth() const
  {
    return this->NearDepth <= -this->Reach && this->FarDepth >= this->Reach;
  }
  /**
   * Depth at which a ray ends for a window depth in [0, 1]. All ends in front of the mesh are
   * equal, and all behind it.
   */
  double EndAt(double windowDepth) const
  {
    return std::clamp(this->DepthAt(2.0 * windowDepth - 1.0), -this->Reach, this->Reach);
  }

  /** @param clipDepth in [-1, 1]. */
  double DepthAt(double clipDepth) const
  {
    if (!(clipDepth < 1.0))
    {
      return this->FarDepth;
    }
    const glm::dvec2 shares(0.5 + 0.5 * clipDepth, 0.5 - 0.5 * clipDepth);
    return (shares.x * this->DepthNumerator.x + shares.y * this->DepthNumerator.y) /
      (shares.x * this->DepthDenominator.x + shares.y * this->DepthDenominator.y);
  }
};

/** Rays of an image with `across` times the columns and rows in the same view. */
RayFrame Refined(const RayFrame& frame, int across);

/**
 * Rays of the same image through another point of each pixel.
 * @param fromCenter place in the pixel from its centre, in pixels.
 */
RayFrame Shifted(const RayFrame& frame, const glm::dvec2& fromCenter);

/** True if all numbers are equal, so that images have the same rays. */
bool operator==(const RayFrame& a, const RayFrame& b);

/** True if images have the same rays, but for the clipping planes, which cut the mesh in neither.
 */
bool DifferInClippingRange(const RayFrame& a, const RayFrame& b);

enum class RayFrameStatus
{
  Ok,
  /** A matrix is singular or not finite. */
  Singular,
  /**
   * The homogeneous coordinate varies within planes parallel to the image: not the matrix of a
   * camera.
   */
  NotACamera
};

RayFrameStatus ComputeRayFrame(const RayFrameInput& input, RayFrame& frame);

}
