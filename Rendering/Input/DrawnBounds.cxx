// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rendering/Input/DrawnBounds.h"

#include "Common/BlockLoop.h"
#include "Filters/Common/ThreadedLoop.h"
#include "Rendering/Input/CellReader.h"
#include "Rendering/Input/GridLayout.h"
#include "Rendering/Input/InputContent.h"
#include "Rendering/Input/PointsSource.h"

#include "vtkCellType.h"
#include "vtkDataSet.h"
#include "vtkIdList.h"
#include "vtkNew.h"

#include <cstddef>
#include <cstdint>

namespace meniscus
{
namespace
{

/** Adds the points of cells to a box. */
class CellBox
{
public:
  CellBox(const CellReader& cells, const PointsView& points)
    : Cells(cells)
    , Points(points)
  {
  }

  void Add(vtkIdType cell)
  {
    const int type = this->Cells.GetType(cell);
    if (!HasVolume(type) || this->Cells.IsLeftOut(cell))
    {
      return;
    }
    PointBox ofCell;
    bool isFinite = true;
    const auto add = [this, &ofCell, &isFinite](std::int64_t point)
    {
      const glm::dvec3 at = this->Points[static_cast<std::size_t>(point)];
      isFinite = isFinite && IsFinite(at);
      ofCell.Add(at);
    };
    if (type == VTK_POLYHEDRON ? !this->AddFaces(cell, add) : !this->AddPoints(cell, add))
    {
      return;
    }
    if (isFinite)
    {
      this->Box.Add(ofCell);
    }
  }

  const PointBox& GetBox() const { return this->Box; }

private:
  template <typename Body>
  bool AddPoints(vtkIdType cell, Body&& add)
  {
    if (!this->Cells.ReadPoints(cell, this->Ids, this->Unusable))
    {
      return false;
    }
    for (vtkIdType i = 0; i < this->Ids->GetNumberOfIds(); ++i)
    {
      add(this->Ids->GetId(i));
    }
    return true;
  }

  template <typename Body>
  bool AddFaces(vtkIdType cell, Body&& add)
  {
    std::size_t numberOfFaces = 0;
    if (!this->Cells.ReadFaces(cell, this->Faces, numberOfFaces, this->Unusable))
    {
      return false;
    }
    const std::int64_t* face = this->Faces.data();
    for (std::size_t f = 0; f < numberOfFaces; ++f, face += 1 + face[0])
    {
      for (std::int64_t k = 1; k <= face[0]; ++k)
      {
        add(face[k]);
      }
    }
    return true;
  }

  const CellReader& Cells;
  const PointsView& Points;
  PointBox Box;
  UnusableCells Unusable;
  vtkNew<vtkIdList> Ids;
  std::vector<std::int64_t> Faces;
};

/**
 * Box around the points that are listed, each added once. Returns false if one of them does not
 * exist or is not finite.
 */
bool AddListed(const IdView& ids, const PointsSource& points, PointBox& box)
{
  std::vector<std::uint8_t> isUsed(static_cast<std::size_t>(points.GetNumberOfPoints()), 0);
  for (std::int64_t i = 0; i < ids.GetSize(); ++i)
  {
    const std::int64_t id = ids[i];
    if (id < 0 || id >= points.GetNumberOfPoints())
    {
      return false;
    }
    isUsed[static_cast<std::size_t>(id)] = 1;
  }
  bool isFinite = true;
  for (std::size_t p = 0; p < isUsed.size(); ++p)
  {
    if (isUsed[p])
    {
      const glm::dvec3 at = points.GetView()[p];
      isFinite = isFinite && IsFinite(at);
      box.Add(at);
    }
  }
  return isFinite;
}

PointBox BoxOf(vtkDataSet* grid)
{
  PointBox box;
  const vtkIdType size = grid->GetNumberOfCells();
  if (size == 0)
  {
    return box;
  }
  // Objects that VTK creates on first access must exist before several threads access them.
  const bool isVolume = HasVolume(grid->GetCellType(0));
  const CellReader cells(grid);
  if (HasOneType(grid) && !cells.GetGhosts())
  {
    double bounds[6];
    grid->GetBounds(bounds);
    if (isVolume)
    {
      box.Add(glm::dvec3(bounds[0], bounds[2], bounds[4]));
      box.Add(glm::dvec3(bounds[1], bounds[3], bounds[5]));
    }
    return box;
  }
  const PointsSource points({ grid }, ThreadedLoop);
  PointBox ofTetrahedra;
  if (!cells.GetGhosts() && cells.HasOnlyTetrahedra() &&
    AddListed(cells.GetIds(), points, ofTetrahedra))
  {
    return ofTetrahedra;
  }
  std::vector<PointBox> boxes(NumberOfBlocks(static_cast<std::size_t>(size)));
  ForEachBlock(static_cast<std::size_t>(size),
    IsThreadSafe(grid) ? RangeLoop(ThreadedLoop) : RangeLoop(SerialLoop),
    [&](std::size_t block, std::size_t first, std::size_t last)
    {
      CellBox ofBlock(cells, points.GetView());
      for (std::size_t c = first; c < last; ++c)
      {
        ofBlock.Add(static_cast<vtkIdType>(c));
      }
      boxes[block] = ofBlock.GetBox();
    });
  return Enclose(boxes);
}

}

//------------------------------------------------------------------------------
const PointBox& DrawnBounds::Update(const InputBlocks& input)
{
  std::vector<ObjectVersion> versions = CellVersions(input);
  for (const ObjectVersion& version : PointVersions(input))
  {
    versions.push_back(version);
  }
  if (versions == this->Versions)
  {
    return this->Box;
  }
  this->Versions = std::move(versions);
  std::vector<PointBox> boxes;
  for (const InputPart& part : input.Parts)
  {
    boxes.push_back(BoxOf(part.Grid));
  }
  this->Box = Enclose(boxes);
  return this->Box;
}

}
