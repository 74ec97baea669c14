// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

class vtkShaderProgram;

namespace meniscus
{

/** Interfaces that the shader has room for; it leaves out the reflections at further ones. */
constexpr int LargestNumberOfPlates = 16;

/** Source of vtkPlateTransmittance.glsl for LargestNumberOfPlates. */
std::string PlateShaderSource();

/**
 * Sets its uniforms. The interfaces behind the first LargestNumberOfPlates are left out.
 * @param indices index of refraction behind each interface, relative to the medium in front of the
 *   first.
 */
void SetPlateUniforms(vtkShaderProgram* program, const std::vector<double>& indices);

}
