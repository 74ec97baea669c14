// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vtkTetrahedraRayCastMapper.h>

namespace meniscus
{

/**
 * Settings of the tables on the graphics device for tests. Otherwise the mapper chooses them by the
 * limits of the device.
 */
struct DeviceTableLimits
{
  /** Sets the largest number of texels of a table, besides the device's own limit. */
  static void SetLargest(vtkTetrahedraRayCastMapper* mapper, vtkTypeInt64 texels)
  {
    mapper->MaximumTableSize = texels;
    mapper->Modified();
  }

  /** Sets whether cells take 20 bytes each, even if 32 would fit. */
  static void SetCompact(vtkTetrahedraRayCastMapper* mapper, bool compact)
  {
    mapper->CompactCells = compact;
    mapper->Modified();
  }
};

}
