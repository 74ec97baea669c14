// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Mesh/Tetrahedralizer.h"

#include <algorithm>
#include <iterator>
#include <limits>

namespace meniscus
{
namespace
{

// Faces of the cells: the number of points of each face, followed by its points as indices in the
// cell.
constexpr int HexahedronFaces[] = { 4, 0, 4, 7, 3, 4, 1, 2, 6, 5, 4, 0, 1, 5, 4, 4, 3, 7, 6, 2, 4,
  0, 3, 2, 1, 4, 4, 5, 6, 7 };
constexpr int WedgeFaces[] = { 3, 0, 1, 2, 3, 3, 5, 4, 4, 0, 3, 4, 1, 4, 1, 4, 5, 2, 4, 2, 5, 3,
  0 };
constexpr int PyramidFaces[] = { 4, 0, 3, 2, 1, 3, 0, 1, 4, 3, 1, 2, 4, 3, 2, 3, 4, 3, 3, 0, 4 };

// Four tetrahedra at the corners of a quadratic tetrahedron, and the four parts of the octahedron
// between them, around its axis 4-9.
constexpr int QuadraticParts[8][4] = { { 0, 4, 6, 7 }, { 1, 5, 4, 8 }, { 2, 6, 5, 9 },
  { 3, 7, 9, 8 }, { 4, 9, 5, 6 }, { 4, 9, 6, 7 }, { 4, 9, 7, 8 }, { 4, 9, 8, 5 } };

// Tetrahedra at the corners of quadratic cells, and the faces of the remaining core. All have the
// same orientation in a cell, so that folded cells can be recognised (see TetrahedraSource).
constexpr int HexahedronCorners[8][4] = { { 0, 8, 11, 16 }, { 1, 9, 8, 17 }, { 2, 10, 9, 18 },
  { 3, 11, 10, 19 }, { 4, 15, 12, 16 }, { 5, 12, 13, 17 }, { 6, 13, 14, 18 }, { 7, 14, 15, 19 } };
constexpr int HexahedronCore[] = { 3, 8, 16, 11, 3, 9, 17, 8, 3, 10, 18, 9, 3, 11, 19, 10, 3, 15,
  16, 12, 3, 12, 17, 13, 3, 13, 18, 14, 3, 14, 19, 15, 4, 16, 15, 19, 11, 4, 9, 18, 13, 17, 4, 8,
  17, 12, 16, 4, 19, 14, 18, 10, 4, 11, 10, 9, 8, 4, 12, 13, 14, 15 };
constexpr int WedgeCorners[6][4] = { { 0, 6, 12, 8 }, { 1, 7, 13, 6 }, { 2, 8, 14, 7 },
  { 3, 9, 11, 12 }, { 4, 10, 9, 13 }, { 5, 11, 10, 14 } };
constexpr int WedgeCore[] = { 3, 6, 8, 12, 3, 7, 6, 13, 3, 8, 7, 14, 3, 9, 12, 11, 3, 10, 13, 9, 3,
  11, 14, 10, 3, 6, 7, 8, 3, 9, 11, 10, 4, 12, 9, 13, 6, 4, 13, 10, 14, 7, 4, 14, 11, 12, 8 };
constexpr int PyramidCorners[4][4] = { { 0, 5, 8, 9 }, { 1, 6, 5, 10 }, { 2, 7, 6, 11 },
  { 3, 8, 7, 12 } };
constexpr int PyramidCore[] = { 3, 5, 9, 8, 3, 6, 10, 5, 3, 7, 11, 6, 3, 8, 12, 7, 3, 5, 10, 9, 3,
  6, 11, 10, 3, 7, 12, 11, 3, 8, 9, 12, 4, 8, 7, 6, 5, 4, 9, 10, 11, 12 };
// Top of a quadratic pyramid as a pyramid, and the wedges of a wedge with linear sides.
constexpr int PyramidTop[5] = { 9, 10, 11, 12, 4 };
constexpr int LinearWedges[4][6] = { { 0, 6, 8, 3, 9, 11 }, { 1, 7, 6, 4, 10, 9 },
  { 2, 8, 7, 5, 11, 10 }, { 6, 7, 8, 9, 10, 11 } };

}

//------------------------------------------------------------------------------
void Tetrahedralizer::Add(std::int64_t a, std::int64_t b, std::int64_t c, std::int64_t d)
{
  if (a != b && a != c && a != d && b != c && b != d && c != d)
  {
    this->Tetrahedra.insert(this->Tetrahedra.end(), { a, b, c, d });
  }
}

//------------------------------------------------------------------------------
void Tetrahedralizer::AddFan(std::int64_t apex, const std::int64_t* face, std::size_t size)
{
  const std::size_t start = std::min_element(face, face + size) - face;
  for (std::size_t i = 1; i + 1 < size; ++i)
  {
    this->Add(apex, face[start], face[(start + i) % size], face[(start + i + 1) % size]);
  }
}

//------------------------------------------------------------------------------
void Tetrahedralizer::AddPolyhedron(const std::int64_t* faces, std::size_t numberOfFaces)
{
  std::int64_t apex = std::numeric_limits<std::int64_t>::max();
  const std::int64_t* face = faces;
  for (std::size_t f = 0; f < numberOfFaces; ++f, face += 1 + face[0])
  {
    for (std::int64_t k = 1; k <= face[0]; ++k)
    {
      apex = std::min(apex, face[k]);
    }
  }
  this->AddCone(apex, faces, numberOfFaces);
}

//------------------------------------------------------------------------------
void Tetrahedralizer::AddCone(
  std::int64_t apex, const std::int64_t* faces, std::size_t numberOfFaces)
{
  const std::int64_t* face = faces;
  for (std::size_t f = 0; f < numberOfFaces; ++f, face += 1 + face[0])
  {
    this->AddFan(apex, face + 1, static_cast<std::size_t>(face[0]));
  }
}

//------------------------------------------------------------------------------
template <std::size_t Size>
void Tetrahedralizer::AddShape(const std::int64_t* points, const int (&faces)[Size])
{
  std::int64_t stream[Size];
  std::size_t numberOfFaces = 0;
  for (std::size_t i = 0; i < Size; ++numberOfFaces)
  {
    const int size = faces[i];
    stream[i++] = size;
    for (int k = 0; k < size; ++k, ++i)
    {
      stream[i] = points[faces[i]];
    }
  }
  this->AddPolyhedron(stream, numberOfFaces);
}

//------------------------------------------------------------------------------
void Tetrahedralizer::AddTetrahedron(const std::int64_t* points)
{
  // Added unchanged: the mesh rejects and counts invalid tetrahedra.
  this->Tetrahedra.insert(this->Tetrahedra.end(), points, points + 4);
}

//------------------------------------------------------------------------------
void Tetrahedralizer::AddVoxel(const std::int64_t* points)
{
  const std::int64_t hexahedron[8] = { points[0], points[1], points[3], points[2], points[4],
    points[5], points[7], points[6] };
  this->AddHexahedron(hexahedron);
}

//------------------------------------------------------------------------------
void Tetrahedralizer::AddHexahedron(const std::int64_t* points)
{
  this->AddShape(points, HexahedronFaces);
}

//------------------------------------------------------------------------------
void Tetrahedralizer::AddWedge(const std::int64_t* points)
{
  this->AddShape(points, WedgeFaces);
}

//------------------------------------------------------------------------------
void Tetrahedralizer::AddPyramid(const std::int64_t* points)
{
  this->AddShape(points, PyramidFaces);
}

//------------------------------------------------------------------------------
template <std::size_t Size>
void Tetrahedralizer::AddParts(const std::int64_t* points, const int (&parts)[Size][4])
{
  for (const auto& part : parts)
  {
    this->Add(points[part[0]], points[part[1]], points[part[2]], points[part[3]]);
  }
}

//------------------------------------------------------------------------------
void Tetrahedralizer::AddQuadraticTetrahedron(const std::int64_t* points)
{
  this->AddParts(points, QuadraticParts);
}

//------------------------------------------------------------------------------
void Tetrahedralizer::AddQuadraticHexahedron(const std::int64_t* points)
{
  this->AddParts(points, HexahedronCorners);
  this->AddShape(points, HexahedronCore);
}

//------------------------------------------------------------------------------
void Tetrahedralizer::AddQuadraticWedge(const std::int64_t* points)
{
  this->AddParts(points, WedgeCorners);
  this->AddShape(points, WedgeCore);
}

//------------------------------------------------------------------------------
void Tetrahedralizer::AddQuadraticPyramid(const std::int64_t* points)
{
  this->AddParts(points, PyramidCorners);
  this->AddShape(points, PyramidCore);
  std::int64_t top[5];
  std::transform(std::begin(PyramidTop), std::end(PyramidTop), top,
    [points](int place) { return points[place]; });
  this->AddPyramid(top);
}

//------------------------------------------------------------------------------
void Tetrahedralizer::AddQuadraticLinearWedge(const std::int64_t* points)
{
  for (const auto& places : LinearWedges)
  {
    std::int64_t wedge[6];
    std::transform(
      std::begin(places), std::end(places), wedge, [points](int place) { return points[place]; });
    this->AddWedge(wedge);
  }
}

}
