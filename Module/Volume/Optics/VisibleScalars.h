// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Volume/Optics/TransferFunction.h"

#include <vector>

namespace meniscus
{

/**
 * The scalars that can be seen, in normalised units. They decide whether rays have to visit a cell.
 * Initially none can be seen.
 */
class VisibleScalars
{
public:
  /** All finite scalars: for blend modes that use every cell. */
  static VisibleScalars All();

  /**
   * Adds the scalars that composite blending shows: emission is weighted by attenuation, so a
   * scalar without attenuation cannot be seen. Points of the function within a cell's range are
   * considered as well as the values at its vertices. A cell whose range only touches visible
   * scalars shows them over no length, so it is invisible.
   */
  void AddAttenuation(const std::vector<TransferFunctionInterval>& intervals);

  /**
   * Adds an isosurface. A cell whose range only touches the value is visible: its face may be the
   * surface.
   */
  void AddIsovalue(float value);

  /**
   * True if a cell whose vertices have scalars from `lowest` to `highest` can be seen; false if one
   * of them is NaN.
   */
  bool Meets(float lowest, float highest) const;

  /** Ends of the visible ranges, ascending, each once. */
  std::vector<float> ListEnds() const;
  /** The same ranges with other ends. @param endOf an increasing function. */
  template <typename Function>
  VisibleScalars Mapped(const Function& endOf) const
  {
    VisibleScalars mapped = *this;
    for (Span& span : mapped.Spans)
    {
      span.Lower = endOf(span.Lower);
      span.Upper = endOf(span.Upper);
    }
    return mapped;
  }

  bool operator==(const VisibleScalars& other) const { return this->Spans == other.Spans; }
  bool operator!=(const VisibleScalars& other) const { return !(*this == other); }

private:
  /** An open range, with flags for its ends. */
  struct Span
  {
    float Lower;
    float Upper;
    /** True if a cell whose scalars all equal that end can be seen. */
    bool LowerCounts;
    bool UpperCounts;
    /** True if a cell whose range only touches this range can be seen. */
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
