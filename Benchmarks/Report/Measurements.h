// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Benchmarks_Report_Measurements_h
#define meniscus_Benchmarks_Report_Measurements_h

#include "ReportOptions.h"
#include "ReportText.h"

namespace meniscus::report
{

/** Errors, frames, large meshes and the refraction pass, in the report's order. */
void MeasureAll(const ReportOptions& options, ReportText& report);

} // namespace meniscus::report

#endif
