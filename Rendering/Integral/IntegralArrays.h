// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Rendering/Integral/EnergyBins.h"
#include "Rendering/Integral/EventArrays.h"
#include "Volume/Caster/MeasuredRays.h"
#include "Volume/Optics/ScalarNormalization.h"

#include "vtkFloatArray.h"
#include "vtkNew.h"

#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

class vtkDataArraySelection;
class vtkImageData;

namespace meniscus
{

/** Arrays of an image of integrals. */
enum class IntegralArray
{
  Integral,
  PathLength,
  OpticalDepth,
  FirstDepth,
  LastDepth,
  Minimum,
  MinimumDepth,
  Maximum,
  MaximumDepth,
  RGBA,
  EnergyBins,
  NumberOfArrays
};
constexpr std::size_t NumberOfIntegralArrays =
  static_cast<std::size_t>(IntegralArray::NumberOfArrays);

/** Names of all arrays and events. */
std::vector<const char*> ListArrayNames();

/** Arrays that are wanted. */
struct IntegralChoice
{
  std::array<bool, NumberOfIntegralArrays> Wanted{};
  EventChoice Events;
  /** Number of energy bins, at least 1 if their array is wanted. */
  int NumberOfBins = 0;
  /** True if the bins' attenuations are arrays, otherwise they are multiples of the scalar. */
  bool HasBinArrays = false;

  /**
   * Chooses the arrays that a selection has switched on. Returns a name that does not exist, or an
   * empty one.
   */
  std::string Want(vtkDataArraySelection* selection);
  bool Has(IntegralArray array) const { return this->Wanted[static_cast<std::size_t>(array)]; }
  /** True if an array measures the scalar, be it only where there is one. */
  bool NeedsScalars() const;
  /** True if an array depends on the scalar's values. */
  bool NeedsScalarValues() const;
  /** True if an array needs a volume property. */
  bool NeedsProperty() const { return this->NeedsComposite() || this->Events.NeedsProperty(); }
  /** True if an array needs the functions of composite blending. */
  bool NeedsComposite() const
  {
    return this->Has(IntegralArray::RGBA) || this->Has(IntegralArray::OpticalDepth);
  }
  bool NeedsBinArrays() const { return this->HasBinArrays && this->Has(IntegralArray::EnergyBins); }
  /** Numbers per pixel of all arrays. */
  std::int64_t GetNumbersPerPixel() const;
};

/** The arrays of an image in memory, filled pixel by pixel. */
class IntegralArrays
{
public:
  /** Makes the arrays that are wanted, with the values of rays that meet nothing. */
  IntegralArrays(
    const IntegralChoice& choice, const std::vector<EnergyBin>& bins, std::int64_t pixels);

  /** Sets the values that are measured of the scalar. */
  void SetScalar(
    std::int64_t pixel, const MeasuredScalar& measured, const ScalarNormalization& normalization);
  /** Sets the bins of a table. */
  void SetBins(std::int64_t pixel, const MeasuredBin& measured, const EnergyBinTables::Table& table,
    bool isEmitting);
  /** Premultiplied RGBA of all pixels; null if it is not wanted. */
  float* GetImage() { return this->Values[static_cast<std::size_t>(IntegralArray::RGBA)]; }

  /** Adds the arrays to the points of an image; the first one becomes the active scalars. */
  void AddTo(vtkImageData* image);

  /**
   * Warning that floats do not hold the integrals or extremes of the scalars: numbers are beyond
   * their range, or differences are lost next to a common offset. Empty if they do.
   */
  std::string WarnOfPrecision(const ScalarDistribution& scalars) const;

  /**
   * Warning about the first energy bin that shows nothing of the mesh, because hardly any ray
   * passes it, about one whose rays are amplified, and about numbers beyond the range of floats.
   * Empty if there is none.
   * @param isEmitting true if an array has the light of the mesh.
   * @param opticalDepth of a ray as long as the mesh, with the largest scalar and the coefficient
   * 1; 0 with arrays of attenuation.
   */
  std::string WarnOfBins(bool isEmitting, double opticalDepth) const;

  EventArrays Events;

private:
  void Set(IntegralArray array, std::int64_t pixel, double value)
  {
    if (float* values = this->Values[static_cast<std::size_t>(array)])
    {
      values[pixel] = ToFloat(value);
      if (std::isinf(values[pixel]))
      {
        ++this->TooLarge;
      }
    }
  }
  /** A number in single precision, infinite beyond its range. */
  static float ToFloat(double value)
  {
    using Float = std::numeric_limits<float>;
    return !(std::abs(value) > static_cast<double>(Float::max())) ? static_cast<float>(value)
      : value > 0.0                                               ? Float::infinity()
                                                                  : -Float::infinity();
  }

  std::array<vtkNew<vtkFloatArray>, NumberOfIntegralArrays> Arrays;
  /** Values of the arrays, null for those that are not wanted. */
  std::array<float*, NumberOfIntegralArrays> Values{};
  std::vector<EnergyBin> Bins;
  bool HasBinArrays;
  std::atomic<std::int64_t> TooLarge{ 0 }; ///< numbers beyond the range of floats
};

}
