// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "ReportOptions.h"
#include "ReportText.h"

namespace meniscus::report
{

/** Errors, frames, large meshes and the refraction pass, in the report's order. */
void MeasureAll(const ReportOptions& options, ReportText& report);

} // namespace meniscus::report
