// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Refraction/Stack/StackTriangulation.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace meniscus
{
namespace
{

/** Point nearest to the lines of legs. Returns false if they are parallel. */
bool MeetLines(const std::vector<const SightLeg*>& legs, glm::dvec3& position)
{
  // Coordinates relative to one leg, so that rounding is that of the scene's size.
  const glm::dvec3& origin = legs.front()->Origin;
  glm::dmat3 matrix(0.0);
  glm::dvec3 right(0.0);
  for (const SightLeg* leg : legs)
  {
    // The projection onto the plane across the ray.
    const glm::dmat3 across = glm::dmat3(1.0) - glm::outerProduct(leg->Direction, leg->Direction);
    matrix += across;
    right += across * (leg->Origin - origin);
  }
  // Two eigenvalues are about the number n of rays, the least one is about n sin^2 of their angles,
  // and so the determinant is n^3 sin^2. Entries have a few roundings each: below 64 epsilon the
  // least eigenvalue is noise.
  const auto count = static_cast<double>(legs.size());
  const double determinant = glm::determinant(matrix);
  constexpr double noise = 64.0 * std::numeric_limits<double>::epsilon();
  if (!(determinant > noise * count * count * count))
  {
    return false;
  }
  position = origin + glm::inverse(matrix) * right;
  return true;
}

/** Sum of the squared distances of a position from legs. */
double GetSquares(const std::vector<const SightLeg*>& legs, const glm::dvec3& position)
{
  double sum = 0.0;
  for (const SightLeg* leg : legs)
  {
    const glm::dvec3 away = position - leg->Origin;
    const double along = std::clamp(glm::dot(away, leg->Direction), 0.0, leg->Length);
    const glm::dvec3 off = away - along * leg->Direction;
    sum += glm::dot(off, off);
  }
  return sum;
}

double GetLargestAngle(const std::vector<const SightLeg*>& legs)
{
  double largest = 0.0;
  for (std::size_t i = 0; i < legs.size(); ++i)
  {
    for (std::size_t j = 0; j < i; ++j)
    {
      const glm::dvec3& a = legs[i]->Direction;
      const glm::dvec3& b = legs[j]->Direction;
      largest = std::max(largest, std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)));
    }
  }
  return largest;
}

/** Number of legs of a ray that show something. */
std::size_t CountSeenLegs(const StackSightRay& ray)
{
  return ray.Legs.size() - (ray.End == PathEnd::Missed && ray.Legs.size() > 1 ? 1 : 0);
}

}

//------------------------------------------------------------------------------
TriangulatedPoint Triangulate(const std::vector<TriangulationRay>& rays)
{
  TriangulatedPoint result;
  if (rays.size() < 2)
  {
    return result;
  }
  std::size_t first = 0;
  std::size_t end = std::numeric_limits<std::size_t>::max();
  for (const TriangulationRay& ray : rays)
  {
    first = std::max(first, ray.Passed);
    end = std::min(end, ray.Passed + CountSeenLegs(ray.Ray));
  }
  result.State = TriangulationState::NoMedium;
  double least = std::numeric_limits<double>::infinity();
  std::vector<const SightLeg*> legs(rays.size());
  for (std::size_t medium = end; medium-- > first;)
  {
    for (std::size_t i = 0; i < rays.size(); ++i)
    {
      legs[i] = &rays[i].Ray.Legs[medium - rays[i].Passed];
    }
    glm::dvec3 position;
    if (!MeetLines(legs, position))
    {
      result.State =
        result.State == TriangulationState::Found ? result.State : TriangulationState::Parallel;
      continue;
    }
    const double squares = GetSquares(legs, position);
    if (squares < least)
    {
      least = squares;
      result = { position, std::sqrt(squares / static_cast<double>(rays.size())),
        GetLargestAngle(legs), TriangulationState::Found };
    }
  }
  return result;
}

}
