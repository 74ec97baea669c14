// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rendering/Input/DividedCells.h"

#include "Common/BlockLoop.h"
#include "Rendering/Input/CellShapes.h"
#include "Rendering/Input/ConcatenatedArray.h"
#include "Rendering/Input/GridLayout.h"
#include "Rendering/Input/PointsSource.h"
#include "Rendering/Input/TetrahedraSource.h"

#include "vtkDataArray.h"
#include "vtkDataSet.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace meniscus
{
namespace
{

bool IsFinite(const glm::dvec3& at)
{
  return std::isfinite(at.x) && std::isfinite(at.y) && std::isfinite(at.z);
}

/** Length of the diagonal of the box around the points that are finite. */
double DiagonalOf(const PointFields& fields)
{
  glm::dvec3 lowest(std::numeric_limits<double>::infinity());
  glm::dvec3 highest(-std::numeric_limits<double>::infinity());
  for (std::int64_t p = 0; p < fields.NumberOfPoints; ++p)
  {
    const glm::dvec3 at = fields.Points[static_cast<std::size_t>(p)];
    lowest = IsFinite(at) ? glm::min(lowest, at) : lowest;
    highest = IsFinite(at) ? glm::max(highest, at) : highest;
  }
  return lowest.x <= highest.x ? glm::length(highest - lowest) : 0.0;
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
    ForEachBlock(values.size(), loop,
      [&](std::size_t, std::size_t first, std::size_t last)
      {
        for (std::size_t p = first; p < last; ++p)
        {
          values[p] = valueOf(static_cast<std::int32_t>(p));
        }
      });
    fields.Values.push_back(std::move(values));
  }
  return fields;
}

/** Smallest and largest value that are finite. */
ScalarRange RangeOf(const PointFields& fields, std::size_t field)
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
    if (std::isfinite(value))
    {
      lowest = std::min(lowest, value);
      highest = std::max(highest, value);
    }
  }
  return lowest <= highest ? ScalarRange{ lowest, highest } : ScalarRange{ 0.0, 0.0 };
}

