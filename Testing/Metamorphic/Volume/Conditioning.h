// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "VolumeCase.h"

namespace meniscus::test
{

/**
 * Change of a case's exact picture under the rounding that the software documents.
 *
 * Images of two equal scenes need not be equal where the exact result is discontinuous: at
 * silhouettes, in front of steps of the transfer function, where a ray touches an isosurface. The
 * double-precision reference alone distinguishes such a pixel from a wrong one: it is computed for
 * several copies of the case with points and scalars moved by the rounding, and two images may
 * differ by the range of the results, in addition to the plain tolerance.
 *
 * Rounding of an image:
 * - points: to a grid of 2^-30 of the mesh's radius times 1 + the steepest slope, by half a unit,
 *   and the ray by as much again; 1.5 units with the depth's. Coordinates about the ray are floats:
 *   natively two roundings of 2^-25 of the distance from the ray, which is at most the longest edge
 *   of a cell that the ray meets; by shaders 2^-24 of the radius. Behind a membrane rays are kept
 *   in single precision, and their origin and slope add up: 2^-22.
 * - scalars: to 2^-24 of the range that they are normalised to, by half a unit, and interpolated
 *   along the ray in single precision: 2 units natively, 4 by shaders. The mean adds up a term per
 *   cell, half a unit each. Twice that for two images. Points and scalars are moved by the full
 *   amount, to either side: a random move of vertices displaces an edge by its full size in one of
 *   a few draws only. 12 draws are made, and more for pixels that differ by more (Extend()).
 */
class Conditioning
{
public:
  explicit Conditioning(const VolumeCase& test);
  ~Conditioning();

  /** A pixel and the range of its exact results. */
  struct PixelRange
  {
    int X;
    int Y;
    std::array<double, 4> Low;
    std::array<double, 4> High;
    /** Spread from which on no more results are needed. */
    double Needed;

    void Include(const std::array<double, 4>& color);
    /** The largest of the channels. */
    double GetSpread() const;
  };

  /** Range of a pixel's results for the scene and 12 copies. */
  PixelRange FindRange(int x, int y, double needed);
  /**
   * Adds the results of further copies to the ranges of pixels, up to 200 in all, if few of them
   * need it: the range of a few random copies is less than the range of all roundings.
   */
  void Extend(std::vector<PixelRange>& pixels);

  /** Exact colour of a pixel, premultiplied. */
  std::array<double, 4> GetExact(int x, int y);

private:
  class Truth;
  void MakeCopies();

  const VolumeCase& Case;
  std::vector<std::unique_ptr<Truth>> Copies;
};

/**
 * Largest difference of two images of one scene that is not a failure, apart from conditioning: the
 * error of each with respect to the exact image, as documented for the native backend and for
 * shaders.
 */
double PlainTolerance(int backend);

} // namespace meniscus::test
