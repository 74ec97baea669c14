// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Refraction/Images/ImageMesh.h"
#include "Refraction/Images/SubCellBend.h"
#include "Refraction/Surface/CurveCrossings.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace meniscus
{

/**
 * Number of linear constraints that limit a primitive. A corner has one bit for each constraint
 * that it lies on; the membrane is the first.
 */
constexpr int PrimitiveConstraints = 4;

/** Known images of a point of the object, borrowed. */
struct KnownImages
{
  const ImagePoint* First = nullptr;
  std::size_t Count = 0;
};

/** Corners of a primitive in world coordinates, their indices in the object and their images. */
struct MappedTriangle
{
  std::array<std::int64_t, 3> Ids;
  std::array<glm::dvec3, 3> Corners;
  std::array<KnownImages, 3> Images{};
};

/**
 * Corner of a clipped polygon. The values are linear in the sub-cell, and none is negative inside
 * the primitive. For a triangle they are the distance behind the membrane and the three barycentric
 * coordinates, all times the cosine of the ray. For a line they are the distance, the distances
 * from either end along the line, and the distance from the line. There may be another one, the
 * distance from the end of the ray's leg, times the cosine.
 */
template <int Constraints>
struct ClippedCorner
{
  glm::dvec2 B;
  double Value[Constraints];
  unsigned Edges;
  unsigned Limits; ///< one bit for each constraint that the corner lies on
};

/** Features that a clipped corner lies on. */
struct ClippedBoundary
{
  int Node = -1; ///< corner of the sub-cell that coincides with it, or -1
  int Edge = -1; ///< edge of the sub-cell that it lies on, unless it is a corner of it; otherwise
                 ///< -1
  bool Membrane = false; ///< the primitive meets the membrane there
  bool LegEnd = false;   ///< the primitive meets the next surface there
  int Side = -1;         ///< side of the primitive that it lies on, by the side's constraint, or -1
  glm::length_t End = -1; ///< corner of the primitive that coincides with it, or -1
};

/** A primitive in local coordinates; point = corner[0] + l0 axis[0] + l1 axis[1]. */
struct ObjectPrimitive
{
  /**
   * Side from corner k to k + 1, by its constraint k. Its ends are in the same order for all
   * primitives.
   */
  struct Side
  {
    ObjectLine Line;
    bool Turned = false;
  };

  const MappedTriangle& Primitive;
  std::int64_t SourceCell;
  bool IsLine;
  std::array<glm::dvec3, 3> Corners;
  glm::dvec3 Axis[2];
  glm::dvec3 Normal;
  std::array<Side, PrimitiveConstraints> Sides;
  /** A box around the primitive: its middle and half its sides. */
  glm::dvec3 Middle;
  glm::dvec3 Padding;

  /** A triangle in coordinates relative to `origin`. */
  static ObjectPrimitive MakeTriangle(
    const MappedTriangle& triangle, std::int64_t sourceCell, const glm::dvec3& origin)
  {
    ObjectPrimitive primitive{ triangle, sourceCell, false, {}, {}, {}, {}, {}, {} };
    glm::dvec3 low(std::numeric_limits<double>::max());
    glm::dvec3 high(std::numeric_limits<double>::lowest());
    for (std::size_t i = 0; i < 3; ++i)
    {
      primitive.Corners[i] = triangle.Corners[i] - origin;
      low = glm::min(low, primitive.Corners[i]);
      high = glm::max(high, primitive.Corners[i]);
    }
    primitive.Axis[0] = primitive.Corners[1] - primitive.Corners[0];
    primitive.Axis[1] = primitive.Corners[2] - primitive.Corners[0];
    primitive.SetPlane(0.5 * (low + high), 0.5 * (high - low));
    return primitive;
  }

  /**
   * A line between the first two corners, in the plane that holds it and is perpendicular to the
   * view from `eye`, which is relative to `origin` too.
   */
  static ObjectPrimitive MakeLine(const MappedTriangle& line, std::int64_t sourceCell,
    const glm::dvec3& origin, const glm::dvec3& eye)
  {
    ObjectPrimitive primitive{ line, sourceCell, true, {}, {}, {}, {}, {}, {} };
    primitive.Corners = { line.Corners[0] - origin, line.Corners[1] - origin,
      line.Corners[0] - origin };
    primitive.Axis[0] = primitive.Corners[1] - primitive.Corners[0];
    const glm::dvec3 middle = 0.5 * (primitive.Corners[0] + primitive.Corners[1]);
    primitive.Axis[1] = glm::cross(primitive.Axis[0], middle - eye);
    primitive.SetPlane(middle, 0.5 * glm::abs(primitive.Axis[0]));
    return primitive;
  }

  /** Sets the members that follow from corners, axes and the box of the primitive. */
  void SetPlane(const glm::dvec3& middle, const glm::dvec3& half)
  {
    this->Normal = glm::cross(this->Axis[0], this->Axis[1]);
    this->SetSides();
    this->Middle = middle;
    this->Padding = half;
  }

  void SetSides()
  {
    for (std::size_t k = this->IsLine ? PrimitiveConstraints - 1 : 1; k < PrimitiveConstraints; ++k)
    {
      this->Sides[k].Line =
        ObjectLine::Order(this->Corners[k % 3], this->Corners[(k + 1) % 3], this->Sides[k].Turned);
    }
  }

  double GetSide(std::size_t k, const RefractedPoint& from) const
  {
    const double moment = GetMoment(this->Sides[k].Line, from);
    return this->Sides[k].Turned ? -moment : moment;
  }

  // A barycentric coordinate times the cosine is the ray's moment about the opposite side. The
  // plane does not appear in it, so primitives that share the side get the same number.
  void Measure(const RefractedPoint& from, double* value) const
  {
    const glm::dvec3 away = from.At.Position - this->Corners[0];
    value[0] = -glm::dot(this->Normal, away);
    value[3] = this->GetSide(3, from);
    if (this->IsLine)
    {
      value[1] = -glm::dot(this->Axis[1], glm::cross(away, from.Ray));
      value[2] = glm::dot(this->Normal, from.Ray) - value[1];
      return;
    }
    value[1] = this->GetSide(1, from);
    value[2] = this->GetSide(2, from);
  }

  // True if the sub-cell is outside by more than its own extent, so that curvature cannot bring it
  // back.
  bool IsOutside(const SubCell& nodes) const
  {
    return this->IsOutside(nodes, 0.0, [](int, double extent) { return extent; });
  }

  // True if all corners of the sub-cell are outside by more than `getReach(k, extent)`, by which
  // curvature may bring it back across constraint k; `extent` is the difference between its
  // corners. Parts of the primitive up to `inFront` in front of the surface are not outside.
  template <typename GetReach>
  bool IsOutside(const SubCell& nodes, double inFront, const GetReach& getReach) const
  {
    double value[3][PrimitiveConstraints];
    for (std::size_t i = 0; i < 3; ++i)
    {
      this->Measure(nodes[i].From, value[i]);
    }
    const double cosine[3] = { glm::dot(this->Normal, nodes[0].From.Ray),
      glm::dot(this->Normal, nodes[1].From.Ray), glm::dot(this->Normal, nodes[2].From.Ray) };
    const bool front = cosine[0] > 0.0 && cosine[1] > 0.0 && cosine[2] > 0.0;
    const bool back = cosine[0] < 0.0 && cosine[1] < 0.0 && cosine[2] < 0.0;
    const double margin = inFront > 0.0
      ? inFront * std::max({ std::fabs(cosine[0]), std::fabs(cosine[1]), std::fabs(cosine[2]) })
      : 0.0;
    for (int k = 0; k < PrimitiveConstraints; ++k)
    {
      const bool beside = this->IsLine && k == 3;
      const double most = std::max({ value[0][k], value[1][k], value[2][k] });
      const double least = std::min({ value[0][k], value[1][k], value[2][k] });
      const bool isBelow = (front || beside) && most < 0.0;
      const bool isAbove = (back || beside) && least > 0.0;
      if (isBelow || isAbove)
      {
        const double reach = getReach(k, most - least) + (k == 0 ? margin : 0.0);
        if ((isBelow && most < -reach) || (isAbove && least > reach))
        {
          return true;
        }
      }
    }
    return false;
  }

  // Deviation of a value from linear interpolation in a sub-cell, for a constraint other than the
  // membrane.
  double GetDeviation(int k, const SubCell& nodes, const SubCellBend& bend) const
  {
    const glm::dvec3& place = nodes[0].From.At.Position;
    if (this->IsLine && k != 3)
    {
      const double distance = glm::length(place - this->Corners[0]) + bend.Size;
      const double moment = glm::length(this->Axis[1]) * bend.GetMoment(distance);
      return k == 1 ? moment : moment + glm::length(this->Normal) * bend.Direction;
    }
    const ObjectLine& line = this->Sides[static_cast<std::size_t>(k)].Line;
    return glm::length(line.Direction) *
      bend.GetMoment(glm::length(place - line.Origin) + bend.Size);
  }

  glm::dvec3 GetPoint(const glm::dvec3& weight) const
  {
    return weight.x * this->Corners[0] + weight.y * this->Corners[1] + weight.z * this->Corners[2];
  }

  /** Weights of a point's sources, in the order of the corners. */
  glm::dvec3 GetWeight(const ImagePoint& point) const
  {
    glm::dvec3 weight(0.0);
    for (std::size_t k = 0; k < point.GetNumberOfSources(); ++k)
    {
      const auto& ids = this->Primitive.Ids;
      weight[static_cast<glm::length_t>(
        std::find(ids.begin(), ids.end() - 1, point.Source[k]) - ids.begin())] += point.Weight[k];
    }
    return weight;
  }

  /** Weights of a point in the primitive's plane. */
  glm::dvec3 GetWeight(const glm::dvec3& point) const
  {
    const glm::dvec3 away = point - this->Corners[0];
    const double squared = glm::dot(this->Normal, this->Normal);
    const double first = glm::dot(glm::cross(away, this->Axis[1]), this->Normal) / squared;
    const double second =
      this->IsLine ? 0.0 : glm::dot(glm::cross(this->Axis[0], away), this->Normal) / squared;
    return { 1.0 - first - second, first, second };
  }

  template <int Constraints>
  ClippedBoundary FindBoundary(const ClippedCorner<Constraints>& clipped) const
  {
    ClippedBoundary on;
    on.Membrane = (clipped.Limits & 1u) != 0;
    on.LegEnd = (clipped.Limits >> PrimitiveConstraints & 1u) != 0;
    for (int k = 0; k < 3; ++k)
    {
      on.Edge = clipped.Edges == 1u << k ? k : on.Edge;
      on.Node = clipped.Edges == (7u & ~(1u << k)) ? k : on.Node;
    }
    if (this->IsLine)
    {
      on.Side = (clipped.Limits >> 3 & 1u) != 0 ? 3 : -1;
      on.End = (clipped.Limits & 2u) != 0 ? 0 : ((clipped.Limits & 4u) != 0 ? 1 : -1);
      return on;
    }
    // Constraint k is barycentric coordinate k - 1; it vanishes on the side from corner k to k + 1.
    // Where two of them vanish, the remaining one is the corner of the primitive.
    int left = 3;
    int count = 0;
    for (int k = 1; k < PrimitiveConstraints; ++k)
    {
      if (clipped.Limits >> k & 1u)
      {
        on.Side = k;
        left -= k - 1;
        ++count;
      }
    }
    on.End = count == 2 ? left : -1;
    return on;
  }

  /** Place between two corners where the constraint `k` vanishes. */
  template <typename Corner>
  static Corner Cross(const Corner& a, const Corner& b, int k);

  /**
   * Part of a sub-cell, whose corners are `whole`, that shows the primitive. Clipping by Sutherland
   * and Hodgman in homogeneous coordinates: rays that point away from the plane count as the other
   * side of it, where `sign` is -1 and all values are negative inside.
   */
  template <typename Corner>
  void Clip(const std::vector<Corner>& whole, double sign, std::vector<Corner>& polygon) const;
};

//------------------------------------------------------------------------------
template <typename Corner>
Corner ObjectPrimitive::Cross(const Corner& a, const Corner& b, int k)
{
  constexpr int count = sizeof(Corner::Value) / sizeof(double);
  Corner corner;
  const double part = a.Value[k] / (a.Value[k] - b.Value[k]);
  corner.B = a.B + part * (b.B - a.B);
  for (int m = 0; m < count; ++m)
  {
    corner.Value[m] = a.Value[m] + part * (b.Value[m] - a.Value[m]);
  }
  corner.Value[k] = 0.0;
  corner.Edges = a.Edges & b.Edges;
  corner.Limits = (a.Limits & b.Limits) | 1u << k;
  return corner;
}

//------------------------------------------------------------------------------
template <typename Corner>
void ObjectPrimitive::Clip(
  const std::vector<Corner>& whole, double sign, std::vector<Corner>& polygon) const
{
  constexpr int count = sizeof(Corner::Value) / sizeof(double);
  polygon = whole;
  std::vector<Corner> next;
  for (int turn = 0; turn < count && !polygon.empty(); ++turn)
  {
    // The distance from a line comes last: it leaves the two ends of a segment.
    const int k = this->IsLine && turn >= 3 ? (turn + 1 < count ? turn + 1 : 3) : turn;
    const bool beside = this->IsLine && k == 3;
    next.clear();
    for (std::size_t i = 0; i < polygon.size(); ++i)
    {
      const Corner& a = polygon[i];
      const Corner& b = polygon[(i + 1) % polygon.size()];
      const bool inA = sign * a.Value[k] >= 0.0;
      const bool inB = sign * b.Value[k] >= 0.0;
      if (inA && !beside)
      {
        next.push_back(a);
      }
      if (inA != inB)
      {
        // The intersection is computed from the inside to the outside, whatever the winding of
        // the polygon.
        next.push_back(inA ? Cross(a, b, k) : Cross(b, a, k));
      }
    }
    polygon.swap(next);
  }
}

}
