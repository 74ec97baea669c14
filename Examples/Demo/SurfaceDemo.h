// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Examples_Demo_SurfaceDemo_h
#define meniscus_Examples_Demo_SurfaceDemo_h

#include <string>

/**
 * Fills a closed surface with tetrahedra and draws an array of the surface as a volume. Returns
 * false on failure.
 */
bool RunSurfaceDemo(const std::string& folder);

#endif
