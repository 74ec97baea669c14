// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Rendering/Backends/Native/NativeScene.h"
#include "Rendering/Backends/RayCastFrame.h"
#include "Rendering/Backends/RayCastMembrane.h"
#include "Rendering/Backends/RayCastTables.h"
#include "Volume/Caster/MeasuredRays.h"
#include "Volume/Caster/TileCaster.h"
#include "Volume/Packet/Data/RayEvents.h"

#include <cstdint>
#include <string>
#include <vector>

namespace meniscus
{

/** A pixel whose ray is cast. */
struct PickedPixel
{
  /** Pixel of the viewport, rows from below. */
  int Column = 0;
  int Row = 0;
  /** Window depth at which the ray ends, in [0, 1]; 1 is the far plane. */
  float OpaqueDepth = 1.0f;
};

/**
 * Events of single rays of a mapper's picture. It has tables of its own where the mapper's tables
 * belong to its last frame: vertices about the ray, and refracted rays.
 */
class RayPicker
{
public:
  /**
   * Casts the ray of a pixel.
   * @param tables tables of the mapper, brought up to date; its own Membrane is not used.
   * @param frame frame of the whole viewport; its Output has the viewport's size.
   * @param opacity accumulated opacity of OpacityReachedEvent.
   * @return an error, or an empty text.
   */
  std::string Cast(RayCastTables& tables, RayCastFrame frame, const PickedPixel& pixel,
    double opacity, MeasuredEvents& events);

  /**
   * Computes window depths of an event for all pixels of a frame.
   * @param kind FirstVisibleEvent or another one.
   * @param depths replaced by one depth per pixel, 2 for rays without the event.
   */
  std::string CastDepths(RayCastTables& tables, RayCastFrame frame, double opacity,
    RayEventKind kind, std::vector<float>& depths);

  /** Bytes of the tables about the last ray. */
  std::int64_t GetBytes() const;

  /** Refracting surfaces; to be brought up to date before a pick. */
  RayCastMembrane Membrane;

private:
  /** @param frame is changed to one of events; it must outlive the scene, which points into it. */
  std::string MakeScene(RayCastTables& tables, RayCastFrame& frame, const int (&size)[2],
    double opacity, TileCaster::Scene& scene);

  NativeScene Scenes;
  TileCaster::Workspace Workspace;
};

}
