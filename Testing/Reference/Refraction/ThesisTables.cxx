// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ThesisTables.h"

#include "Refraction/Curved/CurvedMembraneSolver.h"
#include "Refraction/Flat/FlatMembraneSolver.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace meniscus::reference
{
namespace
{

constexpr double DiscRadius = 141.5;

// Side of a square membrane whose corners lie exactly on the hemisphere of DiscRadius.
constexpr double SquareSide = 200.0;

// Samples of the error volume: 40 along a side, 20 units apart.
constexpr int Samples = 40;
constexpr double Spacing = 20.0;

// Fraction of the radius of the flat disc beyond which sight points have no exact point. The thesis
// does not say so, but its numbers of points imply it.
constexpr double FlatDiscPart = 0.9;

constexpr auto Disc = MembraneShape::Disc;
constexpr auto Square = MembraneShape::Square;

const std::vector<ThesisRow> Rows = {
  { "4.1", Disc, 0, 0.0, 900.0, 0.0, 1.0, 1.51, 0.0154, 0.0085, 6988 },
  { "4.1", Disc, 0, 0.0, 900.0, 142.0, 1.0, 1.51, 0.0262, 0.0186, 8046 },
  { "4.1", Disc, 0, 0.0, 900.0, 400.0, 1.0, 1.51, 0.0529, 0.0308, 7712 },
  { "4.1", Disc, 0, 0.0, 900.0, 800.0, 1.0, 1.51, 0.0523, 0.0290, 6244 },
  { "4.1", Disc, 0, 0.0, 450.0, 0.0, 1.0, 1.51, 0.0928, 0.0319, 11348 },
  { "4.1", Disc, 0, 0.0, 450.0, 142.0, 1.0, 1.51, 0.1364, 0.0963, 12144 },
  { "4.1", Disc, 0, 0.0, 450.0, 400.0, 1.0, 1.51, 0.1626, 0.0972, 8620 },
  { "4.1", Disc, 0, 0.0, 450.0, 800.0, 1.0, 1.51, 0.0670, 0.0363, 4880 },
  { "4.1", Disc, 0, 0.0, 150.0, 0.0, 1.0, 1.51, 1.2789, 0.6813, 30297 },
  { "4.1", Disc, 0, 0.0, 150.0, 142.0, 1.0, 1.51, 1.0994, 0.7749, 22030 },
  { "4.1", Disc, 0, 0.0, 150.0, 400.0, 1.0, 1.51, 0.2441, 0.1575, 5964 },
  { "4.1", Disc, 0, 0.0, 150.0, 800.0, 1.0, 1.51, 0.0568, 0.0372, 3616 },
  { "4.2", Disc, 0, 0.0, 450.0, 0.0, 1.0, 1.51, 0.0928, 0.0519, 11348 },
  { "4.2", Disc, 0, 5.0, 450.0, 0.0, 1.0, 1.51, 0.1107, 0.0413, 19856 },
  { "4.2", Disc, 0, 5.0 / 2.0, 450.0, 0.0, 1.0, 1.51, 0.2082, 0.0811, 27412 },
  { "4.2", Disc, 0, 5.0 / 3.0, 450.0, 0.0, 1.0, 1.51, 0.4558, 0.1599, 35476 },
  { "4.2", Disc, 0, 5.0 / 4.0, 450.0, 0.0, 1.0, 1.51, 1.1152, 0.5790, 43599 },
  { "4.2", Disc, 0, 1.0, 450.0, 0.0, 1.0, 1.51, 7.5567, 9.2816, 56890 },
  { "4.3", Disc, 0, 0.0, 450.0, 0.0, 1.0, 2.2, 0.0616, 0.0351, 8356 },
  { "4.3", Disc, 0, 0.0, 450.0, 0.0, 1.0, 1.8, 0.0771, 0.0433, 9708 },
  { "4.3", Disc, 0, 0.0, 450.0, 0.0, 1.0, 1.4, 0.1003, 0.0562, 12144 },
  { "4.3", Disc, 0, 0.0, 450.0, 0.0, 1.0, 1.1, 0.1248, 0.0715, 15668 },
  { "4.3", Disc, 0, 0.0, 450.0, 0.0, 1.1, 1.0, 0.1418, 0.0859, 19492 },
  { "4.3", Disc, 0, 0.0, 450.0, 0.0, 1.4, 1.0, 0.1522, 0.0949, 26263 },
  { "4.3", Disc, 0, 0.0, 450.0, 0.0, 1.8, 1.0, 0.1737, 0.0920, 34788 },
  { "4.3", Disc, 0, 0.0, 450.0, 0.0, 2.2, 1.0, 0.3478, 0.1927, 40984 },
  { "4.3", Disc, 0, 1.0, 200.0, 0.0, 1.0, 2.2, 3.1553, 3.3497, 58879 },
  { "4.3", Disc, 0, 1.0, 200.0, 0.0, 1.0, 1.8, 2.6512, 3.1855, 58807 },
  { "4.3", Disc, 0, 1.0, 200.0, 0.0, 1.0, 1.4, 2.3332, 3.2306, 58766 },
  { "4.3", Disc, 0, 1.0, 200.0, 0.0, 1.0, 1.1, 2.3664, 3.4804, 58720 },
  { "4.3", Disc, 0, 1.0, 200.0, 0.0, 1.1, 1.0, 2.6125, 3.7218, 58596 },
  { "4.3", Disc, 0, 1.0, 200.0, 0.0, 1.4, 1.0, 3.1449, 4.0903, 57825 },
  { "4.3", Disc, 0, 1.0, 200.0, 0.0, 1.8, 1.0, 3.8490, 4.4570, 54940 },
  { "4.3", Disc, 0, 1.0, 200.0, 0.0, 2.2, 1.0, 3.5148, 3.3500, 47982 },
  { "4.4", Disc, 0, 1.0, 450.0, 0.0, 1.0, 2.2, 7.3738, 9.3400, 58629 },
  { "4.4", Disc, 0, 1.0, 450.0, 0.0, 1.0, 1.8, 7.3426, 9.2394, 58124 },
  { "4.4", Disc, 0, 1.0, 450.0, 0.0, 1.0, 1.4, 7.7039, 9.2890, 55898 },
  { "4.4", Disc, 0, 1.0, 450.0, 0.0, 1.0, 1.1, 7.3889, 7.9385, 49003 },
  { "4.4", Disc, 0, 1.0, 450.0, 0.0, 1.1, 1.0, 0.4687, 2.7173, 5745 },
  { "4.4", Disc, 0, 1.0, 450.0, 0.0, 1.4, 1.0, 21.375, 29.218, 376 },
  { "4.4", Disc, 0, 1.0, 450.0, 0.0, 1.8, 1.0, 131.761, 50.943, 31298 },
  { "4.4", Disc, 0, 1.0, 450.0, 0.0, 2.2, 1.0, 33.489, 20.780, 26832 },
  { "4.5", Square, 6, 0.0, 450.0, 0.0, 1.0, 1.51, 0.1116, 0.0726, 0 },
  { "4.5", Square, 10, 0.0, 450.0, 0.0, 1.0, 1.51, 0.0406, 0.0270, 0 },
  { "4.5", Square, 15, 0.0, 450.0, 0.0, 1.0, 1.51, 0.0174, 0.0118, 0 },
  { "4.5", Square, 6, 0.0, 150.0, 0.0, 1.0, 1.51, 1.6858, 0.9680, 0 },
  { "4.5", Square, 10, 0.0, 150.0, 0.0, 1.0, 1.51, 0.6104, 0.3509, 0 },
  { "4.5", Square, 15, 0.0, 150.0, 0.0, 1.0, 1.51, 0.2641, 0.1560, 0 },
  { "4.5", Square, 6, 1.0, 450.0, 0.0, 1.0, 1.51, 4.4397, 6.3253, 0 },
  { "4.5", Square, 10, 1.0, 450.0, 0.0, 1.0, 1.51, 1.4803, 2.4649, 0 },
  { "4.5", Square, 15, 1.0, 450.0, 0.0, 1.0, 1.51, 0.6129, 1.0942, 0 },
  { "4.5", Square, 6, 1.0, 150.0, 0.0, 1.0, 1.51, 1.0636, 0.9138, 0 },
  { "4.5", Square, 10, 1.0, 150.0, 0.0, 1.0, 1.51, 0.3464, 0.2782, 0 },
  { "4.5", Square, 15, 1.0, 150.0, 0.0, 1.0, 1.51, 0.1449, 0.1006, 0 },
};

}

//------------------------------------------------------------------------------
const std::vector<ThesisRow>& GetThesisRows()
{
  return Rows;
}

//------------------------------------------------------------------------------
bool IsReproducible(const ThesisRow& row)
{
  return std::strcmp(row.Table, "4.4") != 0;
}

//------------------------------------------------------------------------------
MembraneMesh MakeThesisMesh(const ThesisRow& row)
{
  const double sphereRadius = row.SphereRatio * DiscRadius;
  return row.Shape == Disc ? MakeDisc(DiscRadius, 5, sphereRadius)
                           : MakeSquare(SquareSide, row.SquareCells, sphereRadius);
}

//------------------------------------------------------------------------------
glm::dvec3 GetThesisEye(const ThesisRow& row)
{
  return { row.EyeOffset, row.EyeHeight, 0.0 };
}

//------------------------------------------------------------------------------
AnalyticMembrane GetThesisSurface(const ThesisRow& row)
{
  return { row.SphereRatio * DiscRadius, row.Exterior, row.Interior };
}

//------------------------------------------------------------------------------
std::optional<double> FindThesisError(
  const ThesisRow& row, const glm::dvec3& point, const VirtualVertex& vertex)
{
  const bool flatDisc = row.Shape == Disc && row.SphereRatio == 0.0;
  if (flatDisc && glm::length(vertex.SightPoint) > FlatDiscPart * DiscRadius)
  {
    return {};
  }
  const auto computed = GetThesisSurface(row).FindTruePoint(GetThesisEye(row), vertex.Position);
  return computed ? std::optional<double>(glm::length(*computed - point)) : std::nullopt;
}

//------------------------------------------------------------------------------
ErrorStatistics MeasureErrors(const ErrorFunction& errorAt)
{
  double sum = 0.0;
  double squares = 0.0;
  ErrorStatistics result;
  for (int i = 0; i < Samples * Samples * Samples; ++i)
  {
    const int ix = i % Samples;
    const int iy = i / Samples % Samples;
    const int iz = i / (Samples * Samples);
    const auto error =
      errorAt({ Spacing * (ix - Samples / 2), -Spacing * (iy + 1), Spacing * (iz - Samples / 2) });
    if (error)
    {
      sum += *error;
      squares += *error * *error;
      result.Largest = std::max(result.Largest, *error);
      ++result.Points;
    }
  }
  const auto count = static_cast<double>(result.Points);
  result.Mean = result.Points > 0 ? sum / count : 0.0;
  result.Deviation =
    result.Points > 0 ? std::sqrt(std::max(squares / count - result.Mean * result.Mean, 0.0)) : 0.0;
  return result;
}

//------------------------------------------------------------------------------
ErrorStatistics MeasureThesisRow(const ThesisRow& row)
{
  FlatMembraneSolver geometry;
  geometry.SetMembrane(MakeThesisMesh(row).AsInput());
  geometry.SetEye(GetThesisEye(row), row.Exterior, row.Interior);
  return MeasureErrors(
    [&geometry, &row](const glm::dvec3& point) -> std::optional<double>
    {
      if (!geometry.HasOneCell(point, ThesisWall))
      {
        return {};
      }
      const VirtualVertex vertex = geometry.SolvePoint(point);
      return vertex.State == ImageState::Found ? FindThesisError(row, point, vertex) : std::nullopt;
    });
}

//------------------------------------------------------------------------------
ErrorStatistics MeasureThesisRowCurved(const ThesisRow& row)
{
  CurvedMembraneSolver geometry;
  geometry.SetMembrane(MakeThesisMesh(row).AsInput());
  geometry.SetEye(GetThesisEye(row), row.Exterior, row.Interior);
  std::vector<VirtualVertex> images;
  return MeasureErrors(
    [&geometry, &images, &row](const glm::dvec3& point) -> std::optional<double>
    {
      geometry.FindImages(point, images);
      return images.size() == 1 ? FindThesisError(row, point, images.front()) : std::nullopt;
    });
}

}
