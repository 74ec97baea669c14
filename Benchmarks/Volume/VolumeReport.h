// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "VolumeOptions.h"

#include <ostream>

namespace meniscus::benchmark
{

/**
 * Prints the mapper's goals next to the measured values: rows of a Markdown table. Uses the meshes
 * of the data folder if they exist, otherwise generated meshes, or the single mesh that is given.
 */
void PrintReport(std::ostream& out, const VolumeOptions& options);

/** Milliseconds per frame for generated meshes of growing size, and the exponent of the growth. */
void PrintGrowth(std::ostream& out, const VolumeOptions& options);

} // namespace meniscus::benchmark
