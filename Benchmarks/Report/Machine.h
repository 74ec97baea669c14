// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "ReportOptions.h"
#include "ReportText.h"

namespace meniscus::report
{

/** Bytes of main memory that programs can still get; 0 if the system does not tell. */
double AvailableMemory();

/** Adds processor, memory, system and graphics device. Returns GL_RENDERER; empty if unknown. */
std::string DescribeMachine(const ReportOptions& options, ReportText& report);

/** True for a device that is a program: llvmpipe or another rasteriser on the processor. */
bool IsSoftware(const std::string& renderer);

} // namespace meniscus::report
