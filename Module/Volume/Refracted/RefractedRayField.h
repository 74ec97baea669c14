// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Volume_Refracted_RefractedRayField_h
#define meniscus_Volume_Refracted_RefractedRayField_h

#include "Common/GroupedItems.h"
#include "Common/RangeLoop.h"
#include "Refraction/Surface/Interface.h"
#include "Refraction/Tubes/BoxTree.h"
#include "Simd/InstructionSets.h"
#include "Volume/Rays/BoundsInFrame.h"
#include "Volume/Rays/RayFrame.h"
#include "Volume/Refracted/PatchIntersector.h"
#include "Volume/Refracted/RefractedRayTiles.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace meniscus
{

/**
 * First intersections of the rays of an image with a membrane of curved patches, and the refracted
 * rays behind it, by tiles: the strategy of RefractedRayStack for one interface. Facets are sorted
 * into tiles by bounds of the projections of their patches. In each pixel, the ray is intersected
 * with the patches by Newton's method, starting from its intersection with the facet.
 */
class RefractedRayField
{
public:
  struct View
  {
    RayFrame Frame;
    int Width = 0;
    int Height = 0;
    /** Origin of the frame, in world coordinates. */
    glm::dvec3 Center{ 0.0 };
    /** Depth of the eye: geometry at smaller depths is not seen. */
    double EyeDepth = 0.0;
    /**
     * Bounds of the mesh. The refraction of rays that miss it on both sides of the membrane is not
     * computed.
     */
    BoundsInFrame Mesh;

    bool operator==(const View& other) const;
  };

  static constexpr int TileSize = RefractedRayTiles::TileSize;
  static constexpr int RaysOfTile = RefractedRayTiles::RaysOfTile;

  /**
   * Traces all rays to the surface of an interface, whose patches are ready, and replaces `rays` by
   * the refracted ones: leg 1 of the rays of the image (RayLegs).
   */
  void Build(const Interface& interface, const View& view, RefractedRayTiles& rays,
    const RangeLoop& loop = SerialLoop);

  /**
   * Mean direction of the refracted rays in the frame of the view; a unit vector, or 0 if there are
   * none.
   */
  const glm::dvec3& GetMeanDirection() const { return this->MeanDirection; }
  /** Bounds of the steps of the refracted rays, there as well; empty if there are none. */
  const AxisBox& GetStepBounds() const { return this->StepBounds; }
  /**
   * Pairs of a ray and a patch that it touches, or runs along, within rounding, such as an outline
   * hit exactly: the ray counts as passing the patch there. 0 for nearly all views.
   */
  std::int64_t GetNumberOfUndecidedRays() const { return this->UndecidedRays; }
  /** Bytes of the tables that are kept for the next image, without the rays. */
  std::int64_t GetBytes() const;

private:
  struct Box
  {
    int Left;
    int Right; // exclusive
    int Bottom;
    int Top; // exclusive

    bool IsEmpty() const { return this->Left >= this->Right || this->Bottom >= this->Top; }
  };
  /** Data of a facet's patch before it is intersected with rays. */
  struct SeenFacet
  {
    Box Pixels{ 0, 0, 0, 0 };
    /** True if rays that meet the patch may reach the mesh. */
    bool Matters = false;
    /** True if the facet is at the border of the membrane. */
    bool IsAtBorder = false;
    /** Side of the facet that is seen: 1 or -1; 0 if it is edge-on. */
    int Side = 0;
    /** True if the projection has no bounds but the image. */
    bool Unbounded = false;
    /** Ball around the patch. */
    glm::dvec3 Center{ 0.0 };
    double Radius = 0.0;
  };
  class PixelRays;

  void PrepareRays(const Membrane& surface, const InterfaceMedia& media);
  SeenFacet See(const Membrane& surface, const CurvedPatches& patches, std::int32_t facet,
    const PixelRays& image) const;
  glm::dvec3 SightTo(const glm::dvec3& place) const;
  bool MayShowMesh(const CurvedPatch& patch, double bulge) const;
  bool PixelOf(const glm::dvec3& place, glm::dvec2& pixel) const;
  void SortFacets(const std::vector<SeenFacet>& facets);
  bool HidesTile(const CurvedPatches& patches, const std::vector<SeenFacet>& facets, int tile,
    const PixelRays& rays) const;
  /** Contributions of a tile to the results. */
  struct TileSum
  {
    /** Sum of the steps of the refracted rays in world coordinates. */
    glm::dvec3 Directions{ 0.0 };
    /** Bounds of the steps in the frame of the view. */
    AxisBox Steps;
    /** Number of undecided rays. */
    std::int64_t Undecided = 0;
  };
  TileSum TraceTile(const CurvedPatches& patches, const std::vector<SeenFacet>& facets, int tile,
    RefractedRayTiles& all) const;
  std::int64_t TraceFacet(const CurvedPatch& patch, const SeenFacet& seen, const PixelRays& rays,
    std::vector<MembraneHit>& hits) const;
  void TraceBox(const PatchIntersector& tracer, const PatchIntersector::FlatHits& flat,
    const Box& box, bool matters, const PixelRays& rays, std::vector<MembraneHit>& hits) const;
  TileSquares RefractTile(const PixelRays& tile, const std::vector<MembraneHit>& hits,
    std::vector<RefractedRay>& rays, TileSum& sum) const;

  View Of;
  int Columns = 0;
  int Rows = 0;
  std::int64_t UndecidedRays = 0;
  glm::dvec3 MeanDirection{ 0.0 };
  AxisBox StepBounds;
  glm::dmat3 WorldToFrame{ 1.0 };
  /** Bounds of the mesh, relative to the membrane's origin. */
  VisibilityBounds Mesh;
  /** Rays of the pixels, relative to the membrane's origin. */
  SightRays Rays;
  InstructionSet Set = BestInstructionSet();
  GroupedItems FacetsOfTiles;
};

}

#endif
