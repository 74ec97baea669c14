// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Filters_ImagePolyData_h
#define meniscus_Filters_ImagePolyData_h

#include "Refraction/ObjectImages.h"
#include "VirtualPolyData.h"

#include "vtkType.h"

#include <cstdint>
#include <functional>
#include <vector>

class vtkPolyData;

namespace meniscus
{

/// The cells of a polydata as plain arrays; cells that name points that do not exist are left out.
struct ObjectTopology
{
  struct Cells
  {
    std::vector<std::int64_t> offsets{ 0 };
    std::vector<std::int64_t> connectivity;
    std::vector<std::int64_t> ids; ///< cell of the input

    std::size_t GetCount() const { return this->ids.size(); }
    bool operator==(const Cells& o) const
    {
      return this->offsets == o.offsets && this->connectivity == o.connectivity &&
        this->ids == o.ids;
    }
    ObjectCells AsObject() const { return { this->offsets.data(), this->connectivity.data() }; }
  };
  Cells vertices; ///< one point each
  Cells lines;
  Cells polygons; ///< strips as triangles
  vtkIdType brokenCells = 0;

  bool operator==(const ObjectTopology& o) const
  {
    return this->vertices == o.vertices && this->lines == o.lines && this->polygons == o.polygons &&
      this->brokenCells == o.brokenCells;
  }
};

ObjectTopology ExtractTopology(vtkPolyData* input);

/// All images of an object.
struct AllImages
{
  ImageMesh lines;
  ImageMesh polygons;
  ImageMesh wholeLines;
  ImageMesh wholePolygons;
  vtkIdType cellsWithoutImage = 0;
};

/// Calls `body` for ranges of [0, count) in any order and from any thread; false if it was stopped.
using ProgressLoop = std::function<bool(std::size_t count, const RangeBody& body)>;

/// Maps the lines and polygons of `topology`, whose points `images` has solved. With `closesSeams`,
/// gaps between the images of neighbours become cells. False if `loop` was stopped.
bool MapCells(vtkPolyData* input, const ObjectTopology& topology, const ObjectImages& images,
  bool closesSeams, const ProgressLoop& loop, AllImages& result);

/// Fills `output` with every image and with the arrays of vtkRefractedGeometryFilter; arrays of
/// the input are interpolated at points that were made.
VirtualPolyDataReport BuildImagePolyData(vtkPolyData* input, const ObjectTopology& topology,
  const ObjectImages& images, const AllImages& cells, const Membrane& membrane,
  const OutputOptions& options, vtkPolyData* output);

}

#endif
