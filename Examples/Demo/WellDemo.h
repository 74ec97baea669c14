// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef WellDemo_h
#define WellDemo_h

#include <string>

/**
 * Pictures of a well with waves and objects in zones of convergence: its virtual geometry with all
 * images, the same by tracing rays, their difference, an error volume, and moving water. False if
 * one could not be written.
 */
bool RunWellDemo(const std::string& folder);

#endif
