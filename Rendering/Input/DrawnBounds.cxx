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

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <numeric>
#include <sstream>
#include <vector>

namespace meniscus
{
namespace
{

/** True if four of the points of a list differ: a cell of fewer has no volume. */
bool HasFourPoints(const std::vector<std::int64_t>& points)
{
  std::array<std::int64_t, 4> found{};
  std::size_t different = 0;
  for (std::size_t i = 0; i < points.size() && different < found.size(); ++i)
  {
    const auto end = found.begin() + static_cast<std::ptrdiff_t>(different);
    if (std::find(found.begin(), end, points[i]) == end)
    {
      found[different++] = points[i];
    }
  }
  return different == found.size();
}

/**
 * True if points lie in a plane within the rounding errors of their coordinates: a cell of them has
 * no volume. The determinant of four points, at most a distance L apart, changes by L^2 at most for
 * each point and unit of length that the point is displaced. Coordinates up to C are off by 2^-53
 * C, so points by sqrt(3) times that, and four by less than 7. The determinant itself is rounded by
 * less than 10 2^-53 L^3: GradedCell.h.
 */
template <typename PlaceOf>
bool IsFlat(std::size_t count, const PlaceOf& placeOf)
{
  const glm::dvec3 first = placeOf(0);
  double largest = 0.0;
  glm::dvec3 edge(0.0);
  for (std::size_t i = 0; i < count; ++i)
  {
    const glm::dvec3 size = glm::abs(placeOf(i));
    const glm::dvec3 other = placeOf(i) - first;
    largest = std::max({ largest, size.x, size.y, size.z });
    edge = glm::dot(other, other) > glm::dot(edge, edge) ? other : edge;
  }
  glm::dvec3 normal(0.0);
  for (std::size_t i = 0; i < count; ++i)
  {
    const glm::dvec3 other = glm::cross(edge, placeOf(i) - first);
    normal = glm::dot(other, other) > glm::dot(normal, normal) ? other : normal;
  }
  double height = 0.0;
  for (std::size_t i = 0; i < count; ++i)
  {
    height = std::max(height, std::abs(glm::dot(normal, placeOf(i) - first)));
  }
  constexpr double rounding = 0.5 * std::numeric_limits<double>::epsilon();
  const double most = 2.0 * glm::length(edge); // the first point may be in the middle
  return height <= rounding * most * most * (7.0 * largest + 10.0 * most);
}

/**
 * Widens a box to that with one cell more, unless the cell is flat. Few cells widen a box, so that
 * few are tested.
 */
template <typename Test>
void WidenUnless(PointBox& box, const PointBox& wider, const Test& isFlat)
{
  if ((wider.Lower != box.Lower || wider.Upper != box.Upper) && !isFlat())
  {
    box = wider;
  }
}

/** Reader of the cells of a data set that are drawn. */
class DrawnCells
{
public:
  /** @param points of the data set. Both arguments must outlive this object. */
  DrawnCells(const CellReader& cells, const PointsView& points)
    : Cells(cells)
    , Points(points)
  {
  }

  /** Reads the points of a cell. Returns false if it is not drawn, unless it is flat. */
  bool Read(vtkIdType cell)
  {
    const int type = this->Cells.GetType(cell);
    this->OfCell.clear();
    return HasVolume(type) && !this->Cells.IsLeftOut(cell) &&
      (type == VTK_POLYHEDRON ? this->ReadFaces(cell) : this->ReadPoints(cell)) &&
      HasFourPoints(this->OfCell) &&
      std::all_of(this->OfCell.begin(), this->OfCell.end(),
        [this](std::int64_t point) { return IsFinite(this->PlaceOf(point)); });
  }
  /** True if the cell has no volume, and is not drawn. */
  bool IsFlatCell() const
  {
    return IsFlat(
      this->OfCell.size(), [this](std::size_t i) { return this->PlaceOf(this->OfCell[i]); });
  }
  /** Points of the cell; those of faces more than once. */
  const std::vector<std::int64_t>& GetPoints() const { return this->OfCell; }
  glm::dvec3 PlaceOf(std::int64_t point) const
  {
    return this->Points[static_cast<std::size_t>(point)];
  }

private:
  bool ReadPoints(vtkIdType cell)
  {
    if (!this->Cells.ReadPoints(cell, this->Ids, this->Unusable))
    {
      return false;
    }
    for (vtkIdType i = 0; i < this->Ids->GetNumberOfIds(); ++i)
    {
      this->OfCell.push_back(this->Ids->GetId(i));
    }
    return true;
  }

