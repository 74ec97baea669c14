// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Volume_Refracted_RefractionFrames_h
#define meniscus_Volume_Refracted_RefractionFrames_h

#include "Common/RangeLoop.h"
#include "Volume/Mesh/TetrahedralMesh.h"
#include "Volume/Optics/SurfaceLighting.h"
#include "Volume/Packet/Data/PacketRays.h"
#include "Volume/Rays/FixedPointRays.h"
#include "Volume/Refracted/RefractedRayField.h"

#include <array>
#include <cstdint>
#include <vector>

namespace meniscus
{

/** A straight line of a frame: (x, y) = Origin + depth * Slope. */
struct FrameLine
{
  glm::dvec2 Origin;
  glm::dvec2 Slope;

  /** Through a place, along a step that has a depth. */
  static FrameLine Through(const glm::dvec3& place, const glm::dvec3& step)
  {
    const glm::dvec2 slope = glm::dvec2(step) / step.z;
    return { glm::dvec2(place) - place.z * slope, slope };
  }
};

/** The frame of the view turned, so that its depth is along the rays. */
struct RefractionFrame
{
  /** Of the view to this one: a rotation. */
  glm::dmat3 FromView{ 1.0 };
  /** The grid. */
  FixedPointRays Rays;
  /** The mesh's coordinates are within this. */
  double Extent = 0.0;
  /** The mesh's, once they have been placed. */
  std::vector<PacketVertex> Vertices;

  /** Lights of the frame of the view. */
  SurfaceLighting Turn(const SurfaceLighting& lighting) const;
};

/**
 * Frames for rays of any direction. One alone places vertices for all slopes within 1; there are
 * six, with depth along and against the axes of a cube. The first one's depth is the mean direction
 * of the rays, so mostly it is all that is needed.
 */
class RefractionFrames
{
public:
  static constexpr int Number = 6;

  /** Turns the frames to the rays behind the membrane, and finds out which are needed. */
  void Turn(const RefractedRayField& sight, const RayFrame& view, const RangeLoop& loop);

  /** Places the vertices of a mesh in the frames that are needed. Scalars as of PlaceVertices(). */
  void Place(const TetrahedralMesh& mesh, const std::vector<float>& scalars, const RangeLoop& loop);

  /** The frame of a ray of that direction. */
  int IndexOf(const glm::dvec3& step) const;
  const RefractionFrame& Get(int index) const
  {
    return this->Frames[static_cast<std::size_t>(index)];
  }
  std::int64_t GetBytes() const;

private:
  /** Columns: the axes of the cube, the mean direction last. */
  glm::dmat3 Axes{ 1.0 };
  unsigned int Needed = 0;
  std::array<RefractionFrame, Number> Frames;
};

}

#endif
