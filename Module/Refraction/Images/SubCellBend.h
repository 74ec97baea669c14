// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Refraction/Images/SubCellDivision.h"

namespace meniscus
{

/**
 * Largest deviations of the places and rays in a sub-cell from linear interpolation between its
 * corners, and the changes between corners.
 */
struct SubCellBend
{
  double Position;  ///< of places
  double Direction; ///< of unit directions of rays
  double Size;      ///< longest side
  double Turn;      ///< largest difference between the directions at two corners

  /** Deviation of the moments of the rays about a unit line through a point at `distance`. */
  double GetMoment(double distance) const
  {
    return distance * this->Direction + this->Position + 0.25 * this->Size * this->Turn;
  }
};

/**
 * Bends of the sub-cells of a patch. They follow to second order from the patch's coefficients and
 * from the turns of normals and sight rays between the corners, without further rays.
 */
class PatchBend
{
public:
  PatchBend(const CurvedPatch& patch, const Media& media);

  SubCellBend Measure(const SubCell& nodes) const;

private:
  const Media& Medium;
  double Ratio;
  double Position; ///< of places of the entire patch
  double Normal;   ///< of normals of the entire patch
};

}
