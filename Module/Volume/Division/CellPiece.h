// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Volume/Division/EdgeIndex.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>

namespace meniscus
{

/** A tetrahedron of a cell. */
struct CellPiece
{
  std::array<std::int32_t, 4> Points{};
  /** Reference coordinates of the points in the cell. */
  std::array<glm::vec3, 4> Places{};
  std::int32_t Cell = 0;
  /**
   * Degree of the shape functions along an axis of the cell; 0 for a piece that is linear, whose
   * edges are divided only if a neighbour's shape asks for it.
   */
  std::uint8_t Degree = 0;
  /** Bits of the edges that have not been tested. */
  std::uint8_t NewEdges = 0;
};

/** Corners at the ends of the edges of a piece. */
constexpr int EdgeEnds[6][2] = { { 0, 1 }, { 0, 2 }, { 0, 3 }, { 1, 2 }, { 1, 3 }, { 2, 3 } };

/** The edge without a common corner. */
constexpr int OppositeEdge(int edge)
{
  return 5 - edge;
}

/** Triangles of a piece. */
constexpr struct
{
  int Corners[3];
  int Edges[3];
} PieceFaces[4] = { { { 1, 2, 3 }, { 3, 4, 5 } }, { { 0, 2, 3 }, { 1, 2, 5 } },
  { { 0, 1, 3 }, { 0, 2, 4 } }, { { 0, 1, 2 }, { 0, 1, 3 } } };

inline EdgePoints EdgeOf(const CellPiece& piece, int edge)
{
  return { piece.Points[static_cast<std::size_t>(EdgeEnds[edge][0])],
    piece.Points[static_cast<std::size_t>(EdgeEnds[edge][1])] };
}

}
