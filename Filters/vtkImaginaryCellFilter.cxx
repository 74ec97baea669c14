// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkImaginaryCellFilter.h"

#include "Common/StandardFloatingPoint.h"
#include "Filters/Mesher/SurfaceMessages.h"
#include "Filters/Mesher/TetGenRun.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCellType.h"
#include "vtkGenericCell.h"
#include "vtkIdList.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

namespace
{

/** Largest number of points: the mesher's indices are of type int. */
constexpr vtkIdType MostPoints = std::numeric_limits<int>::max() / 4;

/** Points and tetrahedra of a grid. */
struct GridCells
{
  std::vector<glm::dvec3> Points;
  std::vector<meniscus::Tetrahedron> Cells;
  vtkIdType OtherSolids = 0; ///< cells of three dimensions that are no tetrahedra
};

//------------------------------------------------------------------------------
GridCells ReadCells(vtkUnstructuredGrid* grid)
{
  GridCells read;
  read.Points.resize(static_cast<std::size_t>(grid->GetNumberOfPoints()));
  for (std::size_t p = 0; p < read.Points.size(); ++p)
  {
    grid->GetPoint(static_cast<vtkIdType>(p), &read.Points[p].x);
  }
  vtkNew<vtkIdList> ids;
  vtkNew<vtkGenericCell> shape;
  const auto isPoint = [&](vtkIdType id) { return id >= 0 && id < grid->GetNumberOfPoints(); };
  for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c)
  {
    const int type = grid->GetCellType(c);
    grid->GetCellPoints(c, ids);
    if (type == VTK_TETRA && ids->GetNumberOfIds() == 4 &&
      std::all_of(ids->begin(), ids->end(), isPoint))
    {
      meniscus::Tetrahedron cell;
      std::transform(
        ids->begin(), ids->end(), cell.begin(), [](vtkIdType id) { return static_cast<int>(id); });
      read.Cells.push_back(cell);
      continue;
    }
    shape->SetCellType(type);
    read.OtherSolids += shape->GetCellDimension() == 3 ? 1 : 0;
  }
  return read;
}

//------------------------------------------------------------------------------
// Copies the arrays of points or cells and repeats the first values up to `total`.
void ExtendArrays(
  vtkDataSetAttributes* from, vtkIdType count, vtkIdType total, vtkDataSetAttributes* to)
{
  to->CopyGlobalIdsOff();
  to->CopyPedigreeIdsOff();
  to->CopyAllocate(from, total);
  to->SetNumberOfTuples(total);
  for (vtkIdType i = 0; i < total; ++i)
  {
    to->CopyData(from, i < count ? i : 0, i);
  }
}

//------------------------------------------------------------------------------
// The grid with hidden cells. Its first points are the surface's.
void AppendHidden(vtkUnstructuredGrid* grid, const meniscus::TriangleSurface& surface,
  const meniscus::TetrahedronCells& hidden, vtkUnstructuredGrid* output)
{
  const std::size_t own = surface.Points.size();
  const vtkIdType points = grid->GetNumberOfPoints();
  const vtkIdType cells = grid->GetNumberOfCells();
  const vtkIdType allPoints = points + static_cast<vtkIdType>(hidden.Points.size() - own);
  const vtkIdType allCells = cells + static_cast<vtkIdType>(hidden.Cells.size());
  output->ShallowCopy(grid);
  vtkNew<vtkPoints> places;
  places->SetDataType(grid->GetPoints()->GetDataType());
  places->DeepCopy(grid->GetPoints());
  for (std::size_t p = own; p < hidden.Points.size(); ++p)
  {
    places->InsertNextPoint(&hidden.Points[p].x);
  }
  output->SetPoints(places);
  vtkNew<vtkCellArray> connectivity;
  connectivity->DeepCopy(grid->GetCells());
  vtkNew<vtkUnsignedCharArray> types;
  types->DeepCopy(grid->GetCellTypesArray());
  for (const meniscus::Tetrahedron& cell : hidden.Cells)
  {
    connectivity->InsertNextCell(4);
    for (const int corner : cell)
    {
      const auto id = static_cast<std::size_t>(corner);
      connectivity->InsertCellPoint(id < own ? static_cast<vtkIdType>(surface.Sources[id])
                                             : points + static_cast<vtkIdType>(id - own));
    }
    types->InsertNextValue(VTK_TETRA);
  }
  output->SetCells(types, connectivity);
  output->GetPointData()->Initialize();
  output->GetCellData()->Initialize();
  ExtendArrays(grid->GetPointData(), points, allPoints, output->GetPointData());
  ExtendArrays(grid->GetCellData(), cells, allCells, output->GetCellData());
  const char* name = vtkDataSetAttributes::GhostArrayName();
  vtkDataArray* before = grid->GetCellData()->GetArray(name);
  vtkNew<vtkUnsignedCharArray> flags;
  flags->SetName(name);
  flags->SetNumberOfTuples(allCells);
  for (vtkIdType c = 0; c < allCells; ++c)
  {
    const unsigned char flag =
      before && c < cells ? static_cast<unsigned char>(before->GetComponent(c, 0)) : 0;
    flags->SetValue(
      c, c < cells ? flag : static_cast<unsigned char>(vtkDataSetAttributes::HIDDENCELL));
  }
  output->GetCellData()->AddArray(flags);
}

} // anonymous namespace