  bool ReadFaces(vtkIdType cell)
  {
    std::size_t numberOfFaces = 0;
    if (!this->Cells.ReadFaces(cell, this->Faces, numberOfFaces, this->Unusable))
    {
      return false;
    }
    const std::int64_t* face = this->Faces.data();
    for (std::size_t f = 0; f < numberOfFaces; ++f, face += 1 + face[0])
    {
      this->OfCell.insert(this->OfCell.end(), face + 1, face + 1 + face[0]);
    }
    return true;
  }

  const CellReader& Cells;
  const PointsView& Points;
  std::vector<std::int64_t> OfCell;
  UnusableCells Unusable;
  vtkNew<vtkIdList> Ids;
  std::vector<std::int64_t> Faces;
};

RangeLoop LoopFor(vtkDataSet* grid)
{
  return IsThreadSafe(grid) ? RangeLoop(ThreadedLoop) : RangeLoop(SerialLoop);
}

/** Marks of a point: bits 0 to 5 are set if it is the point that Extremes found for a side. */
constexpr std::uint8_t AllSides = (1 << 6) - 1;
constexpr std::uint8_t NotFinite = 1 << 6;
/** A point that does not exist, or that a tetrahedron has twice. */
constexpr std::uint8_t NotUsable = 1 << 7;

/** Box around finite points, and a point in each of its sides: lower and upper, by axis. */
struct Extremes
{
  PointBox Box;
  bool AreFinite = true;
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

/** Marks all points and returns the extremes of the finite ones. */
Extremes MarkPoints(const PointsView& points, std::vector<std::uint8_t>& marks)
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
          found.AreFinite = false;
        }
      }
      blocks[block] = found;
    });
  Extremes all;
  for (const Extremes& block : blocks)
  {
    all.AreFinite = all.AreFinite && block.AreFinite;
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
  return all;
}

/** True if the points of a tetrahedron lie in a plane. */
template <typename Id>
bool IsFlatTetrahedron(const Id* ids, const PointsView& points)
{
  return IsFlat(4, [&](std::size_t i) { return points[static_cast<std::size_t>(ids[i])]; });
}

/**
 * Marks of the points of a block of tetrahedra together, without those of sides for flat ones, and
 * NotUsable for a tetrahedron of fewer points.
 */
template <typename Id>
std::uint8_t JoinMarks(const Id* ids, std::size_t tetrahedra, const PointsView& points,
  const std::vector<std::uint8_t>& marks)
{
  std::uint8_t joined = 0;
  for (std::size_t t = 0; t < tetrahedra; ++t)
  {
    const Id* at = ids + 4 * t;
    std::uint8_t own = 0;
    for (std::size_t i = 0; i < 4; ++i)
    {
      const auto id = static_cast<std::size_t>(at[i]);
      own |= id < marks.size() ? marks[id] : NotUsable; // negative numbers are large here
    }
    const bool isRepeated = (at[0] == at[1]) | (at[0] == at[2]) | (at[0] == at[3]) |
      (at[1] == at[2]) | (at[1] == at[3]) | (at[2] == at[3]);
    own |= isRepeated ? NotUsable : 0;
    const bool isAtSide = (own & AllSides) != 0 && (own & NotUsable) == 0;
    joined |= isAtSide && IsFlatTetrahedron(at, points) ? own & ~AllSides : own;
  }
  return joined;
}

