// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Common/RangeLoop.h"
#include "Volume/Caster/TileCaster.h"
#include "Volume/Illumination/LightFrames.h"
#include "Volume/Illumination/ShadowStarts.h"
#include "Volume/Mesh/BoundaryTree.h"
#include "Volume/Rays/RayFrame.h"
#include "Volume/Rays/RayStatistics.h"

#include <glm/vec4.hpp>

#include <cstdint>
#include <functional>
#include <vector>

namespace meniscus
{

/** A medium whose mesh gets shadows. */
struct ShadowScene
{
  /**
   * Mesh, tables and everything else that attenuation depends on, in the frame Base. Its clipping
   * planes cut lines; its rays and its lighting are not used.
   */
  TileCaster::Scene Medium;
  /** One normalised scalar per vertex; empty for scalars of cells. */
  const std::vector<float>* Scalars = nullptr;
  /** Tree over the mesh's boundary, and the starts of lines. */
  const BoundaryTree* Tree = nullptr;
  const ShadowStarts* Starts = nullptr;
  /** Frame of lights; see LightFrames::Set(). */
  RayFrame Base;
  /** Largest length of a line, in units of the frame. */
  double Reach = 2.0;
};

/** Transmittance below which a line ends: 1/16 of a step of a picture with 8 bits. */
constexpr float OpaqueShadow = 1.0f / 4096.0f;

/** Gets the transmittance from a light to a start, a vertex or a cell. */
using ShadowTaker = std::function<void(std::int32_t start, float transmittance)>;

/**
 * Transmittance of a medium from the starts in its mesh to a light. The lines to the light are cast
 * in packets, in groups of starts that follow each other along the mesh's Morton curve, by the walk
 * that draws pictures. A line begins in the cell of its start, goes on behind gaps in the mesh, and
 * ends at the light, at the reach, where it is opaque or where it leaves the mesh for good.
 * @param light position and 1, or direction towards the light, not 0, and 0. From a place at the
 *   light, the transmittance is 1.
 * @param take called for each start, once, from any thread.
 */
RayStatistics CastShadows(const ShadowScene& scene, const glm::dvec4& light, const RangeLoop& loop,
  const ShadowTaker& take);

}
