// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Rendering/Backends/RayCastBackend.h"

#include <memory>

namespace meniscus
{

/** Fragment shaders; AUTOMATIC leaves rasterisers in software to others. */
std::unique_ptr<RayCastBackend> MakeFragmentBackend(RayCastSharing& sharing);

/** Compute shaders, which need OpenGL 4.3; only where asked for. */
std::unique_ptr<RayCastBackend> MakeComputeBackend(RayCastSharing& sharing);

}
