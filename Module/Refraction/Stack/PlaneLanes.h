// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Sight rays to several points behind parallel planes at once: plain loops over arrays, compiled
 * per instruction set.
 */
#pragma once

#include "Simd/InstructionSets.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace meniscus
{

/** A layer in front of, between or behind parallel planes. */
struct PlaneLayer
{
  double Begin;   ///< distance of its front from the eye along the axis; 0 for the first layer
  double End;     ///< distance of its back; infinite for the last layer
  double Index;   ///< index of refraction
  double Squared; ///< square of the index over the smallest index of all layers
};

/**
 * Lateral distance of a ray as a function of its tangent t in a layer of the smallest index m. A
 * layer of index n = r m adds its thickness times t / sqrt(r^2 + (r^2 - 1) t^2), which is concave.
 */
struct LateralSum
{
  /** Most steps; two to four suffice except for grazing rays. */
  static constexpr int MostSteps = 24;
  /** A step of this part of t is the last one. */
  static constexpr double LastStep = 1e-5;

  double Reached = 0.0; ///< lateral distance over t
  double Slope = 0.0;   ///< its derivative
  double Bend = 0.0;    ///< the second derivative is -3 t times this

  static double GetScale(double squared, double t)
  {
    return 1.0 / std::sqrt(squared + (squared - 1.0) * t * t);
  }
  void Add(double thickness, double squared, double t)
  {
    const double scale = GetScale(squared, t);
    const double part = thickness * scale;
    const double slope = part * squared * scale * scale;
    this->Reached += part;
    this->Slope += slope;
    this->Bend += slope * (squared - 1.0) * scale * scale;
  }
  /**
   * Step of Halley's method to the tangent of a lateral distance. With the second and the third
   * derivative at most 3 / t and 15 / t^2 times the first, a step s leaves an error of at most
   * 4.75 s^3 / t^2.
   */
  double GetStep(double distance, double t) const
  {
    const double step = (distance - this->Reached * t) / this->Slope;
    // Twice Newton's step at most, which may end beyond the root: from there steps are shorter.
    return step / std::max(1.0 - 1.5 * t * step * this->Bend / this->Slope, 0.5);
  }
};

/** Arrays of the data of each point. */
struct PlaneLanes
{
  /** Largest number of lanes. */
  static constexpr int Most = 128;

  int Count = 0;
  double Depth[Most];    ///< distance of the point from the eye along the axis
  double Distance[Most]; ///< distance of the point from the axis through the eye
  double Tangent[Most];  ///< tangent of the sight ray in a layer of the smallest index

  /** Members of LateralSum, and 1 if the last step was not short, otherwise 0. */
  double Reached[Most];
  double Slope[Most];
  double Bend[Most];
  double IsOpen[Most];

  /** Leg in the layer that was passed last. */
  double Length[Most];
  double Cosine[Most]; ///< cosine of its angle to the axis
  double Side[Most];   ///< distance of its end from the axis

  double FirstCosine[Most]; ///< Cosine in the first layer
  double Reflectance[Most]; ///< reflectance of the first plane
  double Geometric[Most];   ///< sum of the lengths behind it
  double Optical[Most];     ///< sum of the lengths over the indices of refraction behind it

  /** Light that passes the planes: PlateTransmittance::Shares of both polarisations. */
  double Passed[2][Most];
  double ReflectedBack[2][Most];

  /** Sets the tangents of the sight rays to points in the last layer. */
  void FindTangents(const std::vector<PlaneLayer>& layers, InstructionSet set);
  /** The same from guesses; the results depend on them within rounding only. */
  void RefineTangents(const std::vector<PlaneLayer>& layers, InstructionSet set);

  /** Passes a layer, the first one at first, and the plane behind it, if there is one. */
  void Pass(const std::vector<PlaneLayer>& layers, std::size_t layer, InstructionSet set);
};

}
