// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace meniscus::benchmark
{

/** Points of one colour and marker, joined by a line if there are several; many have no markers. */
struct ChartSeries
{
  std::string Label;
  std::vector<std::pair<double, double>> Points;
};

enum class ChartScale
{
  Logarithmic, ///< points that are not positive are left out
  Linear       ///< from zero
};

/**
 * Draws a chart to a PNG file, both axes of one scale, the name of each curve next to one of its
 * points.
 * Returns false if none is left, or if the file cannot be written.
 */
bool WriteChart(const std::string& file, const std::string& title, const std::string& xTitle,
  const std::string& yTitle, const std::vector<ChartSeries>& series,
  ChartScale scale = ChartScale::Logarithmic);

} // namespace meniscus::benchmark
