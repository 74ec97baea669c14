// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace meniscus
{

/**
 * Definitions of the constants that the ray casting shader shares with C++: enumerators, units of
 * the tables, and the coefficients of polynomials. They have the values of C++ to the last bit.
 */
std::string ShaderConstants();

}
