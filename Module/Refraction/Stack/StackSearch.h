// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Refraction_Stack_StackSearch_h
#define meniscus_Refraction_Stack_StackSearch_h

#include "Refraction/Curved/TriangleMap.h"
#include "Refraction/Membrane/HeightField.h"
#include "Refraction/Stack/StackShot.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace meniscus
{

/**
 * Search of one patch of the first surface for a path to a target.
 *
 * The rays from a part of the patch meet a plane through the target; where the target's place is
 * away from the image of the part, no ray of the part meets the target. The image is interpolated
 * by second degree from six rays, with a margin as in PatchRoots. Parts that cannot be excluded are
 * shot from, or divided; so are parts of which some rays do not pass the stack.
 */
class StackSearch
{
public:
  StackSearch(const RefractionStack& stack, const StackTarget& target)
    : Stack(stack)
    , Target(target)
  {
  }

  /** Returns true if `path` is an image. */
  bool Find(std::int32_t facet, StackPath& path);

  /** False if some part of a patch could be neither excluded nor settled by Newton's method. */
  bool IsComplete() const { return this->Complete; }

private:
  struct Sample
  {
    glm::dvec2 B;
    glm::dvec2 X{ 0.0 };    ///< in the plane, relative to the target
    glm::dvec2 Move{ 0.0 }; ///< Newton's step from here
    double Footprint = 0.0; ///< of the whole patch
    bool IsValid = false;   ///< the ray passes the stack and meets the plane
  };
  enum class Shot
  {
    Here,      ///< converged in the patch
    Elsewhere, ///< converged in another patch
    Failed
  };
  /** Corners, then the middles of the opposite edges. */
  using Part = std::array<Sample, 6>;

  Sample Evaluate(const glm::dvec2& b, StackPath& path);
  bool SearchPart(const Part& part, int depth, StackPath& path);
  bool Divide(const Part& part, int depth, StackPath& path);
  bool SearchWhole(const Part& part, int depth, StackPath& path);
  bool SearchBroken(const Part& part, int depth, StackPath& path);
  bool TakeShot(const glm::dvec2& b, StackPath& path, Shot& shot);

  const RefractionStack& Stack;
  const StackTarget& Target;
  std::int32_t Facet = CurvedPatches::NoFacet;
  HeightFrame Frame; ///< its axis is normal to the plane
  bool HasFrame = false;
  int Divisions = 0;
  bool Complete = true;
};

}

#endif
