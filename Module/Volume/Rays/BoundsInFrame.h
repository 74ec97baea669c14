// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

namespace meniscus
{

/** Bounding box of the visible geometry, in the frame of the view. */
struct BoundsInFrame
{
  glm::dvec3 Center{ 0.0 };
  /** Columns: vectors from the centre to the middles of three sides. */
  glm::dmat3 HalfEdges{ 0.0 };

  bool operator==(const BoundsInFrame& other) const
  {
    return this->Center == other.Center && this->HalfEdges == other.HalfEdges;
  }
};

}
