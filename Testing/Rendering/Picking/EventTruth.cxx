// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "EventTruth.h"

namespace meniscus::test
{
namespace
{

using reference::Ray;
using reference::RaySegment;
using reference::Vector3;

constexpr int Bisections = 100;

double Dot(const Vector3& a, const Vector3& b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Vector3 Cross(const Vector3& a, const Vector3& b)
{
  return { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0] };
}

double LengthOf(const Ray& ray)
{
  return std::sqrt(Dot(ray.Direction, ray.Direction));
}

/** The point in [0, 1] at which a function that decreases or increases passes zero. */
double Bisect(const std::function<double(double)>& function)
{
  double low = 0.0;
  double high = 1.0;
  const bool rises = function(1.0) > function(0.0);
  for (int i = 0; i < Bisections; ++i)
  {
    const double middle = 0.5 * (low + high);
    ((function(middle) < 0.0) == rises ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

/** Part of a segment in one piece of the function. */
struct Piece
{
  const RaySegment* Segment;
  /** Shares of the segment, and attenuation at both. */
  double From;
  double To;
  double Attenuation[2];
  double Length;

  double At(double x) const
  {
    return this->Attenuation[0] + x * (this->Attenuation[1] - this->Attenuation[0]);
  }
  double DepthUpTo(double x) const
  {
    return x * this->Length * 0.5 * (this->Attenuation[0] + this->At(x));
  }
};

std::vector<Piece> SplitAtNodes(
  const Ray& ray, const RaySegment& segment, const reference::ReferenceTransferFunction& function)
{
  std::vector<double> cuts{ 0.0, 1.0 };
  const double change = segment.ScalarEnd - segment.ScalarBegin;
  for (const auto& node : function.GetNodes())
  {
    const double cut = (node.Scalar - segment.ScalarBegin) / change;
    if (cut > 0.0 && cut < 1.0)
    {
      cuts.push_back(cut);
    }
  }
  std::sort(cuts.begin(), cuts.end());
  std::vector<Piece> pieces;
  for (std::size_t i = 1; i < cuts.size(); ++i)
  {
    const std::size_t number =
      function.PieceOf(segment.ScalarBegin + 0.5 * (cuts[i - 1] + cuts[i]) * change);
    const auto at = [&](double share)
    { return function.ValueInPiece(number, segment.ScalarBegin + share * change).Attenuation; };
    pieces.push_back({ &segment, cuts[i - 1], cuts[i], { at(cuts[i - 1]), at(cuts[i]) },
      (cuts[i] - cuts[i - 1]) * (segment.End - segment.Begin) * LengthOf(ray) });
  }
  return pieces;
}

TrueEvent EventAt(const Ray& ray, const RaySegment& segment, double share)
{
  const double place = segment.Begin + share * (segment.End - segment.Begin);
  return { place * LengthOf(ray), segment.Cell,
    segment.ScalarBegin + share * (segment.ScalarEnd - segment.ScalarBegin), -1 };
}

TrueEvent EventAt(const Ray& ray, const Piece& piece, double x)
{
  return EventAt(ray, *piece.Segment, piece.From + x * (piece.To - piece.From));
}

/** Points of a piece at which the contribution may be largest. */
std::vector<double> CandidatesOf(const Piece& piece)
{
  std::vector<double> candidates{ 0.0 };
  const double rate = (piece.Attenuation[1] - piece.Attenuation[0]) / piece.Length;
  const auto slope = [&](double x) { return rate - piece.At(x) * piece.At(x); };
  if (slope(0.0) > 0.0 && slope(1.0) < 0.0)
  {
    candidates.push_back(Bisect(slope));
  }
  candidates.push_back(1.0);
  return candidates;
}

}

//------------------------------------------------------------------------------
TrueEvents EventsOfMedium(const Ray& ray, const std::vector<RaySegment>& segments,
  const reference::ReferenceTransferFunction& function, double opacity)
{
  TrueEvents events;
  double depth = 0.0;
  double largest = 0.0;
  for (const RaySegment& segment : segments)
  {
    for (const Piece& piece : SplitAtNodes(ray, segment, function))
    {
      const double behind = depth + piece.DepthUpTo(1.0);
      if (!(behind > depth))
      {
        continue;
      }
      if (!events[0].IsFound())
      {
        events[0] = EventAt(ray, piece, 0.0);
      }
      if (!events[1].IsFound() && -std::expm1(-behind) >= opacity)
      {
        events[1] = EventAt(ray, piece,
          Bisect([&](double x) { return -std::expm1(-depth - piece.DepthUpTo(x)) - opacity; }));
      }
      for (const double x : CandidatesOf(piece))
      {
        const double contribution = piece.At(x) * std::exp(-depth - piece.DepthUpTo(x));
        // Neighbouring pieces share an end, at which both have the value but for rounding.
        if (contribution > largest * (1.0 + 1.0e-12))
        {
          largest = contribution;
          events[2] = EventAt(ray, piece, x);
        }
      }
      depth = behind;
    }
  }
  return events;
}

//------------------------------------------------------------------------------
TrueEvents EventsOfSurfaces(const Ray& ray, const std::vector<RaySegment>& segments,
  const std::vector<reference::Surface>& surfaces, double opacity)
{
  TrueEvents events;
  double transmittance = 1.0;
  double largest = 0.0;
  for (const RaySegment& segment : segments)
  {
    // A scalar equal to the surface's counts as above it.
    std::vector<std::pair<double, int>> met;
    for (std::size_t i = 0; i < surfaces.size(); ++i)
    {
      const double value = surfaces[i].Scalar;
      if ((segment.ScalarBegin >= value) != (segment.ScalarEnd >= value))
      {
        met.emplace_back((value - segment.ScalarBegin) / (segment.ScalarEnd - segment.ScalarBegin),
          static_cast<int>(i));
      }
    }
    std::sort(met.begin(), met.end());
    for (const auto& [share, number] : met)
    {
      const double weight = transmittance * surfaces[static_cast<std::size_t>(number)].Alpha;
      TrueEvent event = EventAt(ray, segment, share);
      event.Surface = number;
      transmittance -= weight;
      if (weight > 0.0 && !events[0].IsFound())
      {
        events[0] = event;
      }
      // Opacities are single numbers of a few digits; the rest is rounding.
      if (weight > 0.0 && !events[1].IsFound() && 1.0 - transmittance > opacity - 1.0e-7)
      {
        events[1] = event;
      }
      if (weight > largest + 1.0e-7)
      {
        largest = weight;
        events[2] = event;
      }
    }
  }
  return events;
}

//------------------------------------------------------------------------------
TrueEvents EventsOfExtreme(const Ray& ray, const std::vector<RaySegment>& segments, bool isMaximum)
{
  TrueEvents events;
  double best = -std::numeric_limits<double>::infinity();
  for (const RaySegment& segment : segments)
  {
    for (const double share : { 0.0, 1.0 })
    {
      const TrueEvent event = EventAt(ray, segment, share);
      const double height = isMaximum ? event.Scalar : -event.Scalar;
      if (height > best + 1.0e-12)
      {
        best = height;
        events.fill(event);
      }
    }
  }
  return events;
}

//------------------------------------------------------------------------------
RobustEvents FindRobustEvents(const reference::ReferenceRayIntegrator& integrator, const Ray& ray,
  const FindEvents& find, double slope, double scalarRange, double depthRounding)
{
  std::vector<RaySegment> segments;
  integrator.FindSegments(ray, segments);
  RobustEvents robust;
  robust.Events = find(ray, segments);
  for (std::size_t i = 0; i < 3; ++i)
  {
    const TrueEvent& event = robust.Events[i];
    const double length = LengthOf(ray);
    // In another cell along the ray.
    const auto isNear = [&](const RaySegment& segment)
    {
      return segment.Cell != event.Cell &&
        length * segment.Begin - event.Distance < depthRounding &&
        event.Distance - length * segment.End < depthRounding;
    };
    robust.StaysInCell[i] =
      event.IsFound() && std::none_of(segments.begin(), segments.end(), isNear);
  }
  const auto compare = [&](const TrueEvents& moved)
  {
    for (std::size_t i = 0; i < 3; ++i)
    {
      const TrueEvent& event = robust.Events[i];
      const bool bothFound = event.IsFound() && moved[i].IsFound();
      const double change = bothFound           ? std::abs(moved[i].Distance - event.Distance)
        : event.IsFound() == moved[i].IsFound() ? 0.0
                                                : std::numeric_limits<double>::infinity();
      robust.Change[i] = std::max(robust.Change[i], change);
      robust.StaysInCell[i] = robust.StaysInCell[i] && moved[i].Cell == event.Cell;
    }
  };
  for (const double sign : { -1.0, 1.0 })
  {
    std::vector<RaySegment> shifted = segments;
    for (RaySegment& segment : shifted)
    {
      segment.ScalarBegin += sign * scalarRange / 16777216.0;
      segment.ScalarEnd += sign * scalarRange / 16777216.0;
    }
    compare(find(ray, shifted));
  }
  const double radius = 0.5 * integrator.MakeMesh().GetDiagonal();
  const double distance = 2.4e-7 * (1.0 + slope) * radius;
  const Vector3 other = std::abs(ray.Direction[0]) < 0.7 * LengthOf(ray) ? Vector3{ 1.0, 0.0, 0.0 }
                                                                         : Vector3{ 0.0, 1.0, 0.0 };
  const Vector3 across = Cross(ray.Direction, other);
  const Vector3 upwards = Cross(ray.Direction, across);
  const double lengths[2] = { std::sqrt(Dot(across, across)), std::sqrt(Dot(upwards, upwards)) };
  for (int direction = 0; direction < 8; ++direction)
  {
    const double angle = direction * 0.78539816339744831;
    Ray moved = ray;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      moved.Origin[axis] += distance *
        (std::cos(angle) * across[axis] / lengths[0] +
          std::sin(angle) * upwards[axis] / lengths[1]);
    }
    integrator.FindSegments(moved, segments);
    compare(find(moved, segments));
  }
  return robust;
}

} // namespace meniscus::test
