// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "RandomNumbers.h"

namespace meniscus::test
{

using StressRandom = RandomNumbers;

} // namespace meniscus::test
