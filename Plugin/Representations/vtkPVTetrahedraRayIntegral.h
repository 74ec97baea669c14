// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPVTetrahedraRayIntegral
 * @brief   vtkTetrahedraRayIntegral for ParaView, with blocks of surfaces and a table of interfaces
 *
 * Use it on one rank: rays are not continued in the cells of other ranks. See InterfaceTable for
 * the rows of the table.
 */
#ifndef vtkPVTetrahedraRayIntegral_h
#define vtkPVTetrahedraRayIntegral_h

#include "SurfaceGathering.h"                 // For the table of interfaces
#include "vtkDataArraySelection.h"            // For the switches
#include "vtkMeniscusRepresentationsModule.h" // For export macro
#include "vtkTetrahedraRayIntegral.h"

class VTKMENISCUSREPRESENTATIONS_EXPORT vtkPVTetrahedraRayIntegral : public vtkTetrahedraRayIntegral
{
public:
  vtkTypeMacro(vtkPVTetrahedraRayIntegral, vtkTetrahedraRayIntegral);

  /** @{ */
  /** Switches of the arrays; an array of extremes comes with their depths. */
  void SetComputeIntegral(bool on) { this->Switch("Integral", on); }
  void SetComputePathLength(bool on) { this->Switch("PathLength", on); }
  void SetComputeFirstDepth(bool on) { this->Switch("FirstDepth", on); }
  void SetComputeLastDepth(bool on) { this->Switch("LastDepth", on); }
  void SetComputeMinimum(bool on)
  {
    this->Switch("Minimum", on);
    this->Switch("MinimumDepth", on);
  }
  void SetComputeMaximum(bool on)
  {
    this->Switch("Maximum", on);
    this->Switch("MaximumDepth", on);
  }
  void SetComputeEnergyBins(bool on) { this->Switch("EnergyBins", on); }
  /** @} */

  /** @{ */
  /** Statistics that ParaView reads as properties. */
  int GetNumberOfMeshBuilds() { return this->GetNumber("NumberOfMeshBuilds"); }
  int GetNumberOfPointUpdates() { return this->GetNumber("NumberOfPointUpdates"); }
  int GetNumberOfScalarUpdates() { return this->GetNumber("NumberOfScalarUpdates"); }
  /** @} */

private:
  void Switch(const char* name, bool on)
  {
    this->GetArraySelection()->SetArraySetting(name, on ? 1 : 0);
  }
  int GetNumber(const char* name) { return static_cast<int>(this->GetStatistic(name)); }

  meniscusSurfaceGatheringDeclarations(vtkPVTetrahedraRayIntegral, RequestUpdateExtent);
};

#endif
