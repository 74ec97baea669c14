// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/** The well and its membrane for the Embree tracer. */
#ifndef meniscus_Benchmarks_Refraction_TracedWell_h
#define meniscus_Benchmarks_Refraction_TracedWell_h

#include "RefractionTracer.h"
#include "WellScene.h"

namespace meniscus
{
namespace benchmark
{

TracedMesh MembraneOf(const reference::MembraneMesh& mesh);

/** Triangles 2 i and 2 i + 1 are those of quad i. */
TracedMesh ObjectOf(vtkPolyData* data);

/** Colours of these triangles. */
TriangleColors ColorsOf(vtkPolyData* data);

TracedView ViewOf(const testing::PixelCamera& camera);

/** Places that the tracer's image shows. */
testing::PlacePicture PlacesOf(const RefractionTracer& tracer, const testing::PixelCamera& camera);

} // namespace benchmark
} // namespace meniscus

#endif
