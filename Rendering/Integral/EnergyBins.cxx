// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rendering/Integral/EnergyBins.h"

#include "Rendering/Input/ConcatenatedArray.h"
#include "Rendering/Input/InputContent.h"

#include "vtkDataArray.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace meniscus
{
namespace
{

int NumberOfComponents(const InputBlocks& blocks)
{
  return blocks.Parts.front().Scalars->GetNumberOfComponents();
}

/** True if the arrays of all data sets have this number of components. */
bool HaveComponents(const InputBlocks& blocks, int components)
{
  return std::all_of(blocks.Parts.begin(), blocks.Parts.end(),
    [components](const InputPart& part)
    { return part.Scalars->GetNumberOfComponents() == components; });
}

std::string DescribeMismatch(const InputBlocks& attenuation, const InputBlocks& emission)
{
  const int components = NumberOfComponents(attenuation);
  if (!HaveComponents(attenuation, components))
  {
    return "The attenuation arrays of the data sets differ in the number of components";
  }
  if (emission.Parts.empty())
  {
    return std::string();
  }
  if (!HaveSameGrids(attenuation, emission) || attenuation.Place != emission.Place)
  {
    return "Attenuation and emission must be arrays of the same data sets, both of points or both "
           "of cells";
  }
  return HaveComponents(emission, components)
    ? std::string()
    : "The emission array must have as many components as the attenuation array, " +
      std::to_string(components);
}

/** A value in single precision; NaN for one that is not finite or not representable. */
float ToSingle(double value)
{
  return std::abs(value) <= static_cast<double>(std::numeric_limits<float>::max())
    ? static_cast<float>(value)
    : std::numeric_limits<float>::quiet_NaN();
}

}

//------------------------------------------------------------------------------
double TransmittedIntensity(const EnergyBin& bin, double integral)
{
  const double depth = bin.Attenuation * integral;
  // (1 - exp(-depth)) / attenuation, which tends to the integral.
  const double emitted = depth != 0.0 ? -std::expm1(-depth) / bin.Attenuation : integral;
  return bin.Intensity * std::exp(-depth) + (bin.Emission != 0.0 ? bin.Emission * emitted : 0.0);
}

//------------------------------------------------------------------------------
std::string EnergyBinTables::Update(
  const VolumeInput& input, const InputBlocks& attenuation, const InputBlocks& emission)
{
  const std::string mismatch = DescribeMismatch(attenuation, emission);
  if (!mismatch.empty())
  {
    return mismatch;
  }
  const bool isEmitting = !emission.Parts.empty();
  const bool newAttenuation = this->AttenuationWatch.HasChanged(
    ScalarVersions(attenuation), [&attenuation]() { return DigestScalars(attenuation); });
  const bool newEmission = isEmitting &&
    this->EmissionWatch.HasChanged(
      ScalarVersions(emission), [&emission]() { return DigestScalars(emission); });
  if (!newAttenuation && !newEmission && isEmitting == this->Emitting &&
    attenuation.Place == this->Place && input.GetBuildVersion() == this->BuiltMesh)
  {
    return std::string();
  }
  this->Emitting = isEmitting;
  this->Place = attenuation.Place;
  this->BuiltMesh = input.GetBuildVersion();
  this->Tables.clear();
  const int bins = NumberOfComponents(attenuation);
  const int step = isEmitting ? 1 : 3;
  for (int bin = 0; bin < bins; bin += step)
  {
    Table table;
    table.FirstBin = bin;
    table.NumberOfBins = std::min(step, bins - bin);
    table.Values.assign(input.GetSources(this->Place).size(), glm::vec3(0.0f));
    this->Tables.push_back(table);
  }
  std::string error = this->Read(attenuation, input, false);
  if (error.empty() && isEmitting)
  {
    error = this->Read(emission, input, true);
  }
  if (!error.empty())
  {
    this->AttenuationWatch.Forget();
  }
  ++this->Builds;
  return error;
}

//------------------------------------------------------------------------------
/** Reads all components of an array into the tables. Returns an error, or an empty text. */
std::string EnergyBinTables::Read(
  const InputBlocks& blocks, const VolumeInput& input, bool isEmission)
{
  for (Table& table : this->Tables)
  {
    for (int i = 0; i < table.NumberOfBins; ++i)
    {
      const std::vector<double> values = GatherValues(blocks, table.FirstBin + i,
        input.GetSources(this->Place), input.GetInterpolatedPoints(this->Place));
      if (!isEmission &&
        std::any_of(values.begin(), values.end(), [](double value) { return value < 0.0; }))
      {
        return "The attenuation array has a negative value";
      }
      for (std::size_t v = 0; v < values.size(); ++v)
      {
        table.Values[v][isEmission ? 1 : i] = ToSingle(values[v]);
      }
    }
  }
  return std::string();
}

}
