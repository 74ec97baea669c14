// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ostream>
#include <string>

namespace meniscus::benchmark
{

/**
 * Time against error of the ways to draw the thesis's well below water, 512 x 512 pixels, two
 * threads, with a membrane that moves in each frame: the rivals that the thesis names, virtual
 * geometry, and a ray tracer. `PlaceComparison` measures the errors, against rays through the exact
 * surface. Writes the charts FOLDER/rivals-pool.png and FOLDER/rivals-flat.png and prints a table;
 * returns false if a chart cannot be written or if this program is built without Embree.
 */
bool CompareRivals(const std::string& folder, std::ostream& out);

} // namespace meniscus::benchmark
