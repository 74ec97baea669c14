// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Refraction/Surface/Interface.h"
#include "Simd/InstructionSets.h"
#include "Volume/Rays/RayFrame.h"
#include "Volume/Refracted/FacetBoxes.h"
#include "Volume/Refracted/PatchIntersector.h"
#include "Volume/Refracted/RayBlock.h"
#include "Volume/Refracted/RefractedRayTiles.h"

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace meniscus
{

/** Legs of the rays of a block along the world's axes, relative to the view's origin; see RayLeg.
 */
struct WorldLegs
{
  static constexpr int Size = RayBlock::Size;

  double Place[3][Size];
  /** 0 if the ray does not go on. */
  double Step[3][Size];
  /** Drawn depth of Place; infinite if the ray does not come to the interface of the leg. */
  double Depth[Size];
  /** False if no leg behind this interface meets the mesh before the next one. */
  bool MayShow = false;

  /** Ends all rays in front of the leg. */
  void Clear()
  {
    std::fill_n(this->Step[0], 3 * Size, 0.0);
    std::fill_n(this->Depth, Size, std::numeric_limits<double>::infinity());
  }
  void End(int ray)
  {
    for (auto& steps : this->Step)
    {
      steps[ray] = 0.0;
    }
  }
  bool GoesOn(int ray) const
  {
    return (this->Step[0][ray] != 0.0) | (this->Step[1][ray] != 0.0) | (this->Step[2][ray] != 0.0);
  }
};

/**
 * Rays on their way to an interface, each up to its nearest intersection. The lane of a ray that
 * does not go there has a copy of a ray that does, which ends in front of everything.
 */
struct StackLanes : RayBlock
{
  /** Index of refraction of the medium that the ray is in, from leg 1 on. */
  double Medium[Size] = {};
  /** Not 0 if the ray goes to the interface. */
  std::int64_t IsOnWay[Size];
  /** Not 0 for rays in a medium that the interface does not have. */
  std::int64_t IsMismatched[Size];

  /** True if any ray meets the interface. */
  bool IsAnyHit() const
  {
    for (int lane = 0; lane < this->Count; ++lane)
    {
      if (this->IsHit(lane))
      {
        return true;
      }
    }
    return false;
  }
  /** True if the ray of a lane meets the interface. */
  bool IsHit(int lane) const
  {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    return (this->Last[lane] < infinity) & (this->Last[lane] > -infinity);
  }
};

/** Rays of a block of pixels, and all their legs. The functions are compiled per instruction set.
 */
struct StackBlock
{
  static constexpr int Size = RayBlock::Size;
  /** Side length in pixels. */
  static constexpr int Side = RefractedRayTiles::SquareSize;
  static_assert(Side * Side == Size, "the rays of a block fill the lanes");

  StackBlock(std::size_t interfaces, InstructionSet set)
    : Set(set)
    , Legs(interfaces + 1)
  {
  }

  /**
   * Sets leg 0 of the rays.
   * @param first first pixel of the block, in an image of the given width and height.
   * @param side side length in pixels, up to Side.
   */
  void Start(const RayFrame& frame, const glm::ivec2& first, int side, int width, int height);
  /**
   * Sets the lanes to the rays that may meet interface `number`, from the depth `first` on; there
   * are no lanes if there is no such ray. IsMismatched is set in any case.
   * @param toSurface the view's origin relative to the surface's origin.
   */
  void SetLanes(
    std::size_t number, const Interface& interface, const glm::dvec3& toSurface, double first);
  /** Begins the next leg of the rays that meet interface `number`. */
  void Refract(std::size_t number, const Interface& interface);
  /**
   * Ends rays at the last interface behind which they may meet a box about the mesh, and determines
   * MayShow of their legs. Returns false if no leg may meet it.
   */
  bool EndBeside(const glm::dvec3& meshCenter, const glm::dvec3& meshHalf);
  /** Computes the steps of leg `number` in the frame of the view. */
  void FindFrameSteps(
    std::size_t number, const glm::dmat3& worldToFrame, double (&steps)[3][Size]) const;

  /** Facets of interface `number` that the rays may meet; null if they are not known. */
  FacetBoxes* FindFacets(std::size_t number)
  {
    FacetBoxes* own = this->Facets.Find(number);
    return own ? own : this->OfTile.Find(number);
  }
  /** Intersector of a patch, for rays of the length `rayLength`. */
  const PatchIntersector& GetTracer(
    const RefractingSurface& surface, std::int32_t facet, double rayLength);

  InstructionSet Set;
  int Count = 0;
  /** Number of each ray's pixel in the tile. */
  std::array<int, Size> Pixels;
  std::vector<WorldLegs> Legs;
  /** Depths of the intersections with the first interface; infinite without one. */
  double Sights[Size];
  StackLanes Lanes;
  /** Bounds of the lanes, whose parameters are depths. */
  TubeBounds Tube;
  /** Normals at the intersections of the lanes. */
  double Normals[3][Size] = {};
  /** Not 0 if the ray of a lane passes the interface. */
  double Refracted[Size] = {};
  /** Facets that the rays of the tile may meet, and those that the rays of the block may meet. */
  BundleFacets OfTile;
  BundleFacets Facets;

private:
  /** A patch that earlier rays met, of this image or another one. */
  struct KeptPatch
  {
    std::int64_t Shape; ///< RefractingSurface::GetShape()
    std::int32_t Facet;
    PatchIntersector Tracer;
  };
  static constexpr std::uint32_t KeptPatches = 2048;
  static constexpr int PlaceBits = 13;
  /** The latest patches, and the place among them of the next one. */
  std::vector<KeptPatch> Kept;
  std::uint32_t NextPlace = 0;
  /** Places in `Kept` by a hash of the facet. */
  std::array<std::uint16_t, 1 << PlaceBits> Places{};
};

}
