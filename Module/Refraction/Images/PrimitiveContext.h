// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/** Private structures of PrimitiveMapper. */
#ifndef meniscus_Refraction_Images_PrimitiveContext_h
#define meniscus_Refraction_Images_PrimitiveContext_h

#include "Refraction/Curved/CurveCrossings.h"
#include "Refraction/Images/PrimitiveMapper.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

namespace meniscus
{

/**
 * Number of linear constraints that limit a primitive. A corner has one bit for each constraint
 * that it lies on; the membrane is the first.
 */
constexpr int PrimitiveConstraints = 4;

/**
 * Corner of a clipped polygon. The values are linear in the sub-cell, and none is negative inside
 * the primitive. For a triangle they are the distance behind the membrane and the three barycentric
 * coordinates, all times the cosine of the ray. For a line they are the distance, the distances
 * from either end along the line, and the distance from the line.
 */
struct PrimitiveMapper::Corner
{
  glm::dvec2 B;
  double Value[PrimitiveConstraints];
  unsigned Edges;
  unsigned Constraints;
};

/** Features that a clipped corner lies on. */
struct PrimitiveMapper::Boundary
{
  int Node = -1; ///< corner of the sub-cell that coincides with it, or -1
  int Edge = -1; ///< edge of the sub-cell that it lies on, unless it is a corner of it; otherwise
                 ///< -1
  bool Membrane = false; ///< the primitive meets the membrane there
  int Side = -1;         ///< side of the primitive that it lies on, by the side's constraint, or -1
  glm::length_t End = -1; ///< corner of the primitive that coincides with it, or -1
};

/** The primitive in local coordinates; point = corner[0] + l0 axis[0] + l1 axis[1]. */
struct PrimitiveMapper::Context
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
  ImageMesh* Images;
  bool IsLine;
  std::array<glm::dvec3, 3> Corners;
  glm::dvec3 Axis[2];
  glm::dvec3 Normal;
  std::array<Side, PrimitiveConstraints> Sides;
  const CurvedPatch* Patch = nullptr;
  std::int32_t Facet = CurvedPatches::NoFacet;
  std::vector<char>* IsOnMembrane = nullptr; ///< marks points of `Images` on the membrane; null if
                                             ///< not needed

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
    double value[3][PrimitiveConstraints];
    for (std::size_t i = 0; i < 3; ++i)
    {
      this->Measure(nodes[i].From, value[i]);
    }
    const double cosine[3] = { glm::dot(this->Normal, nodes[0].From.Ray),
      glm::dot(this->Normal, nodes[1].From.Ray), glm::dot(this->Normal, nodes[2].From.Ray) };
    const bool front = cosine[0] > 0.0 && cosine[1] > 0.0 && cosine[2] > 0.0;
    const bool back = cosine[0] < 0.0 && cosine[1] < 0.0 && cosine[2] < 0.0;
    for (int k = 0; k < PrimitiveConstraints; ++k)
    {
      const bool beside = this->IsLine && k == 3;
      const double most = std::max({ value[0][k], value[1][k], value[2][k] });
      const double least = std::min({ value[0][k], value[1][k], value[2][k] });
      const double spread = most - least;
      if (((front || beside) && most < -spread) || ((back || beside) && least > spread))
      {
        return true;
      }
    }
    return false;
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

  /** Component along the plane's normal of the ray to a mapped point; only its sign matters. */
  double GetSlope(const ImagePoint& point, const glm::dvec3& origin) const
  {
    return glm::dot(
      this->Normal, this->GetPoint(this->GetWeight(point)) - (point.Vertex.SightPoint - origin));
  }

  Boundary FindBoundary(const Corner& clipped) const
  {
    Boundary on;
    on.Membrane = (clipped.Constraints & 1u) != 0;
    for (int k = 0; k < 3; ++k)
    {
      on.Edge = clipped.Edges == 1u << k ? k : on.Edge;
      on.Node = clipped.Edges == (7u & ~(1u << k)) ? k : on.Node;
    }
    if (this->IsLine)
    {
      on.Side = (clipped.Constraints >> 3 & 1u) != 0 ? 3 : -1;
      on.End = (clipped.Constraints & 2u) != 0 ? 0 : ((clipped.Constraints & 4u) != 0 ? 1 : -1);
      return on;
    }
    // Constraint k is barycentric coordinate k - 1; it vanishes on the side from corner k to k + 1.
    // Where two of them vanish, the remaining one is the corner of the primitive.
    int left = 3;
    int count = 0;
    for (int k = 1; k < PrimitiveConstraints; ++k)
    {
      if (clipped.Constraints >> k & 1u)
      {
        on.Side = k;
        left -= k - 1;
        ++count;
      }
    }
    on.End = count == 2 ? left : -1;
    return on;
  }
};

}

#endif
