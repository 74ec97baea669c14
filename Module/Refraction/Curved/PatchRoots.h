// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Refraction_Curved_PatchRoots_h
#define meniscus_Refraction_Curved_PatchRoots_h

#include "Refraction/Curved/SightEquation.h"

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
 * finds it. Otherwise the triangle is divided in four.
 *
 * Where the patch focuses on the point, the roots are not isolated: a dome with eye and point on
 * its axis shows a ring. In that case the number of divisions is limited, and the roots found
 * represent the ring.
 */
class PatchRoots
{
public:
  /**
   * Largest number of roots. A patch that focuses on a point may show any number of images; a
   * smooth one shows few.
   */
  static constexpr std::size_t Capacity = 16;

  PatchRoots(const SightEquation& equation, const CurvedPatch& patch)
    : Equation(equation)
    , Patch(patch)
  {
  }

  /**
   * Finds all roots inside the facet, whether images or not; [begin, end) holds them afterwards.
   */
  void Find();

  const SightRoot* begin() const { return this->Roots.data(); }
  const SightRoot* end() const { return this->Roots.data() + this->Count; }

private:
  /** Values at the corners, then at the midpoints of the edges opposite to them. */
  struct Triangle
  {
    std::array<glm::dvec2, 6> B;
    std::array<glm::dvec2, 6> F;
  };
  enum class Verdict
  {
    None,
    AtMostOne,
    Unknown
  };

  bool IsFar() const;
  void Search(const Triangle& triangle, int depth);
  void Divide(const Triangle& triangle, int depth);
  bool TakeRoot(const Triangle& triangle);
  static Verdict Judge(const Triangle& triangle);
  void Add(const SightRoot& root);

  const SightEquation& Equation;
  const CurvedPatch& Patch;
  std::array<SightRoot, Capacity> Roots;
  std::size_t Count = 0;
  int Divisions = 0;
};

}

#endif
