// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Common/RangeLoop.h"
#include "Refraction/Membrane/CurvedPatches.h"
#include "Refraction/Membrane/HeightField.h"
#include "Refraction/Membrane/Membrane.h"
#include "Refraction/Surface/SteepDirections.h"
#include "Refraction/Tubes/BoxTree.h"
#include "Refraction/Tubes/RefractedRayBounds.h"

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

/** Parts of a surface. Each needs those before it. */
enum class SurfaceParts
{
  Facets,
  Patches,  ///< curved patches over the facets
  Boxes,    ///< bounds of the patches, and the tree of their boxes
  Crossings ///< bounds of the patches' slants, and the directions of lines that cross them once
};

/**
 * A refracting surface: a membrane, its curved patches, bounds of each patch and a tree of boxes.
 * It does not depend on an eye or on media, so that several solvers and several places of a list
 * can share it. Coordinates are local ones, relative to the membrane's origin.
 */
class RefractingSurface
{
public:
  RefractingSurface() = default;
  RefractingSurface(const RefractingSurface&) = delete; ///< the patches point to the membrane
  RefractingSurface& operator=(const RefractingSurface&) = delete;

  /**
   * Sets the shape, and computes `parts`. If only points and normals differ from the last shape,
   * patches are refitted. The surface can be used only if the result is `Ready`.
   */
  MembraneStatus SetMembrane(
    const MembraneInput& input, SurfaceParts parts, const RangeLoop& loop = SerialLoop);
  /** Computes `parts` of the shape, unless they exist. */
  void Prepare(SurfaceParts parts, const RangeLoop& loop = SerialLoop);

  const Membrane& GetMembrane() const { return this->Surface; }
  const CurvedPatches& GetPatches() const { return this->Patches; }
  /** Tree of the boxes of GetBounds(). */
  const BoxTree& GetTree() const { return this->Tree; }
  /**
   * Number of the arrangement of facets, which shapes of the same facets keep; no two surfaces in a
   * process have the same.
   */
  std::int64_t GetTopology() const { return this->Topology; }
  /** Number of the shape: no two shapes of surfaces in a process have the same. */
  std::int64_t GetShape() const { return this->Shape; }

  /** The patch of a facet; with `flipped`, the same points with the opposite normals. */
  CurvedPatch GetPatch(std::int32_t facet, bool flipped) const;

  /** Bounds of a patch that do not change with the eye. */
  struct PatchBounds
  {
    AxisBox Box;          ///< of all crossings that are found in the patch
    DirectionBox Normals; ///< unit normals, not flipped
    double Bulge;         ///< of points above the facet, widened by the rounding of positions
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

private:
  /** Lines that cross a patch once at most. */
  struct PatchSlant
  {
    glm::dvec3 Facing; ///< unit normal of the facet, on the side of the patch's normals
    double Largest;    ///< as PatchCrossings::GetLargestSlant
  };
  void BuildBoxes(const RangeLoop& loop);
  void BuildCrossings(const RangeLoop& loop);
  bool MayCross(std::int32_t facet, const HeightFrame& frame, const glm::dvec2& place) const;
  static bool FindOnly(const CurvedPatch& patch, const PatchSlant& slant, const glm::dvec3& origin,
    const glm::dvec3& direction, SurfaceCrossing& crossing);
  void FindInPatch(std::int32_t facet, const glm::dvec3& origin, const HeightFrame& frame, int side,
    double least, double& most, SurfaceCrossing& nearest) const;

  Membrane Surface;
  CurvedPatches Patches;
  SurfaceParts Parts = SurfaceParts::Facets;
  std::int64_t Topology = 0;
  std::int64_t Shape = 0;
  std::int64_t PatchesOf = -1; ///< topology that the patches were built for
  std::vector<PatchBounds> Bounds;
  std::vector<PatchSlant> Slants;
  BoxTree Tree;
  SteepDirections Steep;
  double Width = 0.0;
};

}
