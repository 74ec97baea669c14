// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Examples_Demo_RefractionDemo_h
#define meniscus_Examples_Demo_RefractionDemo_h

#include <string>

/**
 * Images of a pool with a wavy surface and objects in it. Returns false if one could not be
 * written.
 */
bool RunRefractionDemo(const std::string& folder);

#endif
