// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Refraction_Curved_PatchCrossings_h
#define meniscus_Refraction_Curved_PatchCrossings_h

#include "Refraction/Membrane/CurvedPatch.h"
#include "Refraction/Membrane/HeightField.h"

#include <array>
#include <cstddef>
#include <limits>

namespace meniscus
{

/** A place where a line along an axis crosses a patch. */
struct PatchCrossing
{
  double Height;     ///< along the axis
  int Side;          ///< +1 if the patch's front faces along the axis there, -1 if its back does
  double Outside;    ///< smallest barycentric coordinate, no less than -Border
  glm::dvec3 Normal; ///< the patch's, not normalised
};

/**
 * Every crossing of one patch with a line parallel to an axis.
 *
 * Seen along the axis, the patch is a map X from the facet's triangle to a plane, and crossings are
 * the roots of X(b) = place. The triangle is divided in four until each part is settled:
 *
 * - X is within some E of the linear interpolant of the part's corners. If the place is farther
 *   than E from the interpolant's triangle, the part has no root.
 * - If the derivatives of X differ from those of the facet, or from those in the middle of the
 * part, by less than these are, as matrices, X is injective on the part and within Reach of it.
 * Newton's method then finds the only root there.
 *
 * E, and how much derivatives differ, follow from bounds of q, n and |n| (CurvedPatch) and their
 * derivatives over the part: control points of polynomials and the rule for products.
 *
 * A part is divided as well if Newton's method does not converge there. What is left after
 * MostDivisions, or is smaller than the rounding of coordinates, is not decided: the line touches
 * the patch within rounding (at a fold of X), or runs along it. IsComplete says so; nothing is
 * guessed.
 */
class PatchCrossings
{
public:
  /** A root on an edge is found in both of its facets, up to what Newton's method leaves. */
  static constexpr double Border = 1e-8;

  /** `patch` and `frame` must outlive this. The axis is the frame's. */
  PatchCrossings(const CurvedPatch& patch, const HeightFrame& frame);

  /** The crossings over `place` with heights in [low, high]; some beyond these may be there too. */
  void Find(const glm::dvec2& place, double low, double high);

  /**
   * Lines that make an angle with the facet's normal whose inverse cosine is no more than this
   * cross the patch, and what is within Reach of it, once at most.
   */
  double GetLargestSlant();
  /** A lower bound of it that costs little. */
  static double BoundLargestSlant(const CurvedPatch& patch);
  /** How far out of its triangle, in barycentric coordinates, the bounds of a part hold. */
  static constexpr double Reach = 0.1;

  const PatchCrossing* begin() const { return this->Crossings.data(); }
  const PatchCrossing* end() const { return this->Crossings.data() + this->Count; }

  bool IsComplete() const { return this->HighestOpen == std::numeric_limits<double>::lowest(); }
  /** No undecided part of the patch is higher; the lowest number if all are decided. */
  double GetHighestOpen() const { return this->HighestOpen; }

private:
  static constexpr std::size_t Capacity = 16;
  static constexpr int DeepestLevel = 40;
  static constexpr double SmallestPart = 0x1p-40;
  static constexpr int MostDivisions = 256;

  /** A corner of a part: barycentric coordinates, the place relative to the line, the height. */
  struct Corner
  {
    glm::dvec2 B;
    glm::dvec2 X;
    double Height;
  };
  /**
   * Bounds of the derivatives along sides of what the patch adds to its facet: first ones, and
   * second ones, which are infinite where they jump.
   */
  struct Bend
  {
    double First = std::numeric_limits<double>::infinity();
    double Second = std::numeric_limits<double>::infinity();

    /** Largest distance from the linear interpolant of a part's corners. */
    double GetDeviation(double size) const;
  };
  /** A triangle of the facet whose sides are `size` times the facet's. */
  struct Part
  {
    std::array<Corner, 3> Corners;
    double Size;
    Bend Across; ///< the axis; bounds that hold for a part hold for its parts
    Bend Along;
  };
  enum class Verdict
  {
    Settled,
    Unknown
  };

  Corner MakeCorner(const glm::dvec2& b) const;
  static double GetLargestSlant(const CurvedPatch& patch, double bend);
  void BoundDeflection(Part& part) const;
  static bool IsSeparated(const Part& part, double reach);
  bool IsPassed(const Part& part, double low, double high) const;
  Verdict Settle(Part& part, double low, double high);
  bool IsInjective(const Part& part) const;
  bool TakeRoot(const Part& part);
  void MarkOpen(const Part& part);

  const CurvedPatch& Patch;
  const HeightFrame& Frame;
  glm::dvec2 Place{ 0.0 };
  int Front;       ///< +1 if the facet's winding goes round its front, -1 if round its back
  double Rounding; ///< of positions
  bool IsFlat;
  std::array<PatchCrossing, Capacity> Crossings;
  std::size_t Count = 0;
  double HighestOpen = std::numeric_limits<double>::lowest();
};

}

#endif
