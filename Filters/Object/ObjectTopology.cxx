// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Object/ObjectTopology.h"

#include "Filters/Common/CellLoop.h"

#include "vtkCellArray.h"
#include "vtkIdList.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <utility>

namespace meniscus
{
namespace
{

// Collects the cells of a polydata in the order vertices, lines, polygons, strips.
class TopologyReader
{
public:
  explicit TopologyReader(vtkPolyData* input)
    : Input(input)
  {
  }

  ObjectTopology Run()
  {
    this->Read(this->Input->GetVerts(),
      [this](vtkIdType count, const vtkIdType* ids)
      {
        for (vtkIdType i = 0; i < count; ++i)
        {
          this->Add(this->Topology.Vertices, { ids[i] });
        }
      });
    this->Read(this->Input->GetLines(),
      [this](vtkIdType count, const vtkIdType* ids) {
        this->Add(this->Topology.Lines, { ids, ids + count });
      });
    this->Read(this->Input->GetPolys(),
      [this](vtkIdType count, const vtkIdType* ids) {
        this->Add(this->Topology.Polygons, { ids, ids + count });
      });
    this->Read(this->Input->GetStrips(),
      [this](vtkIdType count, const vtkIdType* ids)
      {
        for (vtkIdType i = 0; i + 2 < count; ++i)
        {
          const vtkIdType odd = i % 2;
          this->Add(this->Topology.Polygons, { ids[i], ids[i + 1 + odd], ids[i + 2 - odd] });
        }
      });
    return std::move(this->Topology);
  }

private:
  template <typename Accept>
  void Read(vtkCellArray* cells, const Accept& accept)
  {
    const vtkIdType points = this->Input->GetNumberOfPoints();
    ForEachCell(cells,
      [&](vtkIdType count, const vtkIdType* ids)
      {
        const bool broken = count == 0 ||
          std::any_of(ids, ids + count, [points](vtkIdType id) { return id < 0 || id >= points; });
        this->Topology.BrokenCells += broken;
        if (!broken)
        {
          accept(count, ids);
        }
        ++this->Cell;
      });
  }

  void Add(ObjectTopology::Cells& cells, const std::vector<std::int64_t>& ids) const
  {
    cells.Connectivity.insert(cells.Connectivity.end(), ids.begin(), ids.end());
    cells.Offsets.push_back(static_cast<std::int64_t>(cells.Connectivity.size()));
    cells.Ids.push_back(this->Cell);
  }

  vtkPolyData* Input;
  vtkIdType Cell = 0; // counts vertices, lines, polygons, strips
  ObjectTopology Topology;
};

}

//------------------------------------------------------------------------------
ObjectTopology ExtractTopology(vtkPolyData* input)
{
  return TopologyReader(input).Run();
}

}
