// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/** The well and its membrane for the Embree tracer. */
#pragma once

#include "RefractionTracer.h"
#include "WellScene.h"

#include <algorithm>
#include <cstddef>

namespace meniscus::benchmark
{

TracedMesh MembraneOf(const reference::MembraneMesh& mesh);

/** Quad i becomes the triangles 2 i and 2 i + 1. */
TracedMesh ObjectOf(vtkPolyData* data);

/** Colours of these triangles. */
TriangleColors ColorsOf(vtkPolyData* data);

TracedView ViewOf(const test::PixelCamera& camera);

/** Traces an image; calls visit(packet, k, pixel) for each pixel, number k of its packet. */
template <typename Visit>
void TracePixels(const RefractionTracer& tracer, const TracedView& view, const Visit& visit)
{
  TracedPacket packet = {};
  for (packet.Y = 0; packet.Y < view.Pixels; ++packet.Y)
  {
    for (packet.X = 0; packet.X < view.Pixels; packet.X += TracedPacket::Width)
    {
      packet.Count = std::min(TracedPacket::Width, view.Pixels - packet.X);
      tracer.TracePacket(view, packet);
      for (int k = 0; k < packet.Count; ++k)
      {
        visit(packet, k, static_cast<std::size_t>(packet.Y * view.Pixels + packet.X + k));
      }
    }
  }
}

/** Places that the tracer's image shows. */
test::PlacePicture PlacesOf(const RefractionTracer& tracer, const test::PixelCamera& camera);

} // namespace meniscus::benchmark