/** JoinMarks() of each of several blocks of tetrahedra. */
std::vector<std::uint8_t> JoinBlocks(const std::vector<std::size_t>& blocks, const IdView& ids,
  const PointsView& points, const std::vector<std::uint8_t>& marks)
{
  const auto tetrahedra = static_cast<std::size_t>(ids.GetSize()) / 4;
  std::vector<std::uint8_t> joined(blocks.size());
  ForEachItem(blocks.size(), ThreadedLoop,
    [&](std::size_t i)
    {
      const std::size_t first = blocks[i] * BlockSize;
      const std::size_t count = std::min(BlockSize, tetrahedra - first);
      joined[i] = ids.GetInts() ? JoinMarks(ids.GetInts() + 4 * first, count, points, marks)
                                : JoinMarks(ids.GetLongs() + 4 * first, count, points, marks);
    });
  return joined;
}

/** All of the marks together. */
std::uint8_t Join(const std::vector<std::uint8_t>& marks)
{
  return std::accumulate(
    marks.begin(), marks.end(), std::uint8_t{ 0 }, [](int a, int b) { return a | b; });
}

/** Box around the points of tetrahedra that are not flat. */
PointBox BoxOfListed(const IdView& ids, const PointsView& points)
{
  const auto count = static_cast<std::size_t>(ids.GetSize()) / 4;
  std::vector<PointBox> boxes(NumberOfBlocks(count));
  ForEachBlock(count, ThreadedLoop,
    [&](std::size_t block, std::size_t first, std::size_t last)
    {
      PointBox box;
      for (std::size_t t = first; t < last; ++t)
      {
        std::array<std::int64_t, 4> own;
        PointBox wider = box;
        for (std::size_t i = 0; i < own.size(); ++i)
        {
          own[i] = ids[static_cast<std::int64_t>(4 * t + i)];
          wider.Add(points[static_cast<std::size_t>(own[i])]);
        }
        WidenUnless(box, wider, [&]() { return IsFlatTetrahedron(own.data(), points); });
      }
      boxes[block] = box;
    });
  return Enclose(boxes);
}

/**
 * Box around the points of tetrahedra that are not flat. Returns false if one of them does not
 * exist, is not finite, or is there twice in one tetrahedron. Mostly the points at the sides of the
 * box around all points are listed: finding that takes a third of the time of a box around each
 * cell, and less after a motion, since cells at a side mostly stay there.
 * @param sides  of the same cells; set if the box is found.
 */
bool EncloseListed(
  const IdView& ids, const PointsSource& points, DrawnBounds::SideCells& sides, PointBox& box)
{
  std::vector<std::uint8_t> marks(static_cast<std::size_t>(points.GetNumberOfPoints()), 0);
  const Extremes extremes = MarkPoints(points.GetView(), marks);
  box = extremes.Box;
  const auto join = [&](const std::vector<std::size_t>& blocks)
  { return JoinBlocks(blocks, ids, points.GetView(), marks); };
  if (extremes.AreFinite && sides.Points == marks.size() && Join(join(sides.Blocks)) == AllSides)
  {
    return true;
  }
  sides = DrawnBounds::SideCells();
  std::vector<std::size_t> blocks(NumberOfBlocks(static_cast<std::size_t>(ids.GetSize()) / 4));
  std::iota(blocks.begin(), blocks.end(), std::size_t{ 0 });
  const std::vector<std::uint8_t> joined = join(blocks);
  const std::uint8_t found = Join(joined);
  if (found & (NotFinite | NotUsable))
  {
    return false;
  }
  if (found != AllSides)
  {
    box = BoxOfListed(ids, points.GetView());
  }
  sides.Points = marks.size();
  std::uint8_t known = 0;
  for (const std::size_t block : blocks)
  {
    if (joined[block] & ~known)
    {
      sides.Blocks.push_back(block);
      known |= joined[block];
    }
  }
  return true;
}

/**
 * @param withFlat  whether flat cells count as drawn.
 * @param sides     of the same cells.
 */
