// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Illumination/ShadowStarts.h"

#include "Common/BlockLoop.h"
#include "Volume/Mesh/InvertedCells.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace meniscus
{

namespace
{

/** Six times the volume of an active cell; -1 for others. */
float VolumeOf(const TetrahedralMesh& mesh, std::size_t cell)
{
  if (!mesh.IsActiveCell(static_cast<std::int64_t>(cell)))
  {
    return -1.0f;
  }
  const auto& ids = mesh.GetCells()[cell].Vertices;
  const glm::dvec3 corner = mesh.GetPosition(ids[0]);
  const glm::dvec3 edges[3] = { mesh.GetPosition(ids[1]) - corner,
    mesh.GetPosition(ids[2]) - corner, mesh.GetPosition(ids[3]) - corner };
  return static_cast<float>(std::abs(glm::dot(edges[0], glm::cross(edges[1], edges[2]))));
}

glm::dvec3 CenterOf(const TetrahedralMesh& mesh, std::size_t cell)
{
  glm::dvec3 center(0.0);
  for (const std::int32_t corner : mesh.GetCells()[cell].Vertices)
  {
    center += 0.25 * mesh.GetPosition(corner);
  }
  return center;
}

/**
 * A place near the middle of a cell. Lines from the very middles of the cells of a regular mesh
 * pass through other cells along their edges in many directions.
 */
glm::dvec3 PlaceIn(const TetrahedralMesh& mesh, std::size_t cell)
{
  constexpr double weights[4] = { 0.2613, 0.2487, 0.2521, 0.2379 };
  glm::dvec3 place(0.0);
  for (std::size_t i = 0; i < 4; ++i)
  {
    place += weights[i] * mesh.GetPosition(mesh.GetCells()[cell].Vertices[i]);
  }
  return place;
}

/** True if no surface lies between a vertex and the place next to it in a cell. */
bool KeepsSide(
  const StartSurfaces& surfaces, const TetrahedralMesh::Cell& cell, std::int32_t vertex)
{
  const auto scalarOf = [&](std::int32_t v)
  { return double{ surfaces.Scalars[static_cast<std::size_t>(v)] }; };
  double mean = 0.0;
  for (const std::int32_t corner : cell.Vertices)
  {
    mean += 0.25 * scalarOf(corner);
  }
  // A scalar equal to an isovalue counts as above it.
  const auto below = [&](double scalar)
  { return std::upper_bound(surfaces.Isovalues.begin(), surfaces.Isovalues.end(), scalar); };
  const double scalar = scalarOf(vertex);
  return below(scalar) == below(scalar + ShadowStarts::Share * (mean - scalar));
}

}

//------------------------------------------------------------------------------
void ShadowStarts::Build(
  const TetrahedralMesh& mesh, const RangeLoop& loop, const StartSurfaces* surfaces)
{
  this->Inside = !HasInvertedCells(mesh, loop);
  this->FindCells(mesh, loop, surfaces);
  this->CollectNumbers();
  this->FindPlaces(mesh, loop, surfaces);
}

//------------------------------------------------------------------------------
void ShadowStarts::BuildInCells(const TetrahedralMesh& mesh, const RangeLoop& loop)
{
  this->Inside = !HasInvertedCells(mesh, loop);
  const auto cells = static_cast<std::size_t>(mesh.GetNumberOfCells());
  this->Cells.resize(cells);
  this->Places.resize(cells);
  ForEachInBlocks(cells, loop,
    [&](std::size_t c)
    {
      const bool isActive = mesh.IsActiveCell(static_cast<std::int64_t>(c));
      this->Cells[c] = isActive ? static_cast<std::int32_t>(c) : -1;
      this->Places[c] = PlaceIn(mesh, c);
    });
  this->CollectNumbers();
}

//------------------------------------------------------------------------------
void ShadowStarts::CollectNumbers()
{
  this->Numbers.clear();
  for (std::size_t i = 0; i < this->Cells.size(); ++i)
  {
    if (this->Cells[i] >= 0)
    {
      this->Numbers.push_back(static_cast<std::int32_t>(i));
    }
  }
}

//------------------------------------------------------------------------------
void ShadowStarts::FindCells(
  const TetrahedralMesh& mesh, const RangeLoop& loop, const StartSurfaces* surfaces)
{
  const auto cells = static_cast<std::size_t>(mesh.GetNumberOfCells());
  std::vector<float> volumes(cells);
  ForEachInBlocks(cells, loop, [&](std::size_t c) { volumes[c] = VolumeOf(mesh, c); });
  const auto vertices = static_cast<std::size_t>(mesh.GetNumberOfVertices());
  this->Cells.assign(vertices, -1);
  std::vector<char> keeps(surfaces ? vertices : 0, 0);
  for (std::size_t c = 0; c < cells; ++c)
  {
    for (const std::int32_t vertex : mesh.GetCells()[c].Vertices)
    {
      const auto v = static_cast<std::size_t>(vertex);
      std::int32_t& best = this->Cells[v];
      const char side =
        surfaces && volumes[c] >= 0.0f && KeepsSide(*surfaces, mesh.GetCells()[c], vertex) ? 1 : 0;
      const char bestSide = surfaces ? keeps[v] : 0;
      if (volumes[c] < 0.0f || side < bestSide ||
        (side == bestSide && best >= 0 && volumes[c] <= volumes[static_cast<std::size_t>(best)]))
      {
        continue;
      }
      best = static_cast<std::int32_t>(c);
      if (surfaces)
      {
        keeps[v] = side;
      }
    }
  }
}

//------------------------------------------------------------------------------
void ShadowStarts::FindPlaces(
  const TetrahedralMesh& mesh, const RangeLoop& loop, const StartSurfaces* surfaces)
{
  this->Places.resize(this->Cells.size());
  ForEachInBlocks(this->Numbers.size(), loop,
    [&](std::size_t i)
    {
      const std::int32_t vertex = this->Numbers[i];
      const glm::dvec3 place = mesh.GetPosition(vertex);
      const auto c = static_cast<std::size_t>(this->GetCell(vertex));
      const bool keepsSide = !surfaces || KeepsSide(*surfaces, mesh.GetCells()[c], vertex);
      const double share = keepsSide ? Share : -Share;
      this->Places[static_cast<std::size_t>(vertex)] = place + share * (CenterOf(mesh, c) - place);
    });
}

}
