// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "ComparisonScene.h"
#include "VolumeScene.h"

namespace meniscus::test
{

/**
 * Draws a scene by vtkRefractedGeometryFilter and vtkRefractionPass; `tolerance` is the filter's
 * AngularTolerance in degrees.
 */
ByteImage DrawRefractedScene(const ComparisonScene& scene, int pixels, double tolerance);

} // namespace meniscus::test
