// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/** The graphics device that OpenGL uses here: names, limits, and the speed of its memory. */
#pragma once

#include <ostream>

class vtkRenderWindow;

namespace meniscus::benchmark
{

/** Prints one "name: value" per line. */
void PrintDevice(std::ostream& out);

/**
 * Bytes per second that the device reads and writes while it copies one buffer of 256 MiB to
 * another: the best of five copies. 0 if the buffers cannot be had. The window must have rendered.
 */
double MeasureCopyBandwidth(vtkRenderWindow* window);

} // namespace meniscus::benchmark
