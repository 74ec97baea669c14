// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Testing_Support_TestBasics_h
#define meniscus_Testing_Support_TestBasics_h

/** @file
 * Headers that most tests use: those of MathBasics.h, and GoogleTest.
 */

#include "MathBasics.h"

#include <gtest/gtest.h>

#endif
