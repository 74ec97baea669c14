// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "VolumeInput.h"

#include "GridView.h"
#include "ThreadedLoop.h"
#include "Volume/BlockLoop.h"

#include "vtkCellArray.h"
#include "vtkDataArray.h"
#include "vtkExplicitStructuredGrid.h"
#include "vtkImageData.h"
#include "vtkMatrix3x3.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkRectilinearGrid.h"
#include "vtkStructuredGrid.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace meniscus
{
namespace
{

/** Length of a tuple, without overflow on the way. */
double LengthOf(vtkDataArray* array, vtkIdType tuple)
{
  double length = 0.0;
  for (int component = 0; component < array->GetNumberOfComponents(); ++component)
  {
    length = std::hypot(length, array->GetComponent(tuple, component));
  }
  return length;
}

/** The range of the finite values among some, and how many others there are. */
struct ValueRange
{
  double Lowest = std::numeric_limits<double>::infinity();
  double Highest = -std::numeric_limits<double>::infinity();
  std::int64_t NotFinite = 0;

  void Add(double value)
  {
    if (std::isfinite(value))
    {
      this->Lowest = std::min(this->Lowest, value);
      this->Highest = std::max(this->Highest, value);
    }
    else
    {
      ++this->NotFinite;
    }
  }
  void Add(const ValueRange& other)
  {
    this->Lowest = std::min(this->Lowest, other.Lowest);
    this->Highest = std::max(this->Highest, other.Highest);
    this->NotFinite += other.NotFinite;
  }
};

/** The arrays of all parts as one, by numbers that run through them. */
class ValuesOfParts
{
public:
  ValuesOfParts(const InputParts& input, int component)
    : Input(input)
    , Component(component == ScalarSelection::Only ? 0 : component)
  {
    std::int64_t next = 0;
    for (const InputPart& part : input.Parts)
    {
      this->Firsts.push_back(next);
      next += part.Scalars->GetNumberOfTuples();
    }
  }

  double operator()(std::int32_t number) const
  {
    const auto after = std::upper_bound(this->Firsts.begin() + 1, this->Firsts.end(), number);
    const auto part = static_cast<std::size_t>(after - this->Firsts.begin()) - 1;
    vtkDataArray* array = this->Input.Parts[part].Scalars;
    const auto tuple = static_cast<vtkIdType>(number - this->Firsts[part]);
    return this->Component == ScalarSelection::Magnitude
      ? LengthOf(array, tuple)
      : array->GetComponent(tuple, this->Component);
  }

private:
  const InputParts& Input;
  int Component;
  std::vector<std::int64_t> Firsts;
};

}

//------------------------------------------------------------------------------
ObjectVersion::ObjectVersion(vtkObject* object)
  : Object(object)
  , Time(object ? object->GetMTime() : 0)
{
}

//------------------------------------------------------------------------------
void VolumeInput::MeshVersion::Add(vtkDataSet* grid)
{
  const auto add = [this](vtkObject* object) { this->Objects.emplace_back(object); };
  const auto addNumbers = [this](const auto* first, int count)
  { this->Numbers.insert(this->Numbers.end(), first, first + count); };
  add(grid->GetCellGhostArray());
  add(grid->GetPointGhostArray());
  if (auto* set = vtkPointSet::SafeDownCast(grid))
  {
    add(set->GetPoints());
    add(set->GetPoints() ? set->GetPoints()->GetData() : nullptr);
  }
  if (auto* unstructured = vtkUnstructuredGrid::SafeDownCast(grid))
  {
    add(unstructured->GetCells());
    add(unstructured->GetFaces());
  }
  else if (auto* structured = vtkStructuredGrid::SafeDownCast(grid))
  {
    addNumbers(structured->GetExtent(), 6);
  }
  else if (auto* rectilinear = vtkRectilinearGrid::SafeDownCast(grid))
  {
    add(rectilinear->GetXCoordinates());
    add(rectilinear->GetYCoordinates());
    add(rectilinear->GetZCoordinates());
    addNumbers(rectilinear->GetExtent(), 6);
  }
  else if (auto* image = vtkImageData::SafeDownCast(grid))
  {
    addNumbers(image->GetExtent(), 6);
    addNumbers(image->GetOrigin(), 3);
    addNumbers(image->GetSpacing(), 3);
    addNumbers(image->GetDirectionMatrix()->GetData(), 9);
  }
  else
  {
    add(grid);
  }
}

//------------------------------------------------------------------------------
InputReport VolumeInput::UpdateMesh(
  const InputParts& input, const std::function<bool(double)>& progress)
{
  MeshVersion version;
  std::vector<vtkDataSet*> grids;
  for (const InputPart& part : input.Parts)
  {
    version.Add(part.Grid);
    grids.push_back(part.Grid);
  }
  const bool lacksSources = input.Place == ScalarPlace::Cells && !this->KeepsSourceCells;
  if (this->MeshBuilds > 0 && version == this->BuiltMesh && !lacksSources)
  {
    return InputReport();
  }
  this->KeepsSourceCells = this->KeepsSourceCells || lacksSources;
  this->BuiltMesh = version;
  return this->BuildMesh(grids, progress);
}

//------------------------------------------------------------------------------
InputReport VolumeInput::BuildMesh(
  const std::vector<vtkDataSet*>& grids, const std::function<bool(double)>& progress)
{
  this->BuiltScalars.clear();
  this->ActiveSetStale = true;
  ++this->MeshBuilds;
  ++this->LinkChanges;

  InputReport report;
  std::ostringstream text;
  const GridSize size = MeasureGrids(grids);
  if (size.Tetrahedra > TetrahedralMesh::MaximumNumberOfCells ||
    size.Points > std::numeric_limits<std::int32_t>::max())
  {
    this->Mesh = TetrahedralMesh();
    text << "A mesh of " << size.Tetrahedra << " tetrahedra and " << size.Points
         << " points exceeds the limit of " << TetrahedralMesh::MaximumNumberOfCells
         << " tetrahedra and 2^31 points";
    report.Error = text.str();
    return report;
  }
  const GridView gridView(grids, ThreadedLoop);
  TetrahedraView view = gridView.GetView();
  view.KeepSourceCells = this->KeepsSourceCells;
  MeshBuildControl control;
  control.Loop = ThreadedLoop;
  control.Progress = progress;
  if (this->Mesh.Build(view, control) == MeshStatus::Aborted)
  {
    this->BuiltMesh = MeshVersion(); // begun again at the next call
  }
  const std::string omitted = gridView.DescribeOmitted();
  if (!omitted.empty())
  {
    text << "Cells that are not drawn, because of their type: " << omitted << ". ";
    report.Warning = text.str();
  }
  const RejectedCells& rejected = this->Mesh.GetRejectedCells();
  if (rejected.Total() > 0)
  {
    text << rejected.Total() << " of " << view.NumberOfCells
         << " cells are left out: " << rejected.IndexOutOfRange
         << " with a point index out of range, " << rejected.RepeatedVertex
         << " with a repeated point, " << rejected.PointNotFinite
         << " with a point that is not finite.";
    report.Warning = text.str();
  }
  return report;
}

//------------------------------------------------------------------------------
InputReport VolumeInput::UpdateScalars(const InputParts& input, int component)
{
  InputReport report;
  std::vector<ObjectVersion> version;
  for (const InputPart& part : input.Parts)
  {
    version.emplace_back(part.Scalars);
  }
  if (version == this->BuiltScalars && input.Place == this->BuiltPlace &&
    component == this->BuiltComponent)
  {
    return report;
  }
  const bool ofCells = input.Place == ScalarPlace::Cells;
  const std::vector<std::int32_t>& sources =
    ofCells ? this->Mesh.GetSourceCells() : this->Mesh.GetSourcePoints();
  const ValuesOfParts valueOf(input, component);
  std::vector<double> values(sources.size());
  std::vector<ValueRange> ranges(NumberOfBlocks(values.size()));
  ForEachBlock(values.size(), ThreadedLoop,
    [&](std::size_t block, std::size_t first, std::size_t last)
    {
      ValueRange range;
      for (std::size_t v = first; v < last; ++v)
      {
        values[v] = valueOf(sources[v]);
        range.Add(values[v]);
      }
      ranges[block] = range;
    });
  ValueRange range;
  for (const ValueRange& part : ranges)
  {
    range.Add(part);
  }
  const std::int64_t notFinite = range.NotFinite;
  if (notFinite > 0)
  {
    report.Warning = std::to_string(notFinite) + " of " + std::to_string(values.size()) +
      " scalars of the " + (ofCells ? "tetrahedra" : "vertices") +
      " are not finite; cells that use them are transparent.";
  }

  this->Normalization = notFinite == static_cast<std::int64_t>(values.size())
    ? ScalarNormalization()
    : NormalizeRange(range.Lowest, range.Highest);
  this->Scalars.clear();
  this->CellScalars.clear();
  std::vector<float>& normalized = ofCells ? this->CellScalars : this->Scalars;
  normalized.resize(values.size());
  ForEachBlock(values.size(), ThreadedLoop,
    [&](std::size_t, std::size_t first, std::size_t last)
    {
      const ScalarNormalization& n = this->Normalization;
      for (std::size_t v = first; v < last; ++v)
      {
        normalized[v] = std::isfinite(values[v])
          ? static_cast<float>((values[v] - n.Offset) * n.Scale)
          : std::numeric_limits<float>::quiet_NaN();
      }
    });
  this->BuiltScalars = version;
  this->BuiltPlace = input.Place;
  this->BuiltComponent = component;
  this->ActiveSetStale = true;
  ++this->ScalarUpdates;
  return report;
}

//------------------------------------------------------------------------------
void VolumeInput::UpdateActiveCells(const VisibleScalars& visible, TetrahedralMesh::CellJumps jumps)
{
  if (!this->ActiveSetStale && visible == this->Visible && jumps == this->Jumps)
  {
    return;
  }
  const bool changed = this->BuiltPlace == ScalarPlace::Cells
    ? this->Mesh.UpdateActiveCells(this->CellScalars, jumps, visible, ThreadedLoop)
    : this->Mesh.UpdateActiveCells(this->Scalars, visible, ThreadedLoop);
  this->LinkChanges += changed ? 1 : 0;
  this->Visible = visible;
  this->Jumps = jumps;
  this->ActiveSetStale = false;
  ++this->ActiveSetBuilds;
}

//------------------------------------------------------------------------------
std::int64_t VolumeInput::GetBytes() const
{
  return this->Mesh.GetBytes() + BytesOf(this->Scalars) + BytesOf(this->CellScalars) +
    BytesOf(this->Tree.GetNodes()) + BytesOf(this->Tree.GetFaces());
}

//------------------------------------------------------------------------------
const BoundaryTree& VolumeInput::GetBoundaryTree()
{
  if (this->TreeOf != this->LinkChanges)
  {
    this->Tree.Build(this->Mesh);
    this->TreeOf = this->LinkChanges;
  }
  return this->Tree;
}

}
