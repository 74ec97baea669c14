// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rendering/Input/CellReader.h"

#include "Common/BlockLoop.h"
#include "Filters/Common/ThreadedLoop.h"
#include "Rendering/Common/VTKVersions.h"
#include "Rendering/Input/CellShapes.h"
#include "Rendering/Input/GridLayout.h"

#include "vtkAOSDataArrayTemplate.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCellType.h"
#include "vtkDataSet.h"
#include "vtkDataSetAttributes.h"
#include "vtkExplicitStructuredGrid.h"
#include "vtkIdList.h"
#include "vtkPointData.h"
#include "vtkUnsignedCharArray.h"

#include <atomic>
#include <sstream>

namespace meniscus
{
namespace
{

constexpr vtkIdType PointsOfTetrahedron = 4;

/** Number of points of a tetrahedron, a hexahedron or a wedge of some degree along its axes. */
double PointsOfDegrees(int type, double p, double q, double r)
{
  switch (ShapeOf(type).LinearType)
  {
    case VTK_TETRA:
      return (p + 1) * (p + 2) * (p + 3) / 6;
    case VTK_WEDGE:
      return (p + 1) * (p + 2) / 2 * (r + 1);
    default:
      return (p + 1) * (q + 1) * (r + 1);
  }
}

/** True if a cell of one degree along all axes has this number of points. */
bool FitsOneDegree(int type, vtkIdType size)
{
  // Points of degree 2 with points in the middle of the faces and the cell.
  const bool isTetrahedron = ShapeOf(type).LinearType == VTK_TETRA;
  const bool isWedge = ShapeOf(type).LinearType == VTK_WEDGE;
  if ((isTetrahedron && size == 15) || (isWedge && size == 21))
  {
    return true;
  }
  double degree = 1.0;
  while (PointsOfDegrees(type, degree, degree, degree) < static_cast<double>(size))
  {
    degree += 1.0;
  }
  return PointsOfDegrees(type, degree, degree, degree) == static_cast<double>(size);
}

std::string DescribeSizes(
  const char* what, std::int64_t size, const char* of, std::int64_t expected)
{
  std::ostringstream text;
  text << "A data set has " << size << " " << what << " for " << expected << " " << of;
  return text.str();
}

/** Fault of the coordinates of structured data. */
std::string DescribeStructure(vtkDataSet* grid)
{
  if (auto* rectilinear = vtkRectilinearGrid::SafeDownCast(grid))
  {
    vtkDataArray* coordinates[3] = { rectilinear->GetXCoordinates(), rectilinear->GetYCoordinates(),
      rectilinear->GetZCoordinates() };
    int sizes[3];
    rectilinear->GetDimensions(sizes);
    for (int axis = 0; axis < 3; ++axis)
    {
      const vtkIdType size = coordinates[axis] ? coordinates[axis]->GetNumberOfTuples() : 0;
      if (size < sizes[axis])
      {
        return DescribeSizes("coordinates along an axis", size, "points", sizes[axis]);
      }
    }
  }
  if (auto* structured = vtkStructuredGrid::SafeDownCast(grid))
  {
    int sizes[3];
    structured->GetDimensions(sizes);
    const std::int64_t expected = std::int64_t{ sizes[0] } * sizes[1] * sizes[2];
    if (structured->GetNumberOfPoints() < expected)
    {
      return DescribeSizes(
        "points", structured->GetNumberOfPoints(), "places of its dimensions", expected);
    }
  }
  return std::string();
}

}

//------------------------------------------------------------------------------
bool HasVolume(int type)
{
  return KindOf(type).LeastPoints > 0 || ShapeOf(type).Degree == CellShape::Varying ||
    type == VTK_POLYHEDRON;
}

//------------------------------------------------------------------------------
std::string DescribeFault(vtkDataSet* grid)
{
  const vtkIdType cells = grid->GetNumberOfCells();
  if (auto* unstructured = vtkUnstructuredGrid::SafeDownCast(grid))
  {
    vtkDataArray* types = GetTypesOfCells(unstructured, 0);
    const vtkIdType size = types ? types->GetNumberOfTuples() : 0;
    if (size < cells)
    {
      return DescribeSizes("cell types", size, "cells", cells);
    }
  }
  const std::string fault = DescribeStructure(grid);
  if (!fault.empty())
  {
    return fault;
  }
  vtkUnsignedCharArray* ghosts = grid->GetCellGhostArray();
  if (ghosts && ghosts->GetNumberOfTuples() < cells)
  {
    return DescribeSizes("ghost flags", ghosts->GetNumberOfTuples(), "cells", cells);
  }
  // Read by VTK's cells of higher order.
  vtkDataArray* degrees = grid->GetCellData()->GetHigherOrderDegrees();
  if (degrees && (degrees->GetNumberOfTuples() < cells || degrees->GetNumberOfComponents() != 3))
  {
    return DescribeSizes("degrees along three axes",
      degrees->GetNumberOfComponents() == 3 ? degrees->GetNumberOfTuples() : 0, "cells", cells);
  }
  vtkDataArray* weights = grid->GetPointData()->GetRationalWeights();
  if (weights && weights->GetNumberOfTuples() < grid->GetNumberOfPoints())
  {
    return DescribeSizes(
      "rational weights", weights->GetNumberOfTuples(), "points", grid->GetNumberOfPoints());
  }
  return std::string();
}

//------------------------------------------------------------------------------
const unsigned char* FindCellTypes(vtkDataSet* grid)
{
  auto* unstructured = vtkUnstructuredGrid::SafeDownCast(grid);
  vtkDataArray* types = unstructured ? GetTypesOfCells(unstructured, 0) : nullptr;
  auto* bytes = vtkAOSDataArrayTemplate<unsigned char>::FastDownCast(types);
  return bytes ? bytes->GetPointer(0) : nullptr;
}

//------------------------------------------------------------------------------
CellLists::CellLists(vtkCellArray* lists)
{
  if (lists)
  {
    this->Offsets = IdView(lists->GetOffsetsArray());
    this->Ids = IdView(lists->GetConnectivityArray());
  }
}

//------------------------------------------------------------------------------
bool CellLists::HaveSize(std::int64_t size, std::int64_t first, std::int64_t last) const
{
  if (last > this->GetSize() || size * last > this->Ids.GetSize())
  {
    return false;
  }
  const auto follow = [=](const auto* offsets)
  {
    std::int64_t different = 0;
    for (std::int64_t list = first; list <= last; ++list)
    {
      different |= offsets[list] ^ (size * list);
    }
    return different == 0;
  };
  return this->Offsets.GetInts() ? follow(this->Offsets.GetInts())
                                 : follow(this->Offsets.GetLongs());
}

//------------------------------------------------------------------------------
CellReader::CellReader(vtkDataSet* grid)
  : Grid(grid)
  , Types(FindCellTypes(grid))
  , NumberOfPoints(grid->GetNumberOfPoints())
  , Ghosts(grid->GetCellGhostArray())
  , Degrees(grid->GetCellData()->GetHigherOrderDegrees())
  , IsStructured(HasOneType(grid))
{
  if (auto* unstructured = vtkUnstructuredGrid::SafeDownCast(grid))
  {
    this->HasLists = true;
    this->Cells = CellLists(unstructured->GetCells());
    const FaceStorage faces = GetFaceStorage(unstructured);
    this->HasStream = faces.Faces == nullptr;
    this->Stream = IdView(faces.Stream);
    this->Starts = IdView(faces.Starts);
    this->Faces = CellLists(faces.Faces);
    this->FacesOfCells = CellLists(faces.FacesOfCells);
  }
  else if (auto* explicitGrid = vtkExplicitStructuredGrid::SafeDownCast(grid))
  {
    this->HasLists = true;
    this->Cells = CellLists(explicitGrid->GetCells());
  }
}

//------------------------------------------------------------------------------
int CellReader::ComputeType(vtkIdType cell) const
{
  return this->Grid->GetCellType(cell);
}

//------------------------------------------------------------------------------
/** True if the cells [first, last) are tetrahedra of four points each, as those before are. */
bool CellReader::AreTetrahedra(vtkIdType first, vtkIdType last) const
{
  const auto isTetrahedron = [](int type)
  { return type == VTK_TETRA || ResolveCellType(type, PointsOfTetrahedron) == VTK_TETRA; };
  vtkIdType cell = first;
  if (this->Types)
  {
    int different = 0;
    for (vtkIdType c = first; c < last; ++c)
    {
      different |= this->Types[c] ^ VTK_TETRA;
    }
    cell = different == 0 ? last : first;
  }
  while (cell < last && isTetrahedron(this->GetType(cell)))
  {
    ++cell;
  }
  return cell == last && this->Cells.HaveSize(PointsOfTetrahedron, first, last);
}

//------------------------------------------------------------------------------
bool CellReader::HasOnlyTetrahedra() const
{
  const vtkIdType cells = this->Grid->GetNumberOfCells();
  if (!this->HasLists || this->GetIds().GetSize() != PointsOfTetrahedron * cells ||
    this->Cells.GetSize() != cells)
  {
    return false;
  }
  std::atomic<bool> found{ true };
  ForEachBlock(static_cast<std::size_t>(cells),
    IsThreadSafe(this->Grid) ? RangeLoop(ThreadedLoop) : RangeLoop(SerialLoop),
    [this, &found](std::size_t, std::size_t first, std::size_t last)
    {
      if (found.load(std::memory_order_relaxed) &&
        !this->AreTetrahedra(static_cast<vtkIdType>(first), static_cast<vtkIdType>(last)))
      {
        found.store(false, std::memory_order_relaxed);
      }
    });
  return found;
}

//------------------------------------------------------------------------------
unsigned char CellReader::GetLeftOutFlags()
{
  // Finer blocks of an AMR data set show refined cells.
  return vtkDataSetAttributes::DUPLICATECELL | vtkDataSetAttributes::HIDDENCELL |
    vtkDataSetAttributes::REFINEDCELL;
}

//------------------------------------------------------------------------------
bool CellReader::IsLeftOut(vtkIdType cell) const
{
  return this->Ghosts && (this->Ghosts->GetValue(cell) & GetLeftOutFlags()) != 0;
}

//------------------------------------------------------------------------------
bool CellReader::FitsType(vtkIdType cell, vtkIdType size) const
{
  const int type = this->GetType(cell);
  if (ShapeOf(type).Degree != CellShape::Varying)
  {
    return size >= KindOf(type).LeastPoints;
  }
  const bool isTetrahedron = ShapeOf(type).LinearType == VTK_TETRA;
  if (!this->Degrees || isTetrahedron)
  {
    return FitsOneDegree(type, size);
  }
  double degrees[3];
  this->Degrees->GetTuple(cell, degrees);
  return degrees[0] >= 1.0 && degrees[1] >= 1.0 && degrees[2] >= 1.0 &&
    PointsOfDegrees(type, degrees[0], degrees[1], degrees[2]) == static_cast<double>(size);
}

//------------------------------------------------------------------------------
bool CellReader::ReadPoints(vtkIdType cell, vtkIdList* points, UnusableCells& unusable) const
{
  if (!this->HasLists)
  {
    this->Grid->GetCellPoints(cell, points);
  }
  else
  {
    std::int64_t first = 0;
    std::int64_t last = 0;
    if (!this->Cells.Find(cell, first, last))
    {
      ++unusable.OutsideOfArray;
      return false;
    }
    points->SetNumberOfIds(static_cast<vtkIdType>(last - first));
    for (std::int64_t i = first; i < last; ++i)
    {
      points->SetId(
        static_cast<vtkIdType>(i - first), static_cast<vtkIdType>(this->Cells.GetIds()[i]));
    }
  }
  if (this->IsStructured)
  {
    return true;
  }
  const vtkIdType size = points->GetNumberOfIds();
  for (vtkIdType i = 0; i < size; ++i)
  {
    if (points->GetId(i) < 0 || points->GetId(i) >= this->NumberOfPoints)
    {
      ++unusable.PointOutOfRange;
      return false;
    }
  }
  if (!this->FitsType(cell, size))
  {
    ++unusable.WrongNumberOfPoints;
    return false;
  }
  return true;
}

//------------------------------------------------------------------------------
/** Adds the points of a face, which are in an array from `first` to `last`. */
bool CellReader::AddFace(const IdView& ids, std::int64_t first, std::int64_t last,
  std::vector<std::int64_t>& faces, UnusableCells& unusable) const
{
  if (last - first < 3)
  {
    ++unusable.MissingFaces;
    return false;
  }
  faces.push_back(last - first);
  for (std::int64_t i = first; i < last; ++i)
  {
    if (ids[i] < 0 || ids[i] >= this->NumberOfPoints)
    {
      ++unusable.PointOutOfRange;
      return false;
    }
    faces.push_back(ids[i]);
  }
  return true;
}

//------------------------------------------------------------------------------
bool CellReader::ReadFaces(vtkIdType cell, std::vector<std::int64_t>& faces,
  std::size_t& numberOfFaces, UnusableCells& unusable) const
{
  faces.clear();
  numberOfFaces = 0;
  std::int64_t next = 0;
  std::int64_t last = 0;
  if (this->HasStream)
  {
    // A negative place stands for no faces.
    next = cell < this->Starts.GetSize() ? this->Starts[cell] : -1;
    if (next >= this->Stream.GetSize())
    {
      ++unusable.OutsideOfArray;
      return false;
    }
    last = next >= 0 ? this->Stream[next++] : 0;
  }
  else if (!this->FacesOfCells.Find(cell, next, last))
  {
    ++unusable.OutsideOfArray;
    return false;
  }
  const std::int64_t count = this->HasStream ? last : last - next;
  for (std::int64_t face = 0; face < count; ++face)
  {
    std::int64_t begin = 0;
    std::int64_t end = 0;
    bool found = false;
    if (this->HasStream)
    {
      begin = next + 1;
      const std::int64_t room = this->Stream.GetSize() - begin;
      found = room > 0 && this->Stream[next] <= room;
      end = found ? begin + this->Stream[next] : begin;
      next = end;
    }
    else
    {
      found = this->Faces.Find(this->FacesOfCells.GetIds()[next + face], begin, end);
    }
    if (!found)
    {
      ++unusable.OutsideOfArray;
      return false;
    }
    if (!this->AddFace(
          this->HasStream ? this->Stream : this->Faces.GetIds(), begin, end, faces, unusable))
    {
      return false;
    }
    ++numberOfFaces;
  }
  if (numberOfFaces == 0)
  {
    ++unusable.MissingFaces;
  }
  return numberOfFaces > 0;
}

}
