// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Common/RangeLoop.h"
#include "Refraction/Tubes/BoxTree.h"
#include "Volume/Mesh/TetrahedralMesh.h"
#include "Volume/Optics/SurfaceLighting.h"
#include "Volume/Packet/Data/PacketRays.h"
#include "Volume/Rays/FixedPointRays.h"
#include "Volume/Refracted/RayLegs.h"

#include <glm/common.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace meniscus
{

/** A straight line in a frame: (x, y) = Origin + depth * Slope. */
struct FrameLine
{
  glm::dvec2 Origin;
  glm::dvec2 Slope;

  /** The line through `place` along `step`, which must have a depth component. */
  static FrameLine Through(const glm::dvec3& place, const glm::dvec3& step)
  {
    const glm::dvec2 slope = glm::dvec2(step) / step.z;
    return { glm::dvec2(place) - place.z * slope, slope };
  }
};

/** The frame of the view, rotated so that its depth is along the refracted rays. */
struct RefractionFrame
{
  /** Rotation from the frame of the view to this one. */
  glm::dmat3 FromView{ 1.0 };
  FixedPointRays Rays;
  /** Bound of the magnitude of the mesh's coordinates. */
  double Extent = 0.0;
  /** Vertices of the mesh, after they have been placed. */
  std::vector<PacketVertex> Vertices;

  /**
   * The frame `view` after a rotation. Only its maps to the frame and to the world are used.
   * @param steepest largest slope of rays in the frame, 0 or 1.
   * @param pivot depth of the rays' pivot in the frame; moved into the mesh's bounds.
   * @param spacing smallest distance of rays at the pivot, in units of the frame.
   */
  static RefractionFrame Make(const RayFrame& view, const glm::dmat3& rotation, double steepest,
    double pivot, double spacing);
  /** Rotates lights from the frame of the view to this frame. */
  SurfaceLighting Turn(const SurfaceLighting& lighting) const;
};

/**
 * Frames for the refracted legs of an image's rays, of any direction. One frame handles all slopes
 * within 1; there are six, with depth along and against the axes of a cube. The depth of the first
 * one is the mean direction of the refracted rays, so that in most cases no other is needed.
 */
class RefractionFrames
{
public:
  static constexpr int Number = 6;

  /**
   * Rotates the frames to the refracted legs, and determines which frames are needed.
   * @param mean their mean direction in the frame of the view; 0 if there is none.
   * @param steps bounds of their steps, there as well; empty if they are not known.
   */
  void Turn(const RayLegs& legs, const glm::dvec3& mean, const RangeLoop& loop,
    const AxisBox& steps = AxisBox());

  /**
   * Places the vertices of a mesh in the frames that are needed. For the scalars see
   * PlaceVertices().
   */
  void Place(const TetrahedralMesh& mesh, const std::vector<float>& scalars, const RangeLoop& loop);

  /**
   * Rotation to a frame whose depth is along or against an axis of the cube (a column of `axes`);
   * the handedness is always the same.
   */
  static glm::dmat3 RotationTo(const glm::dmat3& axes, int index);
  /** Index of the frame for a ray of that direction. */
  int IndexOf(const glm::dvec3& step) const { return IndexAlong(this->Axes, step); }
  /** The same for frames along the axes of another cube. */
  static int IndexAlong(const glm::dmat3& axes, const glm::dvec3& step)
  {
    const glm::dvec3 along = step * axes;
    const glm::dvec3 size(std::fabs(along.x), std::fabs(along.y), std::fabs(along.z));
    // In the order of the frames' axes, so that the axis of the mean direction is preferred.
    const bool isZ = (size.z >= size.x) & (size.z >= size.y);
    const bool isX = size.x >= size.y;
    const double component = isZ ? along.z : (isX ? along.x : along.y);
    return (isZ ? 0 : (isX ? 2 : 4)) + (component < 0.0 ? 1 : 0);
  }
  /** True if all rays belong to the first frame. */
  bool IsFirstEnough() const { return this->Needed == 1; }
  const RefractionFrame& Get(int index) const
  {
    return this->Frames[static_cast<std::size_t>(index)];
  }
  std::int64_t GetBytes() const;

private:
  bool IsAlongMean(const AxisBox& steps) const;
  unsigned int FindNeeded(const RayLegs& legs, const RangeLoop& loop) const;
  unsigned int FindNeeded(const RayLegs& legs, int tile) const;
  unsigned int FindNeeded(const RefractedRay* rays, int square) const;

  /** Columns: the axes of the cube, the mean direction last. */
  glm::dmat3 Axes{ 1.0 };
  unsigned int Needed = 0;
  std::array<RefractionFrame, Number> Frames;
};

}
