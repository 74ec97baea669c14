// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Refraction/Images/ObjectImages.h"

#include "vtkType.h"

#include <cstdint>
#include <vector>

class vtkPolyData;

namespace meniscus
{

/**
 * Cells of a polydata as plain arrays. Cells that refer to points that do not exist are left out.
 */
struct ObjectTopology
{
  struct Cells
  {
    std::vector<std::int64_t> Offsets{ 0 };
    std::vector<std::int64_t> Connectivity;
    std::vector<std::int64_t> Ids; ///< cell of the input

    std::size_t GetCount() const { return this->Ids.size(); }
    bool operator==(const Cells& o) const
    {
      return this->Offsets == o.Offsets && this->Connectivity == o.Connectivity &&
        this->Ids == o.Ids;
    }
    ObjectCells AsObject() const { return { this->Offsets.data(), this->Connectivity.data() }; }
  };
  Cells Vertices; ///< one point each
  Cells Lines;
  Cells Polygons; ///< strips as triangles
  vtkIdType BrokenCells = 0;

  bool operator==(const ObjectTopology& o) const
  {
    return this->Vertices == o.Vertices && this->Lines == o.Lines && this->Polygons == o.Polygons &&
      this->BrokenCells == o.BrokenCells;
  }
};

ObjectTopology ExtractTopology(vtkPolyData* input);

}
