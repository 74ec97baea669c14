// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/** Loops of the library on the threads of vtkSMPTools. */
#pragma once

#include "Common/RangeLoop.h"
#include "Common/StandardFloatingPoint.h"

#include "vtkSMPTools.h"
#include "vtkType.h"

#include <cstddef>

namespace meniscus
{

/**
 * vtkSMPTools::For() with standard floating-point arithmetic on its threads, whose mode is that of
 * the threads that started them.
 */
template <typename Body>
void ThreadedFor(vtkIdType first, vtkIdType last, vtkIdType grain, const Body& body)
{
  vtkSMPTools::For(first, last, grain,
    [&body](vtkIdType begin, vtkIdType end)
    {
      const StandardFloatingPoint standard;
      body(begin, end);
    });
}

/** Calls `body` for ranges of [0, count), each of at least `grain` elements, on several threads. */
inline void ThreadedRanges(std::size_t count, vtkIdType grain, const RangeBody& body)
{
  ThreadedFor(0, static_cast<vtkIdType>(count), grain,
    [&body](vtkIdType begin, vtkIdType end)
    { body(static_cast<std::size_t>(begin), static_cast<std::size_t>(end)); });
}

/** Loop over blocks, each of which is large enough to be a thread's unit of work. */
inline void ThreadedLoop(std::size_t count, const RangeBody& body)
{
  ThreadedRanges(count, 1, body);
}

/** Loop over points in ranges of 4096, each tens of microseconds of copying. */
inline void PointLoop(std::size_t count, const RangeBody& body)
{
  ThreadedRanges(count, 4096, body);
}

/** Loop over facets in ranges of 512, each tens of microseconds of work. */
inline void FacetLoop(std::size_t count, const RangeBody& body)
{
  ThreadedRanges(count, 512, body);
}

}