/** Largest magnitude of the coordinates that are finite. */
double LargestCoordinate(const PointFields& fields)
{
  double most = 0.0;
  for (std::int64_t p = 0; p < fields.NumberOfPoints; ++p)
  {
    const glm::dvec3 at = glm::abs(fields.Points[static_cast<std::size_t>(p)]);
    most = IsFinite(at) ? std::max({ most, at.x, at.y, at.z }) : most;
  }
  return most;
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

/** @param slack factor of the tolerances. */
DivisionLimits LimitsOf(const DivisionSettings& settings, const PointFields& fields, double slack)
{
  DivisionLimits limits;
  limits.Place = std::max(
    slack * settings.PlaceTolerance * DiagonalOf(fields), RoundingOf(LargestCoordinate(fields)));
  limits.MostPieces =
    std::min<std::int64_t>(settings.MostPieces, TetrahedralMesh::MaximumNumberOfCells);
  for (std::size_t field = 0; field < fields.GetNumberOfFields(); ++field)
  {
    const ScalarRange range = RangeOf(fields, field);
    limits.Values[field] =
      std::max(slack * settings.ScalarTolerance * (range.Highest - range.Lowest),
        RoundingOf(std::max(std::abs(range.Lowest), std::abs(range.Highest))));
  }
  return limits;
}

std::vector<vtkDataSet*> GridsOf(const InputBlocks& input)
{
  std::vector<vtkDataSet*> grids;
  for (const InputPart& part : input.Parts)
  {
    grids.push_back(part.Grid);
  }
  return grids;
}

/** The loop, unless a data set must be read by one thread. */
const RangeLoop& LoopFor(const std::vector<vtkDataSet*>& grids, const RangeLoop& loop)
{
  static const RangeLoop serial = SerialLoop;
  return std::all_of(grids.begin(), grids.end(), IsThreadSafe) ? loop : serial;
}

/** True if there are types of cells with shape functions of a higher degree. */
bool MayBeCurved(const std::vector<vtkDataSet*>& grids)
{
  for (vtkDataSet* grid : grids)
  {
    for (vtkIdType cell = 0; cell < grid->GetNumberOfCells(); ++cell)
    {
      if (ShapeOf(grid->GetCellType(cell)).Degree != 0)
      {
        return true;
      }
    }
  }
  return false;
}

/** Tetrahedra between corners as pieces of their cells. */
class PieceCollector
{
public:
  PieceCollector(
    const std::vector<vtkDataSet*>& grids, const TetrahedraView& view, const PointsView& points)
    : Grids(grids)
    , View(view)
    , Points(points)
    , Functions(grids)
  {
  }

  /** Collects all tetrahedra; those with a point out of range are returned in the second list. */
  void Collect(std::vector<CellPiece>& pieces, std::vector<CellPiece>& invalid);
  bool HasCurved() const { return this->Curved; }

private:
  void Load(std::int64_t cell);

  const std::vector<vtkDataSet*>& Grids;
  const TetrahedraView& View;
  const PointsView& Points;
  GridShapeFunctions Functions;
  vtkNew<vtkIdList> Ids;
  /** The cell that was loaded last, and its data set. */
  std::int64_t Loaded = -1;
  std::size_t Part = 0;
  std::int64_t FirstCell = 0;
  std::int64_t FirstPoint = 0;
  CellShape Shape;
  int Degree = 0;
  bool Curved = false;
};

//------------------------------------------------------------------------------
/** Cells are loaded in ascending order. */
void PieceCollector::Load(std::int64_t cell)
{
  if (cell == this->Loaded)
  {
    return;
  }
  this->Loaded = cell;
  while (cell >= this->FirstCell + this->Grids[this->Part]->GetNumberOfCells())
  {
    this->FirstCell += this->Grids[this->Part]->GetNumberOfCells();
    this->FirstPoint += this->Grids[this->Part]->GetNumberOfPoints();
    ++this->Part;
  }
  vtkDataSet* grid = this->Grids[this->Part];
  const auto local = static_cast<vtkIdType>(cell - this->FirstCell);
  this->Shape = ShapeOf(grid->GetCellType(local));
  grid->GetCellPoints(local, this->Ids);
  bool usable = this->Shape.Degree != 0 && this->Shape.IsKnown() &&
    this->Ids->GetNumberOfIds() >= this->Shape.NumberOfCorners;
  for (vtkIdType i = 0; usable && i < this->Ids->GetNumberOfIds(); ++i)
  {
    const vtkIdType id = this->Ids->GetId(i);
    // IsId() returns the first place of an id: another place if the id is repeated.
    usable = id >= 0 && id < grid->GetNumberOfPoints() && this->Ids->IsId(id) == i &&
      IsFinite(this->Points[static_cast<std::size_t>(this->FirstPoint + id)]);
  }
  constexpr int most = 100;
  this->Degree =
    usable ? std::min(this->Functions.GetDegree(static_cast<std::int32_t>(cell)), most) : 0;
}

//------------------------------------------------------------------------------
void PieceCollector::Collect(std::vector<CellPiece>& pieces, std::vector<CellPiece>& invalid)
{
  for (std::int64_t t = 0; t < this->View.NumberOfCells; ++t)
  {
    const std::int64_t cell = this->View.SourceCells[t];
    this->Load(cell);
    CellPiece piece;
    piece.Cell = static_cast<std::int32_t>(cell);
    piece.Degree = static_cast<std::uint8_t>(this->Degree);
    bool valid = true;
    for (std::size_t i = 0; i < 4; ++i)
    {
      const std::int64_t point = this->View.Cells[4 * static_cast<std::size_t>(t) + i];
      valid = valid && point >= 0 && point < this->View.NumberOfPoints;
      // Numbers beyond 32 bits are out of range as well.
      piece.Points[i] = valid ? static_cast<std::int32_t>(point) : -1;
      if (this->Degree > 0)
      {
        piece.Places[i] = PlaceOfCorner(this->Shape,
          static_cast<int>(this->Ids->IsId(static_cast<vtkIdType>(point - this->FirstPoint))));
      }
    }
    (valid ? pieces : invalid).push_back(piece);
    this->Curved = this->Curved || this->Degree > 0;
  }
}

}

