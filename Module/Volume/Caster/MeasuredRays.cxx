// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Caster/MeasuredRays.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace meniscus
{

//------------------------------------------------------------------------------
void MeasuredScalar::Join(const MeasuredScalar& behind)
{
  if (!(behind.Length > 0.0))
  {
    return;
  }
  if (!(this->Length > 0.0))
  {
    *this = behind;
    return;
  }
  this->Length += behind.Length;
  this->Integral += behind.Integral;
  this->OpticalDepth += behind.OpticalDepth;
  this->First = std::min(this->First, behind.First);
  this->Last = std::max(this->Last, behind.Last);
  if (behind.Lowest < this->Lowest)
  {
    this->Lowest = behind.Lowest;
    this->LowestAt = behind.LowestAt;
  }
  if (behind.Highest > this->Highest)
  {
    this->Highest = behind.Highest;
    this->HighestAt = behind.HighestAt;
  }
}

//------------------------------------------------------------------------------
/** The first integral is the optical depth that the light from behind passes, if there is light. */
void MeasuredBin::Join(const MeasuredBin& behind)
{
  this->Light += std::exp(-this->Integrals[0]) * behind.Light;
  for (std::size_t i = 0; i < this->Integrals.size(); ++i)
  {
    this->Integrals[i] += behind.Integrals[i];
  }
}

//------------------------------------------------------------------------------
MeasuredScalar ReadScalars(const float* values, const LegDistance& distance)
{
  MeasuredScalar measured;
  measured.Length = values[MeasuredLength];
  measured.Integral = values[MeasuredIntegral];
  measured.OpticalDepth = values[MeasuredOpticalDepth];
  measured.First = distance(values[MeasuredFirst]);
  measured.Last = distance(values[MeasuredLast]);
  measured.Lowest = values[MeasuredLowest];
  measured.LowestAt = distance(values[MeasuredLowestAt]);
  measured.Highest = values[MeasuredHighest];
  measured.HighestAt = distance(values[MeasuredHighestAt]);
  return measured;
}

//------------------------------------------------------------------------------
MeasuredBin ReadBins(const float* values)
{
  MeasuredBin measured;
  std::copy_n(values, 3, measured.Integrals.begin());
  measured.Light = values[3];
  return measured;
}

//------------------------------------------------------------------------------
void IgnoreEvent(RayEventKind kind, RayEventState& state)
{
  state.Events[kind].Cell = 0;
  if (kind == LargestContributionEvent)
  {
    state.Largest = std::numeric_limits<double>::infinity();
  }
}

//------------------------------------------------------------------------------
void TakeEvents(const RayEventState& state, const LegLine& line, MeasuredEvents& events)
{
  for (std::size_t kind = 0; kind < events.Events.size(); ++kind)
  {
    if ((state.Fresh >> kind & 1u) == 0)
    {
      continue;
    }
    const RayEvent& event = state.Events[kind];
    const double distance = line.Distance(event.Depth);
    const double along = distance - line.Distance.AtBegin;
    events.Events[kind] = { distance, line.Begin + along * line.PerDistance,
      line.DrawnDepth + along * line.DrawnPerDistance, event.Scalar, event.Cell, event.Surface };
  }
  events.State = state;
  events.State.Fresh = 0;
}

}
