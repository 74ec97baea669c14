// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "FuzzSurface.h"

#include "FuzzTarget.h"

#include <glm/geometric.hpp>

#include <array>
#include <cmath>
#include <limits>

namespace meniscus::test
{
namespace
{

constexpr int MostRows = 6;
constexpr int MostPoints = 24;
constexpr int MostTriangles = 32;
constexpr int MostObjectPoints = 10;
constexpr int MostCells = 5;
constexpr int MostCorners = 6;

/** Lengths of unit vectors and sums of weights are within a few roundings of 1. */
constexpr double Rounding = 32.0 * std::numeric_limits<double>::epsilon();

bool IsFinite(const glm::dvec3& v)
{
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/** Points of a cell that exist. */
void ReadCells(ByteReader& reader, std::int64_t points, int least, int most,
  std::vector<std::int64_t>& ends, std::vector<std::int64_t>& ids)
{
  for (int cell = reader.Below(MostCells); cell > 0; --cell)
  {
    for (int corner = least + reader.Below(most - least); corner > 0; --corner)
    {
      ids.push_back(reader.Below(static_cast<int>(points)));
    }
    ends.push_back(static_cast<std::int64_t>(ids.size()));
  }
}

void CheckPoint(const ImagePoint& point, std::int64_t points)
{
  double sum = 0.0;
  for (std::size_t k = 0; k < point.GetNumberOfSources(); ++k)
  {
    Require(point.Source[k] >= 0 && point.Source[k] < points, "sources of an image exist");
    Require(point.Weight[k] >= 0.0, "weights are not negative");
    sum += point.Weight[k];
  }
  Require(std::fabs(sum - 1.0) <= Rounding, "weights add up to 1");
}

/** Checks cells whose points are `points`, those of the object or those of the mesh itself. */
void CheckCells(const ImageMesh& mesh, std::size_t points)
{
  Require(
    mesh.Ends.size() == mesh.SourceCells.size() && mesh.Ends.size() == mesh.Orientations.size(),
    "arrays of cells are as long as each other");
  std::int64_t begin = 0;
  for (const std::int64_t end : mesh.Ends)
  {
    Require(end > begin, "images of cells have points");
    begin = end;
  }
  Require(begin == static_cast<std::int64_t>(mesh.Connectivity.size()), "the last cell ends last");
  for (const std::int64_t id : mesh.Connectivity)
  {
    Require(id >= 0 && id < static_cast<std::int64_t>(points), "points of images exist");
  }
}

}

//------------------------------------------------------------------------------
FuzzSurface::FuzzSurface(ByteReader& reader)
{
  switch (reader.Below(4))
  {
    case 0:
      this->ReadTriangles(reader);
      break;
    case 1:
      this->ReadBody(reader);
      break;
    default:
      this->ReadSheet(reader);
  }
  this->ReadNormals(reader);
  this->Borrow();
}

//------------------------------------------------------------------------------
void FuzzSurface::Borrow()
{
  this->Input.NumberOfPoints = this->Points.size() / 3;
  this->Input.NumberOfTriangles = this->Triangles.size() / 3;
  this->Input.Points = this->Points.data();
  this->Input.Triangles = this->Triangles.data();
  this->Input.CellIds = this->Ids.empty() ? nullptr : this->Ids.data();
  this->Input.Normals = this->Normals.empty() ? nullptr : this->Normals.data();
}

//------------------------------------------------------------------------------
void FuzzSurface::ReadPoints(ByteReader& reader)
{
  for (double& coordinate : this->Points)
  {
    coordinate += reader.Number() / 16.0;
  }
}

//------------------------------------------------------------------------------
/** A sheet over [-1, 1] squared with heights of any size. */
void FuzzSurface::ReadSheet(ByteReader& reader)
{
  const int columns = 2 + reader.Below(MostRows);
  const int rows = 2 + reader.Below(MostRows);
  const double unit = reader.Flag() ? reader.FiniteNumber() : 1.0;
  const glm::dvec3 offset = reader.Flag() ? reader.FiniteVector() : glm::dvec3(0.0);
  const double height = reader.Number() / 4.0;
  for (int row = 0; row < rows; ++row)
  {
    for (int column = 0; column < columns; ++column)
    {
      const glm::dvec3 point(2.0 * column / (columns - 1) - 1.0, height * reader.Below(256) / 255.0,
        2.0 * row / (rows - 1) - 1.0);
      const glm::dvec3 placed = offset + unit * point;
      this->Points.insert(this->Points.end(), { placed.x, placed.y, placed.z });
    }
  }
  for (int row = 0; row + 1 < rows; ++row)
  {
    for (int column = 0; column + 1 < columns; ++column)
    {
      const std::int64_t a = row * columns + column;
      const std::int64_t c = a + columns;
      this->Triangles.insert(this->Triangles.end(), { a, c, a + 1, a + 1, c, c + 1 });
    }
  }
}

//------------------------------------------------------------------------------
/** An octahedron whose corners are moved along their axes. */
void FuzzSurface::ReadBody(ByteReader& reader)
{
  const glm::dvec3 offset = reader.FiniteVector();
  for (int axis = 0; axis < 3; ++axis)
  {
    for (const double sign : { -1.0, 1.0 })
    {
      glm::dvec3 point = offset;
      point[axis] += sign * (reader.Flag() ? reader.Number() : 1.0);
      this->Points.insert(this->Points.end(), { point.x, point.y, point.z });
    }
  }
  this->Triangles = { 1, 3, 5, 3, 0, 5, 0, 2, 5, 2, 1, 5, 3, 1, 4, 0, 3, 4, 2, 0, 4, 1, 2, 4 };
}

//------------------------------------------------------------------------------
void FuzzSurface::ReadTriangles(ByteReader& reader)
{
  const int points = 1 + reader.Below(MostPoints);
  for (int i = 0; i < points; ++i)
  {
    const glm::dvec3 point = reader.Vector();
    this->Points.insert(this->Points.end(), { point.x, point.y, point.z });
  }
  for (int i = reader.Below(MostTriangles); i > 0; --i)
  {
    for (int k = 0; k < 3; ++k)
    {
      const int byte = reader.Below(256);
      this->Triangles.push_back(
        byte == 255 ? reader.Read<std::int64_t>() : (byte == 254 ? points : byte % points));
    }
    this->Ids.push_back(reader.Below(256));
  }
}

//------------------------------------------------------------------------------
void FuzzSurface::ReadNormals(ByteReader& reader)
{
  if (reader.Below(4) != 3)
  {
    return;
  }
  for (std::size_t i = 0; i < this->Points.size() / 3; ++i)
  {
    const glm::dvec3 normal = reader.Vector();
    this->Normals.insert(this->Normals.end(), { normal.x, normal.y, normal.z });
  }
}

//------------------------------------------------------------------------------
void CheckSurface(const Membrane& surface, const MembraneInput& input, MembraneStatus status)
{
  if (status != MembraneStatus::Ready)
  {
    Require(surface.GetFacets().empty(), "a membrane that is not ready is empty");
    return;
  }
  Require(!surface.GetFacets().empty(), "a ready membrane has facets");
  Require(surface.GetFacets().size() + surface.GetReport().Skipped() == input.NumberOfTriangles,
    "every triangle is accepted or counted");
  Require(
    surface.GetRadius() > 0.0 && std::isfinite(surface.GetRadius()), "the radius is positive");
  Require(IsFinite(surface.GetOrigin()), "the origin is finite");
  Require(
    surface.GetPieces().PieceOf.size() == surface.GetFacets().size(), "every facet has a piece");
  for (const Membrane::Facet& facet : surface.GetFacets())
  {
    for (const std::int32_t vertex : facet)
    {
      const auto i = static_cast<std::size_t>(vertex);
      Require(vertex >= 0 && i < surface.GetPositions().size(), "vertices exist");
      const glm::dvec3& position = surface.GetPositions()[i];
      Require(IsFinite(position) && std::fabs(position.x) <= surface.GetRadius() &&
          std::fabs(position.y) <= surface.GetRadius() &&
          std::fabs(position.z) <= surface.GetRadius(),
        "positions are within the radius");
      Require(std::fabs(glm::length(surface.GetNormals()[i]) - 1.0) <= Rounding,
        "normals have unit length");
    }
  }
}

//------------------------------------------------------------------------------
bool IsOfSolvableSize(const Membrane& surface)
{
  return surface.GetRadius() >= 0x1p-100 && surface.GetRadius() <= 0x1p100;
}

//------------------------------------------------------------------------------
double ReadIndexOfRefraction(ByteReader& reader)
{
  static constexpr std::array<double, 7> indices = { 1.0, 1.333, 1.5, 2.4, 1.1, 0.5, 1.0003 };
  const int choice = reader.Below(8);
  return choice < 7 ? indices[static_cast<std::size_t>(choice)] : reader.Number();
}

//------------------------------------------------------------------------------
FuzzObject::FuzzObject(ByteReader& reader)
{
  const std::int64_t points = 1 + reader.Below(MostObjectPoints);
  for (std::int64_t i = 0; i < points; ++i)
  {
    const glm::dvec3 point = reader.Vector();
    this->Points.insert(this->Points.end(), { point.x, point.y, point.z });
  }
  ReadCells(reader, points, 2, MostCorners, this->LineEnds, this->Lines);
  ReadCells(reader, points, 3, MostCorners, this->PolygonEnds, this->Polygons);
  for (int i = 0; i < MostCells; ++i)
  {
    this->Names.push_back(i);
  }
}

//------------------------------------------------------------------------------
void FuzzObject::Map(const CellImages& images, bool closesSeams) const
{
  const auto points = static_cast<std::int64_t>(this->GetNumberOfPoints());
  const std::vector<ImagePoint>& ofPoints = images.GetPointImages();
  for (const ImagePoint& point : ofPoints)
  {
    CheckPoint(point, points);
  }
  const auto split = [](
                       const std::int64_t*, std::size_t count, std::vector<std::int64_t>& triangles)
  {
    for (std::size_t i = 1; i + 1 < count; ++i)
    {
      const auto k = static_cast<std::int64_t>(i);
      triangles.insert(triangles.end(), { 0, k, k + 1 });
    }
  };
  const auto check = [&](const ImageMesh& pieces, const ImageMesh& whole)
  {
    CheckCells(whole, ofPoints.size());
    CheckCells(pieces, pieces.Points.size());
    for (const ImagePoint& point : pieces.Points)
    {
      CheckPoint(point, points);
      Require(IsFinite(point.Vertex.Position), "images of cells are finite");
    }
  };
  ImageMesh pieces;
  ImageMesh whole;
  images.MapLines({ this->LineEnds.data(), this->Lines.data() }, this->Names.data(), 0,
    this->LineEnds.size() - 1, pieces, whole);
  check(pieces, whole);
  pieces = ImageMesh();
  whole = ImageMesh();
  const std::size_t polygons = this->PolygonEnds.size() - 1;
  std::vector<unsigned char> isMapped(polygons, 0);
  const ObjectCells cells{ this->PolygonEnds.data(), this->Polygons.data() };
  images.MapPolygons(cells, this->Names.data(), 0, polygons, split, pieces, whole, isMapped.data());
  images.MeetNeighbours(cells, polygons, isMapped.data(), closesSeams, whole, pieces, SerialLoop);
  check(pieces, whole);
}

//------------------------------------------------------------------------------
void CheckImage(const VirtualVertex& image, std::size_t facets)
{
  if (image.State != ImageState::Found)
  {
    return;
  }
  Require(IsFinite(image.Position) && IsFinite(image.SightPoint), "images are finite");
  Require(image.Facet >= -1 && image.Facet < static_cast<std::int32_t>(facets),
    "the facet of an image exists");
  Require(image.Depth >= 0.0 && std::isfinite(image.Depth), "depths are not negative");
  Require(image.Reflectance >= 0.0 && image.Reflectance <= 1.0, "reflectances are shares");
  Require(image.Cosine >= 0.0 && image.Cosine <= 1.0 + Rounding, "cosines are of acute angles");
  Require(image.Orientation == 1 || image.Orientation == -1, "orientations are signs");
}

}
