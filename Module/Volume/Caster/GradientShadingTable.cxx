// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Caster/GradientShadingTable.h"
#include "Volume/Packet/Data/PacketOptics.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <cstdint>

namespace meniscus
{
namespace
{

/** Rounds a vector to single precision. */
template <typename Vector, int Size>
void Round(const Vector& from, float (&to)[Size])
{
  for (int i = 0; i < Size; ++i)
  {
    to[i] = static_cast<float>(from[i]);
  }
}

}

//------------------------------------------------------------------------------
void GradientShadingTable::Pack(const SurfaceLighting* lighting, const glm::dmat3& gradientToFrame,
  double gradientMagnitude, const std::vector<PacketInterval>* opacity)
{
  const glm::dmat3 rows = glm::transpose(gradientToFrame);
  for (int row = 0; row < 3; ++row)
  {
    Round(rows[row], this->Medium.GradientToFrame[row]);
  }
  this->Medium.GradientMagnitude = static_cast<float>(gradientMagnitude);
  this->Medium.Opacity = opacity ? opacity->data() : nullptr;
  this->Medium.NumberOfOpacityIntervals = opacity ? static_cast<std::int32_t>(opacity->size()) : 0;
  this->Medium.Shading = lighting != nullptr;
  this->Lights.clear();
  if (lighting)
  {
    this->Medium.Ambient = static_cast<float>(lighting->Ambient);
    this->Medium.Diffuse = static_cast<float>(lighting->Diffuse);
    this->Medium.Specular = static_cast<float>(lighting->Specular);
    this->Medium.SpecularPower = static_cast<float>(lighting->SpecularPower);
    this->Medium.BrightestLight = lighting->BrightestLight;
    this->Medium.Scattering = static_cast<float>(lighting->Scattering);
    this->Medium.Anisotropy = static_cast<float>(lighting->Anisotropy);
    for (const RayCastLight& light : lighting->Lights)
    {
      this->Lights.emplace_back();
      PacketLight& packed = this->Lights.back();
      const bool positional = light.Position.w != 0.0;
      const glm::dvec3 place(light.Position);
      Round(
        glm::dvec4(positional ? place : glm::normalize(place), light.Position.w), packed.Position);
      Round(light.Diffuse, packed.Diffuse);
      Round(light.Specular, packed.Specular);
      Round(light.Cone, packed.Cone);
      Round(light.Falloff, packed.Falloff);
    }
  }
  this->Medium.Lights = this->Lights.data();
  this->Medium.NumberOfLights = static_cast<std::int32_t>(this->Lights.size());
}

}
