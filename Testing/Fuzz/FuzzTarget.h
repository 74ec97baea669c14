// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <stdexcept>

namespace meniscus::test
{

/** Throws if a property that every result has is violated. */
inline void Require(bool holds, const char* property)
{
  if (!holds)
  {
    throw std::logic_error(property);
  }
}

/** A way from bytes through a part of the kernel. `Run` throws if a result violates a property. */
struct FuzzTarget
{
  const char* Name;
  void (*Run)(const std::uint8_t* bytes, std::size_t size);
};

void FuzzFunction(const std::uint8_t* bytes, std::size_t size);
void FuzzMembrane(const std::uint8_t* bytes, std::size_t size);
void FuzzStack(const std::uint8_t* bytes, std::size_t size);
void FuzzVolume(const std::uint8_t* bytes, std::size_t size);

inline constexpr FuzzTarget FuzzTargets[] = { { "function", FuzzFunction },
  { "membrane", FuzzMembrane }, { "stack", FuzzStack }, { "volume", FuzzVolume } };

}
