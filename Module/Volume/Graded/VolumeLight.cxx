// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Graded/VolumeLight.h"

#include "Simd/SimdDouble.h"
#include "Volume/Graded/GradedCell.h"
#include "Volume/Packet/Models/CompositeModel.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>

namespace meniscus
{
namespace
{

/**
 * Largest (a^2 + N) T^2 of a segment: its square is 470 times 2^-24. It keeps a T, and so the
 * change of n, below 0.073 times the smallest n.
 */
constexpr double LargestTurn = 5.29e-3;

/** Least ratio of the smallest n of such a segment to that at its beginning: 1 / 1.073. */
constexpr double LeastRatio = 0.93;

/** Squared ratio of the largest n of such a segment to the smallest one: 1.146^2. */
constexpr double SquaredRatio = 1.32;

/**
 * Shortest segment as a share of an arc's time. Only where n is next to 0, and the ray turns at
 * once, would a shorter one be needed.
 */
constexpr double ShortestShare = 1.0 / 4096.0;

/**
 * Factors by which the number of an arc's segments is searched, coarse ones first. There are too
 * many by up to the last one.
 */
constexpr double Growths[] = { 2.83, 1.68, 1.19 };

/** Transmittance at which a ray ends: that of a mapper that ends no ray early. */
constexpr float LeastTransmittance = 1.0e-30f;

/**
 * Longest time of a segment by the bound of its length.
 * @param index n at its beginning.
 */
double LongestTime(const GradedArc& arc, double index)
{
  const double turn = arc.GetLargestForce() / (LeastRatio * index);
  return std::sqrt(LargestTurn / (turn * turn + arc.GetForceNorm()));
}

PacketJob JobOf(const EmittingMedium& medium)
{
  PacketJob job{};
  job.Blending = BlendMode::Composite;
  job.Intervals = medium.Intervals->data();
  job.NumberOfIntervals = static_cast<std::int32_t>(medium.Intervals->size());
  job.TerminationTransmittance = LeastTransmittance;
  return job;
}

TransferFunctionPoint PointOf(const PacketInterval& interval, float scalar)
{
  const double offset = double{ scalar } - interval.Lower;
  const double attenuation = interval.Attenuation + offset * interval.AttenuationSlope;
  TransferFunctionPoint point{ scalar, std::max(0.0, attenuation), glm::dvec3(0.0) };
  for (int k = 0; k < 3; ++k)
  {
    point.Color[k] = interval.Color[k] + offset * interval.ColorSlope[k];
  }
  return point;
}

/** Scale of the errors that a medium shows, for normalised scalars. */
ErrorScale MakeErrorScale(const EmittingMedium& medium)
{
  PictureFunction function;
  function.Use = ScalarUse::Medium;
  const std::vector<PacketInterval>& intervals = *medium.Intervals;
  // The outermost intervals are constant and without end.
  for (std::size_t i = 1; i < intervals.size(); ++i)
  {
    const PacketInterval& below = intervals[i - 1];
    function.Points.push_back(PointOf(below, below.Upper));
    function.Points.push_back(PointOf(intervals[i], intervals[i].Lower));
  }
  return function.MakeScale(2.0 * medium.Mesh->GetRadius(), 2.0);
}

/** End of the segment that begins at a share of an arc's time, of equal ones up to an end. */
double NextShare(double from, double end, double longest)
{
  const double parts = std::ceil((end - from) / longest);
  return parts > 1.0 ? std::min(end, from + std::max((end - from) / parts, ShortestShare)) : end;
}

}

/** The model of composite blending, for one ray at a time. */
class VolumeLight::Blending : public CompositeModel<SimdDouble>
{
public:
  explicit Blending(const EmittingMedium& medium)
    : CompositeModel<SimdDouble>(JobOf(medium))
  {
  }

  void Load(const Sum& sum)
  {
    for (int channel = 0; channel < 3; ++channel)
    {
      this->Color[channel].V = sum.Color[channel];
    }
    this->Transmittance.V = sum.Transmittance;
  }
  void Save(Sum& sum) const
  {
    for (int channel = 0; channel < 3; ++channel)
    {
      sum.Color[channel] = this->Color[channel].V;
    }
    sum.Transmittance = this->Transmittance.V;
  }

