// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Refraction/Stack/StackTriangulation.h"

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
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

/** The leg of a ray that shows the medium on a side of an interface; null if there is none. */
const SightLeg* FindLeg(const StackSightRay& ray, std::size_t side)
{
  const auto end = ray.Legs.begin() + static_cast<std::ptrdiff_t>(CountSeenLegs(ray));
  const auto leg = std::find_if(ray.Legs.begin(), end,
    [side](const SightLeg& each) { return each.Sides[0] == side || each.Sides[1] == side; });
  return leg == end ? nullptr : &*leg;
}

/** Legs of all rays on a side of an interface. Returns false if a ray has none. */
bool FindLegs(
  const std::vector<StackSightRay>& rays, std::size_t side, std::vector<const SightLeg*>& legs)
{
  legs.clear();
  for (const StackSightRay& ray : rays)
  {
    legs.push_back(FindLeg(ray, side));
    if (!legs.back())
    {
      return false;
    }
  }
  return true;
}

}

//------------------------------------------------------------------------------
TriangulatedPoint Triangulate(const std::vector<StackSightRay>& rays)
{
  TriangulatedPoint result;
  if (rays.size() < 2)
  {
    return result;
  }
  result.State = TriangulationState::NoMedium;
  double least = std::numeric_limits<double>::infinity();
  std::vector<const SightLeg*> legs;
  std::vector<const SightLeg*> known;
  const auto use = [&](std::size_t side)
  {
    // The sides at both ends of a leg usually have the same legs.
    if (!FindLegs(rays, side, legs) || legs == known)
    {
      return;
    }
    known = legs;
    glm::dvec3 position;
    if (!MeetLines(legs, position))
    {
      result.State =
        result.State == TriangulationState::Found ? result.State : TriangulationState::Parallel;
      return;
    }
    const double squares = GetSquares(legs, position);
    if (squares < least)
    {
      least = squares;
      result = { position, std::sqrt(squares / static_cast<double>(rays.size())),
        GetLargestAngle(legs), TriangulationState::Found };
    }
  };
  for (std::size_t i = CountSeenLegs(rays.front()); i-- > 0;)
  {
    const SightLeg& leg = rays.front().Legs[i];
    use(leg.Sides[1]);
    use(leg.Sides[0]);
  }
  return result;
}

}
