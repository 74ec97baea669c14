// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "VolumeInput.h"

#include "GridView.h"
#include "Volume/BlockLoop.h"

#include "vtkCellArray.h"
#include "vtkDataArray.h"
#include "vtkPoints.h"
#include "vtkSMPTools.h"
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

/** Blocks of the kernel's loops are large enough to be a thread's unit of work. */
void ThreadedLoop(std::size_t count, const RangeBody& body)
{
  vtkSMPTools::For(0, static_cast<vtkIdType>(count), 1,
    [&body](vtkIdType begin, vtkIdType end)
    { body(static_cast<std::size_t>(begin), static_cast<std::size_t>(end)); });
}

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

}

//------------------------------------------------------------------------------
ObjectVersion::ObjectVersion(vtkObject* object)
  : Object(object)
  , Time(object ? object->GetMTime() : 0)
{
}

//------------------------------------------------------------------------------
bool VolumeInput::MeshVersion::operator==(const MeshVersion& other) const
{
  return this->Points == other.Points && this->Coordinates == other.Coordinates &&
    this->Cells == other.Cells && this->Ghosts == other.Ghosts;
}

//------------------------------------------------------------------------------
InputReport VolumeInput::UpdateMesh(
  vtkUnstructuredGrid* grid, ScalarPlace place, const std::function<bool(double)>& progress)
{
  InputReport report;
  MeshVersion version;
  version.Points = ObjectVersion(grid->GetPoints());
  version.Coordinates = ObjectVersion(grid->GetPoints() ? grid->GetPoints()->GetData() : nullptr);
  version.Cells = ObjectVersion(grid->GetCells());
  version.Ghosts = ObjectVersion(grid->GetCellGhostArray());
  const bool lacksSources = place == ScalarPlace::Cells && !this->KeepsSourceCells;
  if (this->MeshBuilds > 0 && version == this->BuiltMesh && !lacksSources)
  {
    return report;
  }
  this->KeepsSourceCells = this->KeepsSourceCells || lacksSources;

  std::ostringstream text;
  const GridView gridView(grid);
  TetrahedraView view = gridView.GetView();
  view.KeepSourceCells = this->KeepsSourceCells;
  MeshBuildControl control;
  control.Loop = ThreadedLoop;
  control.Progress = progress;
  const MeshStatus status = this->Mesh.Build(view, control);
  // What was aborted is begun again at the next call.
  this->BuiltMesh = status == MeshStatus::Aborted ? MeshVersion() : version;
  this->BuiltScalars = ObjectVersion();
  this->ActiveSetStale = true;
  ++this->MeshBuilds;
  ++this->LinkChanges;

  if (status == MeshStatus::TooLarge)
  {
    text << "A mesh of " << view.NumberOfCells << " cells and " << view.NumberOfPoints
         << " points exceeds the limit of " << TetrahedralMesh::MaximumNumberOfCells
         << " cells and 2^31 points.";
    report.Error = text.str();
    return report;
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
InputReport VolumeInput::UpdateScalars(vtkDataArray* scalars, ScalarPlace place, int component)
{
  InputReport report;
  const ObjectVersion version(scalars);
  if (version == this->BuiltScalars && place == this->BuiltPlace &&
    component == this->BuiltComponent)
  {
    return report;
  }
  const bool ofCells = place == ScalarPlace::Cells;
  const std::vector<std::int32_t>& sources =
    ofCells ? this->Mesh.GetSourceCells() : this->Mesh.GetSourcePoints();
  std::vector<double> values(sources.size());
  std::vector<ValueRange> ranges(NumberOfBlocks(values.size()));
  ForEachBlock(values.size(), ThreadedLoop,
    [&](std::size_t block, std::size_t first, std::size_t last)
    {
      ValueRange range;
      for (std::size_t v = first; v < last; ++v)
      {
        values[v] = component == Magnitude ? LengthOf(scalars, sources[v])
                                           : scalars->GetComponent(sources[v], component);
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
  this->BuiltPlace = place;
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
