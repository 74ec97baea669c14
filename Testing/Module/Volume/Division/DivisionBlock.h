// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Trilinear hexahedra to divide.
#pragma once

#include "Volume/Division/CellDivision.h"
#include "Volume/Mesh/Tetrahedralizer.h"

#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <memory>
#include <numeric>
#include <random>
#include <vector>

namespace meniscus::test
{

inline const glm::vec3 Corners[8] = { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 },
  { 0, 0, 1 }, { 1, 0, 1 }, { 1, 1, 1 }, { 0, 1, 1 } };

inline bool GoOn(double)
{
  return true;
}

/** Weights of a trilinear hexahedron. */
class Trilinear : public ShapeFunctions
{
public:
  explicit Trilinear(const std::vector<std::array<std::int64_t, 8>>& cells)
    : Cells(cells)
  {
  }
  void Weigh(std::int32_t cell, const glm::dvec3& place, PointWeights& row) override
  {
    for (std::size_t i = 0; i < 8; ++i)
    {
      const glm::dvec3 c(Corners[i]);
      const glm::dvec3 w = c * place + (1.0 - c) * (1.0 - place);
      row.Add(
        static_cast<std::int32_t>(this->Cells[static_cast<std::size_t>(cell)][i]), w.x * w.y * w.z);
    }
  }

private:
  const std::vector<std::array<std::int64_t, 8>>& Cells;
};

/** n^3 hexahedra in the unit cube with moved inner points, numbered at random. */
struct Block
{
  std::vector<double> Points;
  std::vector<std::array<std::int64_t, 8>> Cells;
  PointFields Fields;

  Block(int n, double jitter, unsigned int seed)
  {
    std::mt19937 random(seed);
    const int side = n + 1;
    std::vector<std::int64_t> number(static_cast<std::size_t>(side * side * side));
    std::iota(number.begin(), number.end(), 0);
    std::shuffle(number.begin(), number.end(), random);
    this->Points.resize(3 * number.size());
    std::uniform_real_distribution<double> move(-jitter / n, jitter / n);
    const auto at = [&](int i, int j, int k)
    { return number[static_cast<std::size_t>((k * side + j) * side + i)]; };
    for (int k = 0; k < side; ++k)
    {
      for (int j = 0; j < side; ++j)
      {
        for (int i = 0; i < side; ++i)
        {
          const int index[3] = { i, j, k };
          for (int axis = 0; axis < 3; ++axis)
          {
            const bool inner = index[axis] > 0 && index[axis] < n;
            this->Points[static_cast<std::size_t>(3 * at(i, j, k) + axis)] =
              static_cast<double>(index[axis]) / n + (inner ? move(random) : 0.0);
          }
          if (i < n && j < n && k < n)
          {
            this->Cells.push_back({});
            for (std::size_t c = 0; c < 8; ++c)
            {
              this->Cells.back()[c] = at(i + static_cast<int>(Corners[c].x),
                j + static_cast<int>(Corners[c].y), k + static_cast<int>(Corners[c].z));
            }
          }
        }
      }
    }
    this->Fields.Points = this->Points.data();
    this->Fields.NumberOfPoints = static_cast<std::int64_t>(number.size());
  }

  template <typename Function>
  void SetValues(Function&& function)
  {
    this->Fields.Values.assign(1, {});
    for (std::size_t p = 0; p < this->Points.size(); p += 3)
    {
      this->Fields.Values[0].push_back(
        function(glm::dvec3(this->Points[p], this->Points[p + 1], this->Points[p + 2])));
    }
  }

  ShapeFunctionsMaker GetFunctions() const
  {
    return [this]() { return std::make_unique<Trilinear>(this->Cells); };
  }

  std::vector<CellPiece> GetPieces() const
  {
    std::vector<CellPiece> pieces;
    for (std::size_t cell = 0; cell < this->Cells.size(); ++cell)
    {
      const auto& points = this->Cells[cell];
      Tetrahedralizer tetrahedra;
      tetrahedra.AddHexahedron(points.data());
      const auto& ids = tetrahedra.GetTetrahedra();
      for (std::size_t t = 0; t < ids.size(); t += 4)
      {
        CellPiece piece;
        piece.Cell = static_cast<std::int32_t>(cell);
        piece.Degree = 1;
        for (std::size_t i = 0; i < 4; ++i)
        {
          piece.Points[i] = static_cast<std::int32_t>(ids[t + i]);
          piece.Places[i] =
            Corners[std::find(points.begin(), points.end(), ids[t + i]) - points.begin()];
        }
        pieces.push_back(piece);
      }
    }
    return pieces;
  }

  DivisionStatus Divide(
    CellDivision& division, const DivisionLimits& limits, const RangeLoop& loop = SerialLoop) const
  {
    return division.Divide(
      this->GetPieces(), this->Fields, this->GetFunctions(), limits, loop, GoOn);
  }
};

inline DivisionLimits LimitsOf(double place, double value)
{
  DivisionLimits limits;
  limits.Measure.OfPlace = 1.0 / place;
  limits.Measure.OfValues.fill(ErrorScale::Proportional(value));
  limits.MostLevels = 20;
  return limits;
}

}
