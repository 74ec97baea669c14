// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/** Time steps on one mesh: the share that a step takes of the first frame of a mesh. */
#pragma once

#include <iosfwd>

namespace meniscus::benchmark
{

struct VolumeOptions;

/**
 * Prints a Markdown table, natively and through OpenGL, with and without light: processor time of
 * the first frame of a mesh, and of steps with new scalars, new points, both, or new arrays of the
 * same values, relative to that. All arrays of a step are new. Frames have 8 x 8 pixels. With
 * --json, writes the milliseconds to a file, too. Returns false if that cannot be written.
 */
bool PrintSteps(std::ostream& out, const VolumeOptions& options);

} // namespace meniscus::benchmark
