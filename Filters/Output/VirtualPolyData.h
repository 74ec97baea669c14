// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Filters/Output/OutputArrays.h"
#include "Refraction/Membrane/Membrane.h"
#include "Refraction/Sight/VirtualVertex.h"

#include "vtkType.h"

#include <vector>

class vtkPolyData;

namespace meniscus
{

struct ViewSelection;

/** Parts of the input that are missing in the output. */
struct VirtualPolyDataReport
{
  vtkIdType SkippedCells = 0;    ///< cells that need a point without an image
  vtkIdType BrokenCells = 0;     ///< cells that refer to a point that does not exist
  vtkIdType CoarseTriangles = 0; ///< triangles whose images have errors above the tolerance
  int ArraysOfWrongSize = 0;     ///< attribute arrays of the wrong size, which are not passed on
};

/**
 * Fills `output` with the cells of `input` at the virtual points, and with the arrays of
 * vtkRefractedGeometryFilter. `vertices` has one entry per point of `input`; the points in
 * `selection` have been solved with `membrane`.
 */
VirtualPolyDataReport BuildVirtualPolyData(vtkPolyData* input,
  const std::vector<VirtualVertex>& vertices, const ViewSelection& selection,
  const Membrane& membrane, const OutputOptions& options, vtkPolyData* output);

}
