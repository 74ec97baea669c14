// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Simd/InstructionSets.h"

#include <cstdlib>
#include <string>

namespace meniscus
{

//------------------------------------------------------------------------------
const std::vector<InstructionSet>& GetInstructionSets()
{
  static const std::vector<InstructionSet> sets = []
  {
    std::vector<InstructionSet> supported;
#define MENISCUS_ADD_SUPPORTED(name, label, isSupported, target)                                   \
  if (isSupported)                                                                                 \
  {                                                                                                \
    supported.push_back(InstructionSet::name);                                                     \
  }
    MENISCUS_INSTRUCTION_SETS(MENISCUS_ADD_SUPPORTED)
#undef MENISCUS_ADD_SUPPORTED
    return supported;
  }();
  return sets;
}

//------------------------------------------------------------------------------
InstructionSet BestInstructionSet()
{
  const char* const wanted = std::getenv("MENISCUS_INSTRUCTION_SET");
  for (const InstructionSet set : GetInstructionSets())
  {
    if (wanted && std::string(wanted) == NameOf(set))
    {
      return set;
    }
  }
  return GetInstructionSets().front();
}

//------------------------------------------------------------------------------
const char* NameOf(InstructionSet set)
{
#define MENISCUS_LABEL(name, label, isSupported, target) label,
  constexpr const char* labels[] = { MENISCUS_INSTRUCTION_SETS(MENISCUS_LABEL) };
#undef MENISCUS_LABEL
  return labels[static_cast<int>(set)];
}

}
