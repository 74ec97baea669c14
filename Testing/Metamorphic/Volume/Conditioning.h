// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Conditioning_h
#define meniscus_Conditioning_h

#include "TracedImage.h"
#include "VolumeCase.h"

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace meniscus
{
namespace test
{

/**
 * Change of a case's exact picture under the rounding that the software documents.
 *
 * Pictures of two equal scenes need not be equal where the exact result itself is not continuous:
 * at silhouettes, in front of steps of the transfer function, where a ray touches an isosurface.
 * Such a pixel can be told from a wrong one by the double reference alone: it is computed for
 * several copies of the case with points and scalars moved by the rounding, and the range of the
 * results is what two pictures may differ by, over and above the plain tolerance.
 *
 * Rounding of a picture:
 * - points: to a grid of 2^-29 of the mesh's radius times 1 + the steepest slope, by half a unit,
 * and the ray by as much again; 1.5 units with the depth's. Shaders round coordinates about the
 * ray, at most the radius, to 2^-24 of themselves. Behind a membrane rays are kept in single
 * precision, and their origin and slope add up: 2^-22.
 * - depths, and with them lengths: in single precision, 3 units of 2^-24 of the radius. It counts
 * for the mean along a ray only, which divides by a length that may be short.
 * - scalars: to 2^-24 of the range that they are normalised to, by half a unit, and interpolated
 *   along the ray in single precision: 2 units natively, 4 by shaders.
 *   The mean adds up a term per cell, half a unit each.
 * Twice that for two pictures. Points and scalars are moved by all of it, to either side: a random
 * move of vertices displaces an edge by its whole size in one of a few draws only, and 12 are made.
 */
class Conditioning
{
public:
  explicit Conditioning(const VolumeCase& test);
  ~Conditioning();

  /** Range of the exact results of a pixel, the largest of the channels. */
  double spread(int x, int y);

  /** Exact colour of a pixel, premultiplied. */
  std::array<double, 4> exact(int x, int y);

private:
  class Truth;
  void makeCopies();

  const VolumeCase& Case;
  std::vector<std::unique_ptr<Truth>> Copies;
};

/**
 * Largest difference of two pictures of one scene that is no failure, conditioning apart: the
 * error of each against the exact picture that is promised natively, and of shaders.
 */
double plainTolerance(int backend);

} // namespace test
} // namespace meniscus

#endif
