// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Refraction/Membrane/Optics.h"
#include "Refraction/Stack/StackSolver.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>

namespace meniscus
{

/** Places that StackSolver::Solve writes the images of points to. */
struct ImageOutput
{
  VirtualVertex* Vertices;
  StackDetail* Details;
  double* Legs;             ///< one per interface and point
  std::size_t LegsPerPoint; ///< number of interfaces, including interfaces behind the eye
};

/**
 * Images of points behind all planes of a stack of exact parallel planes. The sight rays of a chain
 * of points are found in lanes; the facets that they meet, by the facets of the point before.
 */
class PlaneImages
{
public:
  /** All references must outlive this object. */
  PlaneImages(const RefractionStack& stack, const ParallelPlanes& planes)
    : Stack(stack)
    , Planes(planes)
  {
  }

  /** Number of points that may be added. */
  static constexpr std::size_t Most = PlaneLanes::Most;

  /** Adds a point in world coordinates with its number in the output, if it is behind the planes.
   */
  bool Add(const glm::dvec3& point, std::size_t number);

  /** Writes the images of the points that have been added. */
  void Solve(const ImageOutput& output);

  /** Removes the points, and calls `miss(number)` for those whose rays miss a surface. */
  template <typename Miss>
  void Clear(const Miss& miss)
  {
    for (int lane = 0; lane < this->Lanes.Count; ++lane)
    {
      if (this->IsMissed[lane])
      {
        miss(this->Numbers[lane]);
      }
    }
    this->Lanes.Count = 0;
  }

private:
  /** A facet, and its barycentric coordinates as functions of the place. */
  struct Facet
  {
    std::int32_t Number = CurvedPatches::NoFacet;
    glm::dvec3 Corner{};
    PlaceGradient Gradient{};

    void Set(const CurvedPatches& patches, std::int32_t facet);
    Outside FindOutside(const glm::dvec3& place) const
    {
      const glm::dvec3 way = place - this->Corner;
      return meniscus::FindOutside(
        { glm::dot(this->Gradient.U, way), glm::dot(this->Gradient.V, way) });
    }
  };

  void MeetPlane(std::size_t plane, const ImageOutput& output);
  bool FindFacet(std::size_t plane, const glm::dvec3& place, Facet& facet) const;
  static bool GoToFacet(const CurvedPatches& patches, const glm::dvec3& place, Facet& facet);
  void WriteLegs(std::size_t plane, const ImageOutput& output) const;
  void WriteVertices(const ImageOutput& output) const;

  const RefractionStack& Stack;
  const ParallelPlanes& Planes;
  PlaneLanes Lanes;
  std::size_t Numbers[Most];
  bool IsMissed[Most];
  glm::dvec3 Lateral[Most]; ///< unit vectors from the axis to the points
  PlateTransmittance Transmittance[Most];
  glm::dvec3 SightPoint[Most]; ///< relative to the stack's origin
  std::int32_t FirstFacet[Most];
};

}
