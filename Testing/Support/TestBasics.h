// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/** @file
 * Headers that most tests use: those of MathBasics.h, GoogleTest, and HasText().
 */

#include "MathBasics.h"

#include <gtest/gtest.h>

namespace meniscus::test
{

/** True if a text has a part; a failure shows the text. */
inline ::testing::AssertionResult HasText(const std::string& text, const std::string& part)
{
  const bool has = text.find(part) != std::string::npos;
  return (has ? ::testing::AssertionSuccess() : ::testing::AssertionFailure())
    << '"' << text << "\" and \"" << part << '"';
}

} // namespace meniscus::test