  /** Adds a segment with the scalars of its ends and its world length. */
  void AddSegment(double from, double to, double length)
  {
    SimdDouble::Mask goesOn = this->Begin(this->IsOn(), { from }, { to }, { length }, nullptr);
    while (goesOn.Bit)
    {
      goesOn = this->Advance(goesOn);
    }
  }
};

//------------------------------------------------------------------------------
VolumeLight::VolumeLight(const EmittingMedium& medium, std::size_t rays)
  : Medium(medium)
  , Scale(MakeErrorScale(medium))
  , Model(std::make_unique<Blending>(medium))
  , Sums(rays)
{
}

//------------------------------------------------------------------------------
VolumeLight::~VolumeLight() = default;

//------------------------------------------------------------------------------
/**
 * Number of parts of equal time of an arc for the bound of the scalar, not a whole one.
 * @param lower, upper least and largest scalar at its ends.
 * @param error of the scalar if the arc is not divided.
 */
double VolumeLight::CountParts(double lower, double upper, double error) const
{
  const auto isSeen = [&](double parts)
  {
    const double ofPart = error / (parts * parts);
    return ofPart > LargestScalarError &&
      this->Scale.Bound(lower - error, upper + error, ofPart) > LargestPictureError;
  };
  double parts = 1.0;
  if (isSeen(parts))
  {
    for (const double growth : Growths)
    {
      while (isSeen(parts * growth))
      {
        parts *= growth;
      }
    }
    parts *= *std::rbegin(Growths);
  }
  return parts;
}

//------------------------------------------------------------------------------
void VolumeLight::Add(std::size_t ray, GradedArc& arc, double end)
{
  Sum& sum = this->Sums[ray];
  const double passed = sum.Reached - arc.BeginPath;
  sum.Reached = std::max(sum.Reached, std::max(arc.BeginPath, arc.EndPath));
  if (!(arc.EndPath > arc.BeginPath + std::max(passed, 0.0)))
  {
    return;
  }
  const auto number = static_cast<std::size_t>(arc.Cell);
  const GradedCell& cell = arc.GetCell();
  const bool ofCells = this->Medium.HasCellScalars;
  const auto& vertices = this->Medium.Mesh->GetCells()[number].Vertices;
  std::array<double, 4> scalars;
  for (std::size_t i = 0; i < scalars.size(); ++i)
  {
    scalars[i] = (*this->Medium.Scalars)[ofCells ? number : static_cast<std::size_t>(vertices[i])];
  }
  const auto scalarAt = [&scalars](const std::array<double, 4>& w)
  { return (w[0] * scalars[0] + w[1] * scalars[1]) + (w[2] * scalars[2] + w[3] * scalars[3]); };
  const double gradient = ofCells ? 0.0 : glm::length(cell.AddGradients(scalars));
  const double time = arc.GetTime();
  const double sixth = this->Medium.Mesh->GetRadius() * time / 6.0;
  double from = passed > 0.0 ? passed / (arc.EndPath - arc.BeginPath) : 0.0;
  double scalar = scalarAt(arc.WeightsAt(from));
  const double last = scalarAt(arc.EndWeights);
  const double share = 1.0 /
    this->CountParts(std::min(scalar, last), std::max(scalar, last),
      0.125 * SquaredRatio * gradient * arc.GetLargestForce() * time * time);
  double index = glm::length(arc.DirectionAt(from));
  this->Model->Load(sum);
  while (from < end)
  {
    const double to = NextShare(from, end, std::min(share, LongestTime(arc, index) / time));
    const double middle = glm::length(arc.DirectionAt(0.5 * (from + to)));
    const double indexTo = glm::length(arc.DirectionAt(to));
    const double scalarTo = scalarAt(arc.WeightsAt(to));
    const double length = (to - from) * sixth * (index + 4.0 * middle + indexTo);
    this->Model->AddSegment(scalar, scalarTo, length);
    from = to;
    scalar = scalarTo;
    index = indexTo;
  }
  this->Model->Save(sum);
}

//------------------------------------------------------------------------------
KeptLight VolumeLight::Get(std::size_t ray) const
{
  const Sum& sum = this->Sums[ray];
  KeptLight light;
  for (int channel = 0; channel < 3; ++channel)
  {
    light.Values[channel] = static_cast<float>(sum.Color[channel]);
  }
  light.Values[3] = static_cast<float>(sum.Transmittance);
  return light;
}

}
