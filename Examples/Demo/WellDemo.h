// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Examples_Demo_WellDemo_h
#define meniscus_Examples_Demo_WellDemo_h

#include <string>

/**
 * Images of a well with waves and objects in zones of convergence: its virtual geometry with all
 * images, the same by ray tracing, their difference, an error volume, and moving water. Returns
 * false if one could not be written.
 */
bool RunWellDemo(const std::string& folder);

#endif
