// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Refraction/Surface/Interface.h"
#include "Refraction/Tubes/RayTubeTree.h"
#include "Refraction/Tubes/RefractedRayBounds.h"
#include "Simd/InstructionSets.h"
#include "Volume/Refracted/FacetBoxes.h"
#include "Volume/Refracted/PatchIntersector.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <limits>
#include <vector>

namespace meniscus
{

/**
 * Factor larger than the relative change of a distance by rounding, in any view that shows a part
 * of the ball.
 */
constexpr double SightMargin = 1.0 + 1e-6;

/**
 * Rays at the corners of a rectangle of pixels, in order around it; directions per unit of depth.
 */
struct CornerRays
{
  glm::dvec3 Starts[4];
  glm::dvec3 Directions[4];
};

/** Bounds of the visible geometry, for one thread. */
struct VisibilityBounds
{
  /** Centre and half extents of a box along the world's axes. */
  glm::dvec3 Center{ 0.0 };
  glm::dvec3 Half{ 0.0 };
  /** Boxes around the parts of the geometry's boundary; none if they are not known. */
  mutable FacetBoxes Parts;

  /**
   * False if no ray of the tube meets the geometry up to the parameter `last`.
   * @pre GetInstructionSets() has the set
   */
  bool Meets(const TubeBounds& tube, InstructionSet set,
    double last = std::numeric_limits<double>::infinity()) const;

private:
  bool MeetsBox(const TubeBounds& tube, double last) const;
};

/**
 * Finds bundles of rays that show nothing of a mesh behind the first interface of a list. The legs
 * behind each interface are bounded by a tube: of the parts of the surface that the tube in front
 * of it may meet, and of their normals. A leg ends at the next interface, and rays that miss that
 * have no such leg.
 */
class StackVisibility
{
public:
  /**
   * `interfaces` must outlive this object.
   * @param mesh bounds of the mesh, relative to `origin`.
   * @param origin place in world coordinates that sight rays are relative to.
   */
  StackVisibility(const std::vector<Interface>& interfaces, const VisibilityBounds& mesh,
    const glm::dvec3& origin, InstructionSet set)
    : Interfaces(interfaces)
    , Mesh(mesh)
    , Origin(origin)
    , Set(set)
  {
  }

  /**
   * False if no ray of a rectangle of pixels reaches the bounds of the mesh on a leg behind the
   * first interface. True if all rays miss a further interface, which is found at little cost.
   * @param rays starts at the depth from which on geometry is seen, and directions.
   * @param facets is set to the facets of each interface that the rays may meet.
   */
  bool MayShowMesh(const CornerRays& rays, BundleFacets& facets) const;
  /**
   * The same for a part of these rays.
   * @param within facets of the rectangle of pixels; may be empty.
   */
  bool MayShowMesh(const CornerRays& rays, BundleFacets& within, BundleFacets& facets) const;
  /** False if these rays, on straight ways, do not reach the bounds of the mesh. */
  bool MayShowMeshUnrefracted(const CornerRays& rays) const;
  /** True if the rays at the corners, on straight ways, reach the bounds of the mesh. */
  bool CornersMeetBoundsUnrefracted(const CornerRays& rays) const;
  /** False if no ray of a tube reaches the bounds of the mesh up to the parameter `last`. */
  bool MeetsBounds(const TubeBounds& rays, double last) const
  {
    return this->Mesh.Meets(rays, this->Set, last);
  }
  /**
   * True if either none of these rays meets the first interface, or all do, and before they reach
   * the bounds of the mesh.
   * @param facets all facets of the first interface that the rays may meet.
   * @pre MayShowMesh() is false for the rays, or for rays of which they are a part
   */
  bool HidesMesh(const CornerRays& rays, FacetBoxes& facets) const;
  /**
   * The same for a part of the rays of the rectangle behind the first interface.
   * @param rays beginnings, and directions of unit length.
   * @param medium index of refraction of the medium that they are in.
   * @param within facets of the rectangle of pixels; may be empty.
   * @param facets is set to those for these rays, from the second interface on.
   */
  bool MayShowMesh(
    const TubeBounds& rays, double medium, BundleFacets& within, BundleFacets& facets) const;

private:
  /** Bounds of the intersections of the rays of a tube with a surface. */
  struct Meeting
  {
    bool Exists = false;
    AxisBox Places;
    AxisBox Normals;
    /** Largest parameter of the tube at which a ray may meet the surface. */
    double Last = 0.0;
  };
  /** The origin of sight rays, relative to the origin of an interface's surface. */
  glm::dvec3 ToSurface(const Interface& interface) const
  {
    return this->Origin - interface.Surface->GetMembrane().GetOrigin();
  }
  bool FollowLegs(std::size_t number, TubeBounds tube, double medium, BundleFacets& within,
    BundleFacets& facets) const;
  Meeting Meet(const Interface& interface, const TubeBounds& tube, double facing,
    FacetBoxes* within, FacetBoxes& facets) const;

  const std::vector<Interface>& Interfaces;
  VisibilityBounds Mesh;
  glm::dvec3 Origin;
  InstructionSet Set;
};

}
