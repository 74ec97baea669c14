// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Volume/Packet/Data/RayEvents.h"
#include "Volume/Packet/Data/RayMeasuring.h"
#include "Volume/Refracted/RefractedRayTiles.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace meniscus
{

/** Measurement of the scalar along a ray; distances along the ray are in world units. */
struct MeasuredScalar
{
  /** Length of the ray in cells with a scalar; 0 if it meets none. */
  double Length = 0.0;
  /** Integral of the normalised scalar. */
  double Integral = 0.0;
  double OpticalDepth = 0.0;
  /** Distances of the first and of the last such point; not set if the length is 0. */
  double First = 0.0;
  double Last = 0.0;
  /** Extremes of the normalised scalar and the first distances at which they are reached. */
  double Lowest = 0.0;
  double LowestAt = 0.0;
  double Highest = 0.0;
  double HighestAt = 0.0;

  /** Adds a part of the ray that lies behind this one. */
  void Join(const MeasuredScalar& behind);
};

/** Measurement of bins along a ray: integrals, or optical depth and light (MeasuredBins). */
struct MeasuredBin
{
  std::array<double, 3> Integrals{};
  double Light = 0.0;

  /** Adds a part of the ray that lies behind this one. */
  void Join(const MeasuredBin& behind);
};

/** An event of a ray (RayEventKind). */
struct MeasuredEvent
{
  /** Distance along the ray in world units. */
  double Distance = 0.0;
  /** Place in the frame of the view; behind interfaces the true one. */
  glm::dvec3 Place{ 0.0 };
  /** Depth in that frame at which the place is drawn. */
  double DrawnDepth = 0.0;
  /** Normalised scalar. */
  double Scalar = 0.0;
  /** Cell of the mesh; negative if there is no such event. */
  std::int32_t Cell = -1;
  /** Index of the isosurface, ascending by their scalars; negative for a medium. */
  std::int32_t Surface = -1;

  bool IsFound() const { return this->Cell >= 0; }
};

/** Events of a ray, and the state that its next leg continues. */
struct MeasuredEvents
{
  RayEventState State;
  std::array<MeasuredEvent, NumberOfRayEvents> Events;
};

/** Distance along a ray as a function of the depth on one of its legs. */
struct LegDistance
{
  /** Distance at which the leg begins, and the depth there. */
  double AtBegin = 0.0;
  double BeginDepth = 0.0;
  double PerDepth = 1.0;

  double operator()(double depth) const
  {
    return this->AtBegin + (depth - this->BeginDepth) * this->PerDepth;
  }
};

/** Reads NumberOfMeasuredScalars values of a leg. */
MeasuredScalar ReadScalars(const float* values, const LegDistance& distance);
/** Reads NumberOfMeasuredBins values of a leg. */
MeasuredBin ReadBins(const float* values);

/** The straight line of a leg in the frame of the view. */
struct LegLine
{
  LegDistance Distance;
  /** Place at Distance.BeginDepth, and the step per world unit of distance. */
  glm::dvec3 Begin{ 0.0 };
  glm::dvec3 PerDistance{ 0.0 };
  /** Drawn depth at Begin, and per world unit of distance. */
  double DrawnDepth = 0.0;
  double DrawnPerDistance = 0.0;
};

/** Marks an event as settled, so that rays need not go on for its sake; it is never found. */
void IgnoreEvent(RayEventKind kind, RayEventState& state);

/** Takes over the state of a ray at the end of a leg, and places the events found in it. */
void TakeEvents(const RayEventState& state, const LegLine& line, MeasuredEvents& events);

/** Measurements of a tile's rays. Pixels are numbered in rows of RefractedRayTiles::TileSize. */
struct MeasuredRays
{
  std::array<MeasuredScalar, RefractedRayTiles::RaysOfTile> Scalars;
  std::array<MeasuredBin, RefractedRayTiles::RaysOfTile> Bins;
  /** Empty until events are measured. */
  std::vector<MeasuredEvents> Events;
};

}
