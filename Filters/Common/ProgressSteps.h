// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkAlgorithm.h"
#include "vtkType.h"

#include <algorithm>
#include <functional>

namespace meniscus
{

/**
 * Calls `body(begin, end)` for consecutive ranges of numbers below `count`, and reports the
 * progress of the algorithm in between: about `reports` times, but not for fewer than `least`
 * numbers. Returns false after an abort.
 */
inline bool RunInSteps(vtkAlgorithm* algorithm, vtkIdType count, vtkIdType reports, vtkIdType least,
  const std::function<void(vtkIdType, vtkIdType)>& body)
{
  const vtkIdType step = std::max(count / reports, least);
  for (vtkIdType first = 0; first < count; first += step)
  {
    const vtkIdType last = std::min(first + step, count);
    body(first, last);
    algorithm->UpdateProgress(static_cast<double>(last) / static_cast<double>(count));
    if (algorithm->GetAbortExecute())
    {
      return false;
    }
  }
  return true;
}

}
