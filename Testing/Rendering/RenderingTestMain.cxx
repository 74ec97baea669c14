// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "TestBasics.h"
#include "VolumeScene.h"

// VTK's skip code.
constexpr int Skipped = 125;

int main(int argc, char* argv[])
{
  bool listing = false;
  for (int i = 1; i < argc; ++i)
  {
    listing = listing || std::strncmp(argv[i], "--gtest_list_tests", 18) == 0;
  }
  ::testing::InitGoogleTest(&argc, argv);
  if (!listing && !meniscus::test::HasDisplay())
  {
    std::cout << "no display: skipped\n";
    return Skipped;
  }
  std::unique_ptr<meniscus::test::DisplayHold> hold;
  if (!listing)
  {
    hold = std::make_unique<meniscus::test::DisplayHold>();
  }
  const int result = RUN_ALL_TESTS();
  const ::testing::UnitTest& all = *::testing::UnitTest::GetInstance();
  const bool nothingRan =
    all.test_to_run_count() > 0 && all.skipped_test_count() == all.test_to_run_count();
  return result == 0 && nothingRan ? Skipped : result;
}
