// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// The kept corpus of the fuzzers, by the ordinary compiler: no input violates a property, ends the
// process or takes long.
#include "FuzzTarget.h"

#include <gtest/gtest.h>

#include <fstream>
#include <string>
#include <vector>

using namespace meniscus::test;

namespace
{

/** Processor time, at most, of an input; the longest takes less than a second. */
constexpr double LongestSeconds = 60.0;

std::vector<std::uint8_t> BytesOf(const std::string& line)
{
  std::vector<std::uint8_t> bytes;
  for (std::size_t i = 0; i + 1 < line.size(); i += 2)
  {
    bytes.push_back(static_cast<std::uint8_t>(std::stoul(line.substr(i, 2), nullptr, 16)));
  }
  return bytes;
}

class FuzzCorpusTest : public ::testing::TestWithParam<FuzzTarget>
{
};

INSTANTIATE_TEST_SUITE_P(Targets, FuzzCorpusTest, ::testing::ValuesIn(FuzzTargets),
  [](const ::testing::TestParamInfo<FuzzTarget>& tested)
  { return std::string(tested.param.Name); });

}

//------------------------------------------------------------------------------
TEST_P(FuzzCorpusTest, EveryInputHoldsItsProperties)
{
  const FuzzTarget& target = GetParam();
  std::ifstream file(std::string(MENISCUS_FUZZ_CORPUS) + "/" + target.Name + ".txt");
  std::string line;
  int inputs = 0;
  while (std::getline(file, line))
  {
    const std::vector<std::uint8_t> bytes = BytesOf(line);
    const std::clock_t begin = std::clock();
    EXPECT_NO_THROW(target.Run(bytes.data(), bytes.size())) << line;
    EXPECT_LT(static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC, LongestSeconds) << line;
    ++inputs;
  }
  EXPECT_GT(inputs, 20);
}

//------------------------------------------------------------------------------
TEST_P(FuzzCorpusTest, NoBytesAreAnInput)
{
  EXPECT_NO_THROW(GetParam().Run(nullptr, 0));
}
