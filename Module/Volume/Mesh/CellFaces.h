// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>

namespace meniscus
{

/** The three vertices of a cell other than number `face`, in the same order. */
inline std::array<std::int32_t, 3> FaceVertices(const std::array<std::int32_t, 4>& cell, int face)
{
  return { cell[face == 0 ? 1 : 0], cell[face <= 1 ? 2 : 1], cell[face == 3 ? 2 : 3] };
}

/**
 * Orientation of the face opposite vertex `face`, with ascending vertices, relative to the cell's
 * orientation: if the cell's vertices are positively oriented, the face's normal points outwards
 * for faces 0 and 2.
 */
inline int FaceParity(int face)
{
  return face % 2 == 0 ? 1 : -1;
}

}
