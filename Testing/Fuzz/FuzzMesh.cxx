// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "FuzzMesh.h"

#include "FuzzTarget.h"
#include "Volume/Mesh/Tetrahedralizer.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdlib>

namespace meniscus::test
{
namespace
{

constexpr int MostPoints = 40;
constexpr int MostCells = 48;
constexpr int MostShapes = 6;
constexpr int MostFacePoints = 6;

/** An index of a point, sometimes one that does not exist. */
std::int64_t ReadIndex(ByteReader& reader, std::int64_t points)
{
  const int byte = reader.Below(256);
  if (byte == 255)
  {
    return reader.Read<std::int64_t>();
  }
  if (byte == 254 || points == 0)
  {
    return points - reader.Below(2) * (points + 1);
  }
  return byte % points;
}

/** The three vertices of a face, ascending. */
std::array<std::int32_t, 3> FaceOf(const TetrahedralMesh::Cell& cell, int face)
{
  std::array<std::int32_t, 3> vertices{};
  std::size_t count = 0;
  for (int i = 0; i < 4; ++i)
  {
    if (i != face)
    {
      vertices[count++] = cell.Vertices[static_cast<std::size_t>(i)];
    }
  }
  return vertices;
}

void CheckCell(const TetrahedralMesh& mesh, std::size_t index)
{
  const TetrahedralMesh::Cell& cell = mesh.GetCells()[index];
  Require(std::is_sorted(cell.Vertices.begin(), cell.Vertices.end()) &&
      std::adjacent_find(cell.Vertices.begin(), cell.Vertices.end()) == cell.Vertices.end(),
    "vertices of a cell ascend");
  Require(cell.Vertices.front() >= 0 && cell.Vertices.back() < mesh.GetNumberOfVertices(),
    "vertices exist");
  for (int face = 0; face < 4; ++face)
  {
    const std::int32_t read = cell.Links[static_cast<std::size_t>(face)];
    if (read == TetrahedralMesh::NoNeighbor)
    {
      continue;
    }
    const std::int32_t link =
      read < TetrahedralMesh::NoNeighbor ? TetrahedralMesh::MarkedLink(read) : read;
    Require(link / 4 < mesh.GetNumberOfCells(), "linked cells exist");
    const auto& other = mesh.GetCells()[static_cast<std::size_t>(link / 4)];
    const std::int32_t back = other.Links[static_cast<std::size_t>(link % 4)];
    const auto here = static_cast<std::int32_t>(4 * index) + face;
    Require(back == here || TetrahedralMesh::MarkedLink(back) == here, "links are mutual");
    Require(FaceOf(cell, face) == FaceOf(other, link % 4), "linked cells share a face");
  }
}

}

//------------------------------------------------------------------------------
FuzzMesh::FuzzMesh(ByteReader& reader)
{
  this->IsShort = reader.Flag();
  this->View.NumberOfPoints = reader.Below(MostPoints);
  this->ReadPoints(reader);
  this->ReadCells(reader);
  this->ReadOptions(reader);
}

//------------------------------------------------------------------------------
void FuzzMesh::ReadPoints(ByteReader& reader)
{
  // A common unit and offset: meshes far from the origin, and of any size.
  const double unit = reader.Flag() ? reader.FiniteNumber() : 1.0;
  const glm::dvec3 offset = reader.Flag() ? reader.FiniteVector() : glm::dvec3(0.0);
  this->Points.clear();
  for (std::int64_t i = 0; i < this->View.NumberOfPoints; ++i)
  {
    const glm::dvec3 point = offset + unit * reader.Vector();
    this->Points.insert(this->Points.end(), { point.x, point.y, point.z });
  }
  // One value more: no null pointer without points.
  this->Points.push_back(0.0);
  this->ShortPoints.clear();
  for (const double value : this->Points)
  {
    this->ShortPoints.push_back(static_cast<float>(value));
  }
  this->View.Points =
    this->IsShort ? PointsView(this->ShortPoints.data()) : PointsView(this->Points.data());
}

//------------------------------------------------------------------------------
void FuzzMesh::ReadCells(ByteReader& reader)
{
  const int kind = reader.Below(4);
  if (kind == 0)
  {
    this->ReadShapes(reader, reader.Below(MostShapes));
  }
  else
  {
    this->ReadSingleCells(reader, reader.Below(MostCells));
  }
  this->View.NumberOfCells = static_cast<std::int64_t>(this->Cells.size() / 4);
  if (kind == 1)
  {
    for (const std::int64_t id : this->Cells)
    {
      this->ShortCells.push_back(static_cast<std::int32_t>(id & 0xFFFFFFFF));
    }
    this->ShortCells.push_back(0);
    this->View.ShortCells = this->ShortCells.data();
  }
  else
  {
    this->Cells.push_back(0);
    this->View.Cells = this->Cells.data();
  }
}

//------------------------------------------------------------------------------
/** Cells of any points, or of the face of an earlier cell and a further point. */
void FuzzMesh::ReadSingleCells(ByteReader& reader, int count)
{
  for (int i = 0; i < count; ++i)
  {
    const int begin = reader.Below(8);
    std::array<std::int64_t, 4> cell{};
    for (std::size_t k = 0; k < 4; ++k)
    {
      const bool shared = begin < 6 && k < 3 && !this->Cells.empty();
      const std::size_t earlier =
        shared ? this->Cells.size() - 4 + (static_cast<std::size_t>(begin) + k) % 4 : 0;
      cell[k] = shared ? this->Cells[earlier] : ReadIndex(reader, this->View.NumberOfPoints);
    }
    this->Cells.insert(this->Cells.end(), cell.begin(), cell.end());
  }
}

//------------------------------------------------------------------------------
/** Cells of other shapes, divided into tetrahedra. */
void FuzzMesh::ReadShapes(ByteReader& reader, int count)
{
  Tetrahedralizer parts;
  const auto read = [&](std::size_t size)
  {
    std::vector<std::int64_t> ids(size);
    for (std::int64_t& id : ids)
    {
      id = ReadIndex(reader, this->View.NumberOfPoints);
    }
    return ids;
  };
  for (int i = 0; i < count; ++i)
  {
    switch (reader.Below(12))
    {
      case 0:
        parts.AddVoxel(read(8).data());
        break;
      case 1:
        parts.AddHexahedron(read(8).data());
        break;
      case 2:
        parts.AddWedge(read(6).data());
        break;
      case 3:
        parts.AddPyramid(read(5).data());
        break;
      case 4:
        parts.AddQuadraticTetrahedron(read(10).data());
        break;
      case 5:
        parts.AddQuadraticHexahedron(read(20).data());
        break;
      case 6:
        parts.AddQuadraticWedge(read(15).data());
        break;
      case 7:
        parts.AddQuadraticPyramid(read(13).data());
        break;
      case 8:
        parts.AddQuadraticLinearWedge(read(12).data());
        break;
      case 9:
      case 10:
      {
        const auto faces = static_cast<std::size_t>(reader.Below(8));
        std::vector<std::int64_t> stream;
        for (std::size_t face = 0; face < faces; ++face)
        {
          const auto size = static_cast<std::size_t>(reader.Below(MostFacePoints));
          const std::vector<std::int64_t> ids = read(size);
          stream.push_back(static_cast<std::int64_t>(size));
          stream.insert(stream.end(), ids.begin(), ids.end());
        }
        if (reader.Flag())
        {
          parts.AddCone(ReadIndex(reader, this->View.NumberOfPoints), stream.data(), faces);
        }
        else
        {
          parts.AddPolyhedron(stream.data(), faces);
        }
        break;
      }
      default:
        parts.AddTetrahedron(read(4).data());
    }
  }
  this->Cells = parts.GetTetrahedra();
}

//------------------------------------------------------------------------------
void FuzzMesh::ReadOptions(ByteReader& reader)
{
  const auto cells = static_cast<std::size_t>(this->View.NumberOfCells);
  this->View.KeepSourceCells = reader.Flag();
  this->View.MatchPositions = reader.Flag();
  if (reader.Flag())
  {
    this->View.LeftOutBits = reader.Read<std::uint8_t>();
    for (std::size_t i = 0; i < cells; ++i)
    {
      this->Flags.push_back(reader.Read<std::uint8_t>());
    }
    this->Flags.push_back(0);
    this->View.CellFlags = this->Flags.data();
  }
  if (reader.Flag())
  {
    for (std::size_t i = 0; i <= cells; ++i)
    {
      this->Sources.push_back(reader.Below(256));
    }
    this->View.SourceCells = this->Sources.data();
  }
}

//------------------------------------------------------------------------------
void CheckMesh(const TetrahedralMesh& mesh, const TetrahedraView& view, MeshStatus status)
{
  const std::int64_t cells = mesh.GetNumberOfCells();
  Require(
    status == (cells > 0 ? MeshStatus::Ok : MeshStatus::Empty), "the status is that of cells");
  std::int64_t skipped = 0;
  for (std::int64_t i = 0; view.CellFlags && i < view.NumberOfCells; ++i)
  {
    skipped += (view.CellFlags[i] & view.LeftOutBits) != 0;
  }
  Require(cells + mesh.GetRejectedCells().Total() + skipped == view.NumberOfCells,
    "every cell is kept, left out or rejected");
  Require(mesh.GetSourcePoints().size() == mesh.GetFixedPositions().size(),
    "every vertex has a source point");
  Require(mesh.GetSourceCells().size() ==
      (view.KeepSourceCells ? static_cast<std::size_t>(cells) : std::size_t{ 0 }),
    "source cells are kept where they are wanted");
  for (const std::int32_t point : mesh.GetSourcePoints())
  {
    Require(point >= 0 && point < view.NumberOfPoints, "source points exist");
  }
  constexpr std::int64_t largest = std::int64_t{ 1 } << 30;
  for (const glm::ivec3& p : mesh.GetFixedPositions())
  {
    Require(std::abs(std::int64_t{ p.x }) <= largest && std::abs(std::int64_t{ p.y }) <= largest &&
        std::abs(std::int64_t{ p.z }) <= largest,
      "positions are within the radius");
  }
  std::size_t open = 0;
  for (std::size_t cell = 0; cell < mesh.GetCells().size(); ++cell)
  {
    CheckCell(mesh, cell);
    const auto& links = mesh.GetCells()[cell].Links;
    open += static_cast<std::size_t>(
      std::count_if(links.begin(), links.end(), [](std::int32_t link) { return link < 0; }));
  }
  if (mesh.GetNumberOfActiveCells() == cells)
  {
    Require(mesh.GetBoundary().size() == open, "faces without a neighbour are the boundary");
  }
}

}