//------------------------------------------------------------------------------
std::string DivisionSettings::DescribeFault() const
{
  if (!this->IsAdaptive)
  {
    return std::string();
  }
  // Comparisons that are false for NaN.
  const bool positive = this->PlaceTolerance > 0.0 && this->ScalarTolerance > 0.0;
  if (!positive)
  {
    return "The tolerances of the division of cells must be positive, not " +
      std::to_string(this->PlaceTolerance) + " and " + std::to_string(this->ScalarTolerance);
  }
  return std::string();
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
  const std::vector<vtkDataSet*> grids = GridsOf(request.Fields);
  if (!MayBeCurved(grids))
  {
    return DivisionStatus::Ok;
  }
  const PointsSource points(grids, loop);
  std::vector<CellPiece> pieces;
  std::vector<CellPiece> invalid;
  {
    const TetrahedraSource source(grids, loop, CellPoints::Corners);
    const TetrahedraView& view = source.GetView();
    this->MatchPositions = view.MatchPositions;
    this->Omitted = source.DescribeOmitted();
    this->Unusable = source.GetUnusable();
    this->PositionsDecide = source.SplitsByPosition();
    PieceCollector collector(grids, view, points.GetView());
    collector.Collect(pieces, invalid);
    this->Used = collector.HasCurved();
  }
  if (!this->Used)
  {
    return DivisionStatus::Ok;
  }
  ++this->Divisions;
  const PointFields fields = FieldsOf(request, points, loop);
  const DivisionStatus status = this->Division.Divide(
    std::move(pieces), fields, [&grids]() { return std::make_unique<GridShapeFunctions>(grids); },
    LimitsOf(request.Settings, fields, 1.0), LoopFor(grids, loop), progress);
  if (status != DivisionStatus::Ok)
  {
    return status;
  }
  // The mesh rejects and counts those that are not valid.
  for (const std::vector<CellPiece>* list :
    { &this->Division.GetPieces(), &std::as_const(invalid) })
  {
    for (const CellPiece& piece : *list)
    {
      this->Cells.insert(this->Cells.end(), piece.Points.begin(), piece.Points.end());
      this->Sources.push_back(piece.Cell);
    }
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
  const std::vector<vtkDataSet*> grids = GridsOf(request.Fields);
  const PointsSource points(grids, loop);
  const PointFields fields = FieldsOf(request, points, loop);
  return this->Division.Holds(
    fields, [&grids]() { return std::make_unique<GridShapeFunctions>(grids); },
    LimitsOf(request.Settings, fields, 2.0), LoopFor(grids, loop));
}

//------------------------------------------------------------------------------
std::vector<double> DividedCells::ComputePositions(
  const InputBlocks& input, const RangeLoop& loop) const
{
  return this->ComputePositions(PointsSource(GridsOf(input), loop), loop);
}

//------------------------------------------------------------------------------
std::vector<double> DividedCells::ComputePositions(
  const PointsSource& points, const RangeLoop& loop) const
{
  const PointsView& view = points.GetView();
  const std::int64_t size = points.GetNumberOfPoints() + this->GetPoints().GetSize();
  std::vector<double> positions(3 * static_cast<std::size_t>(size));
  ForEachBlock(static_cast<std::size_t>(size), loop,
    [&](std::size_t, std::size_t first, std::size_t last)
    {
      for (std::size_t p = first; p < last; ++p)
      {
        const glm::dvec3 at = this->GetPoints().Interpolate(static_cast<std::int64_t>(p),
          [&view](std::int32_t point) { return view[static_cast<std::size_t>(point)]; });
        positions[3 * p] = at.x;
        positions[3 * p + 1] = at.y;
        positions[3 * p + 2] = at.z;
      }
    });
  return positions;
}

//------------------------------------------------------------------------------
std::int64_t DividedCells::GetBytes() const
{
  return this->Division.GetBytes() + BytesOf(this->Positions) + BytesOf(this->Cells) +
    BytesOf(this->Sources);
}

}
