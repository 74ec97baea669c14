// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Volume_Mesh_DuplicateCells_h
#define meniscus_Volume_Mesh_DuplicateCells_h

#include "Common/MortonOrder.h"
#include "Common/RangeLoop.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace meniscus
{

/** Returns, for each of `count` vertices, the lowest vertex at the same position, bit for bit. */
std::vector<std::int32_t> FindLowestCoincident(std::size_t count,
  const std::function<glm::dvec3(std::size_t)>& getPosition, const RangeLoop& loop);

/**
 * Removes the keys of cells that have the same vertices as an earlier cell in the run of their
 * code, and returns the number of removed keys.
 * @param keys sorted by code. Cells with the same vertices have the same code.
 * @param verticesOf returns the vertices of a key's cell in ascending order; called only where a
 *   code occurs repeatedly.
 */
std::size_t RemoveDuplicateCells(std::vector<MortonKey>& keys,
  const std::function<std::array<std::int32_t, 4>(std::size_t)>& verticesOf, const RangeLoop& loop);

}

#endif
