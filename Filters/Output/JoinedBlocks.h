// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkType.h"

class vtkDataObject;

namespace meniscus
{

/** The output of a filter as one vtkPolyData. It is joined again if a composite output changes. */
class JoinedBlocks
{
public:
  /**
   * Returns the output itself if it is a vtkPolyData; all blocks of a composite output together,
   * with the arrays that all of them have; or null.
   */
  vtkPolyData* Get(vtkDataObject* output);

private:
  vtkNew<vtkPolyData> Joined;
  vtkMTimeType Time = 0; ///< of the output that is joined
};

}
