// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Volume_Caster_ImageEdges_h
#define meniscus_Volume_Caster_ImageEdges_h

#include "Common/RangeLoop.h"
#include "Volume/Entries/BoundaryRaster.h"

#include <cstdint>
#include <vector>

namespace meniscus
{

/**
 * Height of a step that is not an edge. At a step of height h, anywhere in a pixel, a single ray
 * differs from the pixel's mean colour by a number between 0 and h / 2, by h / sqrt(12) in the
 * quadratic mean: that is 2 of 255 levels.
 */
constexpr float EdgeThreshold = 2.0f * 3.4641016f / 255.0f;

/**
 * Finds the pixels of an image for which one ray is not enough: their colour differs from the mean
 * of two opposite neighbours, in one of the four directions, by more than EdgeThreshold / 2. A step
 * of a colour between two pixels changes both of these differences by its height, a linear change
 * none. The mean colour of a pixel at a step differs from one of the two colours by at most half
 * of the height.
 * @param rgba premultiplied colours, four numbers per pixel, rows from below.
 * @param filled pixels outside of this box are zero.
 * @param edges set to 1 for each pixel at an edge, and to 0 for the others. Images with a single
 *   row or column are edges as a whole.
 */
void FindImageEdges(const std::vector<float>& rgba, int width, int height,
  const BoundaryRaster::PixelBox& filled, const RangeLoop& loop, std::vector<std::uint8_t>& edges);

}

#endif
