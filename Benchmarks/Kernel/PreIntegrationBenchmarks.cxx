// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Time to build a pre-integration table of the size of Weiler et al., 128 x 128 scalars and 256
// lengths: incrementally, and entry by entry as their comparison does.
#include "Volume/Optics/PreIntegration.h"

#include <benchmark/benchmark.h>

#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

using namespace meniscus;

namespace
{

constexpr int Scalars = 128;
constexpr int Lengths = 256;
constexpr double Longest = 3.0;

std::vector<TransferFunctionInterval> MakeRamps()
{
  return BuildIntervals({ { -1.0, 0.5, { 1.0, 0.2, 0.0 } }, { -0.3, 2.0, { 0.1, 0.9, 0.3 } },
                          { 0.25, 1.0, { 0.2, 0.1, 1.0 } }, { 1.0, 4.0, { 1.0, 1.0, 0.2 } } },
    ScalarNormalization());
}

void BuildIncrementally(benchmark::State& state)
{
  const auto function = MakeRamps();
  for (auto _ : state)
  {
    PreIntegrationTable table;
    table.Build(function, Longest, Scalars, Lengths);
    benchmark::DoNotOptimize(table.GetValues().data());
  }
}

/** Attenuation and colour at 2 Scalars - 1 places: the Nyquist rate of the table's scalars. */
struct FunctionSample
{
  double Attenuation = 0.0;
  glm::dvec3 Color{ 0.0 };
};

std::vector<FunctionSample> SampleFunction(const std::vector<TransferFunctionInterval>& function)
{
  std::vector<FunctionSample> samples(2 * Scalars - 1);
  for (std::size_t i = 0; i < samples.size(); ++i)
  {
    const double scalar = -1.0 + static_cast<double>(i) / (Scalars - 1);
    const auto interval = std::find_if(function.begin(), function.end(),
      [scalar](const TransferFunctionInterval& each) { return scalar <= each.Upper; });
    const double offset = scalar - interval->Lower;
    samples[i].Attenuation = interval->Attenuation + offset * interval->AttenuationSlope;
    samples[i].Color = glm::dvec3(interval->Color) + offset * glm::dvec3(interval->ColorSlope);
  }
  return samples;
}

/** Colour of one entry, by one step per sample of the function between its scalars. */
glm::dvec3 IntegrateEntry(
  const std::vector<FunctionSample>& samples, int front, int back, double length)
{
  const int steps = std::max(2 * std::abs(back - front), 1);
  const int sign = back >= front ? 1 : -1;
  glm::dvec3 color(0.0);
  double passed = 1.0;
  for (int i = 0; i < steps; ++i)
  {
    const FunctionSample& sample = samples[static_cast<std::size_t>(2 * front + sign * i)];
    const double opacity = -std::expm1(-sample.Attenuation * length / steps);
    color += passed * opacity * sample.Color;
    passed *= 1.0 - opacity;
  }
  return color;
}

void BuildEntryByEntry(benchmark::State& state)
{
  const auto samples = SampleFunction(MakeRamps());
  for (auto _ : state)
  {
    std::vector<glm::vec3> table;
    table.reserve(std::size_t{ Lengths } * Scalars * Scalars);
    for (int k = 0; k < Lengths; ++k)
    {
      for (int back = 0; back < Scalars; ++back)
      {
        for (int front = 0; front < Scalars; ++front)
        {
          table.emplace_back(IntegrateEntry(samples, front, back, Longest * k / (Lengths - 1)));
        }
      }
    }
    benchmark::DoNotOptimize(table.data());
  }
}

BENCHMARK(BuildIncrementally)->Name("PreIntegration/incremental")->Unit(benchmark::kMillisecond);
BENCHMARK(BuildEntryByEntry)->Name("PreIntegration/each_entry")->Unit(benchmark::kMillisecond);

} // anonymous namespace
