// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Refraction_Stack_StackSurface_h
#define meniscus_Refraction_Stack_StackSurface_h

#include "Common/RangeLoop.h"
#include "Refraction/Curved/SteepDirections.h"
#include "Refraction/Membrane/CurvedPatches.h"
#include "Refraction/Membrane/HeightField.h"
#include "Refraction/Membrane/Membrane.h"
#include "Refraction/Tubes/BoxTree.h"
#include "Refraction/Tubes/RefractedRayBounds.h"

#include <atomic>
#include <cmath>
#include <cstdint>
#include <vector>

namespace meniscus
{

/** Place where a ray crosses a surface. */
struct SurfaceCrossing
{
  std::int32_t Facet = CurvedPatches::NoFacet;
  glm::dvec2 B{ 0.0 };
  double Distance = 0.0;
  int Side = 0; ///< +1 if the ray goes the way of the normals, -1 if it goes against them
};

/**
 * A surface of curved patches that rays are traced to: a membrane, its patches, bounds of each
 * patch and a tree of boxes. It does not depend on an eye or on media, so that several places of a
 * list can share it. Coordinates are local ones, relative to the membrane's origin.
 */
class StackSurface
{
public:
  StackSurface() = default;
  StackSurface(const StackSurface&) = delete; ///< the patches point to the membrane
  StackSurface& operator=(const StackSurface&) = delete;

  /** Sets the shape. The surface can be used only if the result is `Ready`. */
  MembraneStatus SetMembrane(const MembraneInput& input, const RangeLoop& loop = SerialLoop);

  const Membrane& GetMembrane() const { return this->Surface; }
  const CurvedPatches& GetPatches() const { return this->Patches; }

  /** The patch of a facet; with `flipped`, the same points with the opposite normals. */
  CurvedPatch GetPatch(std::int32_t facet, bool flipped) const;

  /** Bounds of a patch that do not change with the eye. */
  struct PatchBounds
  {
    AxisBox Box;          ///< widened by the rounding of positions
    DirectionBox Normals; ///< unit normals, not flipped
    double Bulge;
    glm::dvec3 Facing; ///< unit normal of the facet, on the side of the patch's normals
    /** As PatchCrossings::GetLargestSlant, of lines that cross the patch once at most. */
    double LargestSlant;
  };
  const PatchBounds& GetBounds(std::int32_t facet) const
  {
    return this->Bounds[static_cast<std::size_t>(facet)];
  }

  /**
   * Nearest crossing of the ray from `origin` along the unit vector `direction` at a distance from
   * `least` to `most`, which may be below zero within rounding. With a `side` of +1 or -1, other
   * crossings are left out; with 0 all count. Returns false if there is none.
   */
  bool FindCrossing(const glm::dvec3& origin, const glm::dvec3& direction, int side, double least,
    double most, SurfaceCrossing& nearest) const;

  /** Largest side of the surface's bounding box. */
  double GetWidth() const { return this->Width; }

  /** Calls `visit(facet, range)` for every patch that a ray of the tube may meet. */
  template <typename Visitor>
  void VisitFacets(const TubeBounds& tube, Visitor&& visit) const
  {
    static constexpr double all = std::numeric_limits<double>::max();
    this->Tree.Visit(tube, all,
      [&visit](std::int32_t facet, const TubeRange& range)
      {
        visit(facet, range);
        return all;
      });
  }

  /** True if a line along the unit vector `direction` is known to cross the surface once at most.
   */
  bool IsCrossedOnce(const glm::dvec3& direction) const { return this->Steep.Contains(direction); }

  /** True if a point lies on the surface within rounding. */
  bool IsOnSurface(const glm::dvec3& local) const;

  /** Rounding error of a position at `distance` from the origin. */
  double GetSlack(double distance) const;

  /**
   * Number of patches since construction that a ray touched, or ran along, within rounding, so that
   * its crossings there are not known.
   */
  std::int64_t GetNumberOfUndecidedCrossings() const { return this->Undecided; }

private:
  bool MayCross(std::int32_t facet, const HeightFrame& frame, const glm::dvec2& place) const;
  static bool FindOnly(const CurvedPatch& patch, const PatchBounds& bounds,
    const glm::dvec3& origin, const glm::dvec3& direction, SurfaceCrossing& crossing);
  void FindInPatch(std::int32_t facet, const glm::dvec3& origin, const HeightFrame& frame, int side,
    double least, double& most, SurfaceCrossing& nearest) const;

  Membrane Surface;
  CurvedPatches Patches;
  std::vector<PatchBounds> Bounds;
  BoxTree Tree;
  SteepDirections Steep;
  double Width = 0.0;
  mutable std::atomic<std::int64_t> Undecided{ 0 };
};

}

#endif
