// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTetrahedralizeSurface.h"

#include "Common/StandardFloatingPoint.h"
#include "Filters/Common/Accessors.h"
#include "Filters/Mesher/DelaunayMesher.h"
#include "Filters/Mesher/SurfaceExtraction.h"
#include "Filters/Mesher/SurfaceMessages.h"
#include "Filters/Mesher/TetGenRun.h"

#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkUnstructuredGrid.h"

#include <cmath>
#include <limits>
#include <string>

namespace
{

/** Largest number of points: the mesher's indices are of type int. */
constexpr vtkIdType MostPoints = std::numeric_limits<int>::max() / 4;

}

vtkStandardNewMacro(vtkTetrahedralizeSurface);
meniscusSetClampMacro(vtkTetrahedralizeSurface, Mesher, int, AUTOMATIC, DELAUNAY);

//------------------------------------------------------------------------------
vtkTetrahedralizeSurface::vtkTetrahedralizeSurface() = default;

//------------------------------------------------------------------------------
vtkTetrahedralizeSurface::~vtkTetrahedralizeSurface()
{
  this->SetMesherProgram(nullptr);
}

//------------------------------------------------------------------------------
int vtkTetrahedralizeSurface::FillInputPortInformation(int vtkNotUsed(port), vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPolyData");
  return 1;
}

//------------------------------------------------------------------------------
std::string vtkTetrahedralizeSurface::GetProgram() const
{
  return meniscus::ChooseTetGenProgram(this->MesherProgram);
}

//------------------------------------------------------------------------------
bool vtkTetrahedralizeSurface::HasTetGen()
{
  return !this->GetProgram().empty();
}

//------------------------------------------------------------------------------
/** Reports settings that cannot be used. */
bool vtkTetrahedralizeSurface::HasValidSettings()
{
  const char* problem = nullptr;
  if (!(this->MaximumRadiusEdgeRatio >= 1.0) || !std::isfinite(this->MaximumRadiusEdgeRatio))
  {
    problem = "MaximumRadiusEdgeRatio must be finite and at least 1";
  }
  else if (!(this->MaximumVolume >= 0.0) || !std::isfinite(this->MaximumVolume))
  {
    problem = "MaximumVolume must be finite and not negative";
  }
  else if (!(this->TimeLimit > 0.0))
  {
    problem = "TimeLimit must be positive";
  }
  if (problem)
  {
    vtkErrorMacro(<< problem << "; the output is empty.");
  }
  return !problem;
}

//------------------------------------------------------------------------------
int vtkTetrahedralizeSurface::RequestData(
  vtkInformation* vtkNotUsed(request), vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  const meniscus::StandardFloatingPoint standardFloatingPoint;
  this->UsedMesher = AUTOMATIC;
  this->NumberOfAddedPoints = 0;
  this->LargestRadiusEdgeRatio = 0.0;
  this->NumberOfCellsAboveRatio = 0;
  vtkPolyData* input = vtkPolyData::GetData(inputs[0]);
  vtkUnstructuredGrid* output = vtkUnstructuredGrid::GetData(outputs);
  if (!input || !output || input->GetNumberOfPoints() > MostPoints)
  {
    vtkErrorMacro("There is no surface, or it has more points than the mesher can number.");
    return 0;
  }
  if (!this->HasValidSettings())
  {
    return 0;
  }
  const meniscus::TriangleSurface surface = meniscus::ExtractSurface(input);
  const std::string fault = meniscus::DescribeSurfaceFault(meniscus::FindSurfaceFault(surface));
  if (!fault.empty())
  {
    vtkErrorMacro(<< fault << " The output is empty.");
    return 0;
  }
  meniscus::TetrahedronCells cells;
  if (!this->MakeCells(surface, cells))
  {
    return this->GetAbortExecute() ? 1 : 0;
  }
  const meniscus::CellQuality quality =
    meniscus::MeasureQuality(cells, this->MaximumRadiusEdgeRatio);
  this->LargestRadiusEdgeRatio = quality.LargestRadiusEdgeRatio;
  this->NumberOfCellsAboveRatio = static_cast<vtkIdType>(quality.CellsAboveBound);
  this->NumberOfAddedPoints = static_cast<vtkIdType>(cells.Points.size() - surface.Points.size());
  meniscus::CopyCells(cells, output);
  if (const int failures = meniscus::ContinueArrays(input, surface, cells, output))
  {
    vtkWarningMacro(<< failures << " point arrays cannot be continued into the inside.");
  }
  return 1;
}

