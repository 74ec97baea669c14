// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

/**
 * Fills a closed surface with tetrahedra and draws an array of the surface as a volume. Returns
 * false on failure.
 */
bool RunSurfaceDemo(const std::string& folder);
