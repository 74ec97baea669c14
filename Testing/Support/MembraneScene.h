// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "RefractedRays.h"
#include "TracedImage.h"

namespace meniscus::test
{

/** A membrane as the mapper's input and as the reference's surface. */
struct MembraneCase
{
  vtkSmartPointer<vtkPolyData> Mesh;
  reference::RefractingSurface Surface;

  /**
   * The colour function of refracted rays, where `trace` returns the colour of a straight part of a
   * ray, in front of the membrane or behind it. Without a mesh, it is `trace` itself.
   */
  TraceRay BendMembrane(const TraceRay& trace) const;
};

/** Triangles of a height field y(x, z) over the square of half side `half`, with exact normals. */
vtkSmartPointer<vtkPolyData> MakeHeightField(const std::function<double(double, double)>& height,
  const reference::RefractingSurface& surface, double half, int cells);

/** The plane y = level over a square. */
MembraneCase MakePlaneCase(double level, double half, int cells);

/** The top of a sphere, convex to the eye, over a square; the apex is at y = apex. */
MembraneCase MakeDomeCase(double apex, double radius, double half, int cells);

/** y = level + amplitude sin(k x) sin(k z) over a square. */
MembraneCase MakeWavesCase(double level, double amplitude, double k, double half, int cells);

} // namespace meniscus::test
