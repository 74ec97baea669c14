// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rendering/Input/DividedCells.h"

#include "Common/BlockLoop.h"
#include "Rendering/Input/CellPieces.h"
#include "Rendering/Input/CellShapes.h"
#include "Rendering/Input/ConcatenatedArray.h"
#include "Rendering/Input/DrawnBounds.h"
#include "Rendering/Input/GridLayout.h"
#include "Rendering/Input/PointsSource.h"
#include "Rendering/Input/TetrahedraSource.h"
#include "Volume/Mesh/PointBox.h"

#include "vtkDataArray.h"
#include "vtkDataSet.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <utility>

namespace meniscus
{
namespace
{

/** Box around the points that are drawn, which are finite. */
PointBox BoxOf(const PointFields& fields, const std::vector<std::uint8_t>& drawn)
{
  PointBox box;
  for (std::size_t p = 0; p < drawn.size(); ++p)
  {
    if (drawn[p] != 0)
    {
      box.Add(fields.Points[p]);
    }
  }
  return box;
}

/** Components of the scalars that count. */
std::vector<int> ComponentsOf(const DivisionRequest& request)
{
  int most = 1;
  for (const InputPart& part : request.Fields.Parts)
  {
    most = std::max(most, part.Scalars->GetNumberOfComponents());
  }
  if (request.Component >= 0)
  {
    return { request.Component };
  }
  const bool ofLength = request.Component == ScalarSelection::Magnitude;
  std::vector<int> components(static_cast<std::size_t>(
    ofLength ? most : std::min(most, static_cast<int>(CellSample::MostFields))));
  std::iota(components.begin(), components.end(), 0);
  return components;
}

PointFields FieldsOf(
  const DivisionRequest& request, const PointsSource& points, const RangeLoop& loop)
{
  PointFields fields;
  fields.Points = points.GetView();
  fields.NumberOfPoints = points.GetNumberOfPoints();
  if (request.Fields.Place == FieldAssociation::Cells)
  {
    return fields;
  }
  const std::vector<int> components = ComponentsOf(request);
  fields.IsLength = request.Component == ScalarSelection::Magnitude && components.size() > 1;
  for (const int component : components)
  {
    const ConcatenatedArray array(request.Fields, component);
    const auto valueOf = [&](std::int32_t point)
    { return fields.IsLength ? array.GetComponent(point, component) : array(point); };
    std::vector<double> values(static_cast<std::size_t>(fields.NumberOfPoints));
    ForEachInBlocks(values.size(), loop,
      [&](std::size_t p) { values[p] = valueOf(static_cast<std::int32_t>(p)); });
    fields.Values.push_back(std::move(values));
  }
  return fields;
}

/** Smallest and largest value of the points that are drawn, of those that are finite. */
ScalarRange RangeOf(
  const PointFields& fields, std::size_t field, const std::vector<std::uint8_t>& drawn)
{
  double lowest = std::numeric_limits<double>::infinity();
  double highest = -lowest;
  for (std::size_t p = 0; p < static_cast<std::size_t>(fields.NumberOfPoints); ++p)
  {
    double value = fields.IsLength ? 0.0 : fields.Values[field][p];
    for (std::size_t i = 0; fields.IsLength && i < fields.Values.size(); ++i)
    {
      value = std::hypot(value, fields.Values[i][p]);
    }
    if (drawn[p] != 0 && std::isfinite(value))
    {
      lowest = std::min(lowest, value);
      highest = std::max(highest, value);
    }
  }
  return lowest <= highest ? ScalarRange{ lowest, highest } : ScalarRange{ 0.0, 0.0 };
}

/**
 * Bound of the rounding error of an interpolated value, for values up to `most` in magnitude. A
 * division cannot resolve smaller differences. In a hexahedron of order 3 a weight takes 23
 * roundings (three cubic polynomials of 7 and two products) and the sum of 64 products 63; the
 * magnitudes of the weights add up to at most 1.64^3 = 4.4, so 379 roundings are the most. Cells of
 * higher orders have larger bounds, but rounding errors do not all have one sign.
 */
double RoundingOf(double most)
{
  return 512.0 * std::numeric_limits<double>::epsilon() * most;
}

DivisionMeasure MeasureFor(const DivisionRequest& request, const PointFields& fields)
{
  // A pixel of a mesh that is 1024 pixels long has the error of a step of 256.
  constexpr double displacement = 4.0;
  DivisionMeasure measure;
  // The error is that of the picture, in which other points and their values have no part.
  const std::vector<std::uint8_t> drawn = MarkDrawnPoints(GetGrids(request.Fields));
  const PointBox box = BoxOf(fields, drawn);
  const double diagonal = box.IsEmpty() ? 0.0 : glm::length(box.Upper - box.Lower);
  const glm::dvec3 farthest =
    box.IsEmpty() ? glm::dvec3(0.0) : glm::max(glm::abs(box.Lower), glm::abs(box.Upper));
  measure.OfPlace = diagonal > 0.0 ? displacement / diagonal : 0.0;
  measure.PlaceRounding = RoundingOf(std::max({ farthest.x, farthest.y, farthest.z }));
  measure.ValuesMayMove = request.Picture.Use != ScalarUse::Values;
  measure.HasSurfaces = request.Picture.Use == ScalarUse::Surfaces;
  for (std::size_t field = 0; field < fields.GetNumberOfFields(); ++field)
  {
    const ScalarRange range = RangeOf(fields, field, drawn);
    measure.OfValues[field] =
      request.Picture.MakeScale(request.UnitLength * diagonal, range.Highest - range.Lowest);
    measure.ValueRounding[field] =
      RoundingOf(std::max(std::abs(range.Lowest), std::abs(range.Highest)));
  }
  return measure;
}

int LeastDegreeOf(const DivisionSettings& settings)
{
  return settings.IsAdaptive ? 1 : CellShape::SecondOrder;
}

/** @param fixedPieces number of pieces before they are divided. */
std::int64_t BudgetOf(const DivisionSettings& settings, std::int64_t fixedPieces)
{
  // By default the cost is bounded by a multiple of the fixed division's cost; pieces that are made
  // within a second do not count.
  constexpr std::int64_t multiple = 2;
  constexpr std::int64_t least = 100000;
  const std::int64_t budget =
    settings.MostPieces > 0 ? settings.MostPieces : std::max(multiple * fixedPieces, least);
  return std::min<std::int64_t>(budget, TetrahedralMesh::MaximumNumberOfCells);
}

/** The loop, unless a data set must be read by one thread. */
const RangeLoop& LoopFor(const std::vector<vtkDataSet*>& grids, const RangeLoop& loop)
{
  static const RangeLoop serial = SerialLoop;
  return std::all_of(grids.begin(), grids.end(), IsThreadSafe) ? loop : serial;
}

}

//------------------------------------------------------------------------------
std::string DivisionSettings::DescribeFault() const
{
  // A comparison that is false for NaN.
  return this->Tolerance > 0.0 ? std::string()
                               : "The tolerance of the division of cells must be positive, not " +
      std::to_string(this->Tolerance);
}

//------------------------------------------------------------------------------
void DividedCells::Clear()
{
  const std::int64_t divisions = this->Divisions;
  *this = DividedCells();
  this->Divisions = divisions;
}

//------------------------------------------------------------------------------
DivisionStatus DividedCells::Divide(const DivisionRequest& request, const RangeLoop& loop,
  const std::function<bool(double)>& progress)
{
  this->Clear();
  const std::vector<vtkDataSet*> grids = GetGrids(request.Fields);
  if (!MayBeCurved(grids))
  {
    return DivisionStatus::Ok;
  }
  const PointsSource points(grids, loop);
  const PointFields fields = FieldsOf(request, points, loop);
  DivisionLimits limits;
  limits.Measure = MeasureFor(request, fields);
  limits.Tolerance = request.Settings.Tolerance;
  this->Curved = FindCurvedCells(grids, fields, limits.Measure, limits.Tolerance,
    LeastDegreeOf(request.Settings), LoopFor(grids, loop));
  if (this->Curved.IsEmpty)
  {
    return DivisionStatus::Ok;
  }
  CellPieces collected;
  {
    const TetrahedraSource source(grids, loop, CellPoints::Corners);
    this->MatchPositions = source.GetView().MatchPositions;
    this->Omitted = source.DescribeOmitted();
    this->Unusable = source.GetUnusable();
    this->PositionsDecide = source.SplitsByPosition();
    collected = CollectPieces(grids, source.GetView(), this->Curved);
  }
  this->Used = true;
  ++this->Divisions;
  const auto others = static_cast<std::int64_t>(collected.OtherCells.size());
  this->Budget =
    BudgetOf(request.Settings, others + static_cast<std::int64_t>(collected.Pieces.size()));
  limits.MostPieces = this->Budget - others;
  const DivisionStatus status = this->Division.Divide(
    std::move(collected.Pieces), fields,
    [&grids]() { return std::make_unique<GridShapeFunctions>(grids); }, limits,
    LoopFor(grids, loop), progress);
  if (status != DivisionStatus::Ok)
  {
    return status;
  }
  // The mesh rejects and counts those with a point out of range.
  this->Cells = std::move(collected.Others);
  this->Sources = std::move(collected.OtherCells);
  for (const CellPiece& piece : this->Division.GetPieces())
  {
    this->Cells.insert(this->Cells.end(), piece.Points.begin(), piece.Points.end());
    this->Sources.push_back(piece.Cell);
  }
  this->Division.ForgetPieces();
  this->Positions = this->ComputePositions(points, loop);
  return status;
}

//------------------------------------------------------------------------------
TetrahedraView DividedCells::GetView() const
{
  TetrahedraView view;
  view.Points = this->Positions.data();
  view.NumberOfPoints = static_cast<std::int64_t>(this->Positions.size() / 3);
  view.ShortCells = this->Cells.data();
  view.NumberOfCells = static_cast<std::int64_t>(this->Sources.size());
  view.SourceCells = this->Sources.data();
  view.KeepSourceCells = true;
  view.MatchPositions = this->MatchPositions;
  return view;
}

//------------------------------------------------------------------------------
void DividedCells::FreeView()
{
  this->Positions = std::vector<double>();
  this->Cells = std::vector<std::int32_t>();
  this->Sources = std::vector<std::int32_t>();
}

//------------------------------------------------------------------------------
bool DividedCells::Holds(const DivisionRequest& request, const RangeLoop& loop) const
{
  const std::vector<vtkDataSet*> grids = GetGrids(request.Fields);
  const PointsSource points(grids, loop);
  const PointFields fields = FieldsOf(request, points, loop);
  const DivisionMeasure measure = MeasureFor(request, fields);
  constexpr double slack = 2.0;
  const double most = slack * std::max(request.Settings.Tolerance, this->GetCounts().Error);
  const ShapeFunctionsMaker functions = [&grids]()
  { return std::make_unique<GridShapeFunctions>(grids); };
  if (!this->Division.Holds(fields, functions, measure, most, LoopFor(grids, loop)))
  {
    return false;
  }
  const CurvedCells curved = FindCurvedCells(
    grids, fields, measure, most, LeastDegreeOf(request.Settings), LoopFor(grids, loop));
  for (std::size_t cell = 0; cell < curved.Degrees.size(); ++cell)
  {
    if (curved.Degrees[cell] > 0 &&
      (this->Curved.Degrees.empty() || this->Curved.Degrees[cell] == 0))
    {
      return false;
    }
  }
  return true;
}

//------------------------------------------------------------------------------
std::vector<double> DividedCells::ComputePositions(
  const InputBlocks& input, const RangeLoop& loop) const
{
  return this->ComputePositions(PointsSource(GetGrids(input), loop), loop);
}

//------------------------------------------------------------------------------
std::vector<double> DividedCells::ComputePositions(
  const PointsSource& points, const RangeLoop& loop) const
{
  const PointsView& view = points.GetView();
  const std::int64_t size = points.GetNumberOfPoints() + this->GetPoints().GetSize();
  std::vector<double> positions(3 * static_cast<std::size_t>(size));
  ForEachInBlocks(static_cast<std::size_t>(size), loop,
    [&](std::size_t p)
    {
      const glm::dvec3 at = this->GetPoints().Interpolate(static_cast<std::int64_t>(p),
        [&view](std::int32_t point) { return view[static_cast<std::size_t>(point)]; });
      positions[3 * p] = at.x;
      positions[3 * p + 1] = at.y;
      positions[3 * p + 2] = at.z;
    });
  return positions;
}

//------------------------------------------------------------------------------
std::int64_t DividedCells::GetBytes() const
{
  return this->Division.GetBytes() + BytesOf(this->Positions) + BytesOf(this->Cells) +
    BytesOf(this->Sources) + BytesOf(this->Curved.Degrees);
}

}
