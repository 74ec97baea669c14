// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <glm/vec2.hpp>

namespace meniscus
{

/** Cross product in the plane: positive if `b` points to the left of `a`. */
inline double Cross(const glm::dvec2& a, const glm::dvec2& b)
{
  return a.x * b.y - a.y * b.x;
}

}
