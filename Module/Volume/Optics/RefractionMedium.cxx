// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Twin: Rendering/glsl/vtkMediumTransmittance.glsl (share of the light)
#include "Volume/Optics/RefractionMedium.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace meniscus
{

//------------------------------------------------------------------------------
std::string RefractionMedium::DescribeFault() const
{
  const auto isBad = [](double value) { return !std::isfinite(value) || value < 0.0; };
  if (std::any_of(this->Attenuation.begin(), this->Attenuation.end(), isBad))
  {
    return "Attenuation coefficients must be finite and not negative";
  }
  if (std::any_of(this->Color.begin(), this->Color.end(), isBad))
  {
    return "The components of the medium's colour must be finite and not negative";
  }
  if (isBad(this->Range[0]) || isBad(this->Range[1]) || this->Range[1] < this->Range[0])
  {
    return "The medium's range must be two distances in ascending order";
  }
  return std::string();
}

//------------------------------------------------------------------------------
bool RefractionMedium::IsClear() const
{
  return this->Kind == Model::Exponential &&
    std::all_of(this->Attenuation.begin(), this->Attenuation.end(),
      [](double coefficient) { return coefficient == 0.0; });
}

//------------------------------------------------------------------------------
std::array<double, 3> RefractionMedium::SeenFrom(double distance) const
{
  if (this->Kind == Model::Linear)
  {
    const double width = this->Range[1] - this->Range[0];
    const double seen =
      width > 0.0 ? (this->Range[1] - distance) / width : (distance < this->Range[1] ? 1.0 : 0.0);
    const double share = std::clamp(seen, 0.0, 1.0);
    return { share, share, share };
  }
  const auto along = [distance](double coefficient)
  { return coefficient > 0.0 ? std::exp(-coefficient * distance) : 1.0; };
  return { along(this->Attenuation[0]), along(this->Attenuation[1]), along(this->Attenuation[2]) };
}

//------------------------------------------------------------------------------
std::array<double, 3> RefractionMedium::BackdropOf(const double (&background)[3]) const
{
  std::array<double, 3> color{ background[0], background[1], background[2] };
  if (this->IsInfinite)
  {
    const std::array<double, 3> seen = this->SeenFrom(std::numeric_limits<double>::infinity());
    for (std::size_t i = 0; i < 3; ++i)
    {
      color[i] = seen[i] * background[i] + (1.0 - seen[i]) * this->Color[i];
    }
  }
  return color;
}

//------------------------------------------------------------------------------
bool operator==(const RefractionMedium& a, const RefractionMedium& b)
{
  const auto members = [](const RefractionMedium& medium)
  {
    return std::tie(medium.Kind, medium.Attenuation, medium.Range, medium.Color, medium.IsInfinite);
  };
  return members(a) == members(b);
}

}
