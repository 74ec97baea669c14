// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Common/RangeLoop.h"
#include "Refraction/Surface/Interface.h"
#include "Simd/InstructionSets.h"
#include "Volume/Rays/BoundsInFrame.h"
#include "Volume/Rays/RayFrame.h"
#include "Volume/Refracted/RefractedRayTiles.h"
#include "Volume/Refracted/StackBlock.h"
#include "Volume/Refracted/StackVisibility.h"

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

namespace meniscus
{

/**
 * Rays of an image behind one refracting interface or several, in the order of a list. A ray meets
 * the first interface where it first intersects that surface, from either side. It meets each
 * further one at the first intersection behind the point where it was refracted last, at which it
 * arrives in the medium of that side of the surface; intersections from the other side do not
 * count. A closed surface that is listed twice is thus entered and left.
 *
 * A ray that is totally reflected at an interface ends there. A ray that misses an interface ends
 * at the previous interface, since its further way is unknown; rays that miss the first interface
 * are straight. A ray also ends at an interface behind which it does not reach the mesh.
 *
 * Blocks of rays descend the trees of boxes around the patches. Those that show nothing of the mesh
 * by their bounds (StackVisibility) are not traced behind the first interface. Tiles and blocks of
 * the image in which the mesh is not seen either way, refracted or not, are left out: their rays
 * are straight, or end at the depth of the eye if they meet the first interface before the mesh.
 */
class RefractedRayStack
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
    /** Bounds of the mesh. The refraction of rays that miss it is not computed. */
    BoundsInFrame Mesh;
    /** Bounds of the parts of its boundary, by which fewer rays are refracted that miss it. */
    std::vector<BoundsInFrame> Parts{};

    bool operator==(const View& other) const;
  };

  /** Numbers of rays of an image. */
  struct Counts
  {
    /** Rays that were refracted at an interface and miss the next one. */
    std::int64_t Missing = 0;
    /** Missing rays that are in a medium which the next interface does not have. */
    std::int64_t Mismatched = 0;
    /** Rays that are totally reflected at the second interface or a later one. */
    std::int64_t Reflected = 0;
    /**
     * Pairs of a ray and a patch that it touches, or runs along, within rounding, such as an
     * outline hit exactly: the ray counts as passing the patch there. 0 for nearly all views.
     */
    std::int64_t Undecided = 0;

    void Add(const Counts& other)
    {
      this->Missing += other.Missing;
      this->Mismatched += other.Mismatched;
      this->Reflected += other.Reflected;
      this->Undecided += other.Undecided;
    }
  };

  /** Parts of the surfaces that Build() needs. */
  static constexpr SurfaceParts NeededParts = SurfaceParts::Boxes;

  /** Traces the rays. Media of an interface differ, unless it is the only one. */
  void Build(
    const std::vector<Interface>& interfaces, const View& view, const RangeLoop& loop = SerialLoop);

  /** Rays behind each interface: legs 1 and following (RayLegs). */
  const std::vector<RefractedRayTiles>& GetRays() const { return this->Rays; }
  /** True if any ray that may show the mesh, refracted or not, meets the first interface. */
  bool IsSeen() const { return !this->Rays.empty() && this->Rays.front().HasRays(); }
  /** Mean direction of all legs in the frame of the view; a unit vector, or 0 without any. */
  const glm::dvec3& GetMeanDirection() const { return this->MeanDirection; }
  /** Bounds of the steps of all legs, there as well; empty if there are none. */
  const AxisBox& GetStepBounds() const { return this->StepBounds; }
  /**
   * Counts all rays of the image. Traces the blocks that Build() left out, through the interfaces
   * that it was given.
   */
  Counts GetCounts() const;
  /** Counts the rays in the blocks that Build() traced. */
  const Counts& GetCountsOfTraced() const { return this->Sums; }
  /** Number of the blocks that Build() traced through the first interface only. */
  std::int64_t GetNumberOfUntracedBlocks() const;
  std::int64_t GetBytes() const;

private:
  /** Contributions of a tile to the results. */
  struct TileSum
  {
    /** Sum and bounds of the steps of the legs, in the frame of the view. */
    glm::dvec3 Directions{ 0.0 };
    AxisBox Steps;
    Counts Rays;
  };

  /** Ways on which rays may show the mesh: straight on, and behind the first interface. */
  struct Showing
  {
    bool Straight;
    bool Refracted;
  };

  std::unique_ptr<StackBlock> TakeBlock();
  void PutBack(std::unique_ptr<StackBlock> block);
  TileSum TraceTile(int tile, const StackVisibility& sight, StackBlock& block);
  void PrepareTile(int tile, bool mayShow);
  void ClearTile(int tile, double farthest, TileSquares untraced);
  void HideBlock(int tile, int number, const RefractedRay& ray);
  bool ShowNothing(const Showing& showing, const glm::ivec2& first, const CornerRays& corners,
    const StackVisibility& sight, StackBlock& block, RefractedRay& ray) const;
  TileSum TraceBlocks(int tile, const Showing& ofTile, bool areStraight,
    const StackVisibility& sight, StackBlock& block);
  /** First pixel of a tile. */
  glm::ivec2 FirstPixel(int tile) const
  {
    return RefractedRayTiles::TileSize * glm::ivec2(tile % this->Columns, tile / this->Columns);
  }
  void BoundMesh();
  CornerRays CornersOf(const glm::ivec2& first, int size) const;
  /** The view's origin, relative to the origin of an interface's surface. */
  glm::dvec3 ToSurface(std::size_t number) const
  {
    return this->Of.Center - this->Interfaces[number].Surface->GetMembrane().GetOrigin();
  }
  void MeetFirst(const glm::ivec2& first, int side, StackBlock& block, Counts& sums) const;
  double FindFarthestSight(const StackVisibility& sight, const StackBlock& block) const;
  bool MeetsFirst(const glm::ivec2& pixel, StackBlock& block) const;
  bool TraceBlock(const StackVisibility* sight, StackBlock& block, Counts& sums) const;
  bool MayShowMesh(const StackVisibility& sight, StackBlock& block) const;
  void SetLanes(std::size_t number, StackBlock& block, Counts& sums) const;
  template <typename Meet>
  void VisitFacets(std::size_t number, StackBlock& block, const Meet& meet) const;
  void MeetInterface(std::size_t number, StackBlock& block, Counts& sums) const;
  void StoreBlock(const StackBlock& block, int tile, int number, TileSum& sum);
  void StoreSights(const StackBlock& block, int tile, int number);

  std::vector<Interface> Interfaces;
  View Of;
  int Columns = 0;
  InstructionSet Set = BestInstructionSet();
  /** Blocks that no thread uses. */
  std::vector<std::unique_ptr<StackBlock>> Blocks;
  std::mutex BlocksMutex;
  glm::dmat3 WorldToFrame{ 1.0 };
  /** Bounds of the mesh along the world's axes, relative to the view's origin. */
  VisibilityBounds Mesh;
  std::vector<RefractedRayTiles> Rays;
  /** Blocks with rays that are not traced behind the first interface: a bit per block of a tile. */
  std::vector<TileSquares> Untraced;
  glm::dvec3 MeanDirection{ 0.0 };
  AxisBox StepBounds;
  Counts Sums;
};

}
