// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Sight rays through all interfaces of a stack, from any eye: no tables of the eye are needed.
 * World coordinates.
 */
#pragma once

#include "Refraction/Curved/CrossingChain.h"
#include "Refraction/Curved/CurvedMembraneSolver.h"
#include "Refraction/Stack/RefractionStack.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <vector>

namespace meniscus
{

/** The surfaces that the rays of a stack meet: its links' surfaces, or others close to them. */
class StackSurfaces
{
public:
  virtual ~StackSurfaces() = default;

  /**
   * Intersection of the ray from `origin` along the unit vector `direction` with the surface of a
   * link, from the side from which the link is passed, and the unit normal there, against the ray.
   * At grazing incidence the interpolated normal of a patch may face along the ray: nothing is
   * refracted there.
   * @param near  point of the stack's own surface close to the intersection
   * @return false if there is none
   */
  virtual bool Meet(std::size_t link, const glm::dvec3& origin, const glm::dvec3& direction,
    const glm::dvec3& near, PatchPoint& at) const = 0;
};

/** The crossings of a chain of neighbouring rays with the surface of each interface in a list. */
using StackChain = std::vector<CrossingChain>;

/** The patches of links. The intersection nearest to `near` counts. */
class StackPatches : public StackSurfaces
{
public:
  /**
   * `links` are relative to `origin` in world coordinates, and must outlive this object. With a
   * `chain`, which is empty at first and must outlive this object too, intersections near the last
   * ray's intersections need no search, and the last bits of the results depend on the rays before.
   * A chain serves one list of interfaces, with any eyes.
   */
  StackPatches(const std::vector<RefractionStack::Link>& links, const glm::dvec3& origin,
    StackChain* chain = nullptr);
  bool Meet(std::size_t link, const glm::dvec3& origin, const glm::dvec3& direction,
    const glm::dvec3& near, PatchPoint& at) const override;

private:
  bool Search(const RefractionStack::Link& link, const glm::dvec3& origin,
    const glm::dvec3& direction, double near, CrossingChain* chain, PatchPoint& at) const;

  const std::vector<RefractionStack::Link>& Links;
  glm::dvec3 Origin;
  StackChain* Chain;
};

/** The straight part of a sight ray in one medium. */
struct SightLeg
{
  glm::dvec3 Origin;    ///< the eye, or where the ray passes the surface in front of the leg
  glm::dvec3 Direction; ///< of length 1
  double Index;         ///< of refraction
  double Length;        ///< infinite if the leg meets no further surface
  /**
   * Sides of the interfaces at its begin and at its end, which tell its medium: twice the
   * interface's number in the list, plus 1 on the side that its normals point away from. An end
   * without an interface has the side of the other end; both are 0 if no interface refracts.
   */
  std::size_t Sides[2];
};

/** A sight ray. */
struct StackSightRay
{
  std::vector<SightLeg> Legs; ///< at least one, from the eye
  /**
   * `Missed` if the last leg does not meet the next surface, so that it shows nothing; `Reflected`
   * if it is totally reflected at its end.
   */
  PathEnd End = PathEnd::Passed;
};

/** Traces the sight ray of a stack's eye along a unit vector. See StackPatches for `chain`. */
void TraceSightRay(const RefractionStack& stack, double medium, const glm::dvec3& direction,
  StackSightRay& ray, StackChain* chain = nullptr);

/**
 * Sight rays from eyes that change. An object may be used by one thread at a time; copies are
 * independent.
 */
class SightRayTracer
{
public:
  /** `medium` is the index of refraction around an eye behind which there is no interface. */
  SightRayTracer(const RefractionStack& stack, double medium)
    : Stack(stack)
    , Medium(medium)
  {
  }

  /** Sets the eye in world coordinates. An eye that is set again costs nothing. */
  EyeStatus SetEye(const glm::dvec3& eye);

  /** Traces the ray from the eye, which must be `Ready`, along a unit vector. */
  void Trace(const glm::dvec3& direction, StackSightRay& ray, StackChain* chain = nullptr) const
  {
    TraceSightRay(this->Stack, this->Medium, direction, ray, chain);
  }

  /**
   * False if no ray from the eye passes the surfaces in the order of the list: which of the media
   * is around the eye is then an assumption.
   */
  bool IsMediumKnown() const
  {
    return this->Stack.GetNumberOfInterfaces() == 0 || this->Stack.HasPassage();
  }

  const RefractionStack& GetStack() const { return this->Stack; }
  double GetMedium() const { return this->Medium; }

private:
  RefractionStack Stack;
  double Medium;
  glm::dvec3 Eye{ 0.0 };
  EyeStatus Status = EyeStatus::Ready;
  bool HasEye = false;
};

/** Tracers of the eyes that were asked for last, for points that are seen from several eyes. */
class EyeTracers
{
public:
  EyeTracers(const RefractionStack& stack, double medium)
    : Unused(stack, medium)
  {
  }

  /** The tracer of an eye. Valid until the next call. */
  SightRayTracer& Get(const glm::dvec3& eye);

private:
  /** Eyes to keep: the cameras of a rig. More are set up again at each change. */
  static constexpr std::size_t Most = 16;

  SightRayTracer Unused;
  std::vector<glm::dvec3> Eyes;
  std::vector<SightRayTracer> Tracers;
  std::size_t Next = 0;
};

}
