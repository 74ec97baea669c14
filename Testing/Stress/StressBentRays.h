// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "StressCheck.h"

namespace meniscus::test
{

/**
 * Bends rays through the mesh of a case in random fields of n^2, and judges their paths piece by
 * piece (GradedPathCheck.h). Fields and rays follow from the number of the case.
 */
StressTally CheckBentRays(const StressCase& stress);

} // namespace meniscus::test
