// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * The density-emitter integral of several scalars at once, in double precision, on the segments of
 * ReferenceRayIntegrator.
 */
#pragma once

#include "ReferenceRayIntegrator.h"
#include "ReferenceTransferFunction.h"

#include <array>
#include <vector>

namespace meniscus::reference
{

enum class Mixture
{
  Independent,        ///< attenuations are added, and each component emits its colour
  ColorAndOpacity,    ///< colour by the first component, attenuation by the second
  RedGreenBlueOpacity ///< the first three components are the colour, attenuation by the fourth
};

/**
 * Premultiplied colour of a ray.
 * @param segments segments of one ray, once per component, with equal geometry.
 * @param functions function of each component, in the same order; ignored if the component is a
 *   colour. Weights are included in the attenuations.
 */
std::array<double, 4> IntegrateComponents(const Ray& ray,
  const std::vector<std::vector<RaySegment>>& segments, Mixture mixture,
  const std::vector<ReferenceTransferFunction>& functions);

} // namespace meniscus::reference
