// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * The thesis's algorithm in one place: a membrane, its cells for one eye, the tree over the cells,
 * and the virtual vertices that come out. World coordinates outside, local ones inside.
 *
 * Everything expensive is kept as long as it holds: the tree's topology as long as the shape, cells
 * and tree bounds as long as eye and indices. Solving changes nothing and may run on any number of
 * threads at once.
 */
#ifndef meniscus_Refraction_Flat_FlatMembraneSolver_h
#define meniscus_Refraction_Flat_FlatMembraneSolver_h

#include "Refraction/Flat/RefractionCells.h"
#include "Refraction/Membrane/Membrane.h"
#include "Refraction/Tubes/RayTubeTree.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace meniscus
{

enum class ImageState : unsigned char
{
  Found,
  NoImage,   ///< the point is in no cell
  NotFinite, ///< NaN, infinite, or farther than RayTubeTree::FarthestRadii: no answer is possible
  NotAsked   ///< left out by the caller
};

struct VirtualVertex
{
  glm::dvec3 Position{ 0.0 };   ///< Eq. 2.4, world; the true point if there is no image
  glm::dvec3 SightPoint{ 0.0 }; ///< where the sight ray meets the facet, world
  double Depth = 0.0;           ///< from sight point to true point
  double Reflectance = 0.0;     ///< exact Fresnel at the sight point
  double Cosine = 1.0;          ///< of the angle of incidence there, on the eye's side
  std::int32_t Facet = -1;      ///< index among the membrane's accepted facets
  ImageState State = ImageState::NoImage;
  signed char Orientation = 1; ///< -1: mirrored
};

class FlatMembraneSolver
{
public:
  /** Takes a new shape. The eye must be set again afterwards. */
  MembraneStatus SetMembrane(const MembraneInput& input);
  const Membrane& GetMembrane() const { return this->Surface; }

  /** Rebuilds the cells for an eye in world coordinates. Unless `Ready`, nothing may be solved. */
  EyeStatus SetEye(
    const glm::dvec3& eye, double exterior, double interior, const RangeLoop& loop = SerialLoop);
  const RefractionCells& GetCells() const { return this->Cells; }

  /**
   * Images of `points` (x, y, z each) in [begin, end), written to the same places of `vertices`.
   */
  void Solve(
    const double* points, std::size_t begin, std::size_t end, VirtualVertex* vertices) const;

  /** The image of one point in the first facet, in the order of the input, whose cell holds it. */
  VirtualVertex SolvePoint(const glm::dvec3& point) const;

  /** The same by a loop over all facets: what the tree must agree with, bit by bit. */
  VirtualVertex SolvePointByBruteForce(const glm::dvec3& point) const;

  /**
   * Whether exactly one cell holds `point` with walls widened by `wall`, in barycentric
   * coordinates: the thesis leaves all other points out of its statistics.
   */
  bool HasOneCell(const glm::dvec3& point, double wall) const;

  /** Whether a facet that `chosen` marks may show a point of the cube of half side `padding`. */
  bool MayShow(const glm::dvec3& point, double padding, const std::vector<bool>& chosen) const;

private:
  bool IsInReach(const glm::dvec3& local) const;
  VirtualVertex MakeVertex(const glm::dvec3& local, std::int32_t facet, const CellHit& hit) const;

  Membrane Surface;
  RayTubeTree Tree;
  RefractionCells Cells;
  double Exterior = 1.0;
  double Interior = 1.0;
};

}

#endif
