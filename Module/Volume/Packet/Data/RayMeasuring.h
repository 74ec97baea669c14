// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Plain data only: kernels are compiled once per instruction set, and the linker could merge inline
 * functions that such files share with others.
 */
#pragma once

namespace meniscus
{

/** Quantities that rays measure, instead of the colour of a blend mode. */
enum class RayMeasuring
{
  /** Nothing: rays are drawn. */
  None,
  /** Length, integral and extremes of the scalar (MeasuredScalars). */
  Scalars,
  /** The same, and the optical depth of the transfer function. */
  ScalarsAndOpticalDepth,
  /** Integrals of three values per vertex, or of three values per cell (MeasuredBins). */
  VertexBins,
  CellBins,
  /** Places at which something is seen, by the blend mode (RayEventKind). */
  Events,
  /**
   * The optical depth alone, of a medium of one scalar without gradients, up to the depth at which
   * PacketJob::TerminationTransmittance is reached: the first value of the result.
   */
  OpticalDepth
};

/** Indices of the values that a ray measures of the scalar. */
enum MeasuredScalars
{
  /** World length of the ray in cells with a scalar. */
  MeasuredLength,
  /** Integral of the normalised scalar over this length. */
  MeasuredIntegral,
  MeasuredOpticalDepth,
  /** Depths at which the first cell begins and the last one ends, in grid units from the pivot. */
  MeasuredFirst,
  MeasuredLast,
  /** Extremes of the normalised scalar, and the first depths at which they are reached. */
  MeasuredLowest,
  MeasuredLowestAt,
  MeasuredHighest,
  MeasuredHighestAt,
  NumberOfMeasuredScalars
};

/**
 * Number of values that a ray measures of bins: the integrals of three values, or, with
 * PacketJob::Emitting, the optical depth of the first value, 0, 0 and the light of the second one,
 * attenuated on its way to the viewer.
 */
constexpr int NumberOfMeasuredBins = 4;

}
