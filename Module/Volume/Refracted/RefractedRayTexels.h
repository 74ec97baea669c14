// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Common/RangeLoop.h"
#include "Volume/Refracted/RayLegs.h"
#include "Volume/Refracted/RefractionFrames.h"

#include <cstdint>
#include <vector>

namespace meniscus
{

/**
 * Data that a shader needs about one refracted leg of a pixel's ray, in two texels of integers.
 * Like the sight ray it is a line in a grid: the grid of one of the RefractionFrames instead of
 * the view's grid.
 */
struct RefractedRayLine
{
  /** Offset in grid units. */
  std::int32_t Offset[2];
  /** Slope per grid unit of depth, in units of FixedPointRays::ShaderSlopeUnit. */
  std::int32_t Slope[2];
  /**
   * Depth of the sight point on the leg before, in the frame of that leg; Nowhere if that leg does
   * not meet the interface.
   */
  float EndBefore;
  /** Depth of the sight point in the line's frame. */
  float Start;
  /** Depth in the line's frame per unit of drawn depth (RayLeg); 0 if there is no leg to draw. */
  float PerDepth;
  /**
   * Index of the frame in bits 0 to 7. From bits 8 and 16 on, the corrections, plus 128, to the
   * grid depths of EndBefore and Start, because floats have too few digits.
   */
  std::int32_t FrameAndRests;

  int GetFrame() const { return this->FrameAndRests & 255; }
  /** Depths in grid units, exact where the mesh may be, computed as in the shader. */
  std::int32_t GetGridEndBefore() const;
  std::int32_t GetGridStart() const;

  static constexpr float Nowhere = 1.0e+30f;
};

/**
 * Computes the lines of all refracted legs: for each leg, from leg 1 on, the lines of all pixels in
 * rows from the bottom. Replaces `lines`.
 * @pre frames.Turn()
 */
void LayOutRefractedRays(const RayLegs& legs, const RefractionFrames& frames, const RangeLoop& loop,
  std::vector<RefractedRayLine>& lines);

}
