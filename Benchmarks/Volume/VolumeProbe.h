// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "VolumeContestants.h"

#include <string>

namespace meniscus::benchmark
{

struct ProbeResult
{
  bool Survives = false;
  std::string Fate; // "crashed", "no end in 60 s"; empty if it survives
  double BytesPerCell = 0.0;
};

/**
 * Draws all views with one mapper in a separate process (this program with --probe NAME), which may
 * crash or be terminated, and measures the memory for the mesh in it.
 */
ProbeResult ProbeContestant(const std::string& name, const VolumeOptions& options);

/** Work of that process; returns its exit status. */
int RunProbe(const Contestant& contestant, const VolumeOptions& options);

} // namespace meniscus::benchmark
