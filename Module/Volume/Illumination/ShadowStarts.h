// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Common/RangeLoop.h"
#include "Volume/Mesh/TetrahedralMesh.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <vector>

namespace meniscus
{

/** Isosurfaces that cast shadows. */
struct StartSurfaces
{
  /** One normalised scalar per vertex. */
  const std::vector<float>& Scalars;
  /** Ascending. */
  std::vector<float> Isovalues;
};

/**
 * Places where lines to a light begin: near the middles of the active cells, or next to the
 * vertices of these. A line through a vertex on the border of the mesh might pass outside of it. A
 * place is therefore moved from its vertex by a small share of the way to the centre of a cell, the
 * largest active one at the vertex, which is the cell that a walk begins in. No isosurface lies
 * between a vertex and its place: where one would, another cell is taken, or the place opposite to
 * the cell.
 */
class ShadowStarts
{
public:
  /** Share of the way: light is attenuated too much by this share of a cell's optical depth. */
  static constexpr double Share = 1.0 / 4096.0;

  /** Places next to vertices. @param surfaces null for a medium. */
  void Build(const TetrahedralMesh& mesh, const RangeLoop& loop = SerialLoop,
    const StartSurfaces* surfaces = nullptr);
  /** Middles of cells. */
  void BuildInCells(const TetrahedralMesh& mesh, const RangeLoop& loop = SerialLoop);

  /** Numbers of the starts, in ascending order: of vertices of active cells, or of these cells. */
  const std::vector<std::int32_t>& GetNumbers() const { return this->Numbers; }
  /** Number of the vertices, or of the cells, of the mesh. */
  std::size_t GetSize() const { return this->Cells.size(); }
  /** Cell in which the lines of a start begin unless the place is outside of it. */
  std::int32_t GetCell(std::int32_t number) const
  {
    return this->Cells[static_cast<std::size_t>(number)];
  }
  /** Place of a start, in normalised model coordinates. */
  const glm::dvec3& GetPlace(std::int32_t number) const
  {
    return this->Places[static_cast<std::size_t>(number)];
  }
  /** False if the mesh has inverted cells: lines have to be walked from the boundary. */
  bool AreInside() const { return this->Inside; }
  std::int64_t GetBytes() const
  {
    return BytesOf(this->Numbers) + BytesOf(this->Cells) + BytesOf(this->Places);
  }

private:
  void FindCells(const TetrahedralMesh& mesh, const RangeLoop& loop, const StartSurfaces* surfaces);
  void FindPlaces(
    const TetrahedralMesh& mesh, const RangeLoop& loop, const StartSurfaces* surfaces);

  void CollectNumbers();

  std::vector<std::int32_t> Numbers;
  /** One per vertex or cell; negative without an active cell. */
  std::vector<std::int32_t> Cells;
  std::vector<glm::dvec3> Places;
  bool Inside = true;
};

}
