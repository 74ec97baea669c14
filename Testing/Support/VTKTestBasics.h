// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/** @file
 * Headers that most tests with VTK use: those of VTKBasics.h, GoogleTest, and
 * ExpectSameOnThreads().
 */

#include "TestBasics.h"
#include "VTKBasics.h"

namespace meniscus::test
{

/** Expects the same bits of some numbers, whatever number of threads computes them. */
inline void ExpectSameOnThreads(const std::function<std::vector<double>()>& compute)
{
  std::vector<double> first;
  for (const int threads : { 5, 2, 1 })
  {
    vtkSMPTools::Initialize(threads);
    const std::vector<double> values = compute();
    first = first.empty() ? values : first;
    ASSERT_EQ(values.size(), first.size()) << threads;
    EXPECT_EQ(std::memcmp(values.data(), first.data(), values.size() * sizeof(double)), 0)
      << threads;
  }
  vtkSMPTools::Initialize(0);
  EXPECT_FALSE(first.empty());
}

} // namespace meniscus::test
