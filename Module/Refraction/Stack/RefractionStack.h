// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Refracting surfaces in the order in which sight rays meet them, and the path of a sight ray
 * through them.
 *
 * A path is chosen by its first sight point, a place in a patch of the first surface. From there it
 * is traced: at each interface it goes on to the nearest crossing with the next surface in the
 * direction in which the list passes it. So a ray that enters a closed body, which is listed twice,
 * leaves it at the back without a rule about starting points. Derivatives by the place in the
 * first patch come with the path.
 */
#pragma once

#include "Refraction/Sight/EyeStatus.h"
#include "Refraction/Stack/RayJet.h"
#include "Refraction/Surface/Interface.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

namespace meniscus
{

/** Place in a patch. */
struct StackPlace
{
  std::int32_t Facet = CurvedPatches::NoFacet;
  glm::dvec2 B{ 0.0 };
};

/** Point in which a path meets an interface. */
struct PathPoint
{
  StackPlace Place;
  PlaceBy By;          ///< derivatives by the place in the first patch
  RayJet Ray;          ///< behind the interface; its origin is the sight point
  double Cosine = 0.0; ///< of the angle of incidence
};

enum class PathEnd
{
  Passed,
  Missed,   ///< the next surface is not on the way
  Reflected ///< totally reflected, or the surface faces the other way; the ray that arrives there
            ///< is at the end of the path
};

/** A sight ray through the first interfaces of a stack. Positions are relative to its origin. */
struct StackPath
{
  std::vector<PathPoint> Points; ///< one per interface; places of an earlier path are first guesses
  std::size_t Count = 0;         ///< number of interfaces that the path passes
  glm::dvec3 Sight;              ///< unit direction from the eye
  VectorBy SightBy;

  /**
   * Forgets the places of an earlier path, on which the last bits of the next trace would depend:
   * whatever comes first in a range of parallel work starts from here.
   */
  void Forget(std::size_t interfaces) { this->Points.assign(interfaces, PathPoint()); }

  /** Ray behind the last interface that is passed. */
  const RayJet& GetLast() const { return this->Points[this->Count - 1].Ray; }
};

/**
 * The patch of each interface that a chain of paths met last: neighbouring paths mostly meet the
 * same.
 */
struct HeldPatch
{
  std::int32_t Facet = CurvedPatches::NoFacet;
  CurvedPatch Patch{};
};

class RefractionStack
{
public:
  /** An interface as rays pass it. */
  struct Link
  {
    std::shared_ptr<const RefractingSurface> Surface;
    InterfacePassage Passage;
    glm::dvec3 Shift;  ///< origin of the surface, relative to the stack's origin
    std::size_t Index; ///< in the list
    double Ratio;      ///< of the indices before and behind

    /**
     * The first crossing with a ray in the direction in which the link is passed, at a distance of
     * at least `least` within rounding, and at most `most`. `origin` is relative to the surface's
     * origin. Returns false if there is none.
     */
    bool FindCrossing(const glm::dvec3& origin, const glm::dvec3& direction, double least,
      SurfaceCrossing& crossing, double most = std::numeric_limits<double>::max()) const;
  };

  /**
   * Sets the interfaces; the crossings of their surfaces are ready. Interfaces with equal indices
   * are left out, after the media have been compared. If the result has a fault, the stack is
   * empty.
   */
  MediaChain SetInterfaces(const std::vector<Interface>& list);

  /**
   * Sets the eye in world coordinates and chooses the interfaces that are in front of it: the list
   * begins at the first interface that a ray from the eye to a place in one of its patches meets
   * from the right side before it meets all behind it. HasPassage is false if there is no such ray;
   * in that case the list begins at its first interface.
   */
  EyeStatus SetEye(const glm::dvec3& eye);
  bool HasPassage() const { return this->Passes; }

  /** Interfaces behind the eye's medium that refract, in the order of sight rays. */
  const std::vector<Link>& GetLinks() const { return this->Links; }
  const glm::dvec3& GetOrigin() const { return this->Origin; }
  /** Eye, relative to the origin. */
  const glm::dvec3& GetEye() const { return this->Eye; }
  /** Number of refracting interfaces in the list, including interfaces behind the eye. */
  std::size_t GetNumberOfInterfaces() const { return this->NumberOfInterfaces; }

  /**
   * Traces the path through the first `count` interfaces, at least one, from a place in the first
   * surface. With `follows`, it looks for each next place near the place in the path's last trace,
   * and does not test whether the ray crosses the surface before it: see IsFirstCrossing.
   */
  PathEnd Trace(const StackPlace& first, std::size_t count, bool follows, StackPath& path) const;

  /**
   * As Trace with `follows`, but the ray takes one step of Newton's method only, from the place of
   * the path's last trace, to each next surface. `off` is set to the largest of these steps, in
   * facets; the error of the path is of the order of its square. `held` has an element per link.
   */
  PathEnd TraceStep(const StackPlace& first, std::size_t count, StackPath& path,
    std::vector<HeldPatch>& held, double& off) const;

  /**
   * Traces without derivatives from a point of the first surface with its normal, in the direction
   * of a ray that meets its front. `first` is recorded as its place. The result depends on the
   * point alone.
   */
  PathEnd TraceFrom(
    const StackPlace& first, const PatchPoint& at, std::size_t count, StackPath& path) const;

  /** True if no leg of the path crosses the next surface before the point where it is refracted. */
  bool IsFirstCrossing(const StackPath& path) const;

  /**
   * Nearest crossing of a ray with interface `link` in its direction, at a distance of at most
   * `most`. Returns false if there is none.
   */
  bool FindNext(std::size_t link, const glm::dvec3& origin, const glm::dvec3& direction,
    SurfaceCrossing& crossing, double most = std::numeric_limits<double>::max()) const;

private:
  /**
   * Evaluates the path behind the first surface; `meet(link, ray, point, jet, gradient)` finds the
   * others.
   */
  template <typename Meeting>
  PathEnd TraceOn(const StackPlace& first, PatchJet& jet, std::size_t count, StackPath& path,
    const Meeting& meet) const;
  bool StepTo(const Link& link, const RayJet& ray, PathPoint& point, PatchJet& jet,
    PlaceGradient& gradient, HeldPatch& held, double& off) const;
  /** The argument of TraceOn for complete traces. */
  auto MakeMeeting(bool follows) const;
  bool MeetNear(
    const Link& link, const RayJet& ray, PathPoint& point, CurvedPatch& patch, PatchJet& jet) const;
  bool Meet(
    std::size_t link, const RayJet& ray, bool follows, PathPoint& point, PatchJet& jet) const;
  void ListLinks(const MediaChain::Way& way, std::size_t first, std::vector<Link>& links) const;

  std::vector<Interface> List;
  std::vector<MediaChain::Way> Ways;
  std::size_t NumberOfInterfaces = 0;
  std::vector<Link> Links;
  glm::dvec3 Origin{ 0.0 };
  glm::dvec3 Eye{ 0.0 };
  bool Passes = false;
};

}
