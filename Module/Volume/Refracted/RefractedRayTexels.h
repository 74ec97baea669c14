// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Volume_Refracted_RefractedRayTexels_h
#define meniscus_Volume_Refracted_RefractedRayTexels_h

#include "Common/RangeLoop.h"
#include "Volume/Refracted/RefractedRayField.h"
#include "Volume/Refracted/RefractionFrames.h"

#include <cstdint>
#include <vector>

namespace meniscus
{

/**
 * Data that a shader needs about a pixel's refracted ray, in two texels of integers. Like a
 * straight ray it is a line in a grid: the grid of one of the RefractionFrames instead of that of
 * the view.
 */
struct RefractedRayLine
{
  /** Offset in grid units. */
  std::int32_t Offset[2];
  /** Slope per grid unit of depth, in units of 2^-32. */
  std::int32_t Slope[2];
  /**
   * Depth of the sight point on the straight ray; Nowhere if that ray does not meet the membrane.
   */
  float MembraneDepth;
  /** Depth of the sight point in the line's frame. */
  float Start;
  /**
   * Depth in the line's frame per unit of depth on the straight ray; 0 if there is no refracted ray
   * to draw.
   */
  float PerDepth;
  /**
   * Index of the frame in bits 0 to 7. From bits 8 and 16 on, the corrections, plus 128, to the
   * grid depths of MembraneDepth and Start, because floats have too few digits.
   */
  std::int32_t FrameAndRests;

  int GetFrame() const { return this->FrameAndRests & 255; }
  /** Depths in grid units, exact where the mesh may be, computed as in the shader. */
  std::int32_t GetGridMembraneDepth() const;
  std::int32_t GetGridStart() const;

  static constexpr float Nowhere = 1.0e+30f;
};

/**
 * Computes the lines of all pixels, in rows from the bottom. Replaces `lines`.
 * @pre frames.Turn()
 */
void LayOutRefractedRays(const RefractedRayField& sight, const RefractionFrames& frames,
  const RangeLoop& loop, std::vector<RefractedRayLine>& lines);

}

#endif