PointBox BoxOf(vtkDataSet* grid, bool withFlat, DrawnBounds::SideCells& sides)
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
  // Flags of points hide cells of structured data.
  if (HasOneType(grid) && !cells.GetGhosts() && !grid->GetPointGhostArray())
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
  if (!withFlat && !cells.GetGhosts() && (sides.Points > 0 || cells.HasOnlyTetrahedra()) &&
    EncloseListed(cells.GetIds(), points, sides, ofTetrahedra))
  {
    return ofTetrahedra;
  }
  std::vector<PointBox> boxes(NumberOfBlocks(static_cast<std::size_t>(size)));
  ForEachBlock(static_cast<std::size_t>(size), LoopFor(grid),
    [&](std::size_t block, std::size_t first, std::size_t last)
    {
      DrawnCells drawn(cells, points.GetView());
      for (std::size_t c = first; c < last; ++c)
      {
        if (!drawn.Read(static_cast<vtkIdType>(c)))
        {
          continue;
        }
        PointBox wider = boxes[block];
        for (const std::int64_t point : drawn.GetPoints())
        {
          wider.Add(drawn.PlaceOf(point));
        }
        WidenUnless(boxes[block], wider, [&]() { return !withFlat && drawn.IsFlatCell(); });
      }
    });
  return Enclose(boxes);
}

PointBox BoxOfParts(
  const InputBlocks& input, bool withFlat, std::vector<DrawnBounds::SideCells>& sides)
{
  std::vector<PointBox> boxes;
  for (std::size_t i = 0; i < input.Parts.size(); ++i)
  {
    boxes.push_back(BoxOf(input.Parts[i].Grid, withFlat, sides[i]));
  }
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
  if (newCells || this->Sides.size() != input.Parts.size())
  {
    this->Sides.assign(input.Parts.size(), SideCells());
  }
  const PointBox box = BoxOfParts(input, false, this->Sides);
  this->Box = box.IsEmpty() ? BoxOfParts(input, true, this->Sides) : box;
  ++this->Builds;
  return this->Box;
}

//------------------------------------------------------------------------------
std::string DescribeSmallBox(const PointBox& box)
{
  // vtkCamera keeps 1e-20 between eye and focal point, and vtkRenderer::ResetCameraClippingRange()
  // a gap of 0.176 of that in front of the near plane. vtkRenderer::ResetCamera() puts the farthest
  // point of a box at (1 + 1 / sin 15 degrees) = 4.86 times its radius.
  constexpr double leastRadius = 0.176 * 1e-20 / 4.86;
  const glm::dvec3 half = box.GetHalfSize();
  // std::hypot() does not square the numbers to 0.
  const double radius = std::hypot(half.x, half.y, half.z);
  if (radius == 0.0 || radius >= leastRadius)
  {
    return std::string();
  }
  std::ostringstream text;
  text << "The mesh has a radius of " << radius << ". VTK's cameras see nothing below "
       << leastRadius << ": scale the mesh by a filter, or its volume by SetScale().";
  return text.str();
}

//------------------------------------------------------------------------------
std::vector<std::uint8_t> MarkDrawnPoints(const std::vector<vtkDataSet*>& grids)
{
  std::vector<std::uint8_t> all;
  for (vtkDataSet* grid : grids)
  {
    const auto size = static_cast<std::size_t>(grid->GetNumberOfPoints());
    const std::unique_ptr<std::atomic<std::uint8_t>[]> marks(new std::atomic<std::uint8_t>[size]());
    const PointsSource points({ grid }, ThreadedLoop);
    if (grid->GetNumberOfCells() > 0)
    {
      // Objects that VTK creates on first access must exist before several threads access them.
      grid->GetCellType(0);
    }
    const CellReader cells(grid);
    ForEachBlock(static_cast<std::size_t>(grid->GetNumberOfCells()), LoopFor(grid),
      [&](std::size_t, std::size_t first, std::size_t last)
      {
        DrawnCells drawn(cells, points.GetView());
        for (std::size_t c = first; c < last; ++c)
        {
          if (!drawn.Read(static_cast<vtkIdType>(c)) || drawn.IsFlatCell())
          {
            continue;
          }
          for (const std::int64_t point : drawn.GetPoints())
          {
            marks[static_cast<std::size_t>(point)].store(1, std::memory_order_relaxed);
          }
        }
      });
    for (std::size_t p = 0; p < size; ++p)
    {
      all.push_back(marks[p].load(std::memory_order_relaxed));
    }
  }
  return all;
}

}
