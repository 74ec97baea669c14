// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <glm/vec3.hpp>

#include <cstdint>

namespace meniscus
{

/**
 * Maps positions in a box to 30-bit indices along a Hilbert curve through a cube of 1024^3 cells
 * around the box. Cells with consecutive indices share a face, so points that are sorted by their
 * indices are near each other. The cells are cubes: in longer ones, steps across would be shorter
 * than steps along.
 */
class HilbertCurve
{
public:
  static constexpr int BitsPerAxis = 10;

  /** The box may be flat in any direction, or a point. */
  HilbertCurve(const glm::dvec3& lower, const glm::dvec3& upper);

  std::uint32_t Code(const glm::dvec3& position) const;

private:
  glm::dvec3 Lower;
  double CellsPerUnit;
};

/** Index of a cell; each coordinate is less than 2^HilbertCurve::BitsPerAxis. */
std::uint32_t HilbertCode(const std::uint32_t (&cell)[3]);

}
