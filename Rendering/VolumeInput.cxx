// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "VolumeInput.h"

#include "Volume/BlockLoop.h"

#include "vtkAOSDataArrayTemplate.h"
#include "vtkCellArray.h"
#include "vtkCellType.h"
#include "vtkCellTypes.h"
#include "vtkDataArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkPoints.h"
#include "vtkSMPTools.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
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

/** Cell types other than tetrahedra with their numbers, as text; empty if there are none. */
std::string DescribeOtherCells(vtkUnstructuredGrid* grid)
{
  std::map<int, vtkIdType> others;
  for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c)
  {
    const int type = grid->GetCellType(c);
    if (type != VTK_TETRA)
    {
      ++others[type];
    }
  }
  std::ostringstream text;
  for (const auto& other : others)
  {
    const char* name = vtkCellTypes::GetClassNameFromTypeId(other.first);
    text << (text.tellp() > 0 ? ", " : "") << other.second << " " << (name ? name : "unknown");
  }
  return text.str();
}

/** Points and tetrahedra of a grid where they are stored; copied only if stored otherwise. */
class GridView
{
public:
  explicit GridView(vtkUnstructuredGrid* grid)
  {
    this->View.NumberOfPoints = grid->GetNumberOfPoints();
    this->View.NumberOfCells = grid->GetNumberOfCells();
    this->ViewPoints(grid->GetPoints()->GetData());
    this->ViewCells(grid->GetCells()->GetConnectivityArray());
    if (vtkUnsignedCharArray* ghosts = grid->GetCellGhostArray())
    {
      this->View.CellFlags = ghosts->GetPointer(0);
      this->View.LeftOutBits =
        vtkDataSetAttributes::DUPLICATECELL | vtkDataSetAttributes::HIDDENCELL;
    }
  }

  TetrahedraView View;

private:
  void ViewPoints(vtkDataArray* points)
  {
    if (auto* doubles = vtkAOSDataArrayTemplate<double>::FastDownCast(points))
    {
      this->View.Points = doubles->GetPointer(0);
    }
    else if (auto* floats = vtkAOSDataArrayTemplate<float>::FastDownCast(points))
    {
      this->View.FloatPoints = floats->GetPointer(0);
    }
    else
    {
      this->Points = CopyValues<double>(points);
      this->View.Points = this->Points.data();
    }
  }

  void ViewCells(vtkDataArray* ids)
  {
    if (auto* longs = vtkAOSDataArrayTemplate<vtkTypeInt64>::FastDownCast(ids))
    {
      // VTK's 64-bit integer and the standard's may have two names.
      static_assert(sizeof(vtkTypeInt64) == sizeof(std::int64_t), "both have 64 bits");
      this->View.Cells = reinterpret_cast<const std::int64_t*>(longs->GetPointer(0));
    }
    else if (auto* ints = vtkAOSDataArrayTemplate<vtkTypeInt32>::FastDownCast(ids))
    {
      this->View.ShortCells = ints->GetPointer(0);
    }
    else
    {
      this->Ids = CopyValues<std::int64_t>(ids);
      this->View.Cells = this->Ids.data();
    }
  }

  template <typename T>
  static std::vector<T> CopyValues(vtkDataArray* array)
  {
    const int components = array->GetNumberOfComponents();
    std::vector<T> values(components * array->GetNumberOfTuples());
    for (std::size_t i = 0; i < values.size(); ++i)
    {
      values[i] = static_cast<T>(array->GetComponent(i / components, i % components));
    }
    return values;
  }

  std::vector<double> Points;
  std::vector<std::int64_t> Ids;
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
  vtkUnstructuredGrid* grid, const std::function<bool(double)>& progress)
{
  InputReport report;
  MeshVersion version;
  version.Points = ObjectVersion(grid->GetPoints());
  version.Coordinates = ObjectVersion(grid->GetPoints() ? grid->GetPoints()->GetData() : nullptr);
  version.Cells = ObjectVersion(grid->GetCells());
  version.Ghosts = ObjectVersion(grid->GetCellGhostArray());
  if (this->MeshBuilds > 0 && version == this->BuiltMesh)
  {
    return report;
  }

  std::ostringstream text;
  const std::string others = DescribeOtherCells(grid);
  if (!others.empty())
  {
    text << "Only tetrahedra can be rendered, the input also has " << others
         << ". Put a vtkDataSetTriangleFilter with TetrahedraOnlyOn before the mapper.";
    report.Error = text.str();
    return report;
  }
  const GridView gridView(grid);
  const TetrahedraView& view = gridView.View;
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
InputReport VolumeInput::UpdateScalars(vtkDataArray* scalars)
{
  InputReport report;
  const ObjectVersion version(scalars);
  if (version == this->BuiltScalars)
  {
    return report;
  }
  const std::vector<std::int32_t>& points = this->Mesh.GetSourcePoints();
  std::vector<double> values(points.size());
  std::vector<ValueRange> ranges(NumberOfBlocks(values.size()));
  ForEachBlock(values.size(), ThreadedLoop,
    [&](std::size_t block, std::size_t first, std::size_t last)
    {
      ValueRange range;
      for (std::size_t v = first; v < last; ++v)
      {
        values[v] = scalars->GetComponent(points[v], 0);
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
      " scalars are not finite; cells that use them are transparent.";
  }

  this->Normalization = notFinite == static_cast<std::int64_t>(values.size())
    ? ScalarNormalization()
    : NormalizeRange(range.Lowest, range.Highest);
  this->Scalars.resize(values.size());
  ForEachBlock(values.size(), ThreadedLoop,
    [&](std::size_t, std::size_t first, std::size_t last)
    {
      const ScalarNormalization& n = this->Normalization;
      for (std::size_t v = first; v < last; ++v)
      {
        this->Scalars[v] = std::isfinite(values[v])
          ? static_cast<float>((values[v] - n.Offset) * n.Scale)
          : std::numeric_limits<float>::quiet_NaN();
      }
    });
  this->BuiltScalars = version;
  this->ActiveSetStale = true;
  ++this->ScalarUpdates;
  return report;
}

//------------------------------------------------------------------------------
void VolumeInput::UpdateActiveCells(const VisibleScalars& visible)
{
  if (!this->ActiveSetStale && visible == this->Visible)
  {
    return;
  }
  this->LinkChanges += this->Mesh.UpdateActiveCells(this->Scalars, visible, ThreadedLoop) ? 1 : 0;
  this->Visible = visible;
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
