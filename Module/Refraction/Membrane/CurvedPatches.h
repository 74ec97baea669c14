// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Curved patches over the facets of a membrane, from its vertices and their normals alone.
 *
 * Linear interpolation of the normals is only second-order accurate on a general surface, so the
 * normal in the middle of an edge is fitted. In the tangent plane of each vertex the normals of its
 * neighbours are fitted by a gradient of second degree, whose linear part is the curvature tensor W
 * of the vertex. Cubic Hermite interpolation along an edge e from vertex 0 to 1 then deflects the
 * normal at its middle by m = (W0 e - W1 e) / 8, without its component along N0 + N1, which changes
 * the length only.
 *
 * Fallbacks, each decided by the two ends of an edge, so that no cracks appear: an edge whose
 * normals turn by more than 60 degrees, or lean along the edge by more than 30, is straight and its
 * normals are interpolated linearly. A deflection is at most LargestDeflection. A vertex whose fit
 * is singular is fitted without the second degree, or counts as flat.
 */
#pragma once

#include "Common/Prefetch.h"
#include "Common/RangeLoop.h"
#include "Refraction/Membrane/CurvedPatch.h"
#include "Refraction/Membrane/FacetWalk.h"
#include "Refraction/Membrane/Membrane.h"

#include <array>
#include <cstdint>
#include <vector>

namespace meniscus
{

class CurvedPatches
{
public:
  static constexpr std::int32_t NoFacet = -1;

  /** Topology and fit of a new membrane, which must outlive this object. */
  void Build(const Membrane& membrane, const RangeLoop& loop);

  /**
   * Repeats the fit alone, after the points of the membrane have moved and the facets have not
   * changed.
   */
  void Refit(const RangeLoop& loop);

  CurvedPatch GetPatch(std::int32_t facet) const;

  std::size_t GetSize() const { return this->Patches.size(); }
  /** The first corner of a patch. */
  PatchPoint GetCorner(std::int32_t facet) const
  {
    const auto vertex =
      static_cast<std::size_t>(this->Patches[static_cast<std::size_t>(facet)].Vertex[0]);
    return { this->Surface->GetPositions()[vertex], this->Surface->GetNormals()[vertex] };
  }
  void PrefetchPatch(std::int32_t facet) const
  {
    Prefetch(&this->Patches[static_cast<std::size_t>(facet)]);
  }

  /**
   * Writes corners, normals and bends of a patch to a lane of arrays with these names, and to
   * IsCubic 0 for straight edges and 1 for others.
   */
  template <class Lanes>
  void LoadPatch(std::int32_t facet, int lane, Lanes& lanes) const;

  /**
   * Facet in or near which the straight way from `facet` to `target`, projected along `normal`,
   * ends after at most `steps` facets. The way also ends at a border.
   */
  std::int32_t Walk(
    std::int32_t facet, const glm::dvec3& target, const glm::dvec3& normal, int steps) const
  {
    return FacetWalk(*this, facet, target, normal, steps).Finish();
  }

  /**
   * Facet across the edge opposite `corner`; NoFacet at a border, or where more or fewer than two
   * facets meet.
   */
  std::int32_t GetNeighbour(std::int32_t facet, int corner) const
  {
    return this->Patches[static_cast<std::size_t>(facet)].Neighbour[corner];
  }

  /**
   * Number of an edge: three times its facet and the corner opposite to it, in the first of the two
   * facets that share it.
   */
  std::size_t FindFirstEdge(std::int32_t facet, int corner) const
  {
    const Patch& patch = this->Patches[static_cast<std::size_t>(facet)];
    const std::int32_t other = patch.Neighbour[corner];
    const auto own = static_cast<std::size_t>(3 * std::int64_t{ facet } + corner);
    if (other == NoFacet || other > facet)
    {
      return own;
    }
    // The corner of the other facet that is none of the edge's ends.
    const Patch& shared = this->Patches[static_cast<std::size_t>(other)];
    const std::int32_t first = patch.Vertex[(corner + 1) % 3];
    const std::int32_t last = patch.Vertex[(corner + 2) % 3];
    std::size_t opposite = 0;
    while (shared.Vertex[opposite] == first || shared.Vertex[opposite] == last)
    {
      ++opposite;
    }
    return 3 * static_cast<std::size_t>(other) + opposite;
  }

  /** Number of edges that are straight as a fallback, each counted once per facet. */
  std::size_t GetNumberOfStraightEdges() const;

private:
  friend class FacetWalk;

  /** Stored patch; fills one cache line. */
  struct alignas(64) Patch
  {
    std::int32_t Vertex[3];
    std::int32_t Neighbour[3];
    float Bend[3][3];
    std::uint32_t Straight; ///< bit k is set if edge k is straight
  };

  /** A symmetric tensor: xx, xy, xz, yy, yz, zz. */
  using Tensor = std::array<double, 6>;

  void FindRings();
  void AddSecondRings();
  bool IsSmooth(std::int32_t from, std::int32_t to) const;
  template <typename Visit>
  void VisitSmoothNeighbours(std::int32_t vertex, const Visit& visit) const;
  Tensor FitCurvature(std::int32_t vertex) const;
  void FitFacet(Patch& patch) const;

  const Membrane* Surface = nullptr;
  std::vector<Patch> Patches;
  std::vector<std::int32_t> RingStart;
  std::vector<std::int32_t> Ring;
  std::vector<Tensor> Curvature;
};

//------------------------------------------------------------------------------
inline CurvedPatch CurvedPatches::GetPatch(std::int32_t facet) const
{
  const Patch& patch = this->Patches[static_cast<std::size_t>(facet)];
  CurvedPatch result;
  for (int k = 0; k < 3; ++k)
  {
    const auto vertex = static_cast<std::size_t>(patch.Vertex[k]);
    result.Corner[k] = this->Surface->GetPositions()[vertex];
    result.Normal[k] = this->Surface->GetNormals()[vertex];
    result.Bend[k] = glm::dvec3(patch.Bend[k][0], patch.Bend[k][1], patch.Bend[k][2]);
  }
  for (int k = 0; k < 3; ++k)
  {
    if (patch.Straight >> k & 1u)
    {
      result.Symmetric[k] = 0.0;
      result.Asymmetric[k] = 0.0;
    }
    else
    {
      result.FitEdge(k);
    }
  }
  return result;
}

//------------------------------------------------------------------------------
template <class Lanes>
void CurvedPatches::LoadPatch(std::int32_t facet, int lane, Lanes& lanes) const
{
  const Patch& patch = this->Patches[static_cast<std::size_t>(facet)];
  for (int k = 0; k < 3; ++k)
  {
    const auto vertex = static_cast<std::size_t>(patch.Vertex[k]);
    const glm::dvec3& corner = this->Surface->GetPositions()[vertex];
    const glm::dvec3& normal = this->Surface->GetNormals()[vertex];
    for (int axis = 0; axis < 3; ++axis)
    {
      lanes.Corner[k][axis][lane] = corner[axis];
      lanes.Normal[k][axis][lane] = normal[axis];
      lanes.Bend[k][axis][lane] = patch.Bend[k][axis];
    }
    lanes.IsCubic[k][lane] = patch.Straight >> k & 1u ? 0.0 : 1.0;
  }
}

}
