// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Properties and counters of vtkTetrahedraRayIntegral.
#include "Rendering/RayIntegralInternals.h"

#include "Filters/Common/Accessors.h"

#include "vtkCamera.h"
#include "vtkPolyData.h"
#include "vtkRefractingInterfaceCollection.h"

#include <algorithm>
#include <cstddef>

meniscusStatisticsMacro(vtkTetrahedraRayIntegral);
meniscusSetClampMacro(vtkTetrahedraRayIntegral, FrameMode, int, FITTED, CAMERA);
meniscusSetClampMacro(
  vtkTetrahedraRayIntegral, CellDivision, int, FIXED_DIVISION, ADAPTIVE_DIVISION);
meniscusSetClampMacro(
  vtkTetrahedraRayIntegral, MaximumNumberOfPieces, vtkTypeInt64, 0, VTK_TYPE_INT64_MAX);
meniscusSetClampMacro(vtkTetrahedraRayIntegral, ArrayComponent, int, -1, VTK_INT_MAX);
meniscusSetClampMacro(vtkTetrahedraRayIntegral, EventOpacity, double, 0.0, 1.0);
meniscusSetClampMacro(
  vtkTetrahedraRayIntegral, OpacityModel, int, ATTENUATION_COEFFICIENT, OPACITY_PER_UNIT_DISTANCE);
meniscusGetInternalMacro(
  vtkTetrahedraRayIntegral, vtkDataArraySelection*, ArraySelection(), Arrays);
meniscusGetInternalMacro(vtkTetrahedraRayIntegral, int, NumberOfEnergyBins(), EnergyBins.size());
meniscusObjectMacro(vtkTetrahedraRayIntegral, VolumeProperty, vtkVolumeProperty, VolumeProperty);

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
// Setter and getter of a number of each bin.
#define meniscusBinMacro(name)                                                                     \
  void vtkTetrahedraRayIntegral::SetBin##name(int bin, double value)                               \
  {                                                                                                \
    if (SetOfBin(this->Internals->EnergyBins, bin, &meniscus::EnergyBin::name, value))             \
    {                                                                                              \
      this->Modified();                                                                            \
    }                                                                                              \
  }                                                                                                \
  double vtkTetrahedraRayIntegral::GetBin##name(int bin)                                           \
  {                                                                                                \
    return GetOfBin(this->Internals->EnergyBins, bin, &meniscus::EnergyBin::name);                 \
  }

meniscusBinMacro(Attenuation);
meniscusBinMacro(Emission);
meniscusBinMacro(Intensity);

//------------------------------------------------------------------------------
vtkMTimeType vtkTetrahedraRayIntegral::GetMTime()
{
  vtkMTimeType time = std::max({ this->Superclass::GetMTime(), this->Interfaces->GetMTime(),
    this->Internals->Arrays->GetMTime() });
  if (this->Camera)
  {
    time = std::max(time, this->Camera->GetMTime());
  }
  return this->VolumeProperty ? std::max(time, this->VolumeProperty->GetMTime()) : time;
}

//------------------------------------------------------------------------------
/** All numbers that the class reports. */
const std::vector<meniscus::Statistic<vtkTetrahedraRayIntegral>>&
vtkTetrahedraRayIntegral::vtkInternals::List()
{
  using Self = vtkTetrahedraRayIntegral;
  static const std::vector<meniscus::Statistic<Self>> list =
    meniscus::JoinStatistics<Self, meniscus::RayCastTables>(
      meniscus::RayCastTables::ListStatistics(),
      [](Self& self) -> meniscus::RayCastTables& { return *self.Internals; },
      {
        { "NumberOfBinUpdates", "readings of arrays of energy bins",
          [](Self& self) { return double(self.Internals->Bins.GetNumberOfBuilds()); } },
        { "NumberOfCasts",
          "casts of an image's rays: one for all measurements of the scalar, one for RGBA, one "
          "for three energy bins with arrays or for one that emits",
          [](Self& self) { return double(self.Internals->GetNumberOfCasts()); } },
        { "NumberOfRays", "rays of the last image that met the mesh",
          [](Self& self) { return double(self.Internals->GetStatistics().Rays); } },
        { "NumberOfTraversalSteps", "cells that the rays of the last image crossed",
          [](Self& self) { return double(self.Internals->GetStatistics().Steps); } },
        { "NumberOfLostRays", "rays of the last image whose walk did not end on the boundary",
          [](Self& self) { return double(self.Internals->GetStatistics().Lost); } },
      });
  return list;
}

//------------------------------------------------------------------------------
void vtkTetrahedraRayIntegral::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "CellDivision: " << this->CellDivision << "\n";
  os << indent << "DivisionTolerance: " << this->DivisionTolerance << "\n";
  os << indent << "MaximumNumberOfPieces: " << this->MaximumNumberOfPieces << "\n";
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
  os << indent << "ArraySelection:\n";
  this->Internals->Arrays->PrintSelf(os, indent.GetNextIndent());
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
  meniscus::PrintStatistics(meniscus::MeasureStatistics(*this, vtkInternals::List()), os, indent);
}
