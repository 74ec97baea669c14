// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * The thesis's algorithm: the membrane, its cells for one eye, the tree over the cells, and the
 * resulting virtual vertices. The interface takes world coordinates; members use local ones,
 * relative to the membrane's origin.
 *
 * Everything expensive is kept as long as it is valid: the tree's topology until the shape changes,
 * cells and tree bounds until the eye or the indices change. Solving changes no state and may run
 * on any number of threads at once.
 */
#pragma once

#include "Refraction/Flat/RefractionCells.h"
#include "Refraction/Sight/VirtualVertex.h"
#include "Refraction/Surface/RefractingSurface.h"
#include "Refraction/Tubes/RayTubeTree.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace meniscus
{

class FlatMembraneSolver
{
public:
  /** Sets the surface. Needed again after each change of its shape, and then the eye. */
  void SetSurface(const std::shared_ptr<const RefractingSurface>& surface);
  /** Sets a surface of the solver's own. */
  MembraneStatus SetMembrane(const MembraneInput& input);
  const Membrane& GetMembrane() const { return this->Surface->GetMembrane(); }

  /**
   * Rebuilds the cells for an eye in world coordinates. Solving is allowed only if the result is
   * `Ready`.
   */
  EyeStatus SetEye(
    const glm::dvec3& eye, double exterior, double interior, const RangeLoop& loop = SerialLoop);
  const RefractionCells& GetCells() const { return this->Cells; }

  /**
   * Finds the images of `points` (x, y, z each) in [begin, end) and writes them to the same places
   * of `vertices`.
   */
  void Solve(
    const double* points, std::size_t begin, std::size_t end, VirtualVertex* vertices) const;

  /**
   * Image of one point in the first facet, in the order of the input, whose cell holds the point.
   */
  VirtualVertex SolvePoint(const glm::dvec3& point) const;

  /**
   * As SolvePoint, but by a loop over all facets: the reference with which the tree must agree bit
   * by bit.
   */
  VirtualVertex SolvePointByBruteForce(const glm::dvec3& point) const;

  /**
   * True if exactly one cell holds `point` when its walls are widened by `wall`, in barycentric
   * coordinates. The thesis leaves all other points out of its statistics.
   */
  bool HasOneCell(const glm::dvec3& point, double wall) const;

  /**
   * True if a facet that `chosen` marks may show a point of the cube with centre `point` and half
   * side `padding`.
   */
  bool MayShow(const glm::dvec3& point, double padding, const std::vector<bool>& chosen) const;

private:
  template <typename Visit>
  VirtualVertex SolveAmong(const glm::dvec3& point, const Visit& visit) const;
  bool IsInReach(const glm::dvec3& local) const
  {
    return RayTubeTree::IsInReach(local, this->GetMembrane().GetRadius());
  }
  VirtualVertex MakeVertex(const glm::dvec3& local, std::int32_t facet, const CellHit& hit) const;

  std::shared_ptr<const RefractingSurface> Surface = std::make_shared<RefractingSurface>();
  std::shared_ptr<RefractingSurface> Own; ///< surface of SetMembrane()
  RayTubeTree Tree;
  RefractionCells Cells;
  double Exterior = 1.0;
  double Interior = 1.0;
};

}
