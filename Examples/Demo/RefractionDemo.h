// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

/**
 * Images of a pool with a wavy surface and objects in it. Returns false if one could not be
 * written.
 */
bool RunRefractionDemo(const std::string& folder);
