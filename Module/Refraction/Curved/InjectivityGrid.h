// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Sufficient test that every point of a box has at most one image, without a search for images.
 *
 * A grid over a membrane has, for slabs of heights behind it, the answers of its patches to a test
 * of their rays, and bounds of the slopes of these rays. The slopes bound the places of all sight
 * points of a box of points by a rectangle, and the patches over it show whether there can be
 * several. Documentation/refraction-method.md, "At most one image", has the test and its proof.
 *
 * A membrane that is no field over a convex polygon as a whole may be one over that rectangle.
 * Cells of the grid that are crossed by a border, or that have facets of the other winding or
 * several facets over a place, prove nothing.
 */
#pragma once

#include "Common/RangeLoop.h"
#include "Refraction/Membrane/HeightField.h"
#include "Refraction/Surface/CurveCrossings.h"

#include <array>
#include <cstdint>
#include <vector>

namespace meniscus
{

class InjectivityGrid
{
public:
  /**
   * Builds the grid for points between two heights along the frame's axis, which points against the
   * rays: along the membrane's normals, or against them for reflected rays. No patch may be farther
   * than `bulge` from its flat facet. `isConvexField` tells that IsConvexField() holds.
   */
  void Build(const Membrane& membrane, const CurvedPatches& patches, const HeightFrame& frame,
    bool isConvexField, double bulge, const Media& media, double low, double high,
    const RangeLoop& loop);

  bool IsEmpty() const { return this->Levels.empty(); }

  /**
   * True if each point of the box, in local coordinates, is proved to have at most one image; false
   * proves nothing.
   */
  bool HoldsAtMostOne(const glm::dvec3& low, const glm::dvec3& high) const;

private:
  static constexpr int Slabs = 64;
  static constexpr std::uint64_t AllSlabs = ~std::uint64_t{ 0 };

  /**
   * Bounds of the patches over a cell of the grid, and the slabs in which all of them are
   * injective.
   */
  struct Cell
  {
    std::array<float, 3> Low; ///< slope, slope, height
    std::array<float, 3> High;
    std::uint64_t Slabs;
  };
  struct Box
  {
    glm::dvec2 Low;
    glm::dvec2 High;
  };
  using Level = std::vector<Cell>; ///< square, half as wide as the next finer one

  static Cell MakeEmpty();
  static void Merge(Cell& cell, const Cell& other);
  struct SlopedRay;
  SlopedRay MakeRay(const PatchPoint& at, const Media& media) const;
  std::vector<SlopedRay> MakeEdgeRays(
    const CurvedPatches& patches, const Media& media, const RangeLoop& loop) const;
  /** Judges a patch by its rays at the corners and in the middles of the edges opposite to them. */
  Cell Judge(
    const std::array<glm::dvec3, 3>& corners, const std::array<const SlopedRay*, 6>& rays) const;
  std::vector<Cell> JudgeAll(const Membrane& membrane, const CurvedPatches& patches,
    const Media& media, const RangeLoop& loop) const;
  void FitGrid(const Membrane& membrane);
  void CollectFacets(const Membrane& membrane, const std::vector<Cell>& judged);
  void RejectBorders(const Membrane& membrane, const CurvedPatches& patches);
  void RejectFolds(const Membrane& membrane);
  void BuildCoarserLevels();
  /** Calls `visit(x, y, cell)` for all cells that the bounding box of places touches. */
  template <std::size_t N, typename Visitor>
  void VisitCells(const std::array<glm::dvec2, N>& places, Visitor&& visit);
  int FindIndex(double place, int axis) const;
  Cell Collect(const Box& box) const;
  static std::uint64_t MakeSlabs(int low, int high);
  std::uint64_t FindSlabs(double low, double high) const;

  HeightFrame Frame;
  double LowHeight = 0.0;
  double SlabHeight = 0.0;
  glm::dvec2 Corner{ 0.0 };
  glm::dvec2 Scale{ 0.0 }; ///< cells per length
  glm::dvec2 Far{ 0.0 };
  double Bulge = 0.0;
  int Width = 0; ///< number of cells along an axis of the finest level, a power of two
  std::vector<Level> Levels;
};

}
