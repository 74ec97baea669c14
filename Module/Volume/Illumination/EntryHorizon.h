// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Volume/Mesh/TetrahedralMesh.h"
#include "Volume/Packet/Data/PacketRays.h"
#include "Volume/Refracted/RefractionFrames.h"

#include <glm/vec2.hpp>

#include <vector>

namespace meniscus
{

/**
 * Largest depth at which lines along the depth of a frame enter a mesh, by square of a grid across
 * the depth. A line that begins behind it meets no boundary face by which it could enter, so that
 * none has to be searched for: most lines that begin in a mesh leave it once and for all.
 */
class EntryHorizon
{
public:
  /**
   * @param faces the boundary of the mesh.
   * @param frame frame with the mesh's vertices.
   */
  void Set(const std::vector<BoundaryFace>& faces, const RefractionFrame& frame);

  /**
   * False if a line along the depth enters by no face at this depth or behind it.
   * @param depth in units of the frame.
   */
  bool MayEnter(const PacketRay& ray, double depth) const;

private:
  static constexpr int Size = 256;

  void Raise(const PacketVertex* const (&corners)[3], double area);

  /** Corner of the grid, and squares per grid unit of the frame. */
  glm::dvec2 Lower{ 0.0 };
  glm::dvec2 PerUnit{ 0.0 };
  /** Grid units of depth; row by row. */
  std::vector<float> Depths;
};

}
