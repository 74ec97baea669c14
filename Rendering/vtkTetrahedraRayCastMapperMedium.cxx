// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Medium of vtkTetrahedraRayCastMapper behind the membrane.
#include "vtkTetrahedraRayCastMapper.h"

#include "Rendering/RayCastMapperInternals.h"
#include "Volume/Optics/RefractionMedium.h"

#include <algorithm>
#include <string>

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
    vtkErrorMacro(<< fault << "; the medium is drawn clear.");
    medium = meniscus::RefractionMedium();
  }
  internals.Medium = medium.IsClear() ? internals.Surroundings : medium;
}
