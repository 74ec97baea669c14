// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace meniscus::benchmark
{

/** Processor time of a frame, as VTK draws it and with its blending of opaque geometry off. */
struct FloorFrame
{
  std::string What;
  double Ms = 0.0;
  double UnblendedMs = 0.0;
};

/**
 * Frames of the races' size that cost less than any picture of the well through water: an empty
 * window, one quad over all pixels and the well itself, and the same through water for comparison.
 * Frames of all alternate.
 */
std::vector<FloorFrame> MeasureDrawingFloor();

} // namespace meniscus::benchmark
