// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Filters/Object/ObjectTopology.h"
#include "Filters/Output/VirtualPolyData.h"
#include "Refraction/Images/CellImages.h"

#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkType.h"

#include <functional>
#include <vector>

namespace meniscus
{

/** All images of an object. */
struct AllImages
{
  ImageMesh Lines;
  ImageMesh Polygons;
  ImageMesh WholeLines;
  ImageMesh WholePolygons;
  vtkIdType CellsWithoutImage = 0;
  /** Triangles of the object whose images have errors above the tolerance: CellReport::Coarse. */
  vtkIdType CoarseTriangles = 0;
};

/**
 * Calls `body` for ranges of [0, count) in any order and from any thread; returns false if it was
 * aborted.
 */
using ProgressLoop = std::function<bool(std::size_t count, const RangeBody& body)>;

/**
 * Maps the lines and polygons of `topology`, whose points must have been solved in `images`. With
 * `closesSeams`, gaps between the images of neighbours are filled with cells. Returns false if
 * `loop` was aborted.
 */
bool MapCells(vtkPolyData* input, const ObjectTopology& topology, const CellImages& images,
  bool closesSeams, const ProgressLoop& loop, AllImages& result);

/**
 * Points, cells and additional arrays of an output, and where they come from: all that depends on
 * the images and the options, but not on arrays of the input.
 */
struct ImageAssembly
{
  bool IsReady = false; ///< set to false when images or cells change
  OutputOptions Options;
  std::vector<const VirtualVertex*> Points;
  std::vector<const ImagePoint*> Origins;
  std::vector<vtkIdType> PointSources;
  std::vector<vtkIdType> CellSources;
  vtkNew<vtkPolyData> Geometry;
  VirtualPolyDataReport Report;
};

/**
 * Fills `output` with all images and with the arrays of vtkRefractedGeometryFilter. Arrays of the
 * input are interpolated at new points. `assembly` is made unless it is ready for the same options;
 * it may be used as long as `images` and `cells` exist. Consumers must not see its objects if it is
 * kept, see KeptOutput::Reuse().
 */
VirtualPolyDataReport BuildImagePolyData(vtkPolyData* input, const ObjectTopology& topology,
  const CellImages& images, const AllImages& cells, const Membrane& membrane,
  const OutputOptions& options, ImageAssembly& assembly, vtkPolyData* output);

}
