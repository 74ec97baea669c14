// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Packet/Models/RayEventSegments.h"

#include <algorithm>
#include <cmath>

namespace meniscus
{
namespace
{

double Mix(double from, double to, double at)
{
  return from + at * (to - from);
}

void SetEvent(RayEventState& state, RayEventKind kind, const RayEventSegment& segment, double at,
  double scalar, std::int32_t surface)
{
  state.Events[kind] = { Mix(segment.StartDepth, segment.EndDepth, at), scalar, segment.Cell,
    surface };
  state.Fresh |= 1u << kind;
}

bool Has(const RayEventState& state, RayEventKind kind)
{
  return state.Events[kind].Cell >= 0;
}

/** Sets the three events of modes that show one place. */
void SetAllEvents(RayEventState& state, const RayEventSegment& segment, double at, double scalar)
{
  for (int kind = 0; kind < NumberOfRayEvents; ++kind)
  {
    SetEvent(state, static_cast<RayEventKind>(kind), segment, at, scalar, -1);
  }
}

/** A function of attenuation, and its scalar along a segment. */
struct Course
{
  const PacketInterval* Table;
  std::int32_t Size;
  double From;
  double To;
  /** Interval of the present piece. */
  std::int32_t At = 0;

  /** Chooses the interval in which the segment begins. */
  void Begin()
  {
    const auto below = [](const PacketInterval& interval, double scalar)
    { return interval.Upper < scalar; };
    this->At = static_cast<std::int32_t>(
      std::lower_bound(this->Table, this->Table + this->Size - 1, this->From, below) - this->Table);
    while (this->To > this->From && this->From >= this->Table[this->At].Upper &&
      this->At + 1 < this->Size)
    {
      ++this->At;
    }
  }
  /** Share of the segment at which it leaves the interval; 2 if it ends there. */
  double Leaves() const
  {
    const PacketInterval& interval = this->Table[this->At];
    if (this->To > interval.Upper && this->At + 1 < this->Size)
    {
      return (interval.Upper - this->From) / (this->To - this->From);
    }
    if (this->To<interval.Lower&& this->At> 0)
    {
      return (interval.Lower - this->From) / (this->To - this->From);
    }
    return 2.0;
  }
  void Move() { this->At += this->To > this->From ? 1 : -1; }
  double Attenuation(double at) const
  {
    const PacketInterval& interval = this->Table[this->At];
    const double scalar =
      std::clamp(Mix(this->From, this->To, at), double{ interval.Lower }, double{ interval.Upper });
    return std::max(
      0.0, interval.Attenuation + (scalar - interval.Lower) * interval.AttenuationSlope);
  }
};

/** Factor of the attenuation at one end of a segment. */
double GradientOpacity(const PacketJob& job, const float* gradient)
{
  if (!gradient)
  {
    return 1.0;
  }
  const GradientShading& medium = *job.Medium;
  double square = 0.0;
  for (const float(&row)[3] : medium.GradientToFrame)
  {
    double sum = 0.0;
    for (int k = 0; k < 3; ++k)
    {
      sum += double{ row[k] } * gradient[k];
    }
    square += sum * sum;
  }
  const double size = medium.GradientMagnitude * std::sqrt(square);
  Course function{ medium.Opacity, medium.NumberOfOpacityIntervals, size, size };
  function.Begin();
  return function.Attenuation(0.0);
}

/** Piece of a segment on which the attenuation is linear. */
struct Piece
{
  /** Shares of the segment. */
  double Begin;
  double End;
  double Length;
  /** Attenuation times length at both ends. */
  double Density;
  double DensityTo;

