// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rendering/Integral/IntegralArrays.h"

#include "vtkDataArraySelection.h"
#include "vtkImageData.h"
#include "vtkPointData.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iomanip>
#include <iterator>
#include <limits>
#include <sstream>

namespace meniscus
{
namespace
{

constexpr const char* IntegralNames[NumberOfIntegralArrays] = { "Integral", "PathLength",
  "OpticalDepth", "FirstDepth", "LastDepth", "Minimum", "MinimumDepth", "Maximum", "MaximumDepth",
  "RGBA", "EnergyBins" };

/** True for arrays with a number that only rays through the mesh have. */
bool IsUndefinedOutside(IntegralArray array)
{
  return array >= IntegralArray::FirstDepth && array <= IntegralArray::MaximumDepth;
}

int ComponentsOf(IntegralArray array, int bins)
{
  return array == IntegralArray::EnergyBins ? bins : array == IntegralArray::RGBA ? 4 : 1;
}

/** Counts the rays of an energy bin that the mesh absorbs, amplifies or otherwise changes. */
class PassedRays
{
public:
  void Add(float value, double intensity)
  {
    // A detector of 16 bits shows nothing below, a picture of 8 bits no change below.
    constexpr double levelsOfDetector = 65536.0;
    constexpr double levelsOfPicture = 256.0;
    const double passed = static_cast<double>(value);
    this->Changed += passed != static_cast<double>(static_cast<float>(intensity));
    this->Infinite += std::isfinite(value) ? 0 : 1;
    this->Absorbed += passed < intensity / levelsOfDetector;
    this->Amplified += passed > intensity * (1.0 + 1.0 / levelsOfPicture);
  }

  /**
   * Fault of a bin, or an empty text.
   * @param isLit true if all light comes from behind the mesh.
   */
  std::string DescribeFault(bool isLit) const
  {
    std::ostringstream text;
    if (this->Infinite > 0)
    {
      text << this->Infinite << " numbers are not finite";
    }
    else if (isLit && this->Amplified > 0)
    {
      text << this->Amplified << " of " << this->Changed << " rays are amplified";
    }
    else if (isLit && this->AreAbsorbed())
    {
      text << this->Absorbed << " of " << this->Changed
           << " rays through the mesh are absorbed but for less than 1 / 65536";
    }
    if (isLit && this->Amplified > 0)
    {
      text << ": the attenuation, or the scalar, is negative there";
    }
    return text.str();
  }

