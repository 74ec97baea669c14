// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Plain data only: kernels are compiled once per instruction set, and the linker could merge inline
 * functions that such files share with others.
 */
#pragma once

#include <cstdint>

namespace meniscus
{

/**
 * Places on a ray that contribute to its pixel. Their meaning depends on the blend mode:
 * - Composite and additive blending: the first place with opacity, the place at which the
 *   accumulated opacity reaches a threshold, and the place where attenuation times transmittance,
 *   the contribution per length, is largest.
 * - Isosurfaces: the first visible surface, the surface with which the accumulated opacity reaches
 *   the threshold, and the surface that contributes most.
 * - Maximum and minimum intensity: all three are the first place of the extreme.
 * - Average intensity: all three are the first place with a scalar.
 */
enum RayEventKind
{
  FirstVisibleEvent,
  OpacityReachedEvent,
  LargestContributionEvent,
  NumberOfRayEvents
};

/** A place on a leg of a ray. */
struct RayEvent
{
  /** Grid units from the pivot. */
  double Depth;
  /** Normalised scalar. */
  double Scalar;
  /** Cell of the mesh; negative if there is no such place. */
  std::int32_t Cell;
  /** Index in PacketJob::Surfaces; negative unless the place is on an isosurface. */
  std::int32_t Surface;
};

/** Events of a ray so far, in double precision; kept from leg to leg. */
struct RayEventState
{
  RayEvent Events[NumberOfRayEvents];
  /** Optical depth of the medium passed, and transmittance of the medium or the surfaces. */
  double OpticalDepth;
  double Transmittance;
  /** Contribution of LargestContributionEvent, or the extreme. */
  double Largest;
  /**
   * Number of isosurfaces at or below the last scalar; negative if the next segment does not
   * continue the last one.
   */
  std::int32_t SurfacesBelow;
  /** Bit i is set if event i was found in this leg. */
  std::uint32_t Fresh;
};

/** Parameters of events that all rays share. */
struct RayEventLimits
{
  /** Threshold of the accumulated opacity, and the optical depth at which it is reached. */
  double Opacity;
  double OpticalDepth;
  /** Upper bound of the attenuation coefficient. */
  double LargestAttenuation;
};

}
