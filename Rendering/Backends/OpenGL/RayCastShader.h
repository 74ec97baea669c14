// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Rendering_Backends_OpenGL_RayCastShader_h
#define meniscus_Rendering_Backends_OpenGL_RayCastShader_h

#include "Rendering/Property/RayCastOptics.h"

#include <cstddef>
#include <string>

class vtkShaderProgram;

namespace meniscus
{

/** More lights or planes would not fit into the uniforms that OpenGL 3.2 grants. */
constexpr std::size_t MaximumNumberOfLights = 16;
constexpr std::size_t MaximumNumberOfClippingPlanes = 32;

/** What exceeds these numbers, as text; empty if nothing does. */
std::string DescribeExcess(const RayCastOptics& optics);

/**
 * The preprocessor's definitions that choose among the variants of the ray casting shader: what a
 * scene does not need is not compiled (software rasterisers execute branches that are never taken).
 */
std::string RayCastShaderOptions(const RayCastOptics& optics);

/** A main shader with the walk and the optical model that the options need put in. */
std::string RayCastShaderSource(const char* mainShader, const RayCastOptics& optics);

/** Sets the uniforms of the optical model and the clipping planes. */
void SetOpticsUniforms(vtkShaderProgram* program, const RayCastOptics& optics);

}

#endif
