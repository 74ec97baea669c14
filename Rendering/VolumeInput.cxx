// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "VolumeInput.h"

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

/** Points and tetrahedra of a grid as plain arrays. */
struct GridArrays
{
  std::vector<double> Points;
  std::vector<std::int64_t> Cells;

  explicit GridArrays(vtkUnstructuredGrid* grid)
    : Points(3 * static_cast<std::size_t>(grid->GetNumberOfPoints()))
  {
    for (vtkIdType p = 0; p < grid->GetNumberOfPoints(); ++p)
    {
      grid->GetPoint(p, this->Points.data() + 3 * p);
    }
    vtkUnsignedCharArray* ghosts = grid->GetCellGhostArray();
    const unsigned char leftOut =
      vtkDataSetAttributes::DUPLICATECELL | vtkDataSetAttributes::HIDDENCELL;
    this->Cells.reserve(4 * static_cast<std::size_t>(grid->GetNumberOfCells()));
    for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c)
    {
      if (ghosts && (ghosts->GetValue(c) & leftOut))
      {
        continue;
      }
      vtkIdType size = 0;
      const vtkIdType* ids = nullptr;
      grid->GetCells()->GetCellAtId(c, size, ids);
      this->Cells.insert(this->Cells.end(), ids, ids + 4);
    }
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
InputReport VolumeInput::UpdateMesh(vtkUnstructuredGrid* grid)
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
  const GridArrays arrays(grid);
  const TetrahedraView view{ arrays.Points.data(), grid->GetNumberOfPoints(), arrays.Cells.data(),
    static_cast<std::int64_t>(arrays.Cells.size() / 4) };
  const MeshStatus status = this->Mesh.Build(view);
  this->BuiltMesh = version;
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
  const std::vector<std::int64_t>& points = this->Mesh.GetSourcePoints();
  std::vector<double> values(points.size());
  double minimum = std::numeric_limits<double>::infinity();
  double maximum = -minimum;
  vtkTypeInt64 notFinite = 0;
  for (std::size_t v = 0; v < points.size(); ++v)
  {
    values[v] = scalars->GetComponent(points[v], 0);
    if (std::isfinite(values[v]))
    {
      minimum = std::min(minimum, values[v]);
      maximum = std::max(maximum, values[v]);
    }
    else
    {
      values[v] = std::numeric_limits<double>::quiet_NaN();
      ++notFinite;
    }
  }
  if (notFinite > 0)
  {
    report.Warning = std::to_string(notFinite) + " of " + std::to_string(values.size()) +
      " scalars are not finite; cells that use them are transparent.";
  }

  this->Normalization = notFinite == static_cast<vtkTypeInt64>(values.size())
    ? ScalarNormalization()
    : NormalizeRange(minimum, maximum);
  this->Scalars.resize(values.size());
  const ScalarNormalization& n = this->Normalization;
  std::transform(values.begin(), values.end(), this->Scalars.begin(),
    [&n](double value) { return static_cast<float>((value - n.Offset) * n.Scale); });
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
