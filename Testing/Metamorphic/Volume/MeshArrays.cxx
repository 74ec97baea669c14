// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "MeshArrays.h"

#include <vtkSOADataArrayTemplate.h>

namespace meniscus::test
{

//------------------------------------------------------------------------------
void MeshArrays::AddTuple(const MeshArrays& from, std::size_t tuple)
{
  for (int c = 0; c < from.Components; ++c)
  {
    this->Values.push_back(from.GetValue(tuple, c));
  }
}

//------------------------------------------------------------------------------
vtkIdType MeshArrays::AddPoint(const MeshArrays& from, std::size_t point)
{
  this->Points.push_back(from.Points[point]);
  if (!this->OnCells)
  {
    this->AddTuple(from, point);
  }
  return static_cast<vtkIdType>(this->Points.size()) - 1;
}

//------------------------------------------------------------------------------
void MeshArrays::AddCell(const MeshArrays& from, std::size_t cell)
{
  this->Cells.push_back(from.Cells[cell]);
  if (this->OnCells)
  {
    this->AddTuple(from, cell);
  }
}

//------------------------------------------------------------------------------
void MeshArrays::GetBounds(double result[6]) const
{
  for (int axis = 0; axis < 3; ++axis)
  {
    result[2 * axis] = std::numeric_limits<double>::max();
    result[2 * axis + 1] = std::numeric_limits<double>::lowest();
  }
  for (const glm::dvec3& p : this->Points)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      result[2 * axis] = std::min(result[2 * axis], p[axis]);
      result[2 * axis + 1] = std::max(result[2 * axis + 1], p[axis]);
    }
  }
}

//------------------------------------------------------------------------------
std::array<double, 2> MeshArrays::MakeRange(int component) const
{
  std::array<double, 2> range{ std::numeric_limits<double>::max(),
    std::numeric_limits<double>::lowest() };
  for (std::size_t i = 0; i < this->Tuples(); ++i)
  {
    const double value = this->GetValue(i, component);
    if (std::isfinite(value))
    {
      range = { std::min(range[0], value), std::max(range[1], value) };
    }
  }
  return range;
}

//------------------------------------------------------------------------------
bool MeshArrays::IsTetrahedral() const
{
  return std::all_of(this->Cells.begin(), this->Cells.end(),
    [](const MeshCell& cell) { return cell.Type == VTK_TETRA; });
}

namespace
{

vtkSmartPointer<vtkDataArray> MakeArray(
  int type, bool perComponent, int components, std::size_t tuples)
{
  vtkSmartPointer<vtkDataArray> array;
  if (perComponent && type == VTK_FLOAT)
  {
    array = vtkSmartPointer<vtkSOADataArrayTemplate<float>>::New();
  }
  else if (perComponent)
  {
    array = vtkSmartPointer<vtkSOADataArrayTemplate<double>>::New();
  }
  else
  {
    array = vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(type));
  }
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(static_cast<vtkIdType>(tuples));
  return array;
}

// A value that the array's type cannot represent would be an error of the relation: it ends the
// case.
void SetTuple(vtkDataArray* array, std::size_t at, const double* tuple)
{
  const auto id = static_cast<vtkIdType>(at);
  array->SetTuple(id, tuple);
  for (int c = 0; c < array->GetNumberOfComponents(); ++c)
  {
    const double kept = array->GetComponent(id, c);
    if (kept != tuple[c] && !(std::isnan(kept) && std::isnan(tuple[c])))
    {
      std::abort();
    }
  }
}

void SetCells(const MeshArrays& mesh, bool smallIds, vtkUnstructuredGrid* grid)
{
  vtkNew<vtkCellArray> cells;
  if (smallIds)
  {
    cells->Use32BitStorage();
  }
  else
  {
    cells->Use64BitStorage();
  }
  vtkNew<vtkUnsignedCharArray> types;
  for (const MeshCell& cell : mesh.Cells)
  {
    cells->InsertNextCell(static_cast<vtkIdType>(cell.Ids.size()), cell.Ids.data());
    types->InsertNextValue(static_cast<unsigned char>(cell.Type));
  }
  grid->SetCells(types, cells);
}

} // anonymous namespace

