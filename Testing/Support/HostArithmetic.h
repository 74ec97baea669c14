// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cfloat>
#include <cstdint>

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

namespace meniscus::test
{

/**
 * While an object of this class exists, its thread reads and writes numbers below the smallest
 * normal one as zero, as after the start of OSPRay.
 */
class FlushedArithmetic
{
public:
#if defined(__SSE2__)
  FlushedArithmetic()
    : Before(_mm_getcsr())
  {
    _mm_setcsr(static_cast<unsigned int>(this->Before) | 0x8040);
  }
  ~FlushedArithmetic()
  {
    _mm_setcsr(static_cast<unsigned int>(this->Before));
  }
#elif defined(__aarch64__)
  FlushedArithmetic()
  {
    __asm__ __volatile__("mrs %0, fpcr" : "=r"(this->Before));
    __asm__ __volatile__("msr fpcr, %0" : : "r"(this->Before | 0x1000000));
  }
  ~FlushedArithmetic()
  {
    __asm__ __volatile__("msr fpcr, %0" : : "r"(this->Before));
  }
#else
  FlushedArithmetic() {}
#endif
  FlushedArithmetic(const FlushedArithmetic&) = delete;
  void operator=(const FlushedArithmetic&) = delete;

private:
  std::uint64_t Before = 0;
};

/** True if the thread reads or writes half of the smallest normal number as zero. */
inline bool FlushesSmallNumbers()
{
  volatile double smallest = DBL_MIN;
  volatile double half = smallest * 0.5;
  return half == 0.0;
}

} // namespace meniscus::test
