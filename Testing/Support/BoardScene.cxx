// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "BoardScene.h"

#include "RefractionPicture.h"

namespace meniscus::test
{
namespace
{

const double Pi = std::acos(-1.0);

constexpr int LetterWidth = 5;
constexpr int LetterHeight = 7;
using Letter = std::array<const char*, LetterHeight>;
constexpr Letter M{ "#...#", "##.##", "#.#.#", "#.#.#", "#...#", "#...#", "#...#" };
constexpr Letter E{ "#####", "#....", "#....", "####.", "#....", "#....", "#####" };
constexpr Letter N{ "#...#", "##..#", "#.#.#", "#.#.#", "#..##", "#...#", "#...#" };
constexpr Letter I{ ".###.", "..#..", "..#..", "..#..", "..#..", "..#..", ".###." };
constexpr Letter S{ ".####", "#....", "#....", ".###.", "....#", "....#", "####." };
constexpr Letter C{ ".####", "#....", "#....", "#....", "#....", "#....", ".####" };
constexpr Letter U{ "#...#", "#...#", "#...#", "#...#", "#...#", "#...#", ".###." };
constexpr std::array<Letter, 8> Name{ M, E, N, I, S, C, U, S };

// True on a stroke; u and v run from 0 to 1 over the square.
bool IsStroke(const Letter& letter, double u, double v)
{
  // A square has 11 dots along a side, so that letters have a wide margin.
  const int column = static_cast<int>(std::floor(11.0 * u)) - 3;
  const int row = LetterHeight - 1 - (static_cast<int>(std::floor(11.0 * v)) - 2);
  return column >= 0 && column < LetterWidth && row >= 0 && row < LetterHeight &&
    letter[static_cast<std::size_t>(row)][column] == '#';
}

// Two unit vectors across a unit vector and each other.
std::array<glm::dvec3, 2> GetAcross(const glm::dvec3& axis)
{
  const glm::dvec3 other =
    std::fabs(axis.z) < 0.9 ? glm::dvec3(0.0, 0.0, 1.0) : glm::dvec3(1.0, 0.0, 0.0);
  const glm::dvec3 first = glm::normalize(glm::cross(axis, other));
  return { first, glm::cross(axis, first) };
}

// Two triangles per cell of a grid whose points are numbered from `first` in rows; the last row and
// column may be the first ones.
void AddCells(vtkCellArray* triangles, vtkIdType first, int rows, int columns, bool isClosed)
{
  const int width = isClosed ? columns : columns + 1;
  for (const auto& [j, i] : Product(rows, columns))
  {
    const int right = isClosed ? (i + 1) % columns : i + 1;
    const int above = isClosed ? (j + 1) % rows : j + 1;
    const vtkIdType a = first + j * width + i;
    const vtkIdType b = first + j * width + right;
    const vtkIdType c = first + above * width + right;
    const vtkIdType d = first + above * width + i;
    triangles->InsertNextCell({ a, b, c });
    triangles->InsertNextCell({ a, c, d });
  }
}

void AddBoard(const Board& board, vtkPoints* points, vtkCellArray* triangles)
{
  const vtkIdType first = points->GetNumberOfPoints();
  for (const auto& [j, i] : Product(board.Squares + 1, board.Squares + 1))
  {
    const glm::dvec3 p = board.Centre + (static_cast<double>(i) / board.Squares - 0.5) * board.U +
      (static_cast<double>(j) / board.Squares - 0.5) * board.V;
    points->InsertNextPoint(&p.x);
  }
  AddCells(triangles, first, board.Squares, board.Squares, false);
}

void AddRing(const Ring& ring, vtkPoints* points, vtkCellArray* triangles)
{
  constexpr int along = 48;
  constexpr int around = 24;
  const vtkIdType first = points->GetNumberOfPoints();
  const auto across = GetAcross(ring.Axis);
  for (int j = 0; j < along; ++j)
  {
    const double a = 2.0 * Pi * j / along;
    const glm::dvec3 out = std::cos(a) * across[0] + std::sin(a) * across[1];
    for (int i = 0; i < around; ++i)
    {
      const double b = 2.0 * Pi * i / around;
      const glm::dvec3 p = ring.Centre + (ring.Radius + ring.Tube * std::cos(b)) * out +
        ring.Tube * std::sin(b) * ring.Axis;
      points->InsertNextPoint(&p.x);
    }
  }
  AddCells(triangles, first, along, around, true);
}

// Stripes, lit from above and below.
glm::dvec3 GetRingColour(const Ring& ring, const glm::dvec3& place)
{
  constexpr int stripes = 16;
  const auto across = GetAcross(ring.Axis);
  const glm::dvec3 p = place - ring.Centre;
  const glm::dvec3 flat = p - glm::dot(p, ring.Axis) * ring.Axis;
  const double angle =
    std::atan2(glm::dot(flat, across[1]), glm::dot(flat, across[0])) / (2.0 * Pi);
  const bool isDark = static_cast<int>(std::floor(stripes * (angle + 1.0))) % 2 == 1;
  const glm::dvec3 colour = isDark ? glm::dvec3(0.85, 0.35, 0.1) : glm::dvec3(1.0, 0.85, 0.55);
  const glm::dvec3 normal = glm::normalize(p - ring.Radius * glm::normalize(flat));
  const glm::dvec3 light = glm::normalize(glm::dvec3(-0.5, 1.0, 0.4));
  return (0.35 + 0.65 * std::fabs(glm::dot(normal, light))) * colour;
}

}

//------------------------------------------------------------------------------
Board MakeBoard(double y, double size)
{
  return { { 0.0, y, 0.0 }, { -size, 0.0, 0.0 }, { 0.0, 0.0, size } };
}

//------------------------------------------------------------------------------
glm::dvec3 Board::GetColour(const glm::dvec3& place) const
{
  const glm::dvec3 p = place - this->Centre;
  const double u = std::clamp(glm::dot(p, this->U) / glm::dot(this->U, this->U) + 0.5, 0.0, 1.0);
  const double v = std::clamp(glm::dot(p, this->V) / glm::dot(this->V, this->V) + 0.5, 0.0, 1.0);
  const int i = std::min(static_cast<int>(this->Squares * u), this->Squares - 1);
  const int j = std::min(static_cast<int>(this->Squares * v), this->Squares - 1);
  const glm::dvec3 hue(0.30 + 0.65 * i / this->Squares, 0.60, 0.95 - 0.6 * j / this->Squares);
  const int row = this->Squares - 1 - j;
  const auto letter = static_cast<std::size_t>((row * this->Squares + i) / 2) % Name.size();
  const bool isDark =
    (i + row) % 2 == 1 || IsStroke(Name[letter], this->Squares * u - i, this->Squares * v - j);
  return isDark ? 0.35 * hue : 0.4 * hue + 0.6;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkPolyData> BoardScene::MakeData() const
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> triangles;
  AddBoard(this->Board, points, triangles);
  if (this->Ring)
  {
    AddRing(*this->Ring, points, triangles);
  }
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  data->SetPolys(triangles);
  AddPlaces(data);
  return data;
}

//------------------------------------------------------------------------------
glm::dvec3 BoardScene::GetColour(const glm::dvec3& place) const
{
  // Rounding of interpolated places; the ring is much farther from the board except where it
  // touches it.
  constexpr double onBoard = 1e-6;
  const double off = std::fabs(glm::dot(place - this->Board.Centre, this->Board.GetNormal()));
  return !this->Ring || off < onBoard * glm::length(this->Board.U)
    ? this->Board.GetColour(place)
    : GetRingColour(*this->Ring, place);
}

}
