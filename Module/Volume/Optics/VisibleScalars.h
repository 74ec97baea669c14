// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Volume_Optics_VisibleScalars_h
#define meniscus_Volume_Optics_VisibleScalars_h

#include "Volume/Optics/TransferFunction.h"

#include <vector>

namespace meniscus
{

/**
 * The scalars that can be seen, in normalised units: what decides whether a cell is worth a ray's
 * visit. Starts empty: nothing can be seen.
 */
class VisibleScalars
{
public:
  /** Every finite scalar: for blend modes that look at all cells. */
  static VisibleScalars All();

  /**
   * Adds what composite blending shows: emission is weighted by attenuation, so a scalar without
   * attenuation cannot be seen. The function's points within a cell's range count as well as the
   * values at its vertices; a range that only touches visible scalars has no length to be seen.
   */
  void AddAttenuation(const std::vector<TransferFunctionInterval>& intervals);

  /** Adds an isosurface. A cell that only touches the value counts: its face may be the surface. */
  void AddIsovalue(float value);

  /**
   * Whether a cell can be seen whose vertices have scalars from `lowest` to `highest`. False if one
   * is NaN.
   */
  bool Meets(float lowest, float highest) const;

  bool operator==(const VisibleScalars& other) const { return this->Spans == other.Spans; }
  bool operator!=(const VisibleScalars& other) const { return !(*this == other); }

private:
  /** An open range; of its ends it is said when they count too. */
  struct Span
  {
    float Lower;
    float Upper;
    /** Whether a cell whose scalars all equal that end can be seen. */
    bool LowerCounts;
    bool UpperCounts;
    /** Whether a cell that only touches the range can be seen. */
    bool Touching;

    bool operator==(const Span& other) const;
    bool Meets(float lowest, float highest) const;
    bool Holds(const Span& other) const;
  };

  void Add(const Span& span);

  /** Ascending in both ends. */
  std::vector<Span> Spans;
};

}

#endif
