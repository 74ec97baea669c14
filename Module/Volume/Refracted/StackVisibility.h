// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Volume_Refracted_StackVisibility_h
#define meniscus_Volume_Refracted_StackVisibility_h

#include "Refraction/Tubes/RayTubeTree.h"
#include "Refraction/Tubes/RefractedRayBounds.h"
#include "Simd/InstructionSets.h"
#include "Volume/Refracted/FacetBoxes.h"
#include "Volume/Refracted/PatchIntersector.h"
#include "Volume/Refracted/StackedInterface.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <vector>

namespace meniscus
{

/**
 * Finds bundles of sight rays that show nothing of a mesh through a list of interfaces. The legs
 * behind each interface are bounded by a tube: of the parts of the surface that the tube in front
 * of it may meet, and of their normals.
 */
class StackVisibility
{
public:
  /**
   * `interfaces` must outlive this object.
   * @param mesh bounds of the mesh, relative to `origin`; the ratio is not used.
   * @param origin place in world coordinates that sight rays are relative to.
   */
  StackVisibility(const std::vector<StackedInterface>& interfaces, const VisibilityBounds& mesh,
    const glm::dvec3& origin, InstructionSet set)
    : Interfaces(interfaces)
    , Mesh(mesh)
    , Origin(origin)
    , Set(set)
  {
  }

  /**
   * False if no ray of a rectangle of pixels reaches the bounds of the mesh, on any of its legs.
   * @param rays starts at the depth from which on geometry is seen, and directions.
   * @param within facets for a bundle that holds this one; may be empty.
   * @param facets is set to those for this bundle.
   */
  bool MayShowMesh(const CornerRays& rays, BundleFacets& within, BundleFacets& facets) const;

private:
  /** Bounds of the intersections of the rays of a tube with a surface. */
  struct Meeting
  {
    bool Exists = false;
    AxisBox Places;
    AxisBox Normals;
  };
  Meeting Meet(const StackedInterface& interface, const TubeBounds& tube, double facing,
    FacetBoxes* within, FacetBoxes& facets) const;

  const std::vector<StackedInterface>& Interfaces;
  VisibilityBounds Mesh;
  glm::dvec3 Origin;
  InstructionSet Set;
};

}

#endif
