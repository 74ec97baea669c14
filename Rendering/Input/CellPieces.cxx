// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rendering/Input/CellPieces.h"

#include "Common/BlockLoop.h"
#include "Rendering/Input/CellReader.h"
#include "Rendering/Input/CellShapes.h"
#include "Rendering/Input/GridLayout.h"
#include "Volume/Division/ShapeTest.h"
#include "Volume/Mesh/PointBox.h"

#include "vtkCellType.h"
#include "vtkDataSet.h"
#include "vtkIdList.h"
#include "vtkNew.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

namespace meniscus
{
namespace
{

/** Corners of the cells of data sets, which are numbered consecutively; for one thread. */
class CornerReader
{
public:
  explicit CornerReader(const std::vector<vtkDataSet*>& grids)
    : Grids(grids)
  {
    for (vtkDataSet* grid : grids)
    {
      this->Readers.emplace_back(grid);
    }
  }

  /** Loads a cell. Cells in ascending order are found fastest. */
  void Load(std::int64_t cell)
  {
    if (cell < this->FirstCell)
    {
      this->Part = 0;
      this->FirstCell = 0;
      this->FirstPoint = 0;
    }
    while (cell >= this->FirstCell + this->Grids[this->Part]->GetNumberOfCells())
    {
      this->FirstCell += this->Grids[this->Part]->GetNumberOfCells();
      this->FirstPoint += this->Grids[this->Part]->GetNumberOfPoints();
      ++this->Part;
    }
    const auto local = static_cast<vtkIdType>(cell - this->FirstCell);
    const CellReader& cells = this->Readers[this->Part];
    const int type = cells.GetType(local);
    UnusableCells counted; // TetrahedraSource reports them
    const bool isRead =
      HasVolume(type) && type != VTK_POLYHEDRON && cells.ReadPoints(local, this->Ids, counted);
    this->Shape =
      isRead ? ShapeOf(ResolveCellType(type, this->Ids->GetNumberOfIds())) : CellShape();
  }

  const CellShape& GetShape() const { return this->Shape; }
  /** Number of a corner's point in all data sets. */
  std::size_t PointOf(int corner) const
  {
    return static_cast<std::size_t>(this->FirstPoint + this->Ids->GetId(corner));
  }
  /** Corner at a point. */
  int CornerAt(std::int64_t point) const
  {
    return static_cast<int>(this->Ids->IsId(static_cast<vtkIdType>(point - this->FirstPoint)));
  }
  /** False if a point is repeated, out of range or not finite. */
  bool IsUsable(const PointsView& points) const;

private:
  const std::vector<vtkDataSet*>& Grids;
  std::vector<CellReader> Readers;
  vtkNew<vtkIdList> Ids;
  CellShape Shape;
  std::size_t Part = 0;
  std::int64_t FirstCell = 0;
  std::int64_t FirstPoint = 0;
};

//------------------------------------------------------------------------------
bool CornerReader::IsUsable(const PointsView& points) const
{
  bool usable = this->Shape.IsKnown() && this->Ids->GetNumberOfIds() >= this->Shape.NumberOfCorners;
  for (vtkIdType i = 0; usable && i < this->Ids->GetNumberOfIds(); ++i)
  {
    const vtkIdType id = this->Ids->GetId(i);
    // IsId() returns the first place of an id: another place if the id is repeated.
    usable = id >= 0 && id < this->Grids[this->Part]->GetNumberOfPoints() &&
      this->Ids->IsId(id) == i && IsFinite(points[static_cast<std::size_t>(this->FirstPoint + id)]);
  }
  return usable;
}

/** Measures cells of degree 1 that are drawn by tetrahedra; for one thread. */
class CellMeasure
{
public:
  CellMeasure(
    const PointFields& fields, const ShapeFunctionsMaker& functions, const DivisionMeasure& measure)
    : Fields(fields)
    , Measure(measure)
    , Test(fields, functions, measure)
  {
  }

  /**
   * Largest error of the straight lines between corners, or a bound of it within the limit; above
   * the limit, the first error that is found there.
   */
  double ErrorOf(std::int32_t cell, const CornerReader& reader, double most);

private:
  double BoundOf(const CornerReader& reader, double most) const;

