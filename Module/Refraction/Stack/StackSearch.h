// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Refraction/Curved/TriangleMap.h"
#include "Refraction/Membrane/HeightField.h"
#include "Refraction/Stack/StackBeams.h"
#include "Refraction/Stack/StackShot.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace meniscus
{

/**
 * Search of one patch of the first surface for a path to a target, or for all of them.
 *
 * The rays from a part of the patch meet a plane through the target that is normal to their mean
 * direction; where the target's place is away from the image of the part, no ray of the part meets
 * the target. The image is interpolated by second degree from six rays, with a margin as in
 * PatchRoots. Parts that cannot be excluded are shot from, or divided. All paths are found if they
 * are divided until the image of each is injective, which its control points prove with the same
 * margin; such a part has one path at most.
 *
 * A search for all paths begins with the parts of the patch that StackBeamParts has prepared.
 *
 * Six rays tell nothing about a part if some or all of them do not pass the stack, or if they go to
 * all sides: next to borders and critical angles, or if the surfaces behind are small. Such parts
 * are divided down to 2^-6 of the patch, of its distance from the eye, or of the smallest surface
 * behind it, whichever is smallest, and down to 2^-4 if none of the rays passes, unless interval
 * arithmetic on all of their rays excludes them.
 */
class StackSearch
{
public:
  StackSearch(const RefractionStack& stack, const StackBeams& beams, const StackTarget& target)
    : Stack(stack)
    , Beams(beams)
    , Target(target)
  {
  }

  /** Returns true if `path` is an image. */
  bool Find(std::int32_t facet, StackPath& path);

  /**
   * Adds the paths of all images in the patch of a beam to `images`, unless they are there already.
   * `path` is used as memory.
   */
  void FindAll(const StackBeamParts& beam, StackPath& path, std::vector<StackPath>& images);

  /** False if some part of a patch could be neither excluded nor settled by Newton's method. */
  bool IsComplete() const { return this->Complete; }

private:
  struct Sample
  {
    glm::dvec2 B;
    glm::dvec3 Away{ 0.0 };      ///< from the ray's origin to the target
    glm::dvec3 Direction{ 0.0 }; ///< of the ray
    glm::dvec2 Move{ 0.0 };      ///< Newton's step from here
    double Footprint = 0.0;      ///< of the whole patch
    bool IsValid = false;        ///< the ray passes the stack
  };
  enum class Shot
  {
    Here,      ///< converged in the patch; in a search for all images, in the part or next to it
    Elsewhere, ///< in another place, or where there are no rays
    Failed
  };
  /** Corners, then the middles of the opposite edges. */
  using Part = std::array<Sample, 6>;

  void Begin(std::int32_t facet);
  Part TakePart(const StackBeamParts& beam, const StackBeamParts::Part& part, StackPath& path);
  Sample Evaluate(const glm::dvec2& b, StackPath& path);
  bool SearchPart(const Part& part, int depth, StackPath& path);
  bool Divide(const Part& part, int depth, StackPath& path);
  bool DivideWhere(const Part& part, int depth, StackPath& path);
  bool SearchQuarters(
    const Part& part, const std::array<bool, 4>& quarters, int depth, StackPath& path);
  bool SearchHalves(
    const Part& part, std::size_t corner, const std::array<bool, 2>& halves, StackPath& path);
  static PatchTriangle CornersOf(const Part& part);
  static bool MeetPlane(const Part& part, TriangleMap& places);
  glm::dvec2 GuessRoot(const Part& part, const TriangleMap& places) const;
  bool SearchWhole(const Part& part, const TriangleMap& places, int depth, StackPath& path);
  bool SearchBroken(const Part& part, int depth, StackPath& path);
  bool TakeShot(const Part& part, const glm::dvec2& b, StackPath& path, Shot& shot);
  Shot Judge(const Part& part, const StackPath& path) const;
  void Add(const StackPath& path);
  int CountCoarseLevels(int near) const;
  bool IsDeepest(const Part& part, int depth, int levels, bool fromCoarse) const;
  bool IsDeepest(const Part& part, int depth) const;

  const RefractionStack& Stack;
  const StackBeams& Beams;
  const StackTarget& Target;
  std::vector<StackPath>* Images = nullptr; ///< null in a search for one image
  std::int32_t Facet = CurvedPatches::NoFacet;
  CurvedPatch Patch; ///< of the facet
  FacetShape Shape;
  int Divisions = 0;
  /** Levels after which a part far from the eye is no wider than the smallest later surface. */
  int CoarseLevels = 0;
  bool Complete = true;
};

}
