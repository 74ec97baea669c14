// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

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
  double Outside;    ///< smallest barycentric coordinate, not below -Border
  glm::dvec3 Normal; ///< of the patch, not normalised
  glm::dvec2 B;      ///< barycentric coordinates in the facet
};

/**
 * All crossings of one patch with a line parallel to an axis. The patch is divided until each part
 * has no crossing or at most one, which Newton's method finds: Documentation/refraction-method.md,
 * "Crossings of a line with a patch", has the tests.
 *
 * Parts that remain after MostDivisions, or that are smaller than the rounding of coordinates, stay
 * undecided: the line touches the patch within rounding (at a fold of the projected patch), or runs
 * along it. IsComplete returns false in that case; nothing is guessed.
 */
class PatchCrossings
{
public:
  /** A root on an edge is found in both of its facets, within the accuracy of Newton's method. */
  static constexpr double Border = 1e-8;
  /**
   * Distance, in units of a facet's longest edge, by which boxes and other bounds of a patch are
   * widened. An intersection lies outside of its facet by up to Border in barycentric coordinates,
   * which is 3e-8 edges at most; the rest exceeds the rounding of coordinates up to 1e8 edges from
   * the origin.
   */
  static constexpr double Margin = 1e-7;

  /**
   * Newton's method ends with a step shorter than this, in units of the patch or its part. It
   * converges quadratically, so the remaining error is of the order of the square.
   */
  static constexpr double LastStep = 1e-7;

  /** `patch` and `frame` must outlive this. The axis is the frame's. */
  PatchCrossings(const CurvedPatch& patch, const HeightFrame& frame);

  /**
   * Finds the crossings over `place` with heights in [low, high]. The result may contain others as
   * well.
   */
  void Find(const glm::dvec2& place, double low, double high);

  /**
   * Upper limit of 1 / cos of the angle between a line and the facet's normal such that the line is
   * certain to cross the patch and its surroundings within Reach at most once.
   */
  double GetLargestSlant();
  /** A cheap lower bound of GetLargestSlant. */
  static double BoundLargestSlant(const CurvedPatch& patch);
  /**
   * Distance outside of a part's triangle, in barycentric coordinates, up to which its bounds hold.
   */
  static constexpr double Reach = 0.1;

  const PatchCrossing* begin() const { return this->Crossings.data(); }
  const PatchCrossing* end() const { return this->Crossings.data() + this->Count; }

  bool IsComplete() const { return this->HighestOpen == std::numeric_limits<double>::lowest(); }
  /** Upper bound of the height of all undecided parts; the lowest number if there are none. */
  double GetHighestOpen() const { return this->HighestOpen; }

private:
  static constexpr std::size_t Capacity = 16;
  static constexpr int DeepestLevel = 40;
  static constexpr double SmallestPart = 0x1p-40;
  static constexpr int MostDivisions = 256;

  /** Corner of a part: barycentric coordinates, place relative to the line, and height. */
  struct Corner
  {
    glm::dvec2 B;
    glm::dvec2 X;
    double Height;
  };
  /** Bounds of derivatives along the three sides, each opposite its corner. */
  using BySide = std::array<double, 3>;
  /**
   * Bounds of the derivatives, along sides, of the patch's deviation from its facet: first
   * derivatives, and second ones, which are infinite where they jump.
   */
  struct Bend
  {
    BySide First;
    double Second;

    /** Bounds of any function. */
    static Bend Unknown();
    /** Largest distance from the linear interpolant of a part's corners. */
    double GetDeviation(double size) const;
  };
  /** Part of the facet's triangle. Its sides are `size` times the facet's. */
  struct Part
  {
    std::array<Corner, 3> Corners;
    double Size;
    Bend Across; ///< across the axis; bounds for a part hold for its children too
    Bend Along;
  };
  enum class Verdict
  {
    Settled,
    Unknown
  };

  Corner MakeCorner(const glm::dvec2& b) const;
  static double GetLargestSlant(const CurvedPatch& patch, const BySide& bend);
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
  int Front; ///< +1 if the facet's winding is counterclockwise seen from its front, -1 seen from
             ///< its back
  double Rounding; ///< rounding error of positions
  bool IsFlat;
  std::array<PatchCrossing, Capacity> Crossings;
  std::size_t Count = 0;
  double HighestOpen = std::numeric_limits<double>::lowest();
};

/**
 * True if a point is on a patch within `slack`, measured at right angles to the facet, or if that
 * cannot be decided.
 */
bool IsOnPatch(const CurvedPatch& patch, const glm::dvec3& local, double slack);

/**
 * True if a place is inside of a triangle or within `distance` of one of its sides' lines on their
 * outer side. A line whose projection along an axis is a place farther than a patch's bulge from
 * its projected facet does not cross the patch.
 */
bool PassesNear(const std::array<glm::dvec2, 3>& corners, const glm::dvec2& place, double distance);

}
