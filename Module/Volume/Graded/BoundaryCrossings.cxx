// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Graded/BoundaryCrossings.h"

#include "Volume/Graded/TriangleCrossing.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace meniscus
{

/** A straight ray about the point of it that is nearest to the mesh's centre. */
struct BoundaryCrossings::Line
{
  Line(const glm::dvec3& origin, const glm::dvec3& direction)
    : Point(origin - glm::dot(origin, direction) * direction)
    , Direction(direction)
    , Begin(glm::dot(origin, direction))
  {
  }

  glm::dvec3 Point;
  glm::dvec3 Direction;
  /** Distance of the ray's origin from that point along the ray. */
  double Begin;
};

namespace
{

constexpr double Infinity = std::numeric_limits<double>::infinity();

/**
 * Growth of the boxes of the tree. They are boxes of vertices rounded to single precision, off by
 * up to 2^-25 of the radius; the crossing is found with less error in double precision.
 */
constexpr double BoxGrowth = 0x1p-23;

/**
 * Largest error of the distance of a crossing. Each of the three triple products of the direction
 * and two corners, which are at most 2 from the line's point, is off by at most DistanceError, and
 * their sum, twice the triangle's area along the line, by three times as much. So each weight is
 * off by at most four times DistanceError over the sum, and the place by that of two weights times
 * an edge. A face whose error exceeds the rounding of the mesh's positions is seen edge-on within
 * it.
 */
double ErrorOf(const std::array<glm::dvec3, 3>& corners, double twiceArea)
{
  double square = 0.0;
  for (std::size_t i = 0; i < 3; ++i)
  {
    const glm::dvec3 edge = corners[(i + 1) % 3] - corners[i];
    square = std::max(square, glm::dot(edge, edge));
  }
  constexpr double most = TetrahedralMesh::PositionUnit;
  const double share = 8.0 * std::sqrt(square) / twiceArea;
  return std::min(BoundaryCrossings::DistanceError * (1.0 + share), most);
}

/** True if the line is in a box somewhere from `begin` to `end`. */
bool MeetsBox(const BoundaryTree::Node& node, const glm::dvec3& point, const glm::dvec3& direction,
  const glm::dvec3& inverse, double begin, double end)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    const double middle = node.Center[axis] - point[axis];
    const double half = node.Half[axis] + BoxGrowth;
    if (direction[axis] == 0.0)
    {
      if (std::abs(middle) > half)
      {
        return false;
      }
      continue;
    }
    const double reach = half * std::abs(inverse[axis]);
    const double at = middle * inverse[axis];
    begin = std::max(begin, at - reach);
    end = std::min(end, at + reach);
  }
  return begin <= end;
}

}

//------------------------------------------------------------------------------
bool BoundaryCrossings::Cross(
  const Line& line, std::int32_t number, BoundaryCrossing& crossing) const
{
  const BoundaryFace& face = this->Tree.GetFaces()[static_cast<std::size_t>(number)];
  std::array<glm::dvec3, 3> corners;
  for (std::size_t i = 0; i < 3; ++i)
  {
    corners[i] = this->Mesh.GetPosition(face.Vertices[i]) - line.Point;
  }
  const auto isBefore = [&face](std::size_t a, std::size_t b)
  { return face.Vertices[a] < face.Vertices[b]; };
  // A face that is seen edge-on is crossed by none; its neighbours are.
  TriangleCrossing found;
  if (!CrossTriangle(corners, isBefore, line.Direction, found))
  {
    return false;
  }
  crossing.Weights = found.Weights;
  crossing.Face = number;
  crossing.Error = ErrorOf(corners, found.TwiceArea);
  crossing.Enters = found.IsFront;
  crossing.Distance = glm::dot(found.Way, line.Direction) - line.Begin;
  return true;
}

//------------------------------------------------------------------------------
BoundaryCrossing BoundaryCrossings::Find(const glm::dvec3& origin, const glm::dvec3& direction,
  bool leavingToo, const std::vector<std::int32_t>& excluded,
  const std::vector<std::int32_t>& passed) const
{
  const auto isAmong = [](const std::vector<std::int32_t>& faces, std::int32_t face)
  { return std::find(faces.begin(), faces.end(), face) != faces.end(); };
  const Line line(origin, direction);
  const glm::dvec3 inverse = 1.0 / direction;
  const auto& nodes = this->Tree.GetNodes();
  const BoundaryCones* cones = leavingToo ? nullptr : this->Cones;
  BoundaryCrossing nearest;
  nearest.Distance = Infinity;
  for (std::size_t n = 0; n < nodes.size();)
  {
    const BoundaryTree::Node& node = nodes[n];
    if (!MeetsBox(node, line.Point, direction, inverse, line.Begin - BoxGrowth,
          line.Begin + nearest.Distance) ||
      (cones && cones->LeavesByAll(n, direction)))
    {
      n = static_cast<std::size_t>(node.Skip);
      continue;
    }
    ++n;
    BoundaryCrossing crossing;
    if (node.Face < 0 || !this->Cross(line, node.Face, crossing) ||
      crossing.Distance < -crossing.Error || !(crossing.Enters || leavingToo))
    {
      continue;
    }
    const bool isNear = crossing.Distance <= crossing.Error;
    if ((isNear && isAmong(excluded, node.Face)) || isAmong(passed, node.Face))
    {
      continue;
    }
    crossing.Distance = std::max(crossing.Distance, 0.0);
    if (crossing.Distance < nearest.Distance)
    {
      nearest = crossing;
    }
  }
  return nearest;
}

//------------------------------------------------------------------------------
BoundaryCrossing BoundaryCrossings::FindAmong(const glm::dvec3& origin, const glm::dvec3& direction,
  const EntryFaces& faces, std::size_t ray) const
{
  const Line line(origin, direction);
  BoundaryCrossing nearest;
  nearest.Distance = Infinity;
  for (std::int32_t i = faces.GetFirst(ray); i >= 0; i = faces.GetNext(i))
  {
    BoundaryCrossing crossing;
    if (!this->Cross(line, faces.GetFace(i), crossing) || !crossing.Enters ||
      crossing.Distance < -crossing.Error)
    {
      continue;
    }
    crossing.Distance = std::max(crossing.Distance, 0.0);
    if (crossing.Distance < nearest.Distance ||
      (crossing.Distance == nearest.Distance && crossing.Face < nearest.Face))
    {
      nearest = crossing;
    }
  }
  return nearest;
}

}
