// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string>

namespace meniscus
{

/**
 * The medium behind a membrane: the share of an object's light that reaches the sight point, and
 * the light that the medium scatters into the ray instead, its own colour times the rest.
 */
struct RefractionMedium
{
  enum class Model
  {
    /** exp(-k d) per channel (Beer-Lambert), with the distance d. */
    Exponential,
    /** 1 up to the distance Range[0], 0 from Range[1] on, linear in between. */
    Linear
  };

  Model Kind = Model::Exponential;
  /** Attenuation coefficients k of the exponential medium, per world length. */
  std::array<double, 3> Attenuation{ 0.0, 0.0, 0.0 };
  /** Distances of the linear medium, in world lengths. */
  std::array<double, 2> Range{ 0.0, 1.0 };
  std::array<double, 3> Color{ 0.0, 0.0, 0.0 };
  /** True if the medium has no end where nothing lies behind the membrane. */
  bool IsInfinite = false;

  /** Text of the error for numbers without a meaning; empty if there is none. */
  std::string DescribeFault() const;
  /** True if all light passes the medium, at any distance. */
  bool IsClear() const;

  /** Share of the light per channel from a distance. */
  std::array<double, 3> SeenFrom(double distance) const;
  /** Colour seen where nothing lies behind the membrane. */
  std::array<double, 3> BackdropOf(const double (&background)[3]) const;
};

bool operator==(const RefractionMedium& a, const RefractionMedium& b);

}
