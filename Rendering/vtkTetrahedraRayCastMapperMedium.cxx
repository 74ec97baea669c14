// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Membranes of vtkTetrahedraRayCastMapper, and the medium behind them.
#include "vtkTetrahedraRayCastMapper.h"

#include "Rendering/Common/Matrices.h"
#include "Rendering/RayCastMapperInternals.h"
#include "Volume/Optics/RefractionMedium.h"

#include "vtkPolyData.h"
#include "vtkVolume.h"

#include <algorithm>
#include <string>

//------------------------------------------------------------------------------
void vtkTetrahedraRayCastMapper::SetMembraneData(vtkPolyData* membrane)
{
  this->SetInputDataInternal(1, membrane);
}

//------------------------------------------------------------------------------
void vtkTetrahedraRayCastMapper::AddMembraneData(vtkPolyData* membrane)
{
  this->AddInputDataInternal(1, membrane);
}

//------------------------------------------------------------------------------
vtkPolyData* vtkTetrahedraRayCastMapper::GetMembrane()
{
  return this->GetMembrane(0);
}

//------------------------------------------------------------------------------
vtkPolyData* vtkTetrahedraRayCastMapper::GetMembrane(int i)
{
  return i >= 0 && i < this->GetNumberOfMembranes()
    ? vtkPolyData::SafeDownCast(this->GetInputDataObject(1, i))
    : nullptr;
}

//------------------------------------------------------------------------------
void vtkTetrahedraRayCastMapper::vtkInternals::SetPlace(vtkVolume* volume)
{
  const glm::dmat4 matrix = meniscus::ToGlm(volume->GetMatrix());
  if (meniscus::HasInverse(matrix))
  {
    this->WorldToModel = glm::inverse(matrix);
  }
}

//------------------------------------------------------------------------------
int vtkTetrahedraRayCastMapper::GetNumberOfMembranes()
{
  return this->GetNumberOfInputConnections(1);
}

//------------------------------------------------------------------------------
/** Takes the properties of the medium over; reports those that have no meaning. */
void vtkTetrahedraRayCastMapper::UpdateMedium()
{
  vtkInternals& internals = *this->Internals;
  meniscus::RefractionMedium medium;
  medium.Kind = this->MediumModel == LINEAR ? meniscus::RefractionMedium::Model::Linear
                                            : meniscus::RefractionMedium::Model::Exponential;
  std::copy_n(this->MediumAttenuationCoefficients, 3, medium.Attenuation.begin());
  std::copy_n(this->MediumRange, 2, medium.Range.begin());
  std::copy_n(this->MediumColor, 3, medium.Color.begin());
  const std::string fault = medium.DescribeFault();
  if (!fault.empty())
  {
    // Once for each change, not for each frame.
    if (this->vtkObject::GetMTime() != internals.MediumFaultTime)
    {
      vtkErrorMacro(<< fault << "; the medium is drawn clear.");
    }
    internals.MediumFaultTime = this->vtkObject::GetMTime();
    medium = meniscus::RefractionMedium();
  }
  internals.Medium = medium.IsClear() ? internals.Surroundings : medium;
}
