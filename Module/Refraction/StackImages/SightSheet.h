// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * The rays that the first surface of a stack sends through all interfaces, as a piecewise linear
 * field: each patch is divided into triangular cells in which the rays of every leg are nearly
 * linear. The field depends on the eye and the interfaces, not on primitives, so all primitives
 * share it. Patches are divided when they are first needed.
 *
 * A ray has legs: leg 0 from the eye to the first surface, leg k behind interface k. A leg is seen
 * if the ray goes on to the next surface, or if it is the last one. Where the number of legs that
 * are seen changes along a side, at a border of a later surface or at a critical angle, the side is
 * divided. A side that crosses borders of later surfaces several times is divided between the
 * crossings, and a cell with a corner of a border inside is divided there. Whether and where a side
 * is divided depends on that side alone, so that neighbours, of one patch or of two, have the same
 * nodes bit by bit.
 */
#pragma once

#include "Refraction/Images/SubCellDivision.h"
#include "Refraction/Stack/StackSolver.h"
#include "Refraction/StackImages/SightBorders.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

namespace meniscus
{

/** Rays of one leg at the corners of a cell, and their ends on the next surface. */
struct LegCell
{
  SubCell Nodes;
  std::array<glm::dvec3, 3> Ends; ///< not set behind the last interface
};

class SightSheet
{
public:
  /** A patch of the first surface and its cells. */
  struct Patch;

  /**
   * `tolerance` is the largest error of linear interpolation in a cell, as an angle in radians at
   * the eye, on the surfaces and at the distance `farthest` behind the last one. `solver` must
   * outlive this object.
   */
  SightSheet(const StackSolver& solver, double tolerance, double farthest);
  ~SightSheet();

  /** The patch of a facet, divided at the first call. May be called from several threads. */
  const Patch& GetPatch(std::int32_t facet) const;

  /** The surface's patch, its normals to the eye. */
  static const CurvedPatch& GetSurface(const Patch& patch);

  /**
   * Calls `map(cell)` for each cell of a patch in which leg `leg` is seen and may show a place in
   * the box, unless `isOutside(nodes)` is true.
   */
  template <typename IsOutside, typename Map>
  void Visit(const Patch& patch, std::size_t leg, const AxisBox& box, const IsOutside& isOutside,
    const Map& map) const;

  /** Largest error of linear interpolation in a cell, as an angle in radians at the eye. */
  double GetTolerance() const { return this->Tolerance; }

  /** Number of interfaces. */
  std::size_t GetNumberOfLinks() const { return this->Links; }

private:
  /**
   * Divisions of a cell, each at a side that has at most half of its length before, at a limit, or
   * at a border; next to the middle of the side or of the cell, if there are many. Divisions of
   * cells that are wider than their distance from the eye are not counted.
   */
  static constexpr int DeepestCell = 24;
  /**
   * Each division leaves at most three more cells to visit, and one if a single side is divided: a
   * wide cell has three of them.
   */
  static constexpr std::size_t StackSize = 3 * (DeepestCell + 3 * BeamDivision::MostNearLevels) + 4;

  struct Node
  {
    glm::dvec2 B;
    int Legs = -1;          ///< last leg that is seen; -1 where the surface faces away
    int Rays = 0;           ///< last leg that has a ray, which may miss the next surface
    int Beyond = -1;        ///< at a limit: last leg that is seen just beyond
    bool IsAtLimit = false; ///< the last place on a side where this leg is seen
    bool IsFirst = false;   ///< the sight ray has not met the first surface before
  };
  struct Cell
  {
    std::array<std::int32_t, 3> Nodes;
    std::int32_t FirstChild = 0; ///< children are consecutive
    std::int32_t Children = 0;   ///< 0 for a cell that is not divided
  };
  class Builder;

  bool GetLeg(const Patch& patch, const Cell& cell, std::size_t leg, LegCell& result) const;
  /** False if no ray of a cell can be in a box on leg `leg`. */
  bool MayShow(const Patch& patch, std::size_t cell, std::size_t leg, const AxisBox& box) const;

  const StackSolver& Solver;
  double Tolerance;
  double Farthest;
  std::size_t Links;
  SightBorders Borders;
  mutable std::vector<std::unique_ptr<Patch>> Patches;
  mutable std::unique_ptr<std::once_flag[]> Once;
};

struct SightSheet::Patch
{
  CurvedPatch Surface;
  std::vector<Node> Nodes;
  std::vector<Cell> Cells;     ///< the whole patch first
  std::vector<TubeClip> Tubes; ///< bounds of the rays, per cell and leg
  std::vector<AxisBox> Boxes;  ///< bounds of all of a leg, per leg; not used for the last one
  // One value per node and leg:
  std::vector<glm::dvec3> Points; ///< where the leg begins
  std::vector<glm::dvec3> Directions;
};

//------------------------------------------------------------------------------
template <typename IsOutside, typename Map>
void SightSheet::Visit(const Patch& patch, std::size_t leg, const AxisBox& box,
  const IsOutside& isOutside, const Map& map) const
{
  if (leg < this->Links && !Overlap(box, patch.Boxes[leg]))
  {
    return;
  }
  std::array<std::int32_t, StackSize> open;
  std::size_t depth = 0;
  open[depth++] = 0;
  LegCell legCell;
  while (depth > 0)
  {
    const auto index = static_cast<std::size_t>(open[--depth]);
    if (!this->MayShow(patch, index, leg, box))
    {
      continue;
    }
    const Cell& cell = patch.Cells[index];
    for (std::int32_t k = cell.Children; k-- > 0;)
    {
      open[depth++] = cell.FirstChild + k;
    }
    if (cell.Children == 0 && this->GetLeg(patch, cell, leg, legCell) && !isOutside(legCell.Nodes))
    {
      map(legCell);
    }
  }
}

}