//------------------------------------------------------------------------------
Grid ToGrid(const MeshArrays& mesh, const MeshStorage& storage)
{
  const auto coordinates =
    MakeArray(storage.PointType, storage.PerComponent, 3, mesh.Points.size());
  for (std::size_t i = 0; i < mesh.Points.size(); ++i)
  {
    SetTuple(coordinates, i, &mesh.Points[i][0]);
  }
  const auto values =
    MakeArray(storage.ValueType, storage.PerComponent, mesh.Components, mesh.Tuples());
  values->SetName(ScalarName);
  for (std::size_t i = 0; i < mesh.Tuples(); ++i)
  {
    SetTuple(values, i, &mesh.Values[i * mesh.Components]);
  }
  vtkNew<vtkPoints> points;
  points->SetData(coordinates);
  Grid grid = Grid::New();
  grid->SetPoints(points);
  SetCells(mesh, storage.SmallIds, grid);
  if (mesh.OnCells)
  {
    grid->GetCellData()->SetScalars(values);
  }
  else
  {
    grid->GetPointData()->SetScalars(values);
  }
  return grid;
}

//------------------------------------------------------------------------------
MeshArrays ToArrays(vtkUnstructuredGrid* grid, bool onCells)
{
  MeshArrays mesh;
  mesh.OnCells = onCells;
  for (vtkIdType i = 0; i < grid->GetNumberOfPoints(); ++i)
  {
    const double* x = grid->GetPoint(i);
    mesh.Points.emplace_back(x[0], x[1], x[2]);
  }
  vtkNew<vtkIdList> ids;
  for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c)
  {
    grid->GetCellPoints(c, ids);
    mesh.Cells.push_back({ grid->GetCellType(c), { ids->begin(), ids->end() } });
  }
  vtkDataArray* values =
    onCells ? grid->GetCellData()->GetScalars() : grid->GetPointData()->GetScalars();
  if (!values)
  {
    return mesh;
  }
  mesh.Components = values->GetNumberOfComponents();
  for (const auto& [i, c] : Product(Below<vtkIdType>(values->GetNumberOfTuples()), mesh.Components))
  {
    mesh.Values.push_back(values->GetComponent(i, c));
  }
  return mesh;
}

namespace
{

// Faces of the cells with a volume and flat faces, as indices into the cell's list of points.
const std::vector<std::vector<int>>& FacesOf(int type)
{
  static const std::vector<std::vector<int>> hexahedron{ { 0, 4, 7, 3 }, { 1, 2, 6, 5 },
    { 0, 1, 5, 4 }, { 3, 7, 6, 2 }, { 0, 3, 2, 1 }, { 4, 5, 6, 7 } };
  static const std::vector<std::vector<int>> voxel{ { 0, 4, 6, 2 }, { 1, 3, 7, 5 }, { 0, 1, 5, 4 },
    { 2, 6, 7, 3 }, { 0, 2, 3, 1 }, { 4, 5, 7, 6 } };
  static const std::vector<std::vector<int>> wedge{ { 0, 1, 2 }, { 3, 5, 4 }, { 0, 3, 4, 1 },
    { 1, 4, 5, 2 }, { 2, 5, 3, 0 } };
  static const std::vector<std::vector<int>> pyramid{ { 0, 3, 2, 1 }, { 0, 1, 4 }, { 1, 2, 4 },
    { 2, 3, 4 }, { 3, 0, 4 } };
  static const std::vector<std::vector<int>> none;
  switch (type)
  {
    case VTK_HEXAHEDRON:
      return hexahedron;
    case VTK_VOXEL:
      return voxel;
    case VTK_WEDGE:
      return wedge;
    case VTK_PYRAMID:
      return pyramid;
    default:
      return none;
  }
}

void Pull(const MeshCell& cell, std::size_t number, std::vector<MeshTetrahedron>& result)
{
  const vtkIdType apex = *std::min_element(cell.Ids.begin(), cell.Ids.end());
  for (const std::vector<int>& places : FacesOf(cell.Type))
  {
    std::vector<vtkIdType> face;
    for (const int place : places)
    {
      face.push_back(cell.Ids[static_cast<std::size_t>(place)]);
    }
    if (std::find(face.begin(), face.end(), apex) != face.end())
    {
      continue;
    }
    std::rotate(face.begin(), std::min_element(face.begin(), face.end()), face.end());
    for (std::size_t i = 1; i + 1 < face.size(); ++i)
    {
      result.push_back({ { apex, face[0], face[i], face[i + 1] }, number });
    }
  }
}

} // anonymous namespace

//------------------------------------------------------------------------------
std::vector<MeshTetrahedron> TetrahedraOf(const MeshArrays& mesh)
{
  std::vector<MeshTetrahedron> result;
  for (std::size_t c = 0; c < mesh.Cells.size(); ++c)
  {
    const MeshCell& cell = mesh.Cells[c];
    if (cell.Type == VTK_TETRA)
    {
      result.push_back({ { cell.Ids[0], cell.Ids[1], cell.Ids[2], cell.Ids[3] }, c });
    }
    else
    {
      Pull(cell, c, result);
    }
  }
  return result;
}

} // namespace meniscus::test
