// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Double-precision reference for the tetrahedral ray caster.
 *
 * It shares neither code nor method with the kernel's walk: every cell that a ray crosses is found
 * independently (box tree, then clipping by the cell's four half-spaces), so errors such as a wrong
 * neighbour table, a wrong entry or a lost ray cannot occur in the same way here.
 *
 * Model: density emitter. dC = tau(s) c(s) T dt, T = exp(-integral of tau), with t in world length.
 * The result is premultiplied, alpha = 1 - T.
 *
 * Overlap: inverted and flat cells do not contribute (see ReferenceMesh). On a ray that crosses an
 * inverted cell or overlapping parts, the cells found are sorted in the order in which a path
 * across shared faces meets them, and parts in the order of their entries; each cell is then used
 * from the largest depth reached before it to its own exit. Closed paths, which have no entry, are
 * ignored. Only the order follows from the faces: the cells and their ends are those of clipping. A
 * cell that the transfer function makes invisible in its whole range of scalars occludes nothing.
 */
#pragma once

#include "RayCrossings.h"
#include "ReferenceCellTree.h"
#include "ReferenceMesh.h"
#include "ReferenceTransferFunction.h"

#include <array>
#include <cstdint>
#include <vector>

namespace meniscus::reference
{

/** Part of a ray inside the mesh without a gap. */
struct CoveredSpan
{
  double Begin;
  double End;
};

struct RayReport
{
  std::size_t Cells = 0;    // segments that contribute
  std::size_t Gaps = 0;     // gaps between the first entry and the last exit
  std::size_t Overlaps = 0; // cells clipped by the overlap rule by more than rounding
  bool Ordered = false;     // order determined by shared faces, not by the depth of entry
};

enum class RayClass
{
  Missed,
  Covered,
  Silhouette
};

class ReferenceRayIntegrator
{
public:
  ReferenceRayIntegrator(
    std::vector<double> points, std::vector<std::int64_t> cells, std::vector<double> scalars);

  const ReferenceMesh& MakeMesh() const { return this->Mesh; }

  /** Segments in order along the ray, without overlap. The vector is reused by the caller. */
  RayReport FindSegments(const Ray& ray, std::vector<RaySegment>& segments) const;

  /** As above, without the cells that cannot be seen, wherever cells overlap. */
  RayReport FindVisibleSegments(
    const Ray& ray, const CellTest& canBeSeen, std::vector<RaySegment>& segments) const;
  /** As above, by CanBeSeen(). */
  RayReport FindVisibleSegments(const Ray& ray, const ReferenceTransferFunction& function,
    std::vector<RaySegment>& segments) const;
  /** True if the function attenuates anywhere in the cell's range of scalars. */
  bool CanBeSeen(std::int64_t cell, const ReferenceTransferFunction& function) const;

  /**
   * Premultiplied RGBA along the segments that one of the two functions returned for the same ray.
   */
  static std::array<double, 4> Integrate(const Ray& ray, const std::vector<RaySegment>& segments,
    const ReferenceTransferFunction& function);

  std::array<double, 4> Trace(const Ray& ray, const ReferenceTransferFunction& function) const;

  /**
   * Silhouette: the covered spans change by a jump (not in proportion) when the ray is moved
   * sideways by the distance, in any of 8 directions. Rounding of the vertices to float then
   * decides which cells the ray meets, so such rays are counted separately. In folded or
   * overlapping parts a jump of the result itself counts too: there the order of cells changes at
   * edges inside the mesh.
   */
  RayClass Classify(
    const Ray& ray, double distance, const ReferenceTransferFunction& function) const;

  /** Largest change of the result when the ray is moved sideways by a distance, in 8 directions. */
  double Sensitivity(
    const Ray& ray, double distance, const ReferenceTransferFunction& function) const;

  /**
   * Distance for classify: float rounding of positions and directions, at a distance of a few
   * diagonals, is 3e-7 of the diagonal; the margin is a factor of about 3.
   */
  double SilhouetteDistance() const { return 1e-6 * this->Mesh.GetDiagonal(); }

  std::vector<CoveredSpan> CoveredSpans(const Ray& ray) const;

private:
  RayReport FindSegments(
    const Ray& ray, const CellTest* canBeSeen, std::vector<RaySegment>& segments) const;

  ReferenceMesh Mesh;
  ReferenceCellTree Tree;
};

} // namespace meniscus::reference
