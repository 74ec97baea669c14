// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Refraction/Curved/FacetShape.h"
#include "Refraction/Sight/SightEquation.h"

#include <array>
#include <cstddef>

namespace meniscus
{

/**
 * All roots of the sight equation in one patch.
 *
 * The residual is a map from the facet's triangle to a plane. On a triangle it is interpolated by a
 * polynomial of second degree from its corners and the midpoints of its edges; the control points
 * of the interpolant bound it, with a margin for the parts of higher degree. If a line separates
 * them from zero, there is no root. If the determinants of all pairs of control vectors of its two
 * derivatives have one sign, the map is injective, so there is at most one root and Newton's method
 * finds it. Otherwise the triangle is divided in four, or in two across its longest side if it is
 * slender. Where it is larger than its distance from the eye or from the point, distances have a
 * cone that the six places do not show: there the margin is larger, and no map counts as injective.
 *
 * Where the patch focuses on the point, the roots are not isolated: a dome with eye and point on
 * its axis shows a ring. In that case the number of divisions is limited, the roots found
 * represent the ring, and IsComplete() is false.
 */
class PatchRoots
{
public:
  /**
   * Largest number of roots. A patch that focuses on a point may show any number of images; a
   * smooth one shows few.
   */
  static constexpr std::size_t Capacity = 16;
  /**
   * Assumed part of higher degree of a map, relative to the part of second degree: on a mesh that
   * resolves the membrane each degree is a fraction of the previous one. In a triangle half as
   * large the ratio is half of this, so the margin that is really needed shrinks with the
   * subdivision.
   */
  static constexpr double HigherDegree = 0.5;

  PatchRoots(const SightEquation& equation, const CurvedPatch& patch)
    : Equation(equation)
    , Patch(patch)
  {
  }

  /**
   * Finds all roots inside the facet, whether images or not; [begin, end) holds them afterwards.
   */
  void Find();

  /**
   * False if roots may be missing: a part of the patch that could not be divided any further may
   * hold one that Newton's method did not find, or several, or there are more than Capacity.
   */
  bool IsComplete() const { return this->Complete; }

  const SightRoot* begin() const { return this->Roots.data(); }
  const SightRoot* end() const { return this->Roots.data() + this->Count; }

private:
  /** Values at the corners, then at the midpoints of the edges opposite to them. */
  struct Triangle
  {
    std::array<glm::dvec2, 6> B;
    std::array<glm::dvec2, 6> F;
    std::array<double, 6> Nearest; ///< eye or point
    double Size = 0.0;             ///< longest side
  };
  enum class Verdict
  {
    None,
    AtMostOne,
    Unknown
  };

  bool IsFar() const;
  bool IsDeepest(const Triangle& triangle) const;
  void Search(const Triangle& triangle);
  void Divide(const Triangle& triangle);
  void Quarter(const Triangle& triangle);
  void Halve(const Triangle& triangle, std::size_t corner);
  bool TakeRoot(const Triangle& triangle);
  void Evaluate(Triangle& triangle, std::size_t place) const;
  double BoundCone(const Triangle& triangle) const;
  static Verdict Judge(const Triangle& triangle, double cone);
  void Add(const SightRoot& root);

  const SightEquation& Equation;
  const CurvedPatch& Patch;
  SightEquation::Plane Plane;
  FacetShape Shape;
  std::array<SightRoot, Capacity> Roots;
  std::size_t Count = 0;
  int Divisions = 0;
  bool Complete = true;
};

}
