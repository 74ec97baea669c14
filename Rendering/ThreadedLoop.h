// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef ThreadedLoop_h
#define ThreadedLoop_h

#include "Refraction/RangeLoop.h"

#include "vtkSMPTools.h"
#include "vtkType.h"

namespace meniscus
{

/** Blocks of the kernel's loops are large enough to be a thread's unit of work. */
inline void ThreadedLoop(std::size_t count, const RangeBody& body)
{
  vtkSMPTools::For(0, static_cast<vtkIdType>(count), 1,
    [&body](vtkIdType begin, vtkIdType end)
    { body(static_cast<std::size_t>(begin), static_cast<std::size_t>(end)); });
}

}

#endif
