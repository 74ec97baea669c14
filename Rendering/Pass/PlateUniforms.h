// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

class vtkShaderProgram;

namespace meniscus
{

/** Source of vtkPlateTransmittance.glsl, with the number of interfaces that it takes, 16. */
std::string PlateShaderSource();

/**
 * Sets its uniforms. The interfaces behind the first 16 are left out.
 * @param indices index of refraction behind each interface, relative to the medium in front of the
 *   first.
 */
void SetPlateUniforms(vtkShaderProgram* program, const std::vector<double>& indices);

}
