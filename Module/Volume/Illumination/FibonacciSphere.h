// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <glm/vec3.hpp>

namespace meniscus
{

/**
 * Direction number `index` of `count` that cover the sphere evenly: a spiral of equal steps in
 * height whose turns are the golden angle, rotated so that no direction is along an axis.
 */
glm::dvec3 FibonacciDirection(int index, int count);

}
