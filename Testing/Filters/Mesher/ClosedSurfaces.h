// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "VTKBasics.h"

namespace meniscus::test
{

using Surface = vtkSmartPointer<vtkPolyData>;

/** @{ */
/** Surfaces of triangles, in double precision, with shared points. */
Surface MakeBox(double x, double y, double z);
Surface MakeSphere(double radius, int theta, int phi);
/** A sphere of an icosahedron whose triangles are divided `levels` times by four. */
Surface MakeGeodesicSphere(double radius, int levels);
Surface MakeTorus(double radius, double tube, int around, int across);
/** @} */

/** @{ */
/** Volumes of the polyhedra in closed form; that of the geodesic sphere as a sum of pyramids. */
double GeodesicSphereVolume(double radius, int levels);
double SphereVolume(double radius, int theta, int phi);
double TorusVolume(double radius, double tube, int around, int across);
/** @} */

/** @{ */
/** Changed copies. */
Surface Reversed(vtkPolyData* surface);
Surface Moved(vtkPolyData* surface, const std::array<double, 3>& by);
Surface Flattened(vtkPolyData* surface);
Surface Joined(const std::vector<Surface>& surfaces);
/** @} */

void RemoveTriangle(vtkPolyData* surface, vtkIdType triangle);
void TurnTriangle(vtkPolyData* surface, vtkIdType triangle);

}
