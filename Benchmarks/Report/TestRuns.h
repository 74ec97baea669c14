// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/** Google Test programs, test by test, also if one of them crashes. */
#pragma once

#include "ReportOptions.h"
#include "ReportText.h"

namespace meniscus::report
{

/**
 * Runs the numeric tests with each backend, and the tests of kernel, reference and filters. A test
 * whose process ends is recorded as crashed, and those after it run in a new process. With Quick,
 * every 32nd test of a program runs, and the others count as not run.
 */
void RunTests(const ReportOptions& options, ReportText& report);

} // namespace meniscus::report
