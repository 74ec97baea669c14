// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTetrahedralizeSurface.h"

#include "Filters/Common/ClampedSetter.h"
#include "Filters/Mesher/DelaunayMesher.h"
#include "Filters/Mesher/MesherProcess.h"
#include "Filters/Mesher/SurfaceExtraction.h"
#include "Filters/Mesher/SurfaceMessages.h"

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

/**
 * Distance from a triangle's plane at which TetGen still takes a point for coplanar, relative to
 * the size of the surface: its default for the switch T. VTK adds no points at all, and rounding of
 * the volumes is far below.
 */
constexpr double CoplanarTolerance = 1e-8;

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
  return this->MesherProgram ? std::string(this->MesherProgram) : meniscus::FindTetGenProgram();
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
    meniscus::DescribeSolidFault(meniscus::KeepSolid(surface, CoplanarTolerance, cells));
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
  meniscus::MesherProcess process;
  process.Program = this->GetProgram();
  process.TimeLimit = this->TimeLimit;
  // TetGen reports no progress: each tenth of the time limit shows half of the remainder as done.
  process.GoesOn = [this](double seconds)
  {
    this->UpdateProgress(1.0 - std::exp2(-10.0 * seconds / this->TimeLimit));
    return !this->GetAbortExecute();
  };
  if (process.Program.empty())
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
  meniscus::MeshingAnswer answer;
  const meniscus::ProcessEnd end = process.Run(task, answer);
  if (end == meniscus::ProcessEnd::Aborted)
  {
    return false;
  }
  std::string fault = meniscus::DescribeProcessEnd(end, process);
  if (fault.empty())
  {
    fault = meniscus::DescribeMeshingEnd(answer.End);
  }
  if (!fault.empty())
  {
    vtkErrorMacro(<< fault << " The output is empty.");
    return false;
  }
  cells = std::move(answer.Cells);
  return true;
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
