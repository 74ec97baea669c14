// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/** Projection of a membrane along an axis, as a field of heights over a plane. */
#pragma once

#include "Refraction/Membrane/CurvedPatches.h"
#include "Refraction/Membrane/Membrane.h"

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace meniscus
{

/** Two directions perpendicular to an axis, and the height along it. */
struct HeightFrame
{
  HeightFrame() = default;
  explicit HeightFrame(const glm::dvec3& axis);

  glm::dvec2 Project(const glm::dvec3& v) const
  {
    return { glm::dot(this->First, v), glm::dot(this->Second, v) };
  }
  double GetHeight(const glm::dvec3& v) const { return glm::dot(this->Axis, v); }
  /** Coordinates in the frame; the third one is along the axis. */
  glm::dvec3 ToFrame(const glm::dvec3& v) const { return { this->Project(v), this->GetHeight(v) }; }

  glm::dvec3 Axis{ 0.0, 0.0, 1.0 };
  glm::dvec3 First{ 1.0, 0.0, 0.0 };
  glm::dvec3 Second{ 0.0, 1.0, 0.0 };
};

/**
 * True if the flat facets, projected along the axis, are a triangulation of one convex polygon: all
 * have the same winding, and their border is one loop that turns to one side only and once around.
 * In that case no place of the polygon is covered twice, and the straight way between two of its
 * places stays inside.
 */
bool IsConvexField(
  const Membrane& membrane, const CurvedPatches& patches, const HeightFrame& frame);

}