//------------------------------------------------------------------------------
/** Makes the cells and checks them. Returns false after an error or an abort. */
bool vtkTetrahedralizeSurface::MakeCells(
  const meniscus::TriangleSurface& surface, meniscus::TetrahedronCells& cells)
{
  this->UsedMesher =
    this->Mesher == AUTOMATIC ? (this->HasTetGen() ? TETGEN : DELAUNAY) : this->Mesher;
  const bool made = this->UsedMesher == TETGEN ? this->RunTetGen(surface, cells)
                                               : this->RunDelaunay(surface, cells);
  if (!made)
  {
    return false;
  }
  const std::string fault =
    meniscus::DescribeSolidFault(meniscus::KeepSolid(surface, meniscus::CoplanarTolerance, cells));
  if (!fault.empty())
  {
    vtkErrorMacro(<< fault << " The output is empty.");
    return false;
  }
  return true;
}

//------------------------------------------------------------------------------
bool vtkTetrahedralizeSurface::RunTetGen(
  const meniscus::TriangleSurface& surface, meniscus::TetrahedronCells& cells)
{
  const std::string program = this->GetProgram();
  if (program.empty())
  {
    vtkErrorMacro("There is no program for TetGen: build Meniscus with MENISCUS_WITH_TETGEN, set "
                  "MesherProgram or use DELAUNAY. The output is empty.");
    return false;
  }
  meniscus::MeshingTask task;
  task.Surface = surface;
  task.RadiusEdgeRatio = this->MaximumRadiusEdgeRatio;
  task.MaximumVolume = this->MaximumVolume;
  task.KeepsSurface = this->PreserveSurface;
  return meniscus::RunTetGen(this, program, this->TimeLimit, task, cells);
}

//------------------------------------------------------------------------------
bool vtkTetrahedralizeSurface::RunDelaunay(
  const meniscus::TriangleSurface& surface, meniscus::TetrahedronCells& cells)
{
  cells = meniscus::MeshByDelaunay(surface);
  if (const std::size_t lost = meniscus::NumberRegions(surface, cells))
  {
    vtkErrorMacro(<< meniscus::DescribeSolidFault(meniscus::SolidFault::LostFacets) << ' ' << lost
                  << " of " << surface.Triangles.size()
                  << " triangles are missing. The output is empty.");
    return false;
  }
  return true;
}

//------------------------------------------------------------------------------
void vtkTetrahedralizeSurface::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Mesher: " << this->Mesher << '\n';
  os << indent << "MaximumRadiusEdgeRatio: " << this->MaximumRadiusEdgeRatio << '\n';
  os << indent << "MaximumVolume: " << this->MaximumVolume << '\n';
  os << indent << "PreserveSurface: " << this->PreserveSurface << '\n';
  os << indent << "TimeLimit: " << this->TimeLimit << '\n';
  os << indent << "MesherProgram: " << (this->MesherProgram ? this->MesherProgram : "(none)")
     << '\n';
  os << indent << "UsedMesher: " << this->UsedMesher << '\n';
  os << indent << "NumberOfAddedPoints: " << this->NumberOfAddedPoints << '\n';
  os << indent << "LargestRadiusEdgeRatio: " << this->LargestRadiusEdgeRatio << '\n';
  os << indent << "NumberOfCellsAboveRatio: " << this->NumberOfCellsAboveRatio << '\n';
}
