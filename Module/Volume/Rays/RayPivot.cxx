// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Rays/RayPivot.h"

#include "Volume/Mesh/TetrahedralMesh.h"

#include <glm/matrix.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace meniscus
{
namespace
{

/** Number of intervals between rays along a side of the image. */
constexpr int Steps = 8;

constexpr double Infinity = std::numeric_limits<double>::infinity();

/**
 * Depth, not before `begin`, from which the line place + depth * along is in the box about the
 * origin; infinite if it is not.
 */
double FirstDepth(
  const glm::dvec3& place, const glm::dvec3& along, const glm::dvec3& half, double begin)
{
  double end = Infinity;
  for (int axis = 0; axis < 3; ++axis)
  {
    if (along[axis] != 0.0)
    {
      const double first = (-half[axis] - place[axis]) / along[axis];
      const double second = (half[axis] - place[axis]) / along[axis];
      begin = std::max(begin, std::min(first, second));
      end = std::min(end, std::max(first, second));
    }
    else if (!(std::abs(place[axis]) <= half[axis]))
    {
      return Infinity;
    }
  }
  return begin <= end ? begin : Infinity;
}

}

//------------------------------------------------------------------------------
double FindPivot(const RayFrame& frame, int width, int height, const TetrahedralMesh& mesh)
{
  const double begin = std::clamp(frame.NearDepth, -1.0, 1.0);
  const glm::dvec3 half = mesh.GetHalfSize() / mesh.GetRadius();
  const glm::dmat3 toModel =
    glm::inverse(glm::transpose(glm::dmat3(frame.RowX, frame.RowY, frame.RowDepth)));
  double pivot = Infinity;
  for (int i = 0; i <= Steps; ++i)
  {
    for (int j = 0; j <= Steps; ++j)
    {
      const double column = (static_cast<double>(i) / Steps - 0.5) * width;
      const double row = (static_cast<double>(j) / Steps - 0.5) * height;
      const glm::dvec3 place = toModel * glm::dvec3(frame.Origin.At(column, row), 0.0);
      const glm::dvec3 along = toModel * glm::dvec3(frame.Slope.At(column, row), 1.0);
      pivot = std::min(pivot, FirstDepth(place, along, half, begin));
    }
  }
  return pivot <= 1.0 ? pivot : begin;
}

}
