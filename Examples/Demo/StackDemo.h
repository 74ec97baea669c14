// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

/**
 * Images of several refracting interfaces: objects below waves and a pane of glass, and a page
 * under a magnifying glass. Returns false if one could not be written.
 */
bool RunStackDemo(const std::string& folder);
