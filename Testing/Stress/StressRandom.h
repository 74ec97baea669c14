// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Testing_Stress_StressRandom_h
#define meniscus_Testing_Stress_StressRandom_h

#include "RandomNumbers.h"

namespace meniscus::test
{

using StressRandom = RandomNumbers;

} // namespace meniscus::test

#endif
