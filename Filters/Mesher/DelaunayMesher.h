// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Surface/SolidCells.h"

namespace meniscus
{

/** Delaunay tetrahedra of the surface's points, by VTK. No points are added. */
TetrahedronCells MeshByDelaunay(const TriangleSurface& surface);

} // namespace meniscus
