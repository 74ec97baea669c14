// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Volume_MediumTable_h
#define meniscus_Volume_MediumTable_h

#include "Volume/Packet/Packet.h"
#include "Volume/SurfaceLighting.h"

#include <glm/mat3x3.hpp>

#include <vector>

namespace meniscus
{

/** What gradients do to a medium, as packets read it; of the frame of some rays. */
class MediumTable
{
public:
  MediumTable() = default;
  MediumTable(const MediumTable&) = delete;
  MediumTable& operator=(const MediumTable&) = delete;

  /**
   * @param lighting  in the frame; null without light.
   * @param gradientToFrame  from normalised model coordinates.
   * @param gradientMagnitude  from a gradient's length in the frame to what `opacity` is of.
   * @param opacity  null for none; must outlive this.
   */
  void Pack(const SurfaceLighting* lighting, const glm::dmat3& gradientToFrame,
    double gradientMagnitude, const std::vector<PacketInterval>* opacity);

  /** Null if gradients do nothing. */
  const PacketMedium* Get() const
  {
    const bool used = this->Medium.Shading || this->Medium.NumberOfOpacityIntervals > 0;
    return used ? &this->Medium : nullptr;
  }

private:
  PacketMedium Medium{};
  std::vector<PacketLight> Lights;
};

}

#endif
