// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "VolumeContestants.h"

namespace meniscus::benchmark
{

/**
 * Intel's Open VKL, which OSPRay and ParaView's ray tracer sample volumes with, as a mapper. Rays
 * are cast in packets of eight. Along each interval that Open VKL's iterator returns for values of
 * an opacity above 0, the field is sampled at the middle of steps of the interval's nominal length,
 * but at least 1/1024 of its length, divided by `rate`, as its own renderers and OSPRay do; a
 * step's opacity is 1 - exp(-a s) for the attenuation coefficient a of the sample and the length s.
 * A ray ends at an opacity of 0.999.
 *
 * Null if Open VKL's device for processors cannot be loaded.
 * @param rate Samples per nominal length, above 0.
 * @param threads Threads of Open VKL's set-up; 0: all.
 */
MapperPointer MakeOpenVklMapper(double rate, int threads);

} // namespace meniscus::benchmark
