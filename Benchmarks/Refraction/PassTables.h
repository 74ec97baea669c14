// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ostream>
#include <string>

namespace meniscus::benchmark
{

/**
 * Prints tables in Markdown of the filter's frames, the frames of vtkRefractionPass and the picture
 * of the pool, and returns the same as members of a JSON object.
 */
std::string PrintPassTables(std::ostream& out);

/** Writes the picture of the pool with three objects, drawn by the pass, as PNG. */
bool WritePoolPicture(const std::string& file);

} // namespace meniscus::benchmark
