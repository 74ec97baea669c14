// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <glm/geometric.hpp>
#include <glm/mat2x2.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cmath>

namespace meniscus
{

/**
 * Normal at a vertex from the normals at its neighbours, by least squares. The normals n and m at
 * the ends of a chord e of a quadratic surface have (n + m).e = 0, up to the third power of the
 * chord's length. Two neighbours in different directions therefore determine a normal to second
 * order, at a border as well as inside, while the mean of the facets is of first order at a border.
 */
class NormalFit
{
public:
  /** @param start estimate of the normal, of unit length, about which the fit is linear. */
  explicit NormalFit(const glm::dvec3& start)
    : Start(start)
  {
    const glm::dvec3 axis =
      std::fabs(start.x) < 0.5 ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 1.0, 0.0);
    this->U = glm::normalize(glm::cross(start, axis));
    this->V = glm::cross(start, this->U);
  }

  /**
   * Adds a neighbour.
   * @param chord unit vector to it
   * @param normal unit normal there, on either side
   */
  void Add(const glm::dvec3& chord, const glm::dvec3& normal)
  {
    const glm::dvec2 along(glm::dot(chord, this->U), glm::dot(chord, this->V));
    const double side = glm::dot(normal, this->Start) < 0.0 ? -1.0 : 1.0;
    const double rest = -side * glm::dot(normal, chord) - glm::dot(this->Start, chord);
    this->Matrix +=
      glm::dmat2(along.x * along.x, along.x * along.y, along.x * along.y, along.y * along.y);
    this->Rest += rest * along;
  }

  /**
   * True if the neighbours are in different directions: for two of them, by 30 degrees at least, so
   * that errors of their normals grow by a factor of four at most.
   */
  bool IsDetermined() const
  {
    const double trace = this->GetTrace();
    return glm::determinant(this->Matrix) >= trace * trace / 16.0 && trace > 0.0;
  }

  /** Unit normal; if it is not determined, the start, turned about one axis at most. */
  glm::dvec3 Solve() const
  {
    const double trace = this->GetTrace();
    if (!(trace > 0.0))
    {
      return this->Start;
    }
    const glm::dvec2 move =
      this->IsDetermined() ? glm::inverse(this->Matrix) * this->Rest : this->Rest / trace;
    const glm::dvec3 turned = this->Start + move.x * this->U + move.y * this->V;
    return turned / glm::length(turned);
  }

private:
  double GetTrace() const { return this->Matrix[0][0] + this->Matrix[1][1]; }

  glm::dvec3 Start;
  glm::dvec3 U;
  glm::dvec3 V;
  glm::dmat2 Matrix{ 0.0 };
  glm::dvec2 Rest{ 0.0 };
};

}
