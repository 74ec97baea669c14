// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "RefractionOptions.h"

#include <ostream>

namespace meniscus::benchmark
{

/** Measures each row of the table of goals and prints it next to its goal. */
void PrintRefractionReport(std::ostream& out, const RefractionOptions& options);

} // namespace meniscus::benchmark
