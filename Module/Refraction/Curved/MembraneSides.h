// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Refraction_Curved_MembraneSides_h
#define meniscus_Refraction_Curved_MembraneSides_h

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
 * The side of a membrane of curved patches that a point is on: that of the nearest patch below it
 * along an axis.
 *
 * Facets over or under the point are found by a tree over their columns. A facet's patch is no
 * farther from it than its bulge, so a line that passes the facet's border at more than that
 * crosses the patch just as the facet (their borders are homotopic in the plane without the line).
 * Only lines closer to a border, and points as close to the facet, ask for the crossings themselves
 * (PatchCrossings).
 *
 * A line that runs along a patch, or touches it, decides nothing. Then the way to a place nearby is
 * taken instead, in a direction across the first: the side is that of the nearest patch on the way,
 * or of the place if there is none. Each way is as good as any other. A point for which a dozen of
 * them decide nothing is counted and is not in front.
 */
class MembraneSides
{
public:
  enum class Side
  {
    Unknown, ///< no patch below the point
    Front,
    Behind
  };

  /** Builds the tree. `surface` and `patches` must outlive this. */
  void Build(const Membrane& surface, const CurvedPatches& patches, const HeightFrame& frame);

  /** The side of a point in local coordinates. Points within rounding of a patch are in front. */
  Side Find(const glm::dvec3& local) const;

  /** Points whose side no way has decided, since construction. */
  std::int64_t GetNumberOfUndecided() const { return this->Undecided; }

private:
  /** A facet whose patch the line may cross, and bounds of the height of that. */
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
    std::int32_t OpenFacet; ///< the line decides nothing because of it; NoFacet: it does
  };
  struct Column
  {
    float Bulge; ///< rounded up
    signed char Front;
  };

  /** Of a sign; 0: no patch. */
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
  double Slack = 0.0; ///< rounding of a point of a patch
  mutable std::atomic<std::int64_t> Undecided{ 0 };
};

}

#endif
