// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Rendering/Property/RayCastOptics.h"

#include <cstddef>
#include <string>

class vtkShaderProgram;

namespace meniscus
{

/** More lights or planes would exceed the uniforms that OpenGL 3.2 guarantees. */
constexpr std::size_t MaximumNumberOfLights = 16;
constexpr std::size_t MaximumNumberOfClippingPlanes = 32;

/** Description of the numbers that are exceeded; empty if none is. */
std::string DescribeExcess(const RayCastOptics& optics);

/**
 * Preprocessor definitions that select the variant of the ray casting shader: code that a scene
 * does not need is not compiled (software rasterisers execute branches that are never taken).
 */
std::string RayCastShaderOptions(const RayCastOptics& optics);

/** A main shader with the walk and the optical model for the options inserted. */
std::string RayCastShaderSource(const char* mainShader, const RayCastOptics& optics);

/**
 * Source of the shader that lists the entries of tiles.
 * @param legs number of legs of a ray.
 * @param behind true for the entries of a refracted leg.
 */
std::string EntryListerSource(const char* mainShader, int legs, bool behind);

/** Sets the uniforms of the optical model and the clipping planes. */
void SetOpticsUniforms(vtkShaderProgram* program, const RayCastOptics& optics);

}
