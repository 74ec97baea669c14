// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Plain data only: kernels are compiled once per instruction set, and the linker could merge inline
 * functions that such files share with others.
 */
#pragma once

#include <cstdint>

namespace meniscus
{

/** Part of a ray along which the scalar is linear. */
struct MediumSegment
{
  /** Normalised scalars at both ends. */
  float From;
  float To;
  /** World length; other than > 0, the segment does not count. */
  float Length;
};

/** Segments of rays that were cut by other means than the packets' walk. */
struct MediumSegmentList
{
  /** The segments of each ray front to back, ray after ray. */
  const MediumSegment* Segments;
  /** One number per ray: the number of the segment after its last one. */
  const std::int32_t* Ends;
  std::int32_t NumberOfRays;
  /** Four numbers per ray: premultiplied colour and transmittance of its segments. */
  float* Values;
};

}
