// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Volume/Optics/RefractionMedium.h"

class vtkShaderProgram;

namespace meniscus
{

/** Sets the uniforms of vtkMediumTransmittance.glsl, if the program uses them. */
void SetMediumUniforms(vtkShaderProgram* program, const RefractionMedium& medium);

}