  /** True if hardly any ray passes. */
  bool AreAbsorbed() const
  {
    // Rays along the border of a mesh have short ways, and pass.
    constexpr std::int64_t onePassesOf = 100;
    return this->Absorbed > 0 && this->Absorbed * onePassesOf >= this->Changed * (onePassesOf - 1);
  }

private:
  std::int64_t Changed = 0;
  std::int64_t Infinite = 0;
  std::int64_t Absorbed = 0;
  std::int64_t Amplified = 0;
};

}

//------------------------------------------------------------------------------
std::vector<const char*> ListArrayNames()
{
  std::vector<const char*> names(std::begin(IntegralNames), std::end(IntegralNames));
  names.insert(names.end(), std::begin(EventNames), std::end(EventNames));
  return names;
}

//------------------------------------------------------------------------------
std::string IntegralChoice::Want(vtkDataArraySelection* selection)
{
  const auto chosen = [selection](const char* name)
  { return selection->ArrayIsEnabled(name) != 0; };
  std::transform(std::begin(IntegralNames), std::end(IntegralNames), this->Wanted.begin(), chosen);
  std::transform(std::begin(EventNames), std::end(EventNames), this->Events.Wanted.begin(), chosen);
  const std::vector<const char*> known = ListArrayNames();
  for (int i = 0; i < selection->GetNumberOfArrays(); ++i)
  {
    const std::string name = selection->GetArrayName(i);
    if (chosen(name.c_str()) && std::find(known.begin(), known.end(), name) == known.end())
    {
      return name;
    }
  }
  return std::string();
}

//------------------------------------------------------------------------------
bool IntegralChoice::NeedsScalars() const
{
  bool needs = this->Has(IntegralArray::EnergyBins) && !this->HasBinArrays;
  for (int array = 0; array <= static_cast<int>(IntegralArray::MaximumDepth); ++array)
  {
    needs = needs || this->Has(static_cast<IntegralArray>(array));
  }
  return needs;
}

//------------------------------------------------------------------------------
bool IntegralChoice::NeedsScalarValues() const
{
  return this->Has(IntegralArray::Integral) || this->Has(IntegralArray::Minimum) ||
    this->Has(IntegralArray::MinimumDepth) || this->Has(IntegralArray::Maximum) ||
    this->Has(IntegralArray::MaximumDepth) || this->Events.IsAnyWanted() ||
    (this->Has(IntegralArray::EnergyBins) && !this->HasBinArrays);
}

//------------------------------------------------------------------------------
std::int64_t IntegralChoice::GetNumbersPerPixel() const
{
  std::int64_t numbers = this->Events.GetNumbersPerPixel();
  for (std::size_t i = 0; i < NumberOfIntegralArrays; ++i)
  {
    numbers +=
      this->Wanted[i] ? ComponentsOf(static_cast<IntegralArray>(i), this->NumberOfBins) : 0;
  }
  return numbers;
}

//------------------------------------------------------------------------------
IntegralArrays::IntegralArrays(
  const IntegralChoice& choice, const std::vector<EnergyBin>& bins, std::int64_t pixels)
  : Events(choice.Events, pixels)
  , Bins(bins)
  , HasBinArrays(choice.HasBinArrays)
{
  for (std::size_t i = 0; i < NumberOfIntegralArrays; ++i)
  {
    if (!choice.Wanted[i])
    {
      continue;
    }
    const auto array = static_cast<IntegralArray>(i);
    vtkFloatArray* made = this->Arrays[i];
    made->SetName(IntegralNames[i]);
    made->SetNumberOfComponents(ComponentsOf(array, choice.NumberOfBins));
    made->SetNumberOfTuples(pixels);
    made->Fill(IsUndefinedOutside(array) ? std::numeric_limits<double>::quiet_NaN() : 0.0);
    for (int bin = 0; array == IntegralArray::EnergyBins && bin < choice.NumberOfBins; ++bin)
    {
      made->FillTypedComponent(
        bin, static_cast<float>(this->Bins[static_cast<std::size_t>(bin)].Intensity));
    }
    this->Values[i] = made->GetPointer(0);
  }
}

//------------------------------------------------------------------------------
void IntegralArrays::SetScalar(
  std::int64_t pixel, const MeasuredScalar& measured, const ScalarNormalization& normalization)
{
  if (!(measured.Length > 0.0))
  {
    return;
  }
  const double unit = 1.0 / normalization.Scale;
  const double integral = normalization.Offset * measured.Length + unit * measured.Integral;
  this->Set(IntegralArray::Integral, pixel, integral);
  this->Set(IntegralArray::PathLength, pixel, measured.Length);
  this->Set(IntegralArray::OpticalDepth, pixel, measured.OpticalDepth);
  this->Set(IntegralArray::FirstDepth, pixel, measured.First);
  this->Set(IntegralArray::LastDepth, pixel, measured.Last);
  this->Set(IntegralArray::Minimum, pixel, normalization.Offset + unit * measured.Lowest);
  this->Set(IntegralArray::MinimumDepth, pixel, measured.LowestAt);
  this->Set(IntegralArray::Maximum, pixel, normalization.Offset + unit * measured.Highest);
  this->Set(IntegralArray::MaximumDepth, pixel, measured.HighestAt);
  float* bins = this->Values[static_cast<std::size_t>(IntegralArray::EnergyBins)];
  if (bins && !this->HasBinArrays)
  {
    const auto count = static_cast<std::int64_t>(this->Bins.size());
    for (std::int64_t bin = 0; bin < count; ++bin)
    {
      bins[count * pixel + bin] =
        ToFloat(TransmittedIntensity(this->Bins[static_cast<std::size_t>(bin)], integral));
    }
  }
}

//------------------------------------------------------------------------------
void IntegralArrays::SetBins(std::int64_t pixel, const MeasuredBin& measured,
  const EnergyBinTables::Table& table, bool isEmitting)
{
  const auto count = static_cast<std::int64_t>(this->Bins.size());
  float* bins = this->Values[static_cast<std::size_t>(IntegralArray::EnergyBins)] + count * pixel;
  for (int i = 0; i < table.NumberOfBins; ++i)
  {
    const int bin = table.FirstBin + i;
    const double depth = measured.Integrals[static_cast<std::size_t>(i)];
    const double source = this->Bins[static_cast<std::size_t>(bin)].Intensity;
    bins[bin] = ToFloat(source * std::exp(-depth) + (isEmitting ? measured.Light : 0.0));
  }
}

//------------------------------------------------------------------------------
void IntegralArrays::AddTo(vtkImageData* image)
{
  bool isFirst = true;
  for (std::size_t i = 0; i < NumberOfIntegralArrays; ++i)
  {
    if (!this->Values[i])
    {
      continue;
    }
    image->GetPointData()->AddArray(this->Arrays[i]);
    if (isFirst)
    {
      image->GetPointData()->SetActiveScalars(IntegralNames[i]);
      isFirst = false;
    }
  }
  this->Events.AddTo(image);
}

//------------------------------------------------------------------------------
// The scalars are held if floats, which have 24 binary digits, tell 255 levels of their range
// apart.
std::string IntegralArrays::WarnOfPrecision(const ScalarDistribution& scalars) const
{
  using Float = std::numeric_limits<float>;
  constexpr double levels = 255.0;
  const bool isWanted = this->Values[static_cast<std::size_t>(IntegralArray::Integral)] ||
    this->Values[static_cast<std::size_t>(IntegralArray::Minimum)] ||
    this->Values[static_cast<std::size_t>(IntegralArray::Maximum)];
  if (!isWanted || scalars.IsEmpty())
  {
    return std::string();
  }
  const double low = scalars.GetLowest();
  const double high = scalars.GetHighest();
  const double largest = std::max(std::abs(low), std::abs(high));
  std::ostringstream text;
  const auto describe = [&](const char* fault, const char* cure)
  {
    text << "The scalars, from " << std::setprecision(12) << low << " to " << high << ", are "
         << fault << " (32-bit floats): " << cure << ", for example with vtkArrayCalculator.";
    return text.str();
  };
  if (this->TooLarge > 0)
  {
    text << this->TooLarge << " numbers of the output are infinite. ";
    return describe("beyond the range of the output", "divide them by a constant");
  }
  if (largest > 0.0 && largest < levels * static_cast<double>(Float::min()))
  {
    return describe("below the range of the output", "multiply them by a constant");
  }
  if (high > low && largest * static_cast<double>(Float::epsilon()) * levels > high - low)
  {
    return describe("too close together for the output", "subtract a constant");
  }
  return std::string();
}

//------------------------------------------------------------------------------
std::string IntegralArrays::WarnOfBins(bool isEmitting, double opticalDepth) const
{
  const float* values = this->Values[static_cast<std::size_t>(IntegralArray::EnergyBins)];
  if (!values)
  {
    return std::string();
  }
  vtkFloatArray* array = this->Arrays[static_cast<std::size_t>(IntegralArray::EnergyBins)];
  const std::size_t count = this->Bins.size();
  const auto pixels = static_cast<std::size_t>(array->GetNumberOfTuples());
  for (std::size_t bin = 0; bin < count; ++bin)
  {
    PassedRays rays;
    for (std::size_t pixel = 0; pixel < pixels; ++pixel)
    {
      rays.Add(values[count * pixel + bin], this->Bins[bin].Intensity);
    }
    // If the mesh emits light, the intensity does not show how much was absorbed.
    const bool isLit =
      !isEmitting && this->Bins[bin].Intensity > 0.0 && this->Bins[bin].Emission == 0.0;
    const std::string fault = rays.DescribeFault(isLit);
    if (!fault.empty())
    {
      std::ostringstream text;
      text << "Energy bin " << bin << ": " << fault;
      if (opticalDepth > 0.0 && rays.AreAbsorbed())
      {
        text << ". Its attenuation is " << this->Bins[bin].Attenuation << " times the scalar; with "
             << 1.0 / opticalDepth << " the optical depth of the mesh is about 1";
      }
      return text.str() + ".";
    }
  }
  return std::string();
}

}
