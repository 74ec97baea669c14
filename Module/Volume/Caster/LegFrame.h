// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Volume/Caster/GradientShadingTable.h"
#include "Volume/Optics/SurfaceLighting.h"
#include "Volume/Packet/Data/PacketJob.h"
#include "Volume/Rays/FixedPointRays.h"

#include <glm/mat3x3.hpp>

#include <cstdint>
#include <vector>

namespace meniscus
{

/** Optics that depend on the frame of the rays; see GradientShadingTable::Pack(). */
struct FrameOptics
{
  const SurfaceLighting* Lighting = nullptr;
  glm::dmat3 GradientToFrame{ 1.0 };
  double GradientMagnitude = 1.0;
  const std::vector<PacketInterval>* GradientOpacity = nullptr;
};

/** Frame in which legs of rays are cast: the vertices in its grid, and the optics in it. */
class LegFrame
{
public:
  LegFrame() = default;
  LegFrame(const LegFrame&) = delete;
  LegFrame& operator=(const LegFrame&) = delete;

  /**
   * @param grid grid of the frame.
   * @param vertices vertices of the mesh in that grid; must outlive this object.
   * @param optics its gradient opacity must outlive this object.
   */
  void Set(const FixedPointRays& grid, const std::vector<PacketVertex>& vertices,
    const FrameOptics& optics);

  /** Sets the members of a job that depend on the frame; its blend mode must be set. */
  void Describe(PacketJob& job) const;

private:
  double GridUnit = 1.0;
  std::int32_t Pivot = 0;
  bool RaysAreFine = false;
  const std::vector<PacketVertex>* Vertices = nullptr;
  bool Lit = false;
  SurfaceLighting Lighting;
  glm::dmat3 GradientToFrame{ 1.0 };
  GradientShadingTable Medium;
};

}
