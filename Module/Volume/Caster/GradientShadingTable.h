// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Volume/Optics/SurfaceLighting.h"
#include "Volume/Packet/Data/PacketOptics.h"

#include <glm/mat3x3.hpp>

#include <vector>

namespace meniscus
{

/**
 * Effect of gradients on a medium (lighting, gradient opacity), in the packets' layout and in one
 * frame of rays.
 */
class GradientShadingTable
{
public:
  GradientShadingTable() = default;
  GradientShadingTable(const GradientShadingTable&) = delete;
  GradientShadingTable& operator=(const GradientShadingTable&) = delete;

  /**
   * @param lighting lights in the frame of the rays; null for none.
   * @param gradientToFrame matrix from normalised model coordinates to the frame.
   * @param gradientMagnitude factor from the length of a gradient in the frame to the argument of
   *   `opacity`.
   * @param opacity gradient opacity; null for none. Must outlive this object.
   */
  void Pack(const SurfaceLighting* lighting, const glm::dmat3& gradientToFrame,
    double gradientMagnitude, const std::vector<PacketInterval>* opacity);

  /** Null if gradients have no effect. */
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
