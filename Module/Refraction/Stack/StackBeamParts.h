// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Refraction/Curved/FacetShape.h"
#include "Refraction/Stack/RefractionStack.h"
#include "Refraction/Stack/StackTubes.h"
#include "Refraction/Tubes/BoxTree.h"
#include "Refraction/Tubes/RayTubeTree.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <unordered_map>
#include <vector>

namespace meniscus
{

/** How far the beam of a patch is divided; the same in StackBeamParts and in StackSearch. */
struct BeamDivision
{
  /**
   * Divisions of a part that is as wide as the smallest later surface and no wider than its
   * distance from the eye. Along a border or a critical angle the number of parts doubles with each
   * level. Parts none of whose rays passes the list are divided less often: they are most of the
   * parts where surfaces cross, or where most rays are totally reflected.
   */
  static constexpr int DeepestLevel = 6;
  static constexpr int DeepestBlind = 4;

  /**
   * Largest number of levels up to a part that is as wide as the smallest later surface; for bodies
   * of less than 2^-6 of a facet's size the search would take too long.
   */
  static constexpr int MostCoarseLevels = 6;

  /**
   * Largest number of levels up to a part that is no wider than its distance from the eye: a sea of
   * two facets may be a million times as wide as the eye is high. On each of them only the few
   * parts are divided that are wider than their distance from the eye. PatchCrossings::Border, 1e-8
   * of a facet, is the resolution of places.
   */
  static constexpr int MostNearLevels = 26;

  /** Largest number of levels down to a part. */
  static constexpr int MostLevels = MostNearLevels + MostCoarseLevels + DeepestLevel;

  /**
   * As in PatchRoots: size of the part of second degree, relative to the linear part, above which
   * the interpolant of six rays is only a guess.
   */
  static constexpr double LargestDeflection = 0.5;

  /**
   * Assumed part of higher degree relative to the part of second degree. It is four times as large
   * as for one surface (PatchRoots), because each surface adds parts of higher degree: with half as
   * much, pairs of images next to caustics behind three surfaces were missed.
   */
  static constexpr double HigherDegree = 2.0;

  /**
   * Newton's step from a place in a smallest part, in units of that part, beyond which there is no
   * root in the part: rays are nearly linear there.
   */
  static constexpr double FarthestRoot = 4.0;

  /**
   * Levels down to a part of a patch of the first surface, at a place, that is no wider than its
   * distance from the eye.
   */
  static int CountNearLevels(
    const RefractionStack& stack, const CurvedPatch& patch, const glm::dvec2& b);
  /** Then levels down to one that is no wider than the smallest of the next surfaces either. */
  static int CountCoarseLevels(
    const RefractionStack& stack, double size, int near, std::size_t interfaces);
  /** Levels down to a triangle in a facet: halvings of the facet's size, rounded. */
  static int CountLevels(const FacetShape& facet, const PatchTriangle& corners);
  /** Largest difference between coordinates of corners of a triangle: 2^-n after n quarterings. */
  static double GetExtent(const PatchTriangle& corners);
};

/** Places of six rays in a patch: corners, then the middles of the opposite edges. */
extern const glm::dvec2 BeamPlaces[6];

/**
 * Box of the control points of a map of second degree with the given values at the places of six
 * rays, widened by its part of higher degree: `higherDegree` times the part of second degree, or as
 * much as for one surface (PatchRoots) if the interpolant is only a guess. Returns false if it is a
 * guess and its part of second degree is not below `least`.
 */
bool BoundBeamMap(
  const std::array<glm::dvec3, 6>& f, double least, double higherDegree, AxisBox& box);

/** Deflection of unit directions below which their linear part may vanish: parallel beams. */
constexpr double SmallBeamDeflection = 1e-3;

/**
 * The beam that a patch of the first surface sends through a stack, divided into triangular parts:
 * where the rays are smooth, until six of them tell where the others go, and along borders and
 * critical angles as far as BeamDivision allows. Each part has six rays and bounds of all of its
 * rays behind each interface. The parts do not depend on the point that is looked for, so that all
 * searches share them, and a search only looks at those that can hold its point.
 */
class StackBeamParts
{
public:
  /** A ray behind an interface. */
  struct Ray
  {
    glm::dvec3 Origin{ 0.0 };
    glm::dvec3 Direction{ 0.0 };
    double Footprint = 0.0; ///< of the whole patch
  };

