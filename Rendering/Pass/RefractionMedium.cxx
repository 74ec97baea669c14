// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rendering/Pass/RefractionMedium.h"

#include "vtkShaderProgram.h"

#include <algorithm>
#include <cmath>
#include <limits>

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
std::string RefractionMedium::DeclareInShader()
{
  return R"(
uniform bool mediumIsLinear;
uniform vec3 mediumAttenuation;
uniform vec2 mediumRange;
uniform vec3 mediumColor;

vec3 inMedium(vec3 color, float distance)
{
  vec3 seen = exp(-mediumAttenuation * distance);
  if (mediumIsLinear)
  {
    float width = mediumRange.y - mediumRange.x;
    seen = vec3(width > 0.0 ? clamp((mediumRange.y - distance) / width, 0.0, 1.0)
                            : (distance < mediumRange.y ? 1.0 : 0.0));
  }
  return mix(mediumColor, color, seen);
}
)";
}

//------------------------------------------------------------------------------
void RefractionMedium::SetUniforms(vtkShaderProgram* program) const
{
  if (!program->IsUniformUsed("mediumAttenuation"))
  {
    return;
  }
  const auto toFloat = [](double value) { return static_cast<float>(value); };
  float attenuation[3];
  float color[3];
  float range[2];
  std::transform(this->Attenuation.begin(), this->Attenuation.end(), attenuation, toFloat);
  std::transform(this->Color.begin(), this->Color.end(), color, toFloat);
  std::transform(this->Range.begin(), this->Range.end(), range, toFloat);
  program->SetUniformi("mediumIsLinear", this->Kind == Model::Linear ? 1 : 0);
  program->SetUniform3f("mediumAttenuation", attenuation);
  program->SetUniform3f("mediumColor", color);
  program->SetUniform2f("mediumRange", range);
}

}
