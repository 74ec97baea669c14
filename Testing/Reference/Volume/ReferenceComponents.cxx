// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ReferenceComponents.h"

#include <algorithm>
#include <cmath>

namespace meniscus::reference
{

namespace
{

// Steps of a piece per optical depth: Gauss' rule of three points then errs by less than 1e-9.
constexpr double StepsPerDepth = 4.0;

double LengthOf(const Vector3& v)
{
  return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

// A scalar along a segment.
double ScalarAt(const RaySegment& segment, double part)
{
  return segment.ScalarBegin + part * (segment.ScalarEnd - segment.ScalarBegin);
}

// Attenuation, and emission of the three colours.
std::array<double, 4> MediumAt(const std::vector<const RaySegment*>& segments, Mixture mixture,
  const std::vector<ReferenceTransferFunction>& functions, double part)
{
  std::array<double, 4> medium{ 0.0, 0.0, 0.0, 0.0 };
  if (mixture == Mixture::Independent)
  {
    for (std::size_t i = 0; i < segments.size(); ++i)
    {
      const OpticalSample sample = functions[i].GetValue(ScalarAt(*segments[i], part));
      medium[0] += sample.Attenuation;
      for (int c = 0; c < 3; ++c)
      {
        medium[c + 1] += sample.Attenuation * sample.Color[c];
      }
    }
    return medium;
  }
  const std::size_t last = segments.size() - 1;
  medium[0] = functions[last].GetValue(ScalarAt(*segments[last], part)).Attenuation;
  const OpticalSample byFirst = functions[0].GetValue(ScalarAt(*segments[0], part));
  for (int c = 0; c < 3; ++c)
  {
    medium[c + 1] = medium[0] *
      (mixture == Mixture::ColorAndOpacity ? byFirst.Color[c] : ScalarAt(*segments[c], part));
  }
  return medium;
}

// Places in [0, 1] between which all functions are linear.
std::vector<double> PiecesOf(const std::vector<const RaySegment*>& segments,
  const std::vector<ReferenceTransferFunction>& functions)
{
  std::vector<double> places{ 0.0, 1.0 };
  for (std::size_t i = 0; i < segments.size(); ++i)
  {
    const double change = segments[i]->ScalarEnd - segments[i]->ScalarBegin;
    for (const TransferFunctionNode& node : functions[i].GetNodes())
    {
      const double part = (node.Scalar - segments[i]->ScalarBegin) / change;
      if (part > 0.0 && part < 1.0)
      {
        places.push_back(part);
      }
    }
  }
  std::sort(places.begin(), places.end());
  return places;
}

} // anonymous namespace

//------------------------------------------------------------------------------
std::array<double, 4> IntegrateComponents(const Ray& ray,
  const std::vector<std::vector<RaySegment>>& segments, Mixture mixture,
  const std::vector<ReferenceTransferFunction>& functions)
{
  std::array<double, 4> result{ 0.0, 0.0, 0.0, 0.0 };
  double transmittance = 1.0;
  const double unit = LengthOf(ray.Direction);
  std::vector<const RaySegment*> here(segments.size());
  for (std::size_t s = 0; s < segments[0].size(); ++s)
  {
    for (std::size_t i = 0; i < segments.size(); ++i)
    {
      here[i] = &segments[i][s];
    }
    const double length = unit * (here[0]->End - here[0]->Begin);
    const std::vector<double> places = PiecesOf(here, functions);
    for (std::size_t p = 0; p + 1 < places.size(); ++p)
    {
      const double span = places[p + 1] - places[p];
      const double depth =
        span * length * MediumAt(here, mixture, functions, places[p] + 0.5 * span)[0];
      const int steps = 2 + static_cast<int>(StepsPerDepth * depth);
      const double step = span / steps;
      for (int k = 0; k < steps; ++k)
      {
        // Attenuation is linear: up to a place in the step it is that of half the way. Emission
        // times transmittance by Gauss' rule of three points.
        const double begin = places[p] + k * step;
        const auto depthTo = [&](double part) {
          return part * step * length *
            MediumAt(here, mixture, functions, begin + 0.5 * part * step)[0];
        };
        for (const int side : { -1, 0, 1 })
        {
          const double part = 0.5 * (1.0 + side * std::sqrt(0.6));
          const double weight = (side == 0 ? 8.0 : 5.0) / 18.0;
          const auto medium = MediumAt(here, mixture, functions, begin + part * step);
          const double shown = weight * transmittance * std::exp(-depthTo(part)) * step * length;
          for (int c = 0; c < 3; ++c)
          {
            result[c] += shown * medium[c + 1];
          }
        }
        transmittance *= std::exp(-depthTo(1.0));
      }
    }
  }
  result[3] = 1.0 - transmittance;
  return result;
}

} // namespace meniscus::reference
