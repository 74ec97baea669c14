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
 * What a shader wants to know of a pixel's ray behind the membrane, in two texels of integers. Like
 * a straight ray it is a line in a grid, that of one of the RefractionFrames in place of the grid
 * of the view.
 */
struct RefractedRayLine
{
  /** In grid units. */
  std::int32_t Offset[2];
  /** Per grid unit of depth, in units of 2^-32. */
  std::int32_t Slope[2];
  /** Of the sight point, on the straight ray; Nowhere where that does not meet the membrane. */
  float MembraneDepth;
  /** The sight point's depth in the line's frame. */
  float Start;
  /** Depth in the line's frame per depth on the straight ray; 0 where nothing goes on. */
  float PerDepth;
  /**
   * Index of the frame; from bit 8 and 16 on what has to be added to the grid depths of
   * MembraneDepth and Start, plus 128, for floats have too few digits.
   */
  std::int32_t FrameAndRests;

  int GetFrame() const { return this->FrameAndRests & 255; }
  /** Depths in grid units, exact where the mesh may be; as a shader finds them. */
  std::int32_t GetGridMembraneDepth() const;
  std::int32_t GetGridStart() const;

  static constexpr float Nowhere = 1.0e+30f;
};

/** The lines of all pixels, rows from below. Replaces `lines`. @pre frames.Turn() */
void LayOutRefractedRays(const RefractedRayField& sight, const RefractionFrames& frames,
  const RangeLoop& loop, std::vector<RefractedRayLine>& lines);

}

#endif
