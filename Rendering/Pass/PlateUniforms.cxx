// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rendering/Pass/PlateUniforms.h"

#include "vtkPlateTransmittance.h"

#include "vtkShaderProgram.h"

#include <algorithm>

namespace meniscus
{

//------------------------------------------------------------------------------
std::string PlateShaderSource()
{
  return "#define MAXIMUM_OF_INTERFACES " + std::to_string(LargestNumberOfPlates) + "\n" +
    vtkPlateTransmittance;
}

//------------------------------------------------------------------------------
void SetPlateUniforms(vtkShaderProgram* program, const std::vector<double>& indices)
{
  const int interfaces = std::min(static_cast<int>(indices.size()), LargestNumberOfPlates);
  float numbers[LargestNumberOfPlates];
  std::copy_n(indices.begin(), interfaces, numbers);
  program->SetUniformi("interfaces", interfaces);
  program->SetUniform1fv("relativeIndices", interfaces, numbers);
}

}
