// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "ByteReader.h"
#include "Volume/Optics/SurfaceLighting.h"
#include "Volume/Optics/TransferFunction.h"
#include "Volume/Rays/RayFrame.h"

#include <vector>

namespace meniscus::test
{

/**
 * Control points in the order of their scalars, as BuildIntervals() wants them: finite scalars,
 * attenuations >= 0 and colours in [0, 1].
 */
std::vector<TransferFunctionPoint> ReadFunction(ByteReader& reader);

/** Finite scalars as a distribution. */
ScalarDistribution DistributionOf(const std::vector<double>& scalars);

SurfaceLighting ReadLighting(ByteReader& reader);

/** A camera of any kind, which ComputeRayFrame() may refuse. */
RayFrameInput ReadCamera(
  ByteReader& reader, const glm::dvec3& center, double radius, int width, int height);

}
