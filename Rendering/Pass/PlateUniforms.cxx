// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rendering/Pass/PlateUniforms.h"

#include "vtkPlateTransmittance.h"

#include "vtkShaderProgram.h"

#include <algorithm>

namespace meniscus
{
namespace
{

/** Interfaces that the shader has room for; it leaves out the reflections at further ones. */
constexpr int LargestNumber = 16;

}

//------------------------------------------------------------------------------
std::string PlateShaderSource()
{
  return "#define MAXIMUM_OF_INTERFACES " + std::to_string(LargestNumber) + "\n" +
    vtkPlateTransmittance;
}

//------------------------------------------------------------------------------
void SetPlateUniforms(vtkShaderProgram* program, const std::vector<double>& indices)
{
  const int interfaces = std::min(static_cast<int>(indices.size()), LargestNumber);
  float numbers[LargestNumber];
  std::copy_n(indices.begin(), interfaces, numbers);
  program->SetUniformi("interfaces", interfaces);
  program->SetUniform1fv("relativeIndices", interfaces, numbers);
}

}
