// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

/**
 * Picture of a well with waves and objects in zones of convergence: its virtual geometry with all
 * images, the same by ray tracing, and their difference. Returns false if it could not be written.
 */
bool RunWellDemo(const std::string& folder);
