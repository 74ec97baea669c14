// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Surface/SolidCells.h"

class vtkPolyData;
class vtkUnstructuredGrid;

namespace meniscus
{

/** Polygons and strips as triangles, with coincident points joined. */
TriangleSurface ExtractSurface(vtkPolyData* data);

/** Sets points and cells, without arrays. */
void CopyCells(const TetrahedronCells& cells, vtkUnstructuredGrid* grid);

/**
 * Copies the numerical point arrays of the surface to the grid: as they are at the surface's
 * points, interpolated in triangles at points that were added there, and continued harmonically to
 * those that were added inside. Global and pedigree ids are left out. Returns the number of arrays
 * that have no such continuation, because the iteration did not converge or a value is not finite;
 * inside of the surface these are NaN, or 0 for integers.
 */
int ContinueArrays(vtkPolyData* data, const TriangleSurface& surface, const TetrahedronCells& cells,
  vtkUnstructuredGrid* grid);

} // namespace meniscus
