// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Simd/InstructionSets.h"
#include "TestBasics.h"

namespace
{

using namespace meniscus;

TEST(InstructionSets, TheEnvironmentChoosesOneByName)
{
  constexpr const char* variable = "MENISCUS_INSTRUCTION_SET";
  unsetenv(variable);
  EXPECT_EQ(BestInstructionSet(), GetInstructionSets().front());
  for (const InstructionSet set : GetInstructionSets())
  {
    setenv(variable, NameOf(set), 1);
    EXPECT_EQ(BestInstructionSet(), set);
  }
  setenv(variable, "none of them", 1);
  EXPECT_EQ(BestInstructionSet(), GetInstructionSets().front());
  unsetenv(variable);
}

}
