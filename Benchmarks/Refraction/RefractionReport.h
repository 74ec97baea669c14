// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Benchmarks_Refraction_RefractionReport_h
#define meniscus_Benchmarks_Refraction_RefractionReport_h

#include "RefractionOptions.h"

#include <ostream>

namespace meniscus::benchmark
{

/** Measures each row of the table of goals and prints it next to its goal. */
void PrintRefractionReport(std::ostream& out, const RefractionOptions& options);

} // namespace meniscus::benchmark

#endif
