// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Refraction/Stack/StackTubes.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace meniscus
{

/**
 * Search for a ray from a stack's eye that meets the first surface from the right side before it
 * meets all others. At the last one it may be totally reflected, since it is there on the right
 * side, too.
 *
 * Rays to the middles of all patches are tried first, then those next to the eye's foot, and
 * some that are aimed at the second surface. Patches that interval arithmetic does not
 * exclude are divided, so that a share of a patch that passes is found even if it is small: next to
 * a critical angle or a border.
 */
class StackPassage
{
public:
  explicit StackPassage(const RefractionStack& stack)
    : Stack(stack)
  {
  }

  /** True if there is such a ray, down to the smallest parts. */
  bool Find();

private:
  struct Part
  {
    std::int32_t Facet;
    PatchTriangle Corners;
  };

  bool TryMiddles();
  bool TryFeet();
  bool TryAims();
  bool TryParts(std::vector<Part>& parts);
  bool IsPassedAt(std::int32_t facet, const glm::dvec2& b);

  const RefractionStack& Stack;
  StackPath Path;
  std::size_t Tries = 0;
};

}
