// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Properties and counters of vtkTetrahedraRayIntegral.
#include "Rendering/RayIntegralInternals.h"

#include "vtkCamera.h"
#include "vtkPolyData.h"
#include "vtkRefractingInterfaceCollection.h"

#include <algorithm>
#include <cstddef>

namespace
{

using Bins = std::vector<meniscus::EnergyBin>;

/** Number of a bin; 0 if there is no such bin. */
double GetOfBin(const Bins& bins, int bin, double meniscus::EnergyBin::*member)
{
  return bin >= 0 && bin < static_cast<int>(bins.size())
    ? bins[static_cast<std::size_t>(bin)].*member
    : 0.0;
}

/** Sets a number of a bin, which is added if it is missing. Returns true if something changed. */
bool SetOfBin(Bins& bins, int bin, double meniscus::EnergyBin::*member, double value)
{
  if (bin < 0)
  {
    return false;
  }
  const auto index = static_cast<std::size_t>(bin);
  const bool isNew = index >= bins.size();
  if (isNew)
  {
    bins.resize(index + 1);
  }
  const bool changed = isNew || bins[index].*member != value;
  bins[index].*member = value;
  return changed;
}

}

//------------------------------------------------------------------------------
void vtkTetrahedraRayIntegral::SetMembraneData(vtkPolyData* membrane)
{
  this->SetInputDataInternal(1, membrane);
}

//------------------------------------------------------------------------------
void vtkTetrahedraRayIntegral::AddMembraneData(vtkPolyData* membrane)
{
  this->AddInputDataInternal(1, membrane);
}

//------------------------------------------------------------------------------
void vtkTetrahedraRayIntegral::SetCamera(vtkCamera* camera)
{
  if (this->Camera != camera)
  {
    this->Camera = camera;
    this->Modified();
  }
  if (camera)
  {
    this->SetFrameMode(CAMERA);
  }
}

//------------------------------------------------------------------------------
vtkCamera* vtkTetrahedraRayIntegral::GetCamera()
{
  return this->Camera;
}

