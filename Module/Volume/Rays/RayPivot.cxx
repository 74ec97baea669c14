// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Rays/RayPivot.h"

#include "Volume/Mesh/TetrahedralMesh.h"
#include "Volume/Rays/FixedPointRays.h"

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

/**
 * Rounding error at the far end of the rays over that at the near end, both as a share of a pixel.
 * Places in front hide those behind: at this ratio, the largest errors of nearly opaque and of
 * translucent pictures of data meshes are alike.
 */
constexpr double FarError = 2.5;

/**
 * Size of a mesh's smallest cell, as a share of the mesh's radius, below which the pivot is at the
 * near end. It is 2^20 grid units of depth: rounding moves rays past larger cells by at most 2^-12
 * of their size, wherever the pivot is (FixedPointRays::RoundingOfRay); smaller cells in front need
 * the precision that a pivot next to them gives.
 */
constexpr double SmallCell = 1048576.0 / FixedPointRays::GridPerDepth;

constexpr double Infinity = std::numeric_limits<double>::infinity();

/** Depths between which rays are in a box; empty if the first is larger. */
struct DepthRange
{
  double First = Infinity;
  double Last = -Infinity;
};

/** Extends a range by the part, not before `begin`, of place + depth * along in the box +-half. */
void AddRay(const glm::dvec3& place, const glm::dvec3& along, const glm::dvec3& half, double begin,
  DepthRange& range)
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
      return;
    }
  }
  if (begin <= end)
  {
    range.First = std::min(range.First, begin);
    range.Last = std::max(range.Last, end);
  }
}

}

//------------------------------------------------------------------------------
double FindPivot(const RayFrame& frame, int width, int height, const TetrahedralMesh& mesh)
{
  // The same for all near planes in front of the mesh.
  const double begin = std::clamp(frame.NearDepth, std::max(-frame.Reach, -1.0), 1.0);
  const glm::dvec3 half = mesh.GetHalfSize() / mesh.GetRadius();
  const glm::dmat3 toModel =
    glm::inverse(glm::transpose(glm::dmat3(frame.RowX, frame.RowY, frame.RowDepth)));
  DepthRange range;
  for (int i = 0; i <= Steps; ++i)
  {
    for (int j = 0; j <= Steps; ++j)
    {
      const double column = (static_cast<double>(i) / Steps - 0.5) * width;
      const double row = (static_cast<double>(j) / Steps - 0.5) * height;
      const glm::dvec3 place = toModel * glm::dvec3(frame.Origin.At(column, row), 0.0);
      const glm::dvec3 along = toModel * glm::dvec3(frame.Slope.At(column, row), 1.0);
      AddRay(place, along, half, begin, range);
    }
  }
  const double last = std::min(range.Last, 1.0);
  if (!(range.First <= last))
  {
    return begin;
  }
  if (mesh.GetSmallestCell() < SmallCell)
  {
    return range.First;
  }
  // The distance of the far end from the pivot, as a share of the pixels' spacing there, is
  // FarError times that of the near end. The spacing changes linearly.
  const double spacing = FixedPointRays::SpacingAt(frame, range.First);
  const double sum = spacing + FarError * FixedPointRays::SpacingAt(frame, last);
  return sum > 0.0 ? range.First + (last - range.First) * (spacing / sum) : range.First;
}

}
