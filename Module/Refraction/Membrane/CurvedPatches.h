// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Curved patches over the facets of a membrane, from its vertices and their normals alone.
 *
 * Linear interpolation of the normals is of second order on a general surface, so the normal in the
 * middle of an edge is fitted. In the tangent plane of each vertex the normals of its neighbours
 * are fitted by a gradient of second degree, whose linear part is the curvature tensor W of the
 * vertex. Cubic Hermite interpolation along an edge e from vertex 0 to 1 then bends the normal at
 * its middle by m = (W0 e - W1 e) / 8, less what points along N0 + N1 (which changes the length
 * only).
 *
 * Fallbacks, each decided by an edge's two ends, so that nothing is cracked: an edge whose normals
 * turn by more than 60 degrees, or lean along the edge by more than 30, is straight and its normals
 * are interpolated linearly. A bend is at most LargestDeflection. A vertex whose fit is singular is
 * fitted without the second degree, or counts as flat.
 */
#ifndef meniscus_Refraction_Membrane_CurvedPatches_h
#define meniscus_Refraction_Membrane_CurvedPatches_h

#include "Common/RangeLoop.h"
#include "Refraction/Membrane/CurvedPatch.h"
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

  /** Topology and fit of a new membrane, which must outlive this. */
  void Build(const Membrane& membrane, const RangeLoop& loop);

  /** The fit alone, after the membrane has moved with the same facets. */
  void Refit(const RangeLoop& loop);

  CurvedPatch GetPatch(std::int32_t facet) const;

  /**
   * The place in or near which the straight way from `facet` to `target` ends, seen along
   * `normal`, after at most `steps` facets; a border ends it.
   */
  std::int32_t Walk(
    std::int32_t facet, const glm::dvec3& target, const glm::dvec3& normal, int steps) const;

  /**
   * The facet behind the edge opposite to `corner`; NoFacet at a border, or where more or fewer
   * than two facets meet.
   */
  std::int32_t GetNeighbour(std::int32_t facet, int corner) const
  {
    return this->Patches[static_cast<std::size_t>(facet)].Neighbour[corner];
  }

  /** Edges that fell back to straight ones, each counted once per facet. */
  std::size_t GetNumberOfStraightEdges() const;

private:
  /** One cache line. */
  struct alignas(64) Patch
  {
    std::int32_t Vertex[3];
    std::int32_t Neighbour[3];
    float Bend[3][3];
    std::uint32_t Straight; ///< bit k: edge k
  };

  /** A symmetric tensor: xx, xy, xz, yy, yz, zz. */
  using Tensor = std::array<double, 6>;

  void FindNeighbours();
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

}

#endif
