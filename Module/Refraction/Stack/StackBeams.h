// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Common/RangeLoop.h"
#include "Refraction/Stack/StackBeamParts.h"
#include "Refraction/Stack/StackShot.h"
#include "Refraction/Stack/StackTubes.h"
#include "Refraction/Tubes/RayTubeTree.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <mutex>
#include <vector>

namespace meniscus
{

/**
 * The beams that the patches of the first surface send through a stack: behind each interface,
 * bounds of the rays of each patch, in a tree, and the ray from the patch's middle.
 *
 * Bounds come from six rays, interpolated by second degree with the margin of PatchRoots, where all
 * of them pass, the beam meets few patches at each surface, and the part of second degree is small.
 * Elsewhere they come from interval arithmetic on Snell's law, surface by surface, which is wider.
 */
class StackBeams
{
public:
  /** Fits the beams to the stack's eye. `stack` must outlive this. */
  void Update(const RefractionStack& stack, const RangeLoop& loop);

  /** Discards the trees: a surface has changed. */
  void Clear() { this->TreesOver = nullptr; }

  /** A patch that may show a target, and the expected place of the sight point in it. */
  struct Candidate
  {
    std::int32_t Facet;
    glm::dvec2 Move; ///< from the patch's middle, to first order
    double Size;     ///< of the move; infinite if the ray from the middle does not pass
  };

  /** The beam of a patch in parts, divided at the first call. May be called from several threads.
   */
  const StackBeamParts& GetParts(std::int32_t facet) const;

  /** Replaces `candidates` by all patches that may show the target, the best guess first. */
  void FindCandidates(const StackTarget& target, std::vector<Candidate>& candidates) const;

  /**
   * False if interval arithmetic proves that no ray from a triangle of the patch, with the corners
   * `corners`, meets the target.
   */
  bool MayShow(const StackTarget& target, std::int32_t facet, const PatchTriangle& corners) const;

  /** False if interval arithmetic proves that no ray from it passes `count` interfaces. */
  bool MayPass(std::int32_t facet, const PatchTriangle& corners, std::size_t count) const
  {
    return BoundStackRays(*this->Stack, facet, corners, count).IsValid();
  }

  /** Bounds of a patch's rays behind `count` interfaces, at least one. */
  const TubeBounds& GetBounds(std::int32_t facet, std::size_t count) const
  {
    return this->Bounds[count - 1][static_cast<std::size_t>(facet)];
  }

  /**
   * Calls `visit(facet)` for every patch that may show a point of the cube with centre `middle` and
   * half sides `padding` behind `count` interfaces, at least one.
   */
  template <typename Visitor>
  void VisitFacets(
    std::size_t count, const glm::dvec3& middle, const glm::dvec3& padding, Visitor&& visit) const
  {
    this->Trees[count - 1].Visit(middle, padding,
      [&visit](std::int32_t facet)
      {
        visit(facet);
        return std::numeric_limits<std::int32_t>::max();
      });
  }

private:
  using Samples = std::array<StackPath, 6>;

  void BuildTrees();
  TubeBounds BoundFirstLeg(std::int32_t facet) const;
  bool BoundBySamples(const Samples& samples, std::size_t leg, TubeBounds& bounds) const;
  void Bound(std::int32_t facet, Samples& samples);

  const RefractionStack* Stack = nullptr;
  std::vector<RayTubeTree> Trees;              ///< per interface
  std::vector<std::vector<TubeBounds>> Bounds; ///< per interface and facet
  std::vector<std::vector<RayJet>> Middles;    ///< per interface and facet
  std::vector<std::uint32_t> PassedByMiddle;   ///< per facet: interfaces that its middle ray passes
  const RefractingSurface* TreesOver = nullptr;               ///< used for comparison only
  mutable std::vector<std::unique_ptr<StackBeamParts>> Parts; ///< per facet
  mutable std::unique_ptr<std::once_flag[]> PartsOnce;
};

}
