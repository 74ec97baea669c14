// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Light that falls on geometry through several surfaces: the eye of a stack is the light. World
 * coordinates.
 *
 * The patches of the first surface are divided into triangles whose three rays are traced through
 * all interfaces. Such a beam is interpolated linearly between its rays, and it is divided further
 * while the rays in the middle of its sides are farther from the interpolated ones than a
 * tolerance. The rays cut the plane of a triangle of the geometry in three points; barycentric
 * coordinates in these are places in the beam. The part of the beam that falls on the triangle is
 * the image of the triangle in these coordinates, clipped by the beam and by the ends of the leg.
 * Triangles of one plane therefore divide the light of a beam without gaps and overlaps, behind a
 * focus as well.
 */
#pragma once

#include "Refraction/Stack/RefractionStack.h"
#include "Refraction/Tubes/BoxTree.h"

#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace meniscus
{

/** Triangles that are lit, and the cells that they belong to. */
struct LitTriangles
{
  std::vector<glm::dvec3> Points;
  std::vector<std::array<std::int64_t, 3>> Triangles;
  std::vector<std::int64_t> Cells; ///< of each triangle
};

/** Light that a cell receives; sums over its beams. */
struct CellLight
{
  /** Area of the first surface that it passes, across the incident rays, times the transmittance.
   */
  double Flux = 0.0;
  /**
   * Unit vectors to the light, times the beam's flux, over the cosine of their angle with the
   * cell's normal: the area of the cell times the light that passes an area across the beam.
   */
  glm::dvec3 Vector{ 0.0 };
  /** Lengths of the path behind the first surface, times the flux. */
  double Path = 0.0;

  /**
   * Adds a beam. `cosine` of its angle with the cell's normal, of either sign. Beams that
   * graze the cell count in Vector as if they had the least cosine: their share of the light is
   * then below half a step of a colour of 8 bits.
   */
  void Add(double flux, const glm::dvec3& toLight, double cosine, double path)
  {
    constexpr double least = 0.5 / 255.0;
    this->Flux += flux;
    this->Vector += flux / std::max(std::fabs(cosine), least) * toLight;
    this->Path += flux * path;
  }
};

class StackLight
{
public:
  /** Stack and triangles must outlive this object. The stack has at least one link. */
  StackLight(const RefractionStack& stack, const LitTriangles& lit);

  /** Lights triangles only from the side from which their points are counter-clockwise. */
  void SetOneSided(bool oneSided) { this->OneSided = oneSided; }

  /** Light on each of `cells` cells. The result does not depend on the number of threads. */
  std::vector<CellLight> Gather(std::size_t cells, const RangeLoop& loop) const;

private:
  /** A ray behind one interface, up to the next one. */
  struct Leg
  {
    glm::dvec3 Origin;
    glm::dvec3 Direction;
    double Length;        ///< up to the farthest lit point behind the last interface
    double Transmittance; ///< of the interfaces before the leg
    double Before;        ///< length of the path between the first interface and the leg
  };
  struct Corner
  {
    glm::dvec2 B;
    std::vector<Leg> Legs; ///< those that go on to the next interface, or are the last
  };
  using Corners = std::array<Corner, 3>;
  using BeamRays = std::array<const Leg*, 3>;
  /** A corner of a triangle's image in a beam. */
  struct ImagePoint
  {
    glm::dvec2 B;   ///< place in the beam
    double Behind;  ///< distance along the ray behind the leg's origin
    double InFront; ///< distance along the ray to the leg's end
  };
  struct Share
  {
    std::int64_t Cell;
    double Light;
    glm::dvec3 ToLight;
    double Cosine;
    double Path;
  };

  Corner Trace(std::int32_t facet, const glm::dvec2& b, StackPath& path) const;
  double GetReach(const glm::dvec3& origin, const glm::dvec3& direction) const;
  bool IsLinear(const Corner& a, const Corner& b, const Corner& middle) const;
  void Divide(std::int32_t facet, const Corners& corners, int depth, StackPath& path,
    std::vector<Share>& shares) const;
  static ImagePoint Locate(const BeamRays& rays, const glm::dvec3& point, const glm::dvec3& normal);
  /** Area of a triangle of the first surface, seen from the light. */
  double GetFacing(const Corners& corners) const;
  void Deposit(const Corners& corners, std::size_t leg, std::vector<Share>& shares) const;

  const RefractionStack& Stack;
  const LitTriangles& Lit;
  bool OneSided = false;
  double Tolerance = 0.0;
  AxisBox Bounds; ///< of the lit triangles, relative to the stack's origin
  BoxTree Tree;
};

}