vtkStandardNewMacro(vtkImaginaryCellFilter);

//------------------------------------------------------------------------------
vtkImaginaryCellFilter::vtkImaginaryCellFilter() = default;

//------------------------------------------------------------------------------
vtkImaginaryCellFilter::~vtkImaginaryCellFilter()
{
  this->SetMesherProgram(nullptr);
}

//------------------------------------------------------------------------------
bool vtkImaginaryCellFilter::HasTetGen()
{
  return !meniscus::ChooseTetGenProgram(this->MesherProgram).empty();
}

//------------------------------------------------------------------------------
int vtkImaginaryCellFilter::RequestData(
  vtkInformation* vtkNotUsed(request), vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  const meniscus::StandardFloatingPoint standardFloatingPoint;
  this->NumberOfImaginaryCells = 0;
  this->NumberOfAddedPoints = 0;
  vtkUnstructuredGrid* input = vtkUnstructuredGrid::GetData(inputs[0]);
  vtkUnstructuredGrid* output = vtkUnstructuredGrid::GetData(outputs);
  if (!input || !output || input->GetNumberOfPoints() > MostPoints)
  {
    vtkErrorMacro("There is no mesh, or it has more points than TetGen can number.");
    return 0;
  }
  const std::string program = meniscus::ChooseTetGenProgram(this->MesherProgram);
  if (program.empty() || !(this->TimeLimit > 0.0))
  {
    vtkErrorMacro(<< (program.empty() ? "There is no program for TetGen: build Meniscus with "
                                        "MENISCUS_WITH_TETGEN or set MesherProgram"
                                      : "TimeLimit must be positive")
                  << ". The output is empty.");
    return 0;
  }
  const GridCells mesh = ReadCells(input);
  if (mesh.OtherSolids > 0)
  {
    vtkErrorMacro(<< mesh.OtherSolids << " cells are no linear tetrahedra; "
                  << "vtkDataSetTriangleFilter can divide them. The output is empty.");
    return 0;
  }
  meniscus::MeshingTask task;
  task.Surface = meniscus::FindBoundary(mesh.Points, mesh.Cells);
  const meniscus::SurfaceReport report = meniscus::FindSurfaceFault(task.Surface);
  if (report.Fault == meniscus::SurfaceFault::Empty ||
    report.Fault == meniscus::SurfaceFault::NotFinite)
  {
    vtkErrorMacro(<< "Boundary of the mesh: " << meniscus::DescribeSurfaceFault(report)
                  << " The output is empty.");
    return 0;
  }
  task.KeepsSurface = true;
  task.FillsHull = true;
  meniscus::TetrahedronCells hidden;
  if (!meniscus::RunTetGen(this, program, this->TimeLimit, task, hidden))
  {
    return this->GetAbortExecute() ? 1 : 0;
  }
  const std::string fault = meniscus::DescribeSolidFault(
    meniscus::KeepOutside(task.Surface, meniscus::CoplanarTolerance, hidden));
  if (!fault.empty())
  {
    vtkErrorMacro(<< fault << " The output is empty.");
    return 0;
  }
  AppendHidden(input, task.Surface, hidden, output);
  this->NumberOfImaginaryCells = static_cast<vtkIdType>(hidden.Cells.size());
  this->NumberOfAddedPoints = output->GetNumberOfPoints() - input->GetNumberOfPoints();
  return 1;
}

//------------------------------------------------------------------------------
void vtkImaginaryCellFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "TimeLimit: " << this->TimeLimit << '\n';
  os << indent << "MesherProgram: " << (this->MesherProgram ? this->MesherProgram : "(none)")
     << '\n';
  os << indent << "NumberOfImaginaryCells: " << this->NumberOfImaginaryCells << '\n';
  os << indent << "NumberOfAddedPoints: " << this->NumberOfAddedPoints << '\n';
}
