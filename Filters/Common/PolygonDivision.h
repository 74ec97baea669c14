// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkCellArray.h"
#include "vtkContourTriangulator.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPoints.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <unordered_map>
#include <vector>

namespace meniscus
{

/**
 * Area vector of a polygon, times 2. It is that of all triangles of any complete division, also of
 * a polygon whose corners are not in a plane.
 */
inline glm::dvec3 GetTwiceTheArea(const std::vector<glm::dvec3>& corners)
{
  glm::dvec3 area(0.0);
  for (std::size_t i = 1; i + 1 < corners.size(); ++i)
  {
    area += glm::cross(corners[i] - corners[0], corners[i + 1] - corners[0]);
  }
  return area;
}

/** True if triangles with this sum of their area vectors, times 2, cover the polygon. */
inline bool IsCompleteDivision(const std::vector<glm::dvec3>& corners, const glm::dvec3& sum)
{
  // A cross product of edges from exact coordinates has a rounding error of four units of their
  // lengths' product; there are two sums of such products, one term for each corner.
  constexpr double rounding = 8.0 * std::numeric_limits<double>::epsilon();
  double longest = 0.0;
  for (const glm::dvec3& corner : corners)
  {
    longest = std::max(longest, glm::length(corner - corners[0]));
  }
  const double bound = rounding * static_cast<double>(corners.size()) * 4.0 * longest * longest;
  return glm::length(sum - GetTwiceTheArea(corners)) <= bound;
}

/**
 * Moves the corners of a polygon to the plane of its area vector, and scales them to a size of 1
 * about the origin: VTK leaves out parts of polygons that are not plane, and has tolerances that
 * are lengths.
 */
inline void FlattenPolygon(std::vector<glm::dvec3>& corners)
{
  glm::dvec3 low = corners.front();
  glm::dvec3 high = low;
  for (const glm::dvec3& corner : corners)
  {
    low = glm::min(low, corner);
    high = glm::max(high, corner);
  }
  const glm::dvec3 sides = high - low;
  const double size = std::max({ sides.x, sides.y, sides.z });
  for (glm::dvec3& corner : corners)
  {
    corner = (corner - 0.5 * (low + high)) / (size > 0.0 ? size : 1.0);
  }
  const glm::dvec3 area = GetTwiceTheArea(corners);
  const double length = glm::length(area);
  for (glm::dvec3& corner : corners)
  {
    corner -= length > 0.0 ? glm::dot(corner, area / length) * (area / length) : glm::dvec3(0.0);
  }
}

/**
 * Divides a polygon that touches itself, as along the bridge between a border and a hole, or is not
 * plane, which vtkTriangleFilter leaves out in whole or in part. Calls `add(ids)` with the three
 * points of each triangle; returns false if the polygon cannot be divided.
 */
template <typename Add>
bool DividePolygon(vtkPoints* points, vtkIdType count, const vtkIdType* ids, const Add& add)
{
  std::vector<glm::dvec3> corners(static_cast<std::size_t>(count));
  for (std::size_t i = 0; i < corners.size(); ++i)
  {
    points->GetPoint(ids[i], &corners[i].x);
  }
  FlattenPolygon(corners);
  vtkNew<vtkPoints> flat;
  flat->SetDataTypeToDouble();
  vtkNew<vtkIdList> polygon;
  std::vector<vtkIdType> originals;
  std::unordered_map<vtkIdType, vtkIdType> known; // a polygon may touch itself at a point
  for (std::size_t i = 0; i < corners.size(); ++i)
  {
    const auto [place, isNew] = known.emplace(ids[i], flat->GetNumberOfPoints());
    if (isNew)
    {
      flat->InsertNextPoint(&corners[i].x);
      originals.push_back(ids[i]);
    }
    polygon->InsertNextId(place->second);
  }
  vtkNew<vtkCellArray> triangles;
  vtkContourTriangulator::TriangulatePolygon(polygon, flat, triangles);
  for (vtkIdType i = 0; i < triangles->GetNumberOfCells(); ++i)
  {
    vtkIdType three = 0;
    const vtkIdType* flatIds = nullptr;
    triangles->GetCellAtId(i, three, flatIds);
    vtkIdType corner[3];
    std::transform(flatIds, flatIds + 3, corner,
      [&originals](vtkIdType id) { return originals[static_cast<std::size_t>(id)]; });
    add(corner);
  }
  return triangles->GetNumberOfCells() > 0;
}

}
