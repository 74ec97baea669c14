// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Rendering/Backends/RayCastBackend.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace meniscus
{

/**
 * Tiles of an image that are still to be cast. If the application gives up a frame, the tiles that
 * are done need not be cast again in the next frame with the same view.
 */
class TilesToCast
{
public:
  /**
   * Begins a frame.
   * @param goesOn true if the frame has the image of the frame before it, but for depths.
   * @param isKept true for a tile that need not be cast again if it is done.
   */
  void Begin(int numberOfTiles, bool goesOn, const std::function<bool(int)>& isKept);
  /**
   * Casts the tiles of the frame on all threads; `cast` is called once for each. Returns false if
   * the application gives up the frame before all are done.
   */
  bool Cast(RayCastTarget& target, const std::function<void(int)>& cast);

private:
  /** Nonzero for each tile that is done. */
  std::vector<std::uint8_t> Done;
  std::vector<int> Remaining;
};

}
