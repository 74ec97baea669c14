// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_VolumeReport_h
#define meniscus_VolumeReport_h

#include "VolumeOptions.h"

#include <ostream>

namespace meniscus
{
namespace benchmark
{

/**
 * Prints what the mapper is to reach beside what it reaches: rows of a Markdown table. On the
 * meshes of the data folder where they are, else on generated ones, or on the one mesh given.
 */
void printReport(std::ostream& out, const VolumeOptions& options);

/** ms per frame for generated meshes of growing size, and the exponent of the growth. */
void printGrowth(std::ostream& out, const VolumeOptions& options);

} // namespace benchmark
} // namespace meniscus

#endif
