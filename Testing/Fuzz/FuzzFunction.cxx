// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Transfer functions, distributions of scalars and the tables that are made of them.
#include "ByteReader.h"
#include "FuzzOptics.h"
#include "FuzzTarget.h"

#include "Volume/Optics/PreIntegration.h"
#include "Volume/Optics/VisibleScalars.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace meniscus::test
{
namespace
{

constexpr int MostScalars = 64;

void CheckIntervals(const std::vector<TransferFunctionInterval>& intervals)
{
  Require(intervals.front().Lower < -1.0f && intervals.back().Upper > 1.0f,
    "intervals cover all normalised scalars");
  for (std::size_t i = 0; i < intervals.size(); ++i)
  {
    const TransferFunctionInterval& interval = intervals[i];
    Require(interval.Lower <= interval.Upper, "intervals ascend");
    Require(i == 0 || intervals[i - 1].Upper == interval.Lower, "intervals have no gaps");
    Require(interval.Attenuation >= 0.0f && std::isfinite(interval.Attenuation) &&
        std::isfinite(interval.AttenuationSlope),
      "attenuations are finite and not negative");
    for (int channel = 0; channel < 3; ++channel)
    {
      Require(std::isfinite(interval.Color[channel]) && std::isfinite(interval.ColorSlope[channel]),
        "colours are finite");
    }
  }
}

void CheckNormalization(const ScalarNormalization& normalization, std::vector<double> scalars)
{
  scalars.erase(std::remove_if(scalars.begin(), scalars.end(),
                  [](double scalar) { return !std::isfinite(scalar); }),
    scalars.end());
  std::sort(scalars.begin(), scalars.end());
  float last = -1.0f;
  for (const double scalar : scalars)
  {
    const auto normalized = static_cast<float>(normalization(scalar));
    Require(normalized >= last && normalized <= 1.0f, "normalised scalars ascend in [-1, 1]");
    last = normalized;
  }
}

/** Segments of a table: opacities and colours of a medium whose colours are in [0, 1]. */
void CheckTable(const PreIntegrationTable& table)
{
  Require(table.GetValues().size() ==
      static_cast<std::size_t>(
        4 * table.GetNumberOfScalars() * table.GetNumberOfScalars() * table.GetNumberOfLengths()),
    "the table is complete");
  for (const float value : table.GetValues())
  {
    // Within the error that is promised of colours.
    Require(std::isfinite(value) && value >= -2.0e-5f, "values of the table are not negative");
  }
  for (int k = 0; k + 1 < table.GetNumberOfLengths(); ++k)
  {
    Require(table.GetLength(k) < table.GetLength(k + 1), "lengths ascend");
  }
}

}

//------------------------------------------------------------------------------
void FuzzFunction(const std::uint8_t* bytes, std::size_t size)
{
  ByteReader reader(bytes, size);
  const std::vector<TransferFunctionPoint> function = ReadFunction(reader);
  std::vector<double> scalars(static_cast<std::size_t>(reader.Below(MostScalars)));
  for (double& scalar : scalars)
  {
    scalar = reader.Number();
  }
  const ScalarDistribution distribution = DistributionOf(scalars);
  const std::vector<ScalarFeature> features = FeaturesOf(function);
  const ScalarNormalization first = ChooseNormalization(distribution, {}, nullptr);
  CheckNormalization(first, scalars);
  const ScalarNormalization normalization =
    ChooseNormalization(distribution, features, reader.Flag() ? &first : nullptr);
  CheckNormalization(normalization, scalars);
  const std::vector<TransferFunctionInterval> intervals = BuildIntervals(function, normalization);
  CheckIntervals(intervals);

  VisibleScalars visible;
  visible.AddAttenuation(intervals);
  for (int i = reader.Below(4); i > 0; --i)
  {
    visible.AddIsovalue(static_cast<float>(2.0 * reader.Share() - 1.0));
  }
  const bool isSeen = visible.Meets(-1.0f, 1.0f);
  const auto low = static_cast<float>(2.0 * reader.Share() - 1.0);
  const auto high = static_cast<float>(low + (1.0 - low) * reader.Share());
  // A range of one scalar is seen where others only touch it.
  Require(isSeen || low == high || !visible.Meets(low, high),
    "a part shows nothing that the whole does not");

  const ScalarRange range =
    distribution.IsEmpty() ? ScalarRange() : SampledRange(distribution, features, normalization);
  Require(range.Lowest < range.Highest, "a sampled range has a width");
  const int samples = 2 + reader.Below(7);
  const double length = std::fabs(reader.FiniteNumber());
  PreIntegrationTable table;
  table.Build(
    intervals, length > 0.0 ? length : 1.0, samples, 1 + reader.Below(4), SerialLoop, range);
  CheckTable(table);
}

}
