// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/** Charts like Figs. 7 and 8 of Weiler et al. (2003). */
#pragma once

#include <iosfwd>

namespace meniscus::benchmark
{

struct VolumeOptions;

/**
 * FOLDER/paper-views.png: processor time and steps of native frames while the camera turns about
 * two axes, relative to their means. FOLDER/paper-steps.png: rays that still walk after each step,
 * with and without early termination at an opacity of 0.99, as the double-precision reference
 * counts them, and all rays until the last one ends. Prints the figures; returns false if a chart
 * cannot be written.
 */
bool DrawPaper(std::ostream& out, const VolumeOptions& options);

} // namespace meniscus::benchmark
