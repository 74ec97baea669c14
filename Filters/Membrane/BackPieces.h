// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/** Pieces of a surface that were put in upside down. */
#pragma once

#include "Refraction/Surface/RefractingSurface.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <vector>

namespace meniscus
{

/**
 * Number of facets of the open pieces that show no eye the side from which rays pass the surface,
 * and most of whose facets some eye sees directly: rays end there without a refraction. Pieces
 * behind other parts of the surface do not count, such as the far window of a tank. 0 if all pieces
 * are such.
 * @param eyes in world coordinates
 * @param side +1 if rays pass the surface from the side of its normals, otherwise -1
 */
std::size_t CountBackFacets(
  RefractingSurface& surface, const std::vector<glm::dvec3>& eyes, double side);

}
