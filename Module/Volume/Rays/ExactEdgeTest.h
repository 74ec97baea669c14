// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Twin: Rendering/glsl/vtkTetrahedraRays.glsl (sign of an edge)
#pragma once

#include "Volume/Packet/Data/PacketRays.h"

#include <cmath>
#include <cstdint>

namespace meniscus
{

/**
 * Coordinates about a ray and signs of edges for one ray: to the last bit the numbers that packets
 * compute. It is a template so that each instruction set gets its own code (see
 * PacketJob.h).
 *
 * The coordinates u and v of a vertex about a ray are floats by definition (PacketRay). Whoever
 * needs them computes the same floats, so that all decisions about a ray fit one plane drawing,
 * however the numbers were rounded.
 *
 * The sign of an edge is the sign of the determinant p.u q.v - p.v q.u of these floats. It is exact
 * by Kahan's method with fused multiply-adds: its error is at most 2 units in the last place of the
 * result (C.-P. Jeannerod, N. Louvet and J.-M. Muller, "Further analysis of Kahan's algorithm for
 * the accurate computation of 2x2 determinants", 2013), unless a product under- or overflows.
 * Coordinates are below 2^32. Fractions are multiples of 2^-16. Slopes and their rests are 0 or at
 * least 2^-40 (FixedPointRays), so they are multiples of 2^-63, and so are coordinates; products
 * and their rounding errors are multiples of 2^-126, the smallest normal float.
 */
template <class User>
struct ExactEdgeTest
{
  struct Corner
  {
    float U;
    float V;
    /** Grid units from the pivot of the rays. */
    float Depth;
    std::int32_t Vertex;
  };

  /**
   * @param number number of the vertex.
   * @param pivot pivot of the rays in grid units of depth.
   * @param isFine FixedPointRays::AreFine().
   */
  static Corner AboutRay(const PacketVertex& vertex, std::int32_t number, const PacketRay& ray,
    std::int32_t pivot, bool isFine)
  {
    Corner corner;
    const std::int32_t depth = vertex.Place[2] - pivot;
    corner.Depth = static_cast<float>(depth);
    const auto coordinate = [&](int axis)
    {
      const std::int32_t across = vertex.Place[axis] - ray.Offset[axis];
      const auto place = static_cast<float>(across);
      const float rounded = std::fma(-ray.Slope[axis], corner.Depth, place);
      if (!isFine)
      {
        return rounded;
      }
      const auto restOf = [](std::int32_t whole, float asFloat)
      { return static_cast<float>(whole - static_cast<std::int32_t>(asFloat)); };
      const float lacking = std::fma(
        -ray.Slope[axis], restOf(depth, corner.Depth), restOf(across, place) - ray.Fraction[axis]);
      return rounded + std::fma(-ray.SlopeRest[axis], corner.Depth, lacking);
    };
    corner.U = coordinate(0);
    corner.V = coordinate(1);
    corner.Vertex = number;
    return corner;
  }

  /** Twice the signed area that the edge from p to q spans with the ray. */
  static float AreaOf(const Corner& p, const Corner& q)
  {
    const float product = p.V * q.U;
    const float rest = std::fma(-p.V, q.U, product);
    return std::fma(p.U, q.V, -product) + rest;
  }

  /**
   * True if the ray is left of the edge from p to q. A ray through the edge is treated as displaced
   * by (e, e^2), with e arbitrarily small, which changes the area by
   * e (p.v - q.v) + e^2 (q.u - p.u); ends that coincide are ordered by vertex.
   */
  static bool TurnsLeft(const Corner& p, const Corner& q, float area)
  {
    if (area != 0.0f)
    {
      return area > 0.0f;
    }
    if (p.V != q.V)
    {
      return q.V < p.V;
    }
    return p.U != q.U ? q.U > p.U : p.Vertex < q.Vertex;
  }
};

/** A face by which a ray enters, and the depth at which they meet, in grid units from the pivot. */
template <class User>
struct ExactEntry
{
  bool Entered;
  float Depth;

  /**
   * Tests the face with the corners a, b, c. A face without projected area is met at its first
   * vertex.
   */
  template <class Corner>
  static ExactEntry Of(const Corner& a, const Corner& b, const Corner& c)
  {
    using Test = ExactEdgeTest<User>;
    const float areas[3] = { Test::AreaOf(a, b), Test::AreaOf(b, c), Test::AreaOf(c, a) };
    if (!Test::TurnsLeft(a, b, areas[0]) || !Test::TurnsLeft(b, c, areas[1]) ||
      !Test::TurnsLeft(c, a, areas[2]))
    {
      return { false, 0.0f };
    }
    const float total = areas[0] + areas[1] + areas[2];
    const float across = areas[2] * (b.Depth - a.Depth) + areas[0] * (c.Depth - a.Depth);
    return { true, total > 0.0f ? a.Depth + across / total : a.Depth };
  }
};

}
