// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "VolumeContestants.h"

namespace meniscus::benchmark
{

/**
 * A mesh resampled to an image with `size` points along its longest side by vtkResampleToImage, and
 * drawn by vtkFixedPointVolumeRayCastMapper. Samples outside of the mesh are transparent; opacities
 * are converted, so that both models of opacity attenuate alike.
 */
MapperPointer MakeResampledMapper(int size);

} // namespace meniscus::benchmark