  /** A triangle in the patch. */
  struct Part
  {
    std::array<std::int32_t, 6> Samples; ///< at its corners, then in the middles of opposite sides
    std::int32_t FirstChild = 0;         ///< children are consecutive
    std::uint8_t Children = 0;
    std::uint8_t Depth = 0;
    /** Number of first interfaces behind which six rays tell where the others go. */
    std::uint8_t Resolved = 0;
  };

  StackBeamParts(const RefractionStack& stack, std::int32_t facet);

  std::int32_t GetFacet() const { return this->Facet; }
  const glm::dvec2& GetPlace(std::int32_t sample) const
  {
    return this->Places[static_cast<std::size_t>(sample)];
  }
  /** Number of interfaces that the ray of a sample passes. */
  std::size_t GetPassed(std::int32_t sample) const
  {
    return this->Passed[static_cast<std::size_t>(sample)];
  }
  /** Ray of a sample behind interface `leg`, counted from 0, which it passes. */
  const Ray& GetRay(std::int32_t sample, std::size_t leg) const
  {
    return this->Rays[static_cast<std::size_t>(sample) * this->Links + leg];
  }

  /**
   * Calls `visit(part)` for the parts whose rays behind `count` interfaces, at least one, may hold
   * a point, which is uncertain by `slack`.
   */
  template <typename Visitor>
  void Visit(std::size_t count, const glm::dvec3& point, double slack, const Visitor& visit) const;

private:
  class Builder;

  /** Index of a part's bounds behind interface `leg`, counted from 0. */
  std::size_t GetIndex(std::size_t part, std::size_t leg) const { return part * this->Links + leg; }

  std::int32_t Facet;
  std::size_t Links;
  std::vector<Part> Parts; ///< the whole patch first
  std::vector<glm::dvec2> Places;
  std::vector<std::uint8_t> Passed;
  std::vector<Ray> Rays;       ///< per sample and interface
  std::vector<TubeClip> Tubes; ///< per part and interface
};

//------------------------------------------------------------------------------
template <typename Visitor>
void StackBeamParts::Visit(
  std::size_t count, const glm::dvec3& point, double slack, const Visitor& visit) const
{
  const std::size_t leg = count - 1;
  const AxisBox box{ point - slack, point + slack };
  // A level is a division in four, which leaves three more on the stack, or at most three divisions
  // of slender parts in two, which leave one each. The size of a part is rounded to levels.
  std::array<std::int32_t, 3 * (BeamDivision::MostLevels + 1) + 4> open;
  std::size_t depth = 0;
  open[depth++] = 0;
  while (depth > 0)
  {
    const auto index = static_cast<std::size_t>(open[--depth]);
    const Part& part = this->Parts[index];
    const TubeClip& tube = this->Tubes[this->GetIndex(index, leg)];
    const TubeRange range = tube.Clip(box, std::numeric_limits<double>::max());
    if (!(range.From <= range.To))
    {
      continue;
    }
    if (part.Children > 0 && part.Resolved < count)
    {
      for (std::int32_t k = part.Children; k-- > 0;)
      {
        open[depth++] = part.FirstChild + k;
      }
      continue;
    }
    // Where the next surface is met, legs end.
    if (part.Resolved > count)
    {
      const TubeClip& next = this->Tubes[this->GetIndex(index, count)];
      if (!Overlap(box,
            { glm::min(tube.GetLow(), next.GetLow()), glm::max(tube.GetHigh(), next.GetHigh()) }))
      {
        continue;
      }
    }
    visit(part);
  }
}

}
