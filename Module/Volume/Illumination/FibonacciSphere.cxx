// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Illumination/FibonacciSphere.h"

#include <glm/geometric.hpp>

#include <cmath>

namespace meniscus
{
namespace
{

/** pi (3 - sqrt(5)). */
constexpr double GoldenAngle = 2.399963229728653;

/** A rotation about (1, 2, 3) by one radian, by Rodrigues' formula. */
glm::dvec3 Rotated(const glm::dvec3& v)
{
  const glm::dvec3 axis = glm::normalize(glm::dvec3(1.0, 2.0, 3.0));
  return v * std::cos(1.0) + glm::cross(axis, v) * std::sin(1.0) +
    axis * glm::dot(axis, v) * (1.0 - std::cos(1.0));
}

}

//------------------------------------------------------------------------------
glm::dvec3 FibonacciDirection(int index, int count)
{
  const double height = 1.0 - (2.0 * index + 1.0) / count;
  const double radius = std::sqrt(1.0 - height * height);
  const double angle = GoldenAngle * index;
  return Rotated(glm::dvec3(radius * std::cos(angle), radius * std::sin(angle), height));
}

}
