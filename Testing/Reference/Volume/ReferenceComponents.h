// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * The density-emitter integral of several scalars at once, in double, on the segments that
 * ReferenceRayIntegrator finds.
 */
#ifndef meniscus_ReferenceComponents_h
#define meniscus_ReferenceComponents_h

#include "ReferenceRayIntegrator.h"
#include "ReferenceTransferFunction.h"

#include <array>
#include <vector>

namespace meniscus
{
namespace reference
{

enum class Mixture
{
  Independent,        ///< attenuations add up, each emits its colour
  ColorAndOpacity,    ///< colour by the first, attenuation by the second
  RedGreenBlueOpacity ///< the first three are the colour, attenuation by the fourth
};

/**
 * Premultiplied.
 * @param segments   of one ray, once per component: the same but for the scalars.
 * @param functions  of each component, in the same order; without a meaning where a component is a
 *                   colour. Weights are part of the attenuations.
 */
std::array<double, 4> integrateComponents(const Ray& ray,
  const std::vector<std::vector<RaySegment>>& segments, Mixture mixture,
  const std::vector<ReferenceTransferFunction>& functions);

} // namespace reference
} // namespace meniscus

#endif
