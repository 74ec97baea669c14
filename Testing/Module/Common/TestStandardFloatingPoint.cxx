// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Common/StandardFloatingPoint.h"
#include "HostArithmetic.h"
#include "TestBasics.h"

#include <cfenv>

using namespace meniscus;
using namespace meniscus::test;

TEST(StandardFloatingPoint, KeepsSmallNumbers)
{
  const FlushedArithmetic host;
  ASSERT_TRUE(FlushesSmallNumbers());
  {
    const StandardFloatingPoint standard;
    EXPECT_FALSE(FlushesSmallNumbers());
    {
      const StandardFloatingPoint again;
      EXPECT_FALSE(FlushesSmallNumbers());
    }
    EXPECT_FALSE(FlushesSmallNumbers());
  }
  EXPECT_TRUE(FlushesSmallNumbers());
}

TEST(StandardFloatingPoint, RoundsToNearest)
{
  volatile double one = 1.0;
  volatile double tiny = 1.0e-30;
  ASSERT_EQ(std::fesetround(FE_UPWARD), 0);
  volatile double before = one + tiny;
  volatile double within = 0.0;
  {
    const StandardFloatingPoint standard;
    within = one + tiny;
  }
  volatile double after = one + tiny;
  std::fesetround(FE_TONEAREST);
  EXPECT_GT(before, 1.0);
  EXPECT_EQ(within, 1.0);
  EXPECT_GT(after, 1.0);
}

#if defined(__x86_64__) && defined(__GLIBC__)
TEST(StandardFloatingPoint, RaisesNoSignals)
{
  std::feclearexcept(FE_ALL_EXCEPT);
  ASSERT_NE(feenableexcept(FE_DIVBYZERO | FE_INVALID), -1);
  volatile double zero = 0.0;
  volatile double within = 0.0;
  {
    const StandardFloatingPoint standard;
    within = 1.0 / zero;
    within = zero * within;
  }
  const int after = fedisableexcept(FE_ALL_EXCEPT);
  EXPECT_TRUE(std::isnan(within));
  EXPECT_EQ(after, FE_DIVBYZERO | FE_INVALID);
  EXPECT_EQ(std::fetestexcept(FE_DIVBYZERO | FE_INVALID), 0);
}
#endif
