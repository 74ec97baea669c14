// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace meniscus
{

/** Requests the cache lines of `bytes` bytes of memory, where the compiler can do so. */
inline void Prefetch(const void* memory, std::size_t bytes = 1)
{
#if defined(__GNUC__)
  constexpr std::size_t line = 64;
  for (std::size_t offset = 0; offset < bytes; offset += line)
  {
    __builtin_prefetch(static_cast<const char*>(memory) + offset);
  }
#else
  static_cast<void>(memory);
  static_cast<void>(bytes);
#endif
}

}
