// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkNew.h"
#include "vtkPolyData.h"

namespace meniscus
{

/**
 * The last output of a filter. Points, cells and arrays of the next output that have the same
 * values are replaced by the objects of the last one. Mappers recognise data by object and
 * modification time: they upload only objects that are new or modified.
 */
class KeptOutput
{
public:
  /**
   * Replaces points, cells and arrays of `output`, and keeps the result. Objects of `owned` that
   * the output still has afterwards are copied: consumers must not see them, since they may write
   * to the output in place.
   */
  void Reuse(vtkPolyData* output, vtkPolyData* owned = nullptr);

private:
  vtkNew<vtkPolyData> Last;
};

}