//------------------------------------------------------------------------------
void vtkTetrahedraRayIntegral::SetVolumeProperty(vtkVolumeProperty* property)
{
  if (this->VolumeProperty != property)
  {
    this->VolumeProperty = property;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
vtkVolumeProperty* vtkTetrahedraRayIntegral::GetVolumeProperty()
{
  return this->VolumeProperty;
}

//------------------------------------------------------------------------------
void vtkTetrahedraRayIntegral::SetNumberOfEnergyBins(int bins)
{
  const auto wanted = static_cast<std::size_t>(std::max(bins, 0));
  if (wanted != this->Internals->EnergyBins.size())
  {
    this->Internals->EnergyBins.resize(wanted);
    this->Modified();
  }
}

//------------------------------------------------------------------------------
int vtkTetrahedraRayIntegral::GetNumberOfEnergyBins()
{
  return static_cast<int>(this->Internals->EnergyBins.size());
}

//------------------------------------------------------------------------------
void vtkTetrahedraRayIntegral::SetBinAttenuation(int bin, double attenuation)
{
  if (SetOfBin(this->Internals->EnergyBins, bin, &meniscus::EnergyBin::Attenuation, attenuation))
  {
    this->Modified();
  }
}

//------------------------------------------------------------------------------
double vtkTetrahedraRayIntegral::GetBinAttenuation(int bin)
{
  return GetOfBin(this->Internals->EnergyBins, bin, &meniscus::EnergyBin::Attenuation);
}

//------------------------------------------------------------------------------
void vtkTetrahedraRayIntegral::SetBinEmission(int bin, double emission)
{
  if (SetOfBin(this->Internals->EnergyBins, bin, &meniscus::EnergyBin::Emission, emission))
  {
    this->Modified();
  }
}

//------------------------------------------------------------------------------
double vtkTetrahedraRayIntegral::GetBinEmission(int bin)
{
  return GetOfBin(this->Internals->EnergyBins, bin, &meniscus::EnergyBin::Emission);
}

//------------------------------------------------------------------------------
void vtkTetrahedraRayIntegral::SetBinIntensity(int bin, double intensity)
{
  if (SetOfBin(this->Internals->EnergyBins, bin, &meniscus::EnergyBin::Intensity, intensity))
  {
    this->Modified();
  }
}

//------------------------------------------------------------------------------
double vtkTetrahedraRayIntegral::GetBinIntensity(int bin)
{
  return GetOfBin(this->Internals->EnergyBins, bin, &meniscus::EnergyBin::Intensity);
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkTetrahedraRayIntegral::GetNumberOfMeshBuilds()
{
  return this->Internals->Input.GetBuildVersion().GetChanges();
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkTetrahedraRayIntegral::GetNumberOfPointUpdates()
{
  return this->Internals->Input.GetNumberOfPointUpdates();
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkTetrahedraRayIntegral::GetNumberOfScalarUpdates()
{
  return this->Internals->Input.GetScalarVersion().GetChanges();
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkTetrahedraRayIntegral::GetNumberOfActiveSetBuilds()
{
  return this->Internals->Input.GetActiveSetBuilds();
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkTetrahedraRayIntegral::GetNumberOfTransferFunctionBuilds()
{
  return this->Internals->Property.GetNumberOfBuilds();
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkTetrahedraRayIntegral::GetNumberOfBinUpdates()
{
  return this->Internals->Bins.GetNumberOfBuilds();
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkTetrahedraRayIntegral::GetNumberOfMembraneBuilds()
{
  return this->Internals->Membrane.GetShapeVersion().GetChanges();
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkTetrahedraRayIntegral::GetNumberOfCasts()
{
  return this->Internals->GetNumberOfCasts();
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkTetrahedraRayIntegral::GetNumberOfCellSearches()
{
  return this->Internals->Input.GetNumberOfInputCellSearches();
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkTetrahedraRayIntegral::GetNumberOfRays()
{
  return this->Internals->GetStatistics().Rays;
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkTetrahedraRayIntegral::GetNumberOfTraversalSteps()
{
  return this->Internals->GetStatistics().Steps;
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkTetrahedraRayIntegral::GetNumberOfLostRays()
{
  return this->Internals->GetStatistics().Lost;
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkTetrahedraRayIntegral::GetNumberOfTransparentCells()
{
  return this->Internals->Input.GetMesh().GetNumberOfUnknownCells();
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkTetrahedraRayIntegral::GetNumberOfRejectedCells()
{
  return this->Internals->Input.GetNumberOfRejectedCells();
}

//------------------------------------------------------------------------------
vtkMTimeType vtkTetrahedraRayIntegral::GetMTime()
{
  vtkMTimeType time = std::max(this->Superclass::GetMTime(), this->Interfaces->GetMTime());
  if (this->Camera)
  {
    time = std::max(time, this->Camera->GetMTime());
  }
  return this->VolumeProperty ? std::max(time, this->VolumeProperty->GetMTime()) : time;
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkTetrahedraRayIntegral::GetNumberOfTetrahedra()
{
  return this->Internals->Input.GetMesh().GetNumberOfCells();
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkTetrahedraRayIntegral::GetNumberOfCellDivisions()
{
  return this->Internals->Input.GetDivision().GetNumberOfDivisions();
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkTetrahedraRayIntegral::GetNumberOfFoldedCells()
{
  return this->Internals->Input.GetDivision().GetCounts().FoldedCells;
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkTetrahedraRayIntegral::GetNumberOfUnresolvedEdges()
{
  return this->Internals->Input.GetDivision().GetCounts().UnresolvedEdges;
}

//------------------------------------------------------------------------------
void vtkTetrahedraRayIntegral::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "CellDivision: " << this->CellDivision << "\n";
  os << indent << "DivisionPlaceTolerance: " << this->DivisionPlaceTolerance << "\n";
  os << indent << "DivisionScalarTolerance: " << this->DivisionScalarTolerance << "\n";
  os << indent << "MaximumNumberOfPieces: " << this->MaximumNumberOfPieces << "\n";
  os << indent << "NumberOfTetrahedra: " << this->GetNumberOfTetrahedra() << "\n";
  os << indent << "NumberOfCellDivisions: " << this->GetNumberOfCellDivisions() << "\n";
  os << indent << "NumberOfFoldedCells: " << this->GetNumberOfFoldedCells() << "\n";
  os << indent << "NumberOfUnresolvedEdges: " << this->GetNumberOfUnresolvedEdges() << "\n";
  const auto vector = [&os, indent](const char* name, const double(&values)[3]) {
    os << indent << name << ": (" << values[0] << ", " << values[1] << ", " << values[2] << ")\n";
  };
  const char* const modes[] = { "FITTED", "PARALLEL", "CAMERA" };
  os << indent << "FrameMode: " << modes[this->FrameMode] << "\n";
  vector("Direction", this->Direction);
  vector("ViewUp", this->ViewUp);
  vector("FrameOrigin", this->FrameOrigin);
  vector("FrameAxis1", this->FrameAxis1);
  vector("FrameAxis2", this->FrameAxis2);
  os << indent << "Camera: " << this->Camera << "\n";
  os << indent << "ImageSize: (" << this->ImageSize[0] << ", " << this->ImageSize[1] << ")\n";
  os << indent << "ArrayComponent: " << this->ArrayComponent << "\n";
  os << indent << "ComputeIntegral: " << this->ComputeIntegral << "\n";
  os << indent << "ComputePathLength: " << this->ComputePathLength << "\n";
  os << indent << "ComputeOpticalDepth: " << this->ComputeOpticalDepth << "\n";
  os << indent << "ComputeFirstDepth: " << this->ComputeFirstDepth << "\n";
  os << indent << "ComputeLastDepth: " << this->ComputeLastDepth << "\n";
  os << indent << "ComputeMinimum: " << this->ComputeMinimum << "\n";
  os << indent << "ComputeMaximum: " << this->ComputeMaximum << "\n";
  os << indent << "ComputeRGBA: " << this->ComputeRGBA << "\n";
  os << indent << "ComputeEnergyBins: " << this->ComputeEnergyBins << "\n";
  os << indent << "ComputeFirstVisible: " << this->ComputeFirstVisible << "\n";
  os << indent << "ComputeOpacityReached: " << this->ComputeOpacityReached << "\n";
  os << indent << "ComputeLargestContribution: " << this->ComputeLargestContribution << "\n";
  os << indent << "EventOpacity: " << this->EventOpacity << "\n";
  os << indent << "EventBlendMode: " << this->EventBlendMode << "\n";
  os << indent << "VolumeProperty: " << this->VolumeProperty << "\n";
  os << indent << "OpacityModel: "
     << (this->OpacityModel == ATTENUATION_COEFFICIENT ? "ATTENUATION_COEFFICIENT"
                                                       : "OPACITY_PER_UNIT_DISTANCE")
     << "\n";
  const auto name = [](const char* text) { return text ? text : "(none)"; };
  os << indent << "NumberOfEnergyBins: " << this->GetNumberOfEnergyBins() << "\n";
  os << indent << "AttenuationArrayName: " << name(this->AttenuationArrayName) << "\n";
  os << indent << "EmissionArrayName: " << name(this->EmissionArrayName) << "\n";
  os << indent << "Interfaces: " << this->Interfaces << "\n";
  os << indent << "NumberOfMeshBuilds: " << this->GetNumberOfMeshBuilds() << "\n";
  os << indent << "NumberOfCasts: " << this->GetNumberOfCasts() << "\n";
}
