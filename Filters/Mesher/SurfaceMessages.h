// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Filters/Mesher/MesherProcess.h"

#include <string>

namespace meniscus
{

/** @{ */
/** Error message, or an empty string where nothing is wrong. */
std::string DescribeSurfaceFault(const SurfaceReport& report);
std::string DescribeProcessEnd(ProcessEnd end, const MesherProcess& process);
std::string DescribeMeshingEnd(MeshingEnd end);
std::string DescribeSolidFault(SolidFault fault);
/** @} */

} // namespace meniscus
