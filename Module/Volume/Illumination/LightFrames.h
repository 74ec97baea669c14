// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Common/RangeLoop.h"
#include "Volume/Illumination/ShadowStarts.h"
#include "Volume/Mesh/TetrahedralMesh.h"
#include "Volume/Rays/RayFrame.h"
#include "Volume/Refracted/RefractionFrames.h"

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <vector>

namespace meniscus
{

/**
 * Lines from the vertices of a mesh to a light, in frames whose depth grows towards the light: one
 * frame, along the light, if the light is at infinity; otherwise the frames along and against the
 * axes of a cube that lines need. `base` has the places in the base frame.
 */
class LightFrames
{
public:
  /**
   * @param base frame of the light, of which only the maps to it and to the world are used.
   * @param light position and 1, or direction towards the light, of any length but 0, and 0.
   */
  void Set(const RayFrame& base, const glm::dvec4& light);

  /**
   * Places the vertices in the frames that lines need.
   * @param scalars as for PlaceVertices().
   */
  void Place(const TetrahedralMesh& mesh, const std::vector<float>& scalars,
    const ShadowStarts& starts, const RangeLoop& loop);

  bool IsParallel() const { return this->Light.w == 0.0; }
  int GetNumberOfFrames() const { return static_cast<int>(this->Frames.size()); }
  const RefractionFrame& Get(int index) const
  {
    return this->Frames[static_cast<std::size_t>(index)];
  }
  /** True if lines are in the frame. */
  bool IsNeeded(int index) const { return (this->Needed >> index & 1u) != 0; }

  /** A place of normalised model coordinates in the base frame. */
  glm::dvec3 ToBaseFrame(const glm::dvec3& place) const { return this->ToBase * place; }
  /** Step from a place to the light, or the direction towards a light at infinity, of length 1. */
  glm::dvec3 StepFrom(const glm::dvec3& place) const
  {
    return glm::dvec3(this->Light) - this->Light.w * place;
  }
  /** Index of the frame of a line. */
  int IndexOf(const glm::dvec3& step) const
  {
    return this->IsParallel() ? 0 : RefractionFrames::IndexAlong(this->Axes, step);
  }

private:
  glm::dvec4 Light{ 0.0 };
  glm::dmat3 ToBase{ 1.0 };
  /** Columns: axes of the cube, the direction from the mesh's centre to the light last. */
  glm::dmat3 Axes{ 1.0 };
  unsigned int Needed = 0;
  std::vector<RefractionFrame> Frames;
};

}
