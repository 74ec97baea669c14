// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Volume_Caster_GradientShadingTable_h
#define meniscus_Volume_Caster_GradientShadingTable_h

#include "Volume/Optics/SurfaceLighting.h"
#include "Volume/Packet/Data/PacketOptics.h"

#include <glm/mat3x3.hpp>

#include <vector>

namespace meniscus
{

/** What gradients do to a medium, as packets read it; of the frame of some rays. */
class GradientShadingTable
{
public:
  GradientShadingTable() = default;
  GradientShadingTable(const GradientShadingTable&) = delete;
  GradientShadingTable& operator=(const GradientShadingTable&) = delete;

  /**
   * @param lighting  in the frame; null without light.
   * @param gradientToFrame  from normalised model coordinates.
   * @param gradientMagnitude  from a gradient's length in the frame to what `opacity` is of.
   * @param opacity  null for none; must outlive this.
   */
  void Pack(const SurfaceLighting* lighting, const glm::dmat3& gradientToFrame,
    double gradientMagnitude, const std::vector<PacketInterval>* opacity);

  /** Null if gradients do nothing. */
  const GradientShading* Get() const
  {
    const bool used = this->Medium.Shading || this->Medium.NumberOfOpacityIntervals > 0;
    return used ? &this->Medium : nullptr;
  }

private:
  GradientShading Medium{};
  std::vector<PacketLight> Lights;
};

}

#endif
