// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

#include <cstdint>

namespace meniscus
{

/**
 * While an object of this class exists, its thread calculates as IEEE 754 does by default: numbers
 * are rounded to the nearest, results below the smallest normal number are kept, and no operation
 * raises a signal. Afterwards the thread's mode is as it was before.
 *
 * Host programs change this mode: Open VKL and OSPRay flush small numbers to zero on the thread
 * that starts them, as does a library linked with `-ffast-math` on the thread that loads it, and
 * solvers such as OpenFOAM raise signals for numbers that are not finite. Exact tests, and loops
 * that end at the next larger number, rely on the default.
 *
 * Without effect on processors other than x86-64 and AArch64.
 */
class StandardFloatingPoint
{
public:
  StandardFloatingPoint()
    : Before(Read())
  {
    if ((this->Before & ModeBits) != Standard)
    {
      Write((this->Before & ~ModeBits) | Standard);
    }
  }
  ~StandardFloatingPoint()
  {
    if ((this->Before & ModeBits) != Standard)
    {
      Write(this->Before);
    }
  }
  StandardFloatingPoint(const StandardFloatingPoint&) = delete;
  void operator=(const StandardFloatingPoint&) = delete;

private:
#if defined(__SSE2__)
  // MXCSR (Intel's manual, volume 1, section 10.2.3): flush to zero, rounding, masks of exceptions,
  // small numbers read as zero. Exceptions are masked by default.
  static constexpr std::uint64_t ModeBits = 0x8000 | 0x6000 | 0x1f80 | 0x0040;
  static constexpr std::uint64_t Standard = 0x1f80;
  static std::uint64_t Read()
  {
    return _mm_getcsr();
  }
  static void Write(std::uint64_t mode)
  {
    _mm_setcsr(static_cast<unsigned int>(mode));
  }
#elif defined(__aarch64__)
  // FPCR (Arm's manual, section D19.2.45): default NaN, flush to zero, rounding, traps.
  static constexpr std::uint64_t ModeBits = 0x3000000 | 0xc00000 | 0x9f00;
  static constexpr std::uint64_t Standard = 0;
  static std::uint64_t Read()
  {
    std::uint64_t mode;
    __asm__ __volatile__("mrs %0, fpcr" : "=r"(mode));
    return mode;
  }
  static void Write(std::uint64_t mode)
  {
    __asm__ __volatile__("msr fpcr, %0" : : "r"(mode));
  }
#else
  static constexpr std::uint64_t ModeBits = 0;
  static constexpr std::uint64_t Standard = 0;
  static std::uint64_t Read()
  {
    return 0;
  }
  static void Write(std::uint64_t) {}
#endif

  std::uint64_t Before;
};

}
