// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Testing_Support_VTKTestBasics_h
#define meniscus_Testing_Support_VTKTestBasics_h

/** @file
 * Headers that most tests with VTK use: those of VTKBasics.h, and GoogleTest.
 */

#include "TestBasics.h"
#include "VTKBasics.h"

#endif
