// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Where a point has one image at most, told without looking for any.
 *
 * On the plane at height z behind a membrane that is a field of heights over a convex polygon, the
 * refracted rays draw a map F_z from the polygon to the plane: F_z(u) = S(u) + (h(u) - z) m(u) with
 * the surface's point S and height h over the flat facets' place u, and the ray's slope m. If the
 * symmetric part of its derivative is positive definite along the straight way from u to v, then
 * (v - u).(F_z(v) - F_z(u)) > 0: not both look at the same point. That holds for smaller depths
 * than those of the first caustic and a good part of those behind it, and it is concave in z, so
 * between two heights where it holds it holds too.
 *
 * Per patch it is tested by a Bezier triangle of second degree from six rays, with a margin for
 * what is of higher degree; a grid over the polygon collects the patches' answers for slabs of
 * heights, and bounds of their rays' slopes. From the slopes follows where the sight points of a
 * box of points can be, from the patches there whether they can be several.
 */
#ifndef meniscus_Refraction_Curved_InjectivityGrid_h
#define meniscus_Refraction_Curved_InjectivityGrid_h

#include "Common/RangeLoop.h"
#include "Refraction/Curved/CurveCrossings.h"
#include "Refraction/Membrane/HeightField.h"

#include <array>
#include <cstdint>
#include <vector>

namespace meniscus
{

class InjectivityGrid
{
public:
  /**
   * For points between two heights along the frame's axis. The membrane must be a convex field,
   * no patch of which is farther than `bulge` from its flat facet.
   */
  void Build(const Membrane& membrane, const CurvedPatches& patches, const HeightFrame& frame,
    double bulge, const Media& media, double low, double high, const RangeLoop& loop);

  bool IsEmpty() const { return this->Levels.empty(); }

  /**
   * Whether each point of the box, in local coordinates, has one image at most. False says
   * nothing.
   */
  bool HoldsAtMostOne(const glm::dvec3& low, const glm::dvec3& high) const;

private:
  static constexpr int Slabs = 8;
  static constexpr std::uint8_t AllSlabs = 0xff;

  /** Bounds of what lies over a cell of the grid, and the slabs in which all of it is injective. */
  struct Cell
  {
    std::array<float, 3> Low; ///< slope, slope, height
    std::array<float, 3> High;
    std::uint8_t Slabs;
  };
  struct Box
  {
    glm::dvec2 Low;
    glm::dvec2 High;
  };
  using Level = std::vector<Cell>; ///< square, half as wide as the one before

  static Cell MakeEmpty();
  static void Merge(Cell& cell, const Cell& other);
  Cell Judge(const CurvedPatch& patch, const HeightFrame& frame, const Media& media) const;
  void FitGrid(const Membrane& membrane);
  int FindIndex(double place, int axis) const;
  Cell Collect(const Box& box) const;
  std::uint8_t FindSlabs(double low, double high) const;

  HeightFrame Frame;
  double LowHeight = 0.0;
  double SlabHeight = 0.0;
  glm::dvec2 Corner{ 0.0 };
  glm::dvec2 Scale{ 0.0 }; ///< cells per length
  glm::dvec2 Far{ 0.0 };
  double Bulge = 0.0;
  int Width = 0; ///< of the finest level, a power of two
  std::vector<Level> Levels;
};

}

#endif
