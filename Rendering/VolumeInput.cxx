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
  const GridView gridView(grid);
  const TetrahedraView& view = gridView.GetView();
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
InputReport VolumeInput::UpdateScalars(vtkDataArray* scalars, int component)
{
  InputReport report;
  const ObjectVersion version(scalars);
  if (version == this->BuiltScalars && component == this->BuiltComponent)
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
        values[v] = component == Magnitude ? LengthOf(scalars, points[v])
                                           : scalars->GetComponent(points[v], component);
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
  this->BuiltComponent = component;
  this->ActiveSetStale = true;
  ++this->ScalarUpdates;
  return report;
}

//------------------------------------------------------------------------------
void VolumeInput::UpdateActiveCells(const VisibleScalars& visible)
{
  if (!this->ActiveSetStale && visible == this->Visible && this->OthersVersion == 0)
  {
    return;
  }
  this->LinkChanges += this->Mesh.UpdateActiveCells(this->Scalars, visible, ThreadedLoop) ? 1 : 0;
  this->Visible = visible;
  this->VisibleOthers.clear();
  this->OthersVersion = 0;
  this->ActiveSetStale = false;
  ++this->ActiveSetBuilds;
}

//------------------------------------------------------------------------------
void VolumeInput::UpdateActiveCells(const VisibleScalars& visible, const OtherValues& others)
{
  if (!this->ActiveSetStale && visible == this->Visible && others.Visible == this->VisibleOthers &&
    others.Version == this->OthersVersion)
  {
    return;
  }
  const auto& cells = this->Mesh.GetCells();
  const std::vector<glm::vec3>& values = *others.Values;
  std::vector<std::uint8_t> active(cells.size());
  ForEachBlock(cells.size(), ThreadedLoop,
    [&](std::size_t, std::size_t first, std::size_t last)
    {
      for (std::size_t c = first; c < last; ++c)
      {
        const auto& v = cells[c].Vertices;
        const auto meets = [](const VisibleScalars& seen, float p, float q, float r, float s) {
          return seen.Meets(std::min({ p, q, r, s }), std::max({ p, q, r, s }));
        };
        const float* s = this->Scalars.data();
        bool seen = meets(visible, s[v[0]], s[v[1]], s[v[2]], s[v[3]]);
        for (std::size_t i = 0; i < others.Visible.size(); ++i)
        {
          const int at = static_cast<int>(i);
          seen = seen ||
            meets(others.Visible[i], values[v[0]][at], values[v[1]][at], values[v[2]][at],
              values[v[3]][at]);
        }
        float sum = 0.0f;
        for (const std::int32_t vertex : v)
        {
          sum += s[vertex] + values[vertex].x;
        }
        active[c] = seen && !std::isnan(sum);
      }
    });
  this->LinkChanges += this->Mesh.SetActiveCells(active, ThreadedLoop) ? 1 : 0;
  this->Visible = visible;
  this->VisibleOthers = others.Visible;
  this->OthersVersion = others.Version;
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
