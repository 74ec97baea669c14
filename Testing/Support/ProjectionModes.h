// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "ReferenceOptics.h"
#include "VTKBasics.h"

namespace meniscus::test
{

/** A blend mode that shows one number per ray, and the truth of its pictures. */
struct ProjectionMode
{
  int Number;
  const char* Name;
  reference::Projection Truth;
  /** True if opacity acts per unit distance, false if it is the alpha of a scalar. */
  bool OpacityPerDistance;
};

/** All modes of this kind. */
constexpr ProjectionMode ProjectionModes[] = {
  { vtkVolumeMapper::MAXIMUM_INTENSITY_BLEND, "maximum", reference::Projection::Maximum, false },
  { vtkVolumeMapper::MINIMUM_INTENSITY_BLEND, "minimum", reference::Projection::Minimum, false },
  { vtkVolumeMapper::AVERAGE_INTENSITY_BLEND, "average", reference::Projection::Average, false },
  { vtkVolumeMapper::ADDITIVE_BLEND, "additive", reference::Projection::Additive, true },
};

/** The projection of this number; null for other modes. */
inline const ProjectionMode* FindProjectionMode(int number)
{
  const auto* found = std::find_if(std::begin(ProjectionModes), std::end(ProjectionModes),
    [number](const ProjectionMode& mode) { return mode.Number == number; });
  return found == std::end(ProjectionModes) ? nullptr : found;
}

/** The numbers of all blend modes. */
inline std::vector<int> AllBlendModes()
{
  std::vector<int> numbers{ vtkVolumeMapper::COMPOSITE_BLEND, vtkVolumeMapper::ISOSURFACE_BLEND };
  for (const ProjectionMode& mode : ProjectionModes)
  {
    numbers.push_back(mode.Number);
  }
  return numbers;
}

} // namespace meniscus::test
