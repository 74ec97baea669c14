// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace meniscus::benchmark
{

/** Prints thesis Tables 4.1 to 4.5 side by side and returns them as members of a JSON object. */
std::string RunThesisTables();

/**
 * Mean error of virtual vertices on waves of two periods with `cells` x `cells` x 2 facets, as the
 * distance between a true point and the exact point behind its virtual vertex.
 */
struct WaveError
{
  double Flat = 0.0;
  double Curved = 0.0;
};
WaveError MeasureWaveError(int cells);

/** Images of points on two waves, a dome and for a low eye, compared with the interval oracle. */
struct ImageCount
{
  int Points = 0;
  int Images = 0; ///< certain images
  int Missed = 0;
  int False = 0;
  int Uncertain = 0; ///< uncertain points
};
ImageCount CountImages();

/**
 * Largest error of a sight point on the hemisphere of 184 facets, with the eye at 450, in pixels of
 * an image of 512 pixels that the opening of the hemisphere fills exactly.
 */
double MeasureHemispherePixels();

} // namespace meniscus::benchmark
