// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rendering/Property/MediumUniforms.h"

#include "vtkShaderProgram.h"

#include <algorithm>

namespace meniscus
{

//------------------------------------------------------------------------------
void SetMediumUniforms(vtkShaderProgram* program, const RefractionMedium& medium)
{
  if (!program->IsUniformUsed("mediumAttenuation"))
  {
    return;
  }
  const auto toFloat = [](double value) { return static_cast<float>(value); };
  float attenuation[3];
  float color[3];
  float range[2];
  std::transform(medium.Attenuation.begin(), medium.Attenuation.end(), attenuation, toFloat);
  std::transform(medium.Color.begin(), medium.Color.end(), color, toFloat);
  std::transform(medium.Range.begin(), medium.Range.end(), range, toFloat);
  program->SetUniformi("mediumIsLinear", medium.Kind == RefractionMedium::Model::Linear ? 1 : 0);
  program->SetUniform3f("mediumAttenuation", attenuation);
  program->SetUniform3f("mediumColor", color);
  program->SetUniform2f("mediumRange", range);
}

}
