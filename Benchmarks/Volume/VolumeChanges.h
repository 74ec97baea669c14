// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/** Frames after changes that a user makes: a moved camera, a light, an opacity, another mesh. */
#pragma once

#include <iosfwd>

namespace meniscus
{
namespace benchmark
{

struct VolumeOptions;

/**
 * Prints a Markdown table of processor times of native frames, the least of several of each kind.
 * With --json, writes them to a file, too. Returns false if that cannot be written.
 */
bool PrintChanges(std::ostream& out, const VolumeOptions& options);

} // namespace benchmark
} // namespace meniscus
