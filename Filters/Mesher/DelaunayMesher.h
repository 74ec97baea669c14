// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Filters_Mesher_DelaunayMesher_h
#define meniscus_Filters_Mesher_DelaunayMesher_h

#include "Surface/SolidCells.h"

namespace meniscus
{

/** Delaunay tetrahedra of the surface's points, by VTK. No points are added. */
TetrahedronCells MeshByDelaunay(const TriangleSurface& surface);

} // namespace meniscus

#endif
