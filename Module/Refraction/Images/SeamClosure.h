// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Closes the gaps between neighbours along their common side, the seam. Each neighbour draws it as
 * a chain of straight parts between images of points of the side, but not always of the same
 * points: a neighbour that is whole draws one part, one that is divided draws its own halves, and
 * two mapped ones may put an end of the side into different sub-cells. Parts that both draw cancel
 * out. The others form closed loops, no wider than the tolerances of the two chains, which become
 * cells. Each part of a seam then belongs to two cells with the same ends bit by bit, so no pixel
 * between them stays open.
 *
 * A polygon that is seen nearly edge-on may lack a stretch from one of its sides to another, where
 * linear interpolation turns its rays to the wrong side of its plane. Its neighbours draw the sides
 * of the stretch. These parts of several seams, and the sides that the polygon's own pieces end
 * with, form a closed loop, too, which is filled if it is as thin.
 */
#pragma once

#include "Common/RangeLoop.h"
#include "Refraction/Images/CellImages.h"

#include <glm/vec3.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace meniscus
{

/** Side of polygons of the object, given by the indices of its ends, the lower one first. */
struct Seam
{
  std::int64_t Low;
  std::int64_t High;
  std::int32_t Cells; ///< number of cells that share it

  bool operator<(const Seam& other) const
  {
    return this->Low != other.Low ? this->Low < other.Low : this->High < other.High;
  }
};

/** Calls `visit(side)` for every side of every polygon for which `isWanted(cell)` returns true. */
template <typename IsWanted, typename Visit>
void VisitPolygonSides(
  const ObjectCells& cells, std::size_t count, const IsWanted& isWanted, const Visit& visit)
{
  for (std::size_t cell = 0; cell < count; ++cell)
  {
    if (!isWanted(cell))
    {
      continue;
    }
    const auto [ids, size] = cells.GetCell(cell);
    for (std::size_t k = 0; k < size; ++k)
    {
      const auto [low, high] = std::minmax(ids[k], ids[(k + 1) % size]);
      visit(Seam{ low, high, 0 });
    }
  }
}

/** Index of a side among sorted seams, or -1. */
inline std::ptrdiff_t FindSeam(const std::vector<Seam>& seams, const Seam& side)
{
  const auto at = std::lower_bound(seams.begin(), seams.end(), side);
  return at != seams.end() && !(side < *at) ? at - seams.begin() : -1;
}

/** Sides of mapped polygons in sequence, with the number of polygons that share each. */
std::vector<Seam> FindSeams(
  const ObjectCells& cells, std::size_t count, const unsigned char* isMapped);

/**
 * Calls `visit(low, high, place, point)` for each point of `pieces` on a seam that a polygon shares
 * which has not been mapped. `place` is the point's parameter from 0 at the end with the lower
 * index, whichever has the larger weight, so that all copies of a point get the same. Blocks of
 * points are visited on the threads of `loop`, each by a function from `makeVisit()`.
 */
template <typename MakeVisit>
void VisitPointsOnNeighbours(const std::vector<Seam>& seams, const ObjectCells& cells,
  std::size_t count, const unsigned char* isMapped, ImageMesh& pieces, const RangeLoop& loop,
  const MakeVisit& makeVisit)
{
  std::vector<char> isCommon(seams.size(), 0);
  VisitPolygonSides(
    cells, count, [isMapped](std::size_t cell) { return isMapped[cell] == 0; },
    [&seams, &isCommon](const Seam& side)
    {
      const std::ptrdiff_t at = FindSeam(seams, side);
      if (at >= 0)
      {
        isCommon[static_cast<std::size_t>(at)] = 1;
      }
    });
  // Tens of microseconds of work, if a few of the points are on such seams.
  constexpr std::size_t size = 2048;
  const std::size_t points = pieces.Points.size();
  loop((points + size - 1) / size,
    [&pieces, &seams, &isCommon, &makeVisit, points](std::size_t begin, std::size_t end)
    {
      const auto visit = makeVisit();
      for (std::size_t i = begin * size; i < std::min(end * size, points); ++i)
      {
        ImagePoint& point = pieces.Points[i];
        if (point.GetNumberOfSources() != 2)
        {
          continue;
        }
        const std::size_t low = point.Source[0] < point.Source[1] ? 0 : 1;
        const std::ptrdiff_t at = FindSeam(seams, { point.Source[low], point.Source[1 - low], 0 });
        if (at >= 0 && isCommon[static_cast<std::size_t>(at)])
        {
          visit(point.Source[low], point.Source[1 - low], point.Weight[1 - low], point);
        }
      }
    });
}

class SeamClosure
{
public:
  /**
   * `seams` must be sorted; they are borrowed. Set `hasDiagonals` if polygons have been split: all
   * sides between two points that are no seams are then diagonals, shared by two parts of one
   * polygon. `tolerance` is an angle in radians at `eye`, in world coordinates.
   */
  SeamClosure(
    const std::vector<Seam>& seams, bool hasDiagonals, const glm::dvec3& eye, double tolerance);

  /**
   * Records the cells of a mesh. `areWhole` is true for polygons that are drawn unchanged, false
   * for pieces of others.
   */
  void Collect(const ImageMesh& mesh, const std::vector<ImagePoint>& points, bool areWhole);

  /**
   * Adds the missing cells, in an order that does not depend on the threads of `loop`. `mesh` may
   * be one of the collected meshes.
   */
  void Close(ImageMesh& mesh, const RangeLoop& loop);

private:
  /**
   * A part of a seam as a cell draws it. Points are copied because closing a seam may reallocate
   * them.
   */
  struct Part
  {
    std::int64_t Low;
    std::int64_t High;
    ImagePoint From;
    ImagePoint To;
    std::int64_t Cell;
    signed char Orientation;
    bool IsWhole; ///< side of a polygon that is drawn unchanged
  };
  using Parts = std::vector<const Part*>;
  /** Results of a block of seams: cells, and parts that belong to no loop. */
  struct Closed
  {
    ImageMesh Mesh;
    Parts Open;
  };

  bool MayBeOnSeam(const ImagePoint& point) const;
  void AddPart(const ImageMesh& mesh, std::size_t cell, const ImagePoint& a, const ImagePoint& b,
    bool isWhole);
  void CloseSeam(Parts parts, Parts& open, ImageMesh& mesh) const;
  /** Closes the loops of one seam. Adds the parts that belong to no loop to `open`. */
  void CloseLoops(Parts parts, Parts& open, ImageMesh& mesh) const;
  /**
   * Sides in the interior of polygons with open seams that one piece only has; `open` are the open
   * parts of all seams.
   */
  std::vector<Part> FindFreeSides(const Parts& open, const ImageMesh& mesh) const;
  /** Fills thin loops of parts of several seams and of free sides. */
  void CloseAcrossSeams(const Parts& open, ImageMesh& mesh) const;
  void Fill(const std::vector<const ImagePoint*>& loop, const Part& first, ImageMesh& mesh) const;
  static void AddCell(
    const std::vector<const ImagePoint*>& loop, const Part& first, ImageMesh& mesh);
  bool IsThin(const std::vector<const ImagePoint*>& loop) const;

  const std::vector<Seam>& Seams;
  bool HasDiagonals;
  std::vector<char> HasSeam; ///< by point of the object
  glm::dvec3 Eye;
  double Tolerance;
  std::vector<Part> All;
};

}
