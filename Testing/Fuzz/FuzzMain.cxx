// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Entry point of libFuzzer, for the target that the build chooses.
#include "FuzzTarget.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size)
{
  meniscus::test::MENISCUS_FUZZ_FUNCTION(bytes, size);
  return 0;
}
