// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rendering/Input/DrawnBounds.h"

#include "Common/BlockLoop.h"
#include "Filters/Common/ThreadedLoop.h"
#include "Rendering/Input/CellReader.h"
#include "Rendering/Input/GridLayout.h"
#include "Rendering/Input/PointsSource.h"

#include "vtkCellType.h"
#include "vtkDataSet.h"
#include "vtkIdList.h"
#include "vtkNew.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

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

/** Marks of a point: bits 0 to 5 are set if it is the point that Extremes found for a side. */
constexpr std::uint8_t AllSides = (1 << 6) - 1;
constexpr std::uint8_t NotFinite = 1 << 6;
constexpr std::uint8_t OutOfRange = 1 << 7;

/** Box around finite points, and a point in each of its sides: lower and upper, by axis. */
struct Extremes
{
  PointBox Box;
  std::array<std::size_t, 6> Points{};

  void Add(const glm::dvec3& at, std::size_t point)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      if (at[axis] < this->Box.Lower[axis])
      {
        this->Box.Lower[axis] = at[axis];
        this->Points[2 * axis] = point;
      }
      if (at[axis] > this->Box.Upper[axis])
      {
        this->Box.Upper[axis] = at[axis];
        this->Points[2 * axis + 1] = point;
      }
    }
  }
};

/** Marks all points and returns the box around the finite ones. */
PointBox MarkPoints(const PointsView& points, std::vector<std::uint8_t>& marks)
{
  std::vector<Extremes> blocks(NumberOfBlocks(marks.size()));
  ForEachBlock(marks.size(), ThreadedLoop,
    [&](std::size_t block, std::size_t first, std::size_t last)
    {
      Extremes found;
      for (std::size_t p = first; p < last; ++p)
      {
        const glm::dvec3 at = points[p];
        if (IsFinite(at))
        {
          found.Add(at, p);
        }
        else
        {
          marks[p] = NotFinite;
        }
      }
      blocks[block] = found;
    });
  Extremes all;
  for (const Extremes& block : blocks)
  {
    for (const std::size_t point : block.Points)
    {
      if (!block.Box.IsEmpty())
      {
        all.Add(points[point], point);
      }
    }
  }
  for (std::size_t side = 0; side < all.Points.size() && !all.Box.IsEmpty(); ++side)
  {
    marks[all.Points[side]] |= static_cast<std::uint8_t>(1 << side);
  }
  return all.Box;
}

/** Marks of all listed points together. */
template <typename Id>
std::uint8_t JoinMarks(const Id* ids, std::size_t count, const std::vector<std::uint8_t>& marks)
{
  std::vector<std::uint8_t> parts(NumberOfBlocks(count));
  ForEachBlock(count, ThreadedLoop,
    [&](std::size_t block, std::size_t first, std::size_t last)
    {
      std::uint8_t part = 0;
      for (std::size_t i = first; i < last; ++i)
      {
        const auto id = static_cast<std::size_t>(ids[i]);
        part |= id < marks.size() ? marks[id] : OutOfRange; // negative numbers are large here
      }
      parts[block] = part;
    });
  return std::accumulate(
    parts.begin(), parts.end(), std::uint8_t{ 0 }, [](int a, int b) { return a | b; });
}

/** Box around points that are listed, each as often as it is. */
PointBox BoxOfListed(const IdView& ids, const PointsView& points)
{
  const auto count = static_cast<std::size_t>(ids.GetSize());
  std::vector<PointBox> boxes(NumberOfBlocks(count));
  ForEachBlock(count, ThreadedLoop,
    [&](std::size_t block, std::size_t first, std::size_t last)
    {
      PointBox box;
      for (std::size_t i = first; i < last; ++i)
      {
        box.Add(points[static_cast<std::size_t>(ids[static_cast<std::int64_t>(i)])]);
      }
      boxes[block] = box;
    });
  return Enclose(boxes);
}

/**
 * Box around the points that are listed. Returns false if one of them does not exist or is not
 * finite. Mostly the points at the sides of the box around all points are listed: finding that
 * takes a third of the time of a box around each cell.
 */
bool EncloseListed(const IdView& ids, const PointsSource& points, PointBox& box)
{
  std::vector<std::uint8_t> marks(static_cast<std::size_t>(points.GetNumberOfPoints()), 0);
  box = MarkPoints(points.GetView(), marks);
  const auto size = static_cast<std::size_t>(ids.GetSize());
  const std::uint8_t found =
    ids.GetInts() ? JoinMarks(ids.GetInts(), size, marks) : JoinMarks(ids.GetLongs(), size, marks);
  if (found & (NotFinite | OutOfRange))
  {
    return false;
  }
  if (found != AllSides)
  {
    box = BoxOfListed(ids, points.GetView());
  }
  return true;
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
    EncloseListed(cells.GetIds(), points, ofTetrahedra))
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
const PointBox& DrawnBounds::Update(const InputBlocks& input, InputDigests& digests)
{
  const bool newCells =
    this->CellWatch.HasChanged(CellVersions(input), [&]() { return digests.OfCells(input); });
  const bool newPoints =
    this->PointWatch.HasChanged(PointVersions(input), [&]() { return digests.OfPoints(input); });
  if (!newCells && !newPoints)
  {
    return this->Box;
  }
  std::vector<PointBox> boxes;
  for (const InputPart& part : input.Parts)
  {
    boxes.push_back(BoxOf(part.Grid));
  }
  this->Box = Enclose(boxes);
  ++this->Builds;
  return this->Box;
}

}
