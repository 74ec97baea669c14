// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "GridView.h"

#include "vtkAOSDataArrayTemplate.h"
#include "vtkCellArray.h"
#include "vtkCellType.h"
#include "vtkCellTypes.h"
#include "vtkDataSetAttributes.h"
#include "vtkGenericCell.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <array>
#include <sstream>

namespace meniscus
{
namespace
{

constexpr unsigned char LeftOut =
  vtkDataSetAttributes::DUPLICATECELL | vtkDataSetAttributes::HIDDENCELL;

template <typename T>
std::vector<T> CopyValues(vtkDataArray* array)
{
  const int components = array->GetNumberOfComponents();
  std::vector<T> values(components * array->GetNumberOfTuples());
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    values[i] = static_cast<T>(array->GetComponent(
      static_cast<vtkIdType>(i / components), static_cast<int>(i % components)));
  }
  return values;
}

/** Whether a cell of more than one type has quadratic triangles among its faces. */
bool SharesQuadraticTriangles(int type)
{
  return type == VTK_QUADRATIC_WEDGE || type == VTK_QUADRATIC_PYRAMID;
}

/** The points around a face, by their places in it; empty for a type that is not known. */
std::vector<int> AroundFace(vtkCell* face)
{
  switch (face->GetCellType())
  {
    case VTK_TRIANGLE:
      return { 0, 1, 2 };
    case VTK_QUAD:
      return { 0, 1, 2, 3 };
    case VTK_PIXEL:
      return { 0, 1, 3, 2 };
    case VTK_QUADRATIC_TRIANGLE:
      return { 0, 3, 1, 4, 2, 5 };
    case VTK_QUADRATIC_QUAD:
      return { 0, 4, 1, 5, 2, 6, 3, 7 };
    case VTK_QUADRATIC_LINEAR_QUAD:
      return { 0, 4, 1, 2, 5, 3 };
    case VTK_POLYGON:
    {
      std::vector<int> around(face->GetNumberOfPoints());
      for (std::size_t i = 0; i < around.size(); ++i)
      {
        around[i] = static_cast<int>(i);
      }
      return around;
    }
    default:
      return {};
  }
}

}

//------------------------------------------------------------------------------
GridView::GridView(vtkUnstructuredGrid* grid)
{
  this->View.NumberOfPoints = grid->GetNumberOfPoints();
  if (grid->GetPoints())
  {
    this->ViewPoints(grid->GetPoints()->GetData());
  }
  bool onlyTetrahedra = true;
  for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c)
  {
    const int type = grid->GetCellType(c);
    onlyTetrahedra = onlyTetrahedra && type == VTK_TETRA;
    this->QuadraticByFaces = this->QuadraticByFaces || SharesQuadraticTriangles(type);
  }
  if (onlyTetrahedra && grid->GetNumberOfCells() > 0)
  {
    this->ViewTetrahedra(grid);
  }
  else
  {
    this->Tetrahedralize(grid);
  }
}

//------------------------------------------------------------------------------
void GridView::ViewPoints(vtkDataArray* points)
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

//------------------------------------------------------------------------------
void GridView::ViewTetrahedra(vtkUnstructuredGrid* grid)
{
  this->View.NumberOfCells = grid->GetNumberOfCells();
  vtkDataArray* ids = grid->GetCells()->GetConnectivityArray();
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
  if (vtkUnsignedCharArray* ghosts = grid->GetCellGhostArray())
  {
    this->View.CellFlags = ghosts->GetPointer(0);
    this->View.LeftOutBits = LeftOut;
  }
}

//------------------------------------------------------------------------------
void GridView::Tetrahedralize(vtkUnstructuredGrid* grid)
{
  vtkUnsignedCharArray* ghosts = grid->GetCellGhostArray();
  for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c)
  {
    if (!ghosts || !(ghosts->GetValue(c) & LeftOut))
    {
      this->AddCell(grid, c, grid->GetCellType(c));
      this->Sources.resize(
        this->Tetrahedra.GetTetrahedra().size() / 4, static_cast<std::int32_t>(c));
    }
  }
  this->View.SourceCells = this->Sources.data();
  this->View.Cells = this->Tetrahedra.GetTetrahedra().data();
  this->View.NumberOfCells = static_cast<std::int64_t>(this->Tetrahedra.GetTetrahedra().size() / 4);
}

//------------------------------------------------------------------------------
void GridView::AddCell(vtkUnstructuredGrid* grid, std::int64_t cell, int type)
{
  // Most points that a cell of a type with a rule of its own has.
  constexpr vtkIdType MostPoints = 10;
  std::array<std::int64_t, MostPoints> points{};
  vtkIdType size = 0;
  const vtkIdType* ids = nullptr;
  grid->GetCellPoints(cell, size, ids);
  std::copy_n(ids, std::min(size, MostPoints), points.begin());
  if (type == VTK_TETRA && size == 4)
  {
    this->Tetrahedra.AddTetrahedron(points.data());
  }
  else if (type == VTK_VOXEL && size == 8)
  {
    this->Tetrahedra.AddVoxel(points.data());
  }
  else if (type == VTK_HEXAHEDRON && size == 8)
  {
    this->Tetrahedra.AddHexahedron(points.data());
  }
  else if (type == VTK_WEDGE && size == 6)
  {
    this->Tetrahedra.AddWedge(points.data());
  }
  else if (type == VTK_PYRAMID && size == 5)
  {
    this->Tetrahedra.AddPyramid(points.data());
  }
  else if (type == VTK_QUADRATIC_TETRA && size == 10 && !this->QuadraticByFaces)
  {
    this->Tetrahedra.AddQuadraticTetrahedron(points.data());
  }
  else
  {
    vtkNew<vtkGenericCell> generic;
    grid->GetCell(cell, generic);
    if (generic->GetCellDimension() != 3 || !this->AddByFaces(generic))
    {
      ++this->Omitted[type];
    }
  }
}

//------------------------------------------------------------------------------
bool GridView::AddByFaces(vtkCell* cell)
{
  std::vector<std::int64_t> faces;
  for (int f = 0; f < cell->GetNumberOfFaces(); ++f)
  {
    vtkCell* face = cell->GetFace(f);
    const std::vector<int> around = AroundFace(face);
    if (around.empty())
    {
      return false;
    }
    faces.push_back(static_cast<std::int64_t>(around.size()));
    for (const int place : around)
    {
      faces.push_back(face->GetPointId(place));
    }
  }
  this->Tetrahedra.AddPolyhedron(faces.data(), static_cast<std::size_t>(cell->GetNumberOfFaces()));
  return cell->GetNumberOfFaces() > 0;
}

//------------------------------------------------------------------------------
std::string GridView::DescribeOmitted() const
{
  std::ostringstream text;
  for (const auto& omitted : this->Omitted)
  {
    const char* name = vtkCellTypes::GetClassNameFromTypeId(omitted.first);
    text << (text.tellp() > 0 ? ", " : "") << omitted.second << " "
         << (name ? name : "of an unknown type");
  }
  return text.str();
}

}
