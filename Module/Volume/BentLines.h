// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Volume_BentLines_h
#define meniscus_Volume_BentLines_h

#include "Refraction/RangeLoop.h"
#include "Volume/BentFrames.h"
#include "Volume/MembraneSight.h"

#include <vector>

namespace meniscus
{

/**
 * What a shader wants to know of a pixel's ray behind the membrane, in two texels. Like a straight
 * ray it is a line (x, y) = Origin + depth * Slope, of one of the BentFrames in place of the frame
 * of the view, so that single precision does to it what it does to those: slopes are within 1, and
 * the origin is within 2 radii of the mesh where the line meets that.
 */
struct BentLine
{
  float Origin[2];
  float Slope[2];
  /** Of the sight point, on the straight ray; Nowhere where that does not meet the membrane. */
  float MembraneDepth;
  /** The sight point's depth in the line's frame. */
  float Start;
  /** Depth in the line's frame per depth on the straight ray; 0 where nothing goes on. */
  float PerDepth;
  /** Index of the frame. */
  float Frame;

  static constexpr float Nowhere = 1.0e+30f;
};

/** The lines of all pixels, rows from below. Replaces `lines`. @pre frames.Turn() */
void LayOutBentLines(const MembraneSight& sight, const BentFrames& frames, const RangeLoop& loop,
  std::vector<BentLine>& lines);

}

#endif
