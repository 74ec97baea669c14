// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Common/RangeLoop.h"

#include <array>
#include <cstdint>
#include <vector>

namespace meniscus
{

class TetrahedralMesh;

/** The way from a cell through one of its faces. */
struct CellPassage
{
  /** TetrahedralMesh::Cell::Links of the face. */
  std::int32_t Link;
  /**
   * The vertex of the neighbour that is opposite the face; the cell's own vertex opposite it where
   * there is no neighbour.
   */
  std::int32_t Opposite;
};

/**
 * Passages through the faces of a cell, in the order of the faces. A ray that leaves by a face
 * knows the next vertex without having read the next cell, which can be on its way from memory
 * while the vertex is placed.
 *
 * The alignment keeps each cell within one line of the cache.
 */
struct alignas(32) CellPassages
{
  std::array<CellPassage, 4> Of;
};

/** Passages of all cells. */
std::vector<CellPassages> FindPassages(
  const TetrahedralMesh& mesh, const RangeLoop& loop = SerialLoop);

/** Takes over the links of a mesh in which other cells are active than before. */
void UpdateLinks(
  const TetrahedralMesh& mesh, std::vector<CellPassages>& passages, const RangeLoop& loop);

}
