// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Common_CodeOrder_h
#define meniscus_Common_CodeOrder_h

#include "Common/RangeLoop.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace meniscus
{

/** A code in the upper 32 bits and an index in the lower 32. */
using CodeKey = std::uint64_t;

inline CodeKey MakeCodeKey(std::uint32_t code, std::size_t index)
{
  return (CodeKey{ code } << 32) | static_cast<std::uint32_t>(index);
}

inline std::size_t IndexOf(CodeKey key)
{
  return static_cast<std::uint32_t>(key);
}

/** Sorts keys by their codes (30 bits), stably. */
void SortByCode(std::vector<CodeKey>& keys, const RangeLoop& loop = SerialLoop);

}

#endif
