// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Pre-integrated ray segments: a table over the scalars at both ends and the length, after M.
 * Weiler, M. Kraus, M. Merz, T. Ertl, "Hardware-Based Ray Casting for Tetrahedral Meshes" (2003),
 * Eqs. 3 and 4.
 *
 * Opacity does not need the length as a dimension: it is 1 - exp(-length * mean attenuation), and
 * the mean depends on the two scalars only. The table over the length holds the segment's colour
 * divided by its opacity. If that does not depend on the length (one colour, or segments so short
 * that their self-absorption can be neglected), the table has two dimensions.
 *
 * It is computed incrementally, as in the paper, but by doubling instead of steps of the shortest
 * length: a segment consists of two segments of half its length. Errors of interpolation therefore
 * add up over the logarithm of the number of lengths only. The lengths are a geometric sequence
 * that begins at 0, because cell sizes differ by factors.
 */
#pragma once

#include "Common/RangeLoop.h"
#include "Volume/Optics/TransferFunction.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <vector>

namespace meniscus
{

class PreIntegrationTable
{
public:
  /**
   * @param function intervals of the transfer function, in normalised scalars.
   * @param longest length of the longest segment, in the unit of the attenuation; > 0.
   * @param scalars number of samples of the scalar range, >= 2.
   * @param lengths number of samples of the length, >= 1; 1 neglects the self-absorption of
   *   segments.
   * @param range range of scalars; at its ends and outside of it, the function is taken as
   *   constant.
   */
  void Build(const std::vector<TransferFunctionInterval>& function, double longest, int scalars,
    int lengths, const RangeLoop& loop = SerialLoop, const ScalarRange& range = ScalarRange());

  /** The table is indexed by (scalar - middle) * perHalfRange, in [-1, 1]. */
  double GetMiddle() const { return this->Middle; }
  double GetPerHalfRange() const { return this->PerHalfRange; }

  int GetNumberOfScalars() const { return this->Scalars; }
  /** Number of lengths as requested, or 1 if the colour does not depend on the length. */
  int GetNumberOfLengths() const { return this->Lengths; }
  double GetLongest() const { return this->Longest; }
  /** The first length above 0, and the number of lengths from it to its double. */
  double GetShortest() const { return this->Shortest; }
  int GetLengthsPerOctave() const { return this->LengthsPerOctave; }
  /** The k-th length. */
  double GetLength(int k) const;

  /**
   * Colour divided by opacity, followed by the mean attenuation: 4 numbers for each scalar at the
   * front, nested in the scalars at the back, nested in the lengths.
   */
  const std::vector<float>& GetValues() const { return this->Values; }

private:
  /** Values for one length: colour divided by opacity, front scalars nested in back scalars. */
  using Slice = std::vector<glm::vec3>;

  void SampleFunction(const std::vector<TransferFunctionInterval>& intervals);
  void ChooseLengths(
    const std::vector<TransferFunctionInterval>& intervals, double longest, int lengths);
  double MeanAttenuation(int front, int back) const;
  Slice ShortSegments(const RangeLoop& loop) const;
  Slice DoubleLength(const Slice& halves, double length, const RangeLoop& loop) const;
  void Store(int length, const Slice& slice, const RangeLoop& loop);

  /**
   * Samples at 2 Scalars - 1 places, so that the middle of two scalars is one of them: attenuation,
   * colour, the integral of attenuation up to that place, and the integrals of attenuation and of
   * attenuation times colour from the sample before.
   */
  struct Sample
  {
    double Attenuation = 0.0;
    glm::dvec3 Color{ 0.0 };
    double Depth = 0.0;
    double StepDepth = 0.0;
    glm::dvec3 StepEmission{ 0.0 };
  };

  std::vector<Sample> Samples;
  std::vector<float> Values;
  int Scalars = 0;
  int Lengths = 0;
  int LengthsPerOctave = 1;
  double Shortest = 0.0;
  double Longest = 0.0;
  double LargestAttenuation = 0.0;
  double Middle = 0.0;
  double PerHalfRange = 1.0;
};

}
