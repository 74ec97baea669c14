// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Refraction/Membrane/CurvedPatches.h"
#include "Refraction/Membrane/HeightField.h"
#include "Refraction/Membrane/Membrane.h"
#include "Refraction/Tubes/RayTubeTree.h"

#include <atomic>
#include <cstdint>
#include <vector>

namespace meniscus
{

/**
 * Side of a membrane of curved patches on which a point lies: the side of the nearest patch below
 * it along an axis.
 *
 * Facets above or below the point are found by a tree over their columns. A facet's patch is no
 * farther from the facet than its bulge, so a line that passes the facet's border at a larger
 * distance crosses the patch exactly as it crosses the facet (their borders are homotopic in the
 * plane without the line). Only lines closer to a border, and points that close to the facet, need
 * the exact crossings (PatchCrossings).
 *
 * A line that touches a patch, or runs along it, decides nothing. In that case the straight way to
 * a place nearby is examined, in a direction across the first: the result is the side
 * of the nearest patch on this way, or of the place itself if no patch is on it. All such ways are
 * equally valid. A point for which none of a dozen ways decides is counted and is not in front.
 */
class MembraneSides
{
public:
  enum class Side
  {
    Unknown, ///< no patch below the point
    Front,
    Behind,
    On ///< within rounding of a patch
  };

  /** Builds the tree. `surface` and `patches` must outlive this. */
  void Build(const Membrane& surface, const CurvedPatches& patches, const HeightFrame& frame);

  /** Side of a point in local coordinates. */
  Side Find(const glm::dvec3& local) const;

  /** Number of points since construction whose side no way could decide. */
  std::int64_t GetNumberOfUndecided() const { return this->Undecided; }

private:
  /** A facet whose patch the line may cross, and bounds of the patch's height. */
  struct Candidate
  {
    std::int32_t Facet;
    double Low;
    double High;
    int Side; ///< +1 or -1 if the crossing is certain and below the point; otherwise 0
  };
  struct Look
  {
    Side Answer;
    std::int32_t OpenFacet; ///< facet because of which the line decides nothing; NoFacet if it
                            ///< decides
  };
  struct Column
  {
    float Bulge; ///< rounded up
    signed char Front;
  };

  /** Converts a sign to an answer; 0 means that there is no patch. */
  static Look MakeLook(int side);
  Candidate Classify(
    std::int32_t facet, const HeightFrame& frame, const glm::dvec3& local, double low) const;
  Look LookAlong(const HeightFrame& frame, const glm::dvec3& local, double reach) const;
  Look LookExactly(const std::vector<Candidate>& candidates, const HeightFrame& frame,
    const glm::dvec3& local, double low) const;
  Side FindAround(const glm::dvec3& local, std::int32_t openFacet) const;

  const Membrane* Surface = nullptr;
  const CurvedPatches* Patches = nullptr;
  HeightFrame Frame;
  RayTubeTree Tree;
  std::vector<Column> Columns;
  double Slack = 0.0; ///< rounding error of a patch's point
  mutable std::atomic<std::int64_t> Undecided{ 0 };
};

}
