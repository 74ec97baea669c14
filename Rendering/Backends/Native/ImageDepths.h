// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Volume/Entries/BoundaryRaster.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace meniscus
{

/** True if two images of one number per pixel are equal in the box. */
template <typename Number>
bool HaveEqualRows(const BoundaryRaster::PixelBox& box, int width, const std::vector<Number>& a,
  const std::vector<Number>& b)
{
  for (int row = box.Bottom; row < box.Top; ++row)
  {
    const std::ptrdiff_t start = std::ptrdiff_t{ row } * width;
    if (!std::equal(a.begin() + start + box.Left, a.begin() + start + box.Right,
          b.begin() + start + box.Left))
    {
      return false;
    }
  }
  return true;
}

/** Window depths in [0, 1] at which the rays of an image end, one per pixel, rows from below. */
struct ImageDepths
{
  const std::vector<float>& Now;
  /** Those that the image was cast for, if the frame is the same otherwise; else null. */
  const std::vector<float>* Before;

  /** True if the image was cast for the same depths in a box of pixels. */
  bool AreThoseBefore(const BoundaryRaster::PixelBox& box, int width) const
  {
    return this->Before && HaveEqualRows(box, width, *this->Before, this->Now);
  }
};

}
