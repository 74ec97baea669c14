// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Refraction/Stack/StackSolver.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace meniscus
{

/**
 * Images of points behind all planes of a stack of exact parallel planes. The sight rays of a chain
 * of points are found in lanes; the facets that they meet, by the facets of the point before.
 * Places on planes are coordinates of the planes' frame, from the axis through the eye.
 */
class PlaneImages
{
public:
  /** `planes` must be exact and outlive this object. */
  explicit PlaneImages(const ParallelPlanes& planes)
    : Stack(planes.GetStack())
    , Planes(planes)
  {
  }

  /** Number of points that may be added. */
  static constexpr std::size_t Most = PlaneLanes::Most;

  /**
   * Adds a point in world coordinates with its number in the output, if it is behind the planes and
   * in the solvers' reach.
   */
  bool Add(const glm::dvec3& point, std::size_t number);

  bool IsFull() const { return this->Lanes.Count == PlaneLanes::Most; }

  /**
   * Writes the images of the points that have been added, and removes the points. The numbers of
   * those whose rays pass a border within rounding are appended to `others`.
   */
  void Solve(const ImageOutput& output, std::vector<std::size_t>& others);

private:
  /** Where a ray meets a plane. */
  enum class Meeting : unsigned char
  {
    Inside,
    Outside, ///< beyond the border by more than rounding
    Open
  };

  /** A facet, and its barycentric coordinates as functions of the place. */
  struct Facet
  {
    std::int32_t Number = CurvedPatches::NoFacet;
    glm::dvec2 Corners[3];
    glm::dvec2 ByPlace[2]; ///< gradients of the second and the third coordinate

    Outside FindOutside(const glm::dvec2& place) const;
  };

  glm::dvec3 GetFoot(std::size_t plane) const;
  Facet MakeFacet(std::size_t plane, std::int32_t number) const;
  bool AreAllInside(std::size_t plane) const;
  void FindFacets(std::size_t plane);
  Meeting FindFacet(std::size_t plane, const glm::dvec2& place, Facet& facet) const;
  Meeting GoToFacet(
    std::size_t plane, const glm::dvec2& place, std::size_t most, Facet& facet) const;
  bool IsBeyond(
    std::size_t plane, const glm::dvec2& place, const Facet& facet, const Outside& outside) const;
  void WriteLegs(std::size_t plane, const ImageOutput& output) const;
  void WriteVertices(const ImageOutput& output) const;
  void WriteWithout(int lane, const ImageOutput& output, std::vector<std::size_t>& others) const;

  const RefractionStack& Stack;
  const ParallelPlanes& Planes;

  /** Lanes, and the places of the rays on the first plane and on the plane met last. */
  struct PlaceLanes : PlaneLanes
  {
    double Across[2][Most]; ///< of the points
    double First[2][Most];
    double Last[2][Most];
  };
  PlaceLanes Lanes;
  std::size_t Numbers[Most];
  glm::dvec3 Points[Most]; ///< in world coordinates
  Meeting Meetings[Most];  ///< with the first plane that the ray does not meet, if there is one
  std::int32_t FirstFacet[Most];

  struct BeginKernel;
  struct PlaceKernel;
};

/**
 * Solves the points in [begin, end) that exact parallel planes decide, which are points behind all
 * of them. The numbers of the others are appended to `others`.
 */
void SolveBehindPlanes(const ParallelPlanes& planes, const double* points, std::size_t begin,
  std::size_t end, const ImageOutput& output, std::vector<std::size_t>& others);

/**
 * Finds the refracted images of points (x, y, z each) in [begin, end) at one exact plane, as
 * CurvedMembraneSolver::Solve does. Points with 0 in `isOpen` are left out; the others get 0 there
 * unless they are on the plane, or their rays meet its border, within rounding. Returns true if any
 * points are left.
 */
bool SolveAtPlane(const ParallelPlanes& plane, const double* points, std::size_t begin,
  std::size_t end, VirtualVertex* vertices, unsigned char* isOpen);

}
