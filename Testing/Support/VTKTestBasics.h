// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/** @file
 * Headers that most tests with VTK use: those of VTKBasics.h, and GoogleTest.
 */

#include "TestBasics.h"
#include "VTKBasics.h"
