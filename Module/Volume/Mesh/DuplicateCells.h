// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

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
 * Marks the cells that have the same vertices as an earlier cell in the run of their code.
 * @param keys sorted by code. Cells with the same vertices have the same code.
 * @param verticesAt returns the vertices, in ascending order, of the cell of the key at a place in
 *   `keys`; called in the order of the keys, and only where a code occurs repeatedly.
 * @return 1 for each marked key, 0 for the others.
 */
std::vector<std::uint8_t> MarkDuplicateCells(const std::vector<MortonKey>& keys,
  const std::function<std::array<std::int32_t, 4>(std::size_t)>& verticesAt, const RangeLoop& loop);

}
