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
 * Places, next to the vertices of the active cells, where lines to a light begin. A line through a
 * vertex on the border of the mesh might pass outside of it. A place is therefore moved from its
 * vertex by a small share of the way to the centre of a cell, the largest active one at the vertex,
 * which is the cell that a walk begins in. No isosurface lies between a vertex and its place: where
 * one would, another cell is taken, or the place opposite to the cell.
 */
class VertexStarts
{
public:
  /** Share of the way: light is attenuated too much by this share of a cell's optical depth. */
  static constexpr double Share = 1.0 / 4096.0;

  /** @param surfaces null for a medium. */
  void Build(const TetrahedralMesh& mesh, const RangeLoop& loop = SerialLoop,
    const StartSurfaces* surfaces = nullptr);

  /** The vertices of active cells, in ascending order. */
  const std::vector<std::int32_t>& GetVertices() const { return this->Vertices; }
  /** Cell, at one of these vertices, in which lines begin unless the place is outside of it. */
  std::int32_t GetCell(std::int32_t vertex) const
  {
    return this->Cells[static_cast<std::size_t>(vertex)];
  }
  /** Place of one of these vertices, in normalised model coordinates. */
  const glm::dvec3& GetPlace(std::int32_t vertex) const
  {
    return this->Places[static_cast<std::size_t>(vertex)];
  }
  /** False if the mesh has inverted cells: lines have to be walked from the boundary. */
  bool AreInside() const { return this->Inside; }
  std::int64_t GetBytes() const
  {
    return BytesOf(this->Vertices) + BytesOf(this->Cells) + BytesOf(this->Places);
  }

private:
  void FindCells(const TetrahedralMesh& mesh, const RangeLoop& loop, const StartSurfaces* surfaces);
  void FindPlaces(
    const TetrahedralMesh& mesh, const RangeLoop& loop, const StartSurfaces* surfaces);

  std::vector<std::int32_t> Vertices;
  /** One per vertex; negative without an active cell. */
  std::vector<std::int32_t> Cells;
  std::vector<glm::dvec3> Places;
  bool Inside = true;
};

}