  const PointFields& Fields;
  const DivisionMeasure& Measure;
  ShapeTest Test;
};

//------------------------------------------------------------------------------
double CellMeasure::ErrorOf(std::int32_t cell, const CornerReader& reader, double most)
{
  const double bound = this->BoundOf(reader, most);
  if (bound <= most)
  {
    return bound;
  }
  const CellShape& shape = reader.GetShape();
  double largest = 0.0;
  for (int a = 0; a < shape.NumberOfCorners && largest <= most; ++a)
  {
    for (int b = a + 1; b < shape.NumberOfCorners && largest <= most; ++b)
    {
      largest = std::max(largest,
        this->Test.MeasureEdge(cell, PlaceOfCorner(shape, a), PlaceOfCorner(shape, b), LeastParts));
    }
  }
  return largest;
}

/** Deviation of a trilinear function from its chords, at most: of values, or of positions. */
template <typename Value, typename LengthOf>
double BoundDeviation(const std::array<Value, 8>& f, const LengthOf& lengthOf)
{
  // Coefficients of x y, x z, y z and x y z. Along a straight line in the unit cube, a product of
  // two coordinates differs from its chord by 1/4 at most, and that of three by 3/4: its second
  // derivative is the sum of six products of numbers up to 1, an eighth of which is the bound.
  const Value xy = f[3] - f[1] - f[2] + f[0];
  const Value xz = f[5] - f[1] - f[4] + f[0];
  const Value yz = f[6] - f[2] - f[4] + f[0];
  const Value xyz = f[7] - f[3] - f[5] - f[6] + f[1] + f[2] + f[4] - f[0];
  return 0.25 * (lengthOf(xy) + lengthOf(xz) + lengthOf(yz)) + 0.75 * lengthOf(xyz);
}

//------------------------------------------------------------------------------
/** A bound in closed form for voxels and hexahedra; infinite if it is above the limit. */
double CellMeasure::BoundOf(const CornerReader& reader, double most) const
{
  constexpr double none = std::numeric_limits<double>::infinity();
  const CellShape& shape = reader.GetShape();
  const bool isTrilinear = shape.LinearType == VTK_VOXEL || shape.LinearType == VTK_HEXAHEDRON;
  if (!isTrilinear || this->Fields.IsLength)
  {
    return none;
  }
  std::array<std::size_t, 8> points{};
  for (int corner = 0; corner < 8; ++corner)
  {
    const glm::dvec3 place = PlaceOfCorner(shape, corner);
    points[static_cast<std::size_t>(place.x + 2.0 * place.y + 4.0 * place.z)] =
      reader.PointOf(corner);
  }
  std::array<glm::dvec3, 8> positions;
  std::transform(points.begin(), points.end(), positions.begin(),
    [this](std::size_t point) { return this->Fields.Points[point]; });
  const double displacement =
    BoundDeviation(positions, [](const glm::dvec3& v) { return glm::length(v); });
  double largest =
    displacement > this->Measure.PlaceRounding ? displacement * this->Measure.OfPlace : 0.0;
  if (largest > most)
  {
    return none;
  }
  double shortest = std::numeric_limits<double>::infinity();
  for (std::size_t a = 0; displacement > 0.0 && a < 8; ++a)
  {
    for (std::size_t b = a + 1; b < 8; ++b)
    {
      shortest = std::min(shortest, glm::distance(positions[a], positions[b]));
    }
  }
  for (std::size_t field = 0; field < this->Fields.Values.size(); ++field)
  {
    std::array<double, 8> values{};
    std::transform(points.begin(), points.end(), values.begin(),
      [this, field](std::size_t point) { return this->Fields.Values[field][point]; });
    const auto ends = std::minmax_element(values.begin(), values.end());
    // A place that is displaced along a chord shows the value of another place of it.
    const double slide =
      displacement > 0.0 ? (*ends.second - *ends.first) * displacement / shortest : 0.0;
    const double deviation =
      BoundDeviation(values, [](double value) { return std::abs(value); }) + slide;
    if (deviation > this->Measure.ValueRounding[field])
    {
      const double bound =
        this->Measure.OfValues[field].Bound(*ends.first, *ends.second, deviation);
      largest = bound <= most ? std::max(largest, bound) : none;
    }
  }
  return largest;
}

}

//------------------------------------------------------------------------------
bool MayBeCurved(const std::vector<vtkDataSet*>& grids)
{
  vtkNew<vtkIdList> ids;
  for (vtkDataSet* grid : grids)
  {
    const CellReader cells(grid);
    for (vtkIdType cell = 0; cell < grid->GetNumberOfCells(); ++cell)
    {
      CellShape shape = ShapeOf(cells.GetType(cell));
      UnusableCells counted;
      if (shape.Degree == CellShape::Varying && cells.ReadPoints(cell, ids, counted))
      {
        shape = ShapeOf(ResolveCellType(cells.GetType(cell), ids->GetNumberOfIds()));
      }
      if (shape.Degree != 0)
      {
        return true;
      }
    }
  }
  return false;
}

//------------------------------------------------------------------------------
CurvedCells FindCurvedCells(const std::vector<vtkDataSet*>& grids, const PointFields& fields,
  const DivisionMeasure& measure, double most, int leastDegree, const RangeLoop& loop)
{
  std::size_t cells = 0;
  for (vtkDataSet* grid : grids)
  {
    cells += static_cast<std::size_t>(grid->GetNumberOfCells());
  }
  CurvedCells curved;
  curved.Degrees.assign(cells, 0);
  std::vector<std::uint8_t> any(NumberOfBlocks(cells), 0);
  std::vector<double> errors(any.size(), 0.0);
  ForEachBlock(cells, loop,
    [&](std::size_t block, std::size_t first, std::size_t last)
    {
      const ShapeFunctionsMaker functions = [&grids]()
      { return std::make_unique<GridShapeFunctions>(grids); };
      GridShapeFunctions degrees(grids);
      CellMeasure cellMeasure(fields, functions, measure);
      CornerReader reader(grids);
      constexpr int highest = 100;
      for (std::size_t c = first; c < last; ++c)
      {
        const auto cell = static_cast<std::int32_t>(c);
        reader.Load(cell);
        const int known = reader.GetShape().Degree;
        if (known == 0 || (known > 0 && known < leastDegree) || !reader.IsUsable(fields.Points))
        {
          continue;
        }
        const int degree = known > 0 ? known : degrees.GetDegree(cell);
        const double error =
          degree == 1 && leastDegree == 1 ? cellMeasure.ErrorOf(cell, reader, most) : 0.0;
        errors[block] = error <= most ? std::max(errors[block], error) : errors[block];
        if (degree >= leastDegree && (degree > 1 || error > most))
        {
          curved.Degrees[c] = static_cast<std::uint8_t>(std::min(degree, highest));
          any[block] = 1;
        }
      }
    });
  curved.IsEmpty = std::count(any.begin(), any.end(), 1) == 0;
  curved.Error = errors.empty() ? 0.0 : *std::max_element(errors.begin(), errors.end());
  return curved;
}

//------------------------------------------------------------------------------
CellPieces CollectPieces(
  const std::vector<vtkDataSet*>& grids, const TetrahedraView& view, const CurvedCells& curved)
{
  const auto pointOf = [&view](std::int64_t t, std::size_t i)
  {
    const std::int64_t point = view.Cells[4 * static_cast<std::size_t>(t) + i];
    // Numbers beyond 32 bits are out of range as well.
    return point >= 0 && point < view.NumberOfPoints ? static_cast<std::int32_t>(point) : -1;
  };
  const auto degreeOf = [&](std::int64_t t)
  { return curved.Degrees[static_cast<std::size_t>(view.SourceCells[t])]; };
  // An edge is divided only if it is one of a curved cell: a new point lies within such a cell.
  std::vector<std::uint8_t> touched(static_cast<std::size_t>(view.NumberOfPoints), 0);
  for (std::int64_t t = 0; t < view.NumberOfCells; ++t)
  {
    for (std::size_t i = 0; degreeOf(t) > 0 && i < 4; ++i)
    {
      touched[static_cast<std::size_t>(pointOf(t, i))] = 1;
    }
  }
  CellPieces collected;
  CornerReader reader(grids);
  std::int64_t loaded = -1;
  for (std::int64_t t = 0; t < view.NumberOfCells; ++t)
  {
    CellPiece piece;
    piece.Cell = view.SourceCells[t];
    piece.Degree = degreeOf(t);
    bool valid = true;
    int shared = 0;
    for (std::size_t i = 0; i < 4; ++i)
    {
      piece.Points[i] = pointOf(t, i);
      valid = valid && piece.Points[i] >= 0;
      shared += valid && touched[static_cast<std::size_t>(piece.Points[i])] != 0;
    }
    if (!valid || shared < 2)
    {
      collected.Others.insert(collected.Others.end(), piece.Points.begin(), piece.Points.end());
      collected.OtherCells.push_back(piece.Cell);
      continue;
    }
    if (piece.Degree > 0 && loaded != piece.Cell)
    {
      reader.Load(piece.Cell);
      loaded = piece.Cell;
    }
    for (std::size_t i = 0; piece.Degree > 0 && i < 4; ++i)
    {
      piece.Places[i] = PlaceOfCorner(reader.GetShape(), reader.CornerAt(piece.Points[i]));
    }
    collected.Pieces.push_back(piece);
  }
  return collected;
}

}
