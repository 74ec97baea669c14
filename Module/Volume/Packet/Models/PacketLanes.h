// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace meniscus
{

/** Bit mask (Simd::Bits()) of all lanes, of which there are at most 32. */
template <class Simd>
constexpr unsigned int AllLanes = ~0u >> (32 - Simd::Width);

}
