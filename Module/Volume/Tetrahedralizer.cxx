// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Tetrahedralizer.h"

#include <algorithm>

namespace meniscus
{
namespace
{

// Faces as their number of points and their points in the cell.
constexpr int HexahedronFaces[] = { 4, 0, 4, 7, 3, 4, 1, 2, 6, 5, 4, 0, 1, 5, 4, 4, 3, 7, 6, 2, 4,
  0, 3, 2, 1, 4, 4, 5, 6, 7 };
constexpr int WedgeFaces[] = { 3, 0, 1, 2, 3, 3, 5, 4, 4, 0, 3, 4, 1, 4, 1, 4, 5, 2, 4, 2, 5, 3,
  0 };
constexpr int PyramidFaces[] = { 4, 0, 3, 2, 1, 3, 0, 1, 4, 3, 1, 2, 4, 3, 2, 3, 4, 3, 3, 0, 4 };

// The tetrahedra at the corners of a quadratic one, and the octahedron between about its axis 4-9.
constexpr int QuadraticParts[8][4] = { { 0, 4, 6, 7 }, { 1, 5, 4, 8 }, { 2, 6, 5, 9 },
  { 3, 7, 9, 8 }, { 4, 9, 5, 6 }, { 4, 9, 6, 7 }, { 4, 9, 7, 8 }, { 4, 9, 8, 5 } };

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
  if (std::find(face, face + size, apex) != face + size)
  {
    return;
  }
  const std::size_t start = std::min_element(face, face + size) - face;
  for (std::size_t i = 1; i + 1 < size; ++i)
  {
    this->Add(apex, face[start], face[(start + i) % size], face[(start + i + 1) % size]);
  }
}

//------------------------------------------------------------------------------
void Tetrahedralizer::AddPolyhedron(const std::int64_t* faces, std::size_t numberOfFaces)
{
  if (numberOfFaces == 0 || faces[0] < 1)
  {
    return;
  }
  std::int64_t apex = faces[1];
  const std::int64_t* face = faces;
  for (std::size_t f = 0; f < numberOfFaces; ++f, face += 1 + face[0])
  {
    apex = std::min(apex, *std::min_element(face + 1, face + 1 + face[0]));
  }
  face = faces;
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
  // As it is: a mesh rejects and counts what is wrong with it.
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
void Tetrahedralizer::AddQuadraticTetrahedron(const std::int64_t* points)
{
  for (const auto& part : QuadraticParts)
  {
    this->Add(points[part[0]], points[part[1]], points[part[2]], points[part[3]]);
  }
}

}
