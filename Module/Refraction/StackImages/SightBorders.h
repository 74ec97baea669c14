// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Borders of the second and later surfaces of a list, where the number of legs of a sight ray
 * changes. A cell of the sheet cannot tell from the rays at its corners that a border
 * enters and leaves it through the same side, or bends within it.
 */
#pragma once

#include "Refraction/Images/SubCellDivision.h"
#include "Refraction/Stack/StackSolver.h"
#include "Refraction/Surface/CurveCrossings.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace meniscus
{

class SightBorders
{
public:
  /** Collects the borders of the surfaces of `solver`. */
  explicit SightBorders(const StackSolver& solver);

  /** A straight edge of a border. `Leg` is the leg of the rays that arrive at its surface. */
  struct Edge
  {
    std::size_t Leg;
    ObjectLine Line;
    AxisBox Box;
  };
  /** A vertex where a border bends. */
  struct Corner
  {
    std::size_t Leg;
    glm::dvec3 Point;
  };
  struct Borders
  {
    std::vector<Edge> Edges;
    std::vector<Corner> Corners;
  };

  /** The borders that rays through a patch of the first surface may meet. */
  Borders FindNear(const StackBeams& beams, std::int32_t facet) const;

private:
  void AddSurface(const RefractionStack::Link& link, std::size_t leg);

  Borders All;
};

/**
 * Adds the place, from 0 to 1, where a ray between two others meets an edge, if there is one. The
 * ray is interpolated linearly.
 */
void AddCrossing(const SightBorders::Edge& edge, const RefractedPoint& first,
  const RefractedPoint& last, std::vector<double>& places);

/**
 * Distance of a place from the nearest side of a cell of sight rays, as an angle at the eye;
 * negative outside.
 */
double GetDepthInCell(const SubCell& sights, const glm::dvec2& place);

/**
 * Places in the middles of the parts between neighbouring `crossings` that are longer than `least`,
 * those next to 1/2 first. Each has as few binary digits as the middle half of its part allows.
 */
std::vector<double> FindPlacesBetween(std::vector<double>& crossings, double least);

}
