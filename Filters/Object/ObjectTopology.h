// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Filters_Object_ObjectTopology_h
#define meniscus_Filters_Object_ObjectTopology_h

#include "Refraction/Images/ObjectImages.h"

#include "vtkType.h"

#include <cstdint>
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

}

#endif