  double DepthUpTo(double share) const
  {
    return share * (this->Density + 0.5 * share * (this->DensityTo - this->Density));
  }
  double InSegment(double share) const { return Mix(this->Begin, this->End, share); }
};

/** Event at a share of a piece. */
void SetInPiece(RayEventState& state, RayEventKind kind, const RayEventSegment& segment,
  const Piece& piece, double share)
{
  const double at = piece.InSegment(share);
  SetEvent(state, kind, segment, at, Mix(segment.From, segment.To, at), -1);
}

/**
 * Moves the place of the largest contribution k exp(-t) to the piece if that is larger there. With
 * k rising at the rate r per length, its derivative is zero where k k = r.
 */
void TryLargest(const RayEventSegment& segment, const Piece& piece, RayEventState& state)
{
  const double bound = std::max(piece.Density, piece.DensityTo) / piece.Length;
  if (!(bound * state.Transmittance > state.Largest))
  {
    return;
  }
  const auto tryAt = [&](double share)
  {
    const double density = Mix(piece.Density, piece.DensityTo, share);
    const double contribution =
      density / piece.Length * state.Transmittance * std::exp(-piece.DepthUpTo(share));
    if (contribution > state.Largest)
    {
      state.Largest = contribution;
      SetInPiece(state, LargestContributionEvent, segment, piece, share);
    }
  };
  tryAt(0.0);
  const double change = piece.DensityTo - piece.Density;
  if (change > 0.0)
  {
    const double share = (std::sqrt(change) - piece.Density) / change;
    if (share > 0.0 && share < 1.0)
    {
      tryAt(share);
    }
  }
  tryAt(1.0);
}

void AddPiece(
  const PacketJob& job, const RayEventSegment& segment, const Piece& piece, RayEventState& state)
{
  const double depth = piece.DepthUpTo(1.0);
  if (!(depth > 0.0))
  {
    return;
  }
  if (!Has(state, FirstVisibleEvent))
  {
    SetInPiece(state, FirstVisibleEvent, segment, piece, 0.0);
  }
  const double missing = job.EventLimits.OpticalDepth - state.OpticalDepth;
  if (!Has(state, OpacityReachedEvent) && missing <= depth)
  {
    // The root of DepthUpTo(share) = missing without cancellation.
    const double change = piece.DensityTo - piece.Density;
    const double root =
      std::sqrt(std::max(0.0, piece.Density * piece.Density + 2.0 * change * missing));
    const double share = missing > 0.0 ? 2.0 * missing / (piece.Density + root) : 0.0;
    SetInPiece(state, OpacityReachedEvent, segment, piece, std::min(share, 1.0));
  }
  TryLargest(segment, piece, state);
  state.OpticalDepth += depth;
  state.Transmittance = std::exp(-state.OpticalDepth);
}

/** The functions that attenuate: of the scalar, and of independent components. */
int ListCourses(const PacketJob& job, const RayEventSegment& segment, Course (&courses)[4])
{
  courses[0] = { job.Intervals, job.NumberOfIntervals, segment.From, segment.To };
  int count = 1;
  for (int i = 0; job.Mixture == ComponentMixture::Independent && i < 3; ++i)
  {
    if (job.NumberOfOtherIntervals[i] > 0)
    {
      courses[count++] = { job.OtherIntervals[i], job.NumberOfOtherIntervals[i],
        segment.Components[0][i], segment.Components[1][i] };
    }
  }
  return count;
}

bool AddMedium(const PacketJob& job, const RayEventSegment& segment, RayEventState& state)
{
  Course courses[4];
  const int count = ListCourses(job, segment, courses);
  std::for_each(courses, courses + count, [](Course& course) { course.Begin(); });
  const double factors[2] = { GradientOpacity(job, segment.Gradients[0]),
    GradientOpacity(job, segment.Gradients[1]) };
  double begin = 0.0;
  while (begin < 1.0)
  {
    double end = 1.0;
    for (int f = 0; f < count; ++f)
    {
      end = std::min(end, std::max(begin, courses[f].Leaves()));
    }
    const double length = (end - begin) * segment.Length;
    double attenuation[2] = { 0.0, 0.0 };
    for (int f = 0; f < count; ++f)
    {
      attenuation[0] += courses[f].Attenuation(begin);
      attenuation[1] += courses[f].Attenuation(end);
    }
    const Piece piece{ begin, end, length,
      length * attenuation[0] * Mix(factors[0], factors[1], begin),
      length * attenuation[1] * Mix(factors[0], factors[1], end) };
    AddPiece(job, segment, piece, state);
    // One function at least goes on to another interval, unless the segment is at its end.
    for (int f = 0; f < count; ++f)
    {
      if (courses[f].Leaves() <= end)
      {
        courses[f].Move();
      }
    }
    begin = end;
  }
  // Behind an optical depth of 745, nothing is left in double precision.
  const bool mayContribute =
    job.EventLimits.LargestAttenuation * state.Transmittance > state.Largest;
  return state.Transmittance > 0.0 &&
    (mayContribute || !Has(state, FirstVisibleEvent) || !Has(state, OpacityReachedEvent));
}

/** Adds a surface at a share of the segment. */
void AddSurface(const PacketJob& job, const RayEventSegment& segment, const PacketSurface& surface,
  double share, RayEventState& state)
{
  const double weight = state.Transmittance * surface.Opacity;
  if (!(weight > 0.0))
  {
    return;
  }
  state.Transmittance -= weight;
  const auto set = [&](RayEventKind kind)
  {
    SetEvent(state, kind, segment, share, surface.Scalar,
      static_cast<std::int32_t>(&surface - job.Surfaces));
  };
  if (!Has(state, FirstVisibleEvent))
  {
    set(FirstVisibleEvent);
  }
  // Opacities are floats, and so is the threshold that they are compared with.
  if (!Has(state, OpacityReachedEvent) &&
    static_cast<float>(1.0 - state.Transmittance) >= static_cast<float>(job.EventLimits.Opacity))
  {
    set(OpacityReachedEvent);
  }
  if (weight > state.Largest)
  {
    state.Largest = weight;
    set(LargestContributionEvent);
  }
}

/** The same surfaces in the same order as CrossSurfaces(). */
bool AddSurfaces(const PacketJob& job, const RayEventSegment& segment, RayEventState& state)
{
  const PacketSurface* const first = job.Surfaces;
  const PacketSurface* const end = first + job.NumberOfSurfaces;
  const auto firstAbove = [&](double scalar)
  {
    return std::upper_bound(first, end, scalar,
      [](double value, const PacketSurface& surface) { return value < surface.Scalar; });
  };
  const PacketSurface* const atFrom = firstAbove(segment.From);
  const PacketSurface* const last = firstAbove(segment.To);
  const PacketSurface* now = state.SurfacesBelow < 0 ? atFrom : first + state.SurfacesBelow;
  const auto cross = [&](const PacketSurface* to, bool isAtStart)
  {
    while (now != to && state.Transmittance > 0.0)
    {
      const bool upward = now < to;
      const PacketSurface& surface = upward ? *now : *(now - 1);
      now += upward ? 1 : -1;
      const double share = isAtStart || job.CellScalars
        ? 0.0
        : std::clamp((surface.Scalar - segment.From) / (segment.To - segment.From), 0.0, 1.0);
      AddSurface(job, segment, surface, share, state);
    }
  };
  // Those that were passed in segments without length.
  cross(atFrom, true);
  cross(last, false);
  state.SurfacesBelow = static_cast<std::int32_t>(last - first);
  const bool mayContribute = state.Transmittance > state.Largest;
  return state.Transmittance > 0.0 &&
    (mayContribute || !Has(state, FirstVisibleEvent) || !Has(state, OpacityReachedEvent));
}

/** Extremes lie at the ends of a segment; of equal ones, the first along the ray counts. */
void AddExtreme(bool isMaximum, const RayEventSegment& segment, RayEventState& state)
{
  for (const double at : { 0.0, 1.0 })
  {
    const double scalar = at == 0.0 ? segment.From : segment.To;
    const double height = isMaximum ? scalar : -scalar;
    if (!Has(state, FirstVisibleEvent) || height > state.Largest)
    {
      state.Largest = height;
      SetAllEvents(state, segment, at, scalar);
    }
  }
}

}

//------------------------------------------------------------------------------
RayEventState EmptyRayEvents()
{
  RayEventState state{};
  for (RayEvent& event : state.Events)
  {
    event = { 0.0, 0.0, -1, -1 };
  }
  state.Transmittance = 1.0;
  state.SurfacesBelow = -1;
  return state;
}

//------------------------------------------------------------------------------
double BoundAttenuation(const PacketJob& job)
{
  const auto largestOf = [](const PacketInterval* table, std::int32_t size)
  {
    double largest = 0.0;
    for (std::int32_t i = 0; i < size; ++i)
    {
      const PacketInterval& interval = table[i];
      const double width = double{ interval.Upper } - interval.Lower;
      largest = std::max({ largest, double{ interval.Attenuation },
        interval.Attenuation + width * interval.AttenuationSlope });
    }
    return largest;
  };
  double bound = largestOf(job.Intervals, job.NumberOfIntervals);
  for (int i = 0; i < 3; ++i)
  {
    bound += largestOf(job.OtherIntervals[i], job.NumberOfOtherIntervals[i]);
  }
  const bool hasFactor = job.Medium && job.Medium->NumberOfOpacityIntervals > 0;
  return hasFactor ? bound * largestOf(job.Medium->Opacity, job.Medium->NumberOfOpacityIntervals)
                   : bound;
}

//------------------------------------------------------------------------------
bool AddToEvents(const PacketJob& job, const RayEventSegment& segment, RayEventState& state)
{
  switch (job.Blending)
  {
    case BlendMode::Isosurfaces:
      return AddSurfaces(job, segment, state);
    case BlendMode::MaximumIntensity:
    case BlendMode::MinimumIntensity:
      AddExtreme(job.Blending == BlendMode::MaximumIntensity, segment, state);
      return true;
    case BlendMode::AverageIntensity:
      if (!Has(state, FirstVisibleEvent))
      {
        SetAllEvents(state, segment, 0.0, segment.From);
      }
      return false;
    case BlendMode::Composite:
    case BlendMode::Additive:
      return AddMedium(job, segment, state);
  }
  return false; // the cases above are all modes
}

}
