// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Twin: Rendering/glsl/vtkTetrahedraRays.glsl (sign of an edge)
#ifndef meniscus_Volume_Rays_ExactEdgeTest_h
#define meniscus_Volume_Rays_ExactEdgeTest_h

#include <cstdint>

namespace meniscus
{

/**
 * Integer arithmetic about a ray, shared by all code that has to decide alike. It is a template so
 * that each instruction set gets its own code (see Packet.h).
 */
template <class User>
struct ExactEdgeTest
{
  /**
   * A cross product in float has the right sign for certain if its magnitude exceeds this fraction
   * of its second product (PacketWalk::EdgeArea()).
   */
  static constexpr float RoundingOfArea = 9.5367431640625e-7f; // 2^-20

  /** u or v of a vertex: its x or y minus that of the ray at the vertex's depth (PacketRay). */
  static std::int32_t AboutRay(
    std::int32_t place, std::int32_t depth, std::int32_t slope, std::int64_t offset)
  {
    return place - static_cast<std::int32_t>((std::int64_t{ depth } * slope + offset) >> 32);
  }

  /**
   * True if the ray is left of the edge from p to q, each { u, v, vertex }. A ray through the edge
   * is treated as displaced by (e, e^2), with e arbitrarily small; ends that coincide are ordered
   * by vertex.
   * @param area twice the signed area that the edge spans with the ray.
   */
  static bool TurnsLeft(const std::int32_t (&p)[3], const std::int32_t (&q)[3], std::int64_t& area)
  {
    area = std::int64_t{ p[0] } * q[1] - std::int64_t{ p[1] } * q[0];
    if (area != 0)
    {
      return area > 0;
    }
    if (p[1] != q[1])
    {
      return q[1] < p[1];
    }
    return p[0] != q[0] ? q[0] > p[0] : p[2] < q[2];
  }
};

}

#endif
