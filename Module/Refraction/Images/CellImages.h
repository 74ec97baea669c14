// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Common/RangeLoop.h"
#include "Refraction/Images/ImageMesh.h"
#include "Refraction/Images/ObjectPrimitive.h"

#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace meniscus
{

/**
 * Cells of one kind, borrowed. Cell i has the points connectivity[offsets[i]] to
 * connectivity[offsets[i + 1] - 1]; all of them must exist.
 */
struct ObjectCells
{
  const std::int64_t* Offsets = nullptr;
  const std::int64_t* Connectivity = nullptr;

  struct Cell
  {
    const std::int64_t* Ids;
    std::size_t Count;
  };
  Cell GetCell(std::size_t i) const
  {
    return { this->Connectivity + this->Offsets[i],
      static_cast<std::size_t>(this->Offsets[i + 1] - this->Offsets[i]) };
  }
};

/** Number of cells by their treatment. */
struct CellReport
{
  std::size_t Whole = 0;   ///< passed through with their points
  std::size_t Divided = 0; ///< have one image, which is curved: divided into several cells
  std::size_t Mapped = 0;  ///< mapped from the membrane, to any number of pieces
  std::size_t Without = 0; ///< have no image
  std::size_t Coarse = 0;  ///< triangles of divided cells that have errors above the tolerance

  void Count(bool isDivided, bool hasPieces)
  {
    ++(isDivided ? this->Divided : (hasPieces ? this->Mapped : this->Without));
  }
};

class ParallelPlanes;
class PlaneSights;

/**
 * Images of the points and cells of an object, behind one interface or several. Holds the images of
 * the points; derived classes solve them and map the cells.
 */
class CellImages
{
public:
  /**
   * Splits the polygon with these points into triangles; writes three indices into the polygon for
   * each.
   */
  using Triangulate = std::function<void(
    const std::int64_t* ids, std::size_t count, std::vector<std::int64_t>& triangles)>;

  /** Number of points that are solved together. */
  static constexpr std::size_t Chunk = 128;

  virtual ~CellImages() = default;

  /** Sets the tolerance of the cells, an angle in radians at the eye, before they are mapped. */
  virtual void SetTolerance(double tolerance) = 0;

  /**
   * Selects the chunks of points that are wanted from now on; an empty list selects all of them.
   * Solved points are kept for later requests, unless all points were wanted.
   */
  void SetWanted(const std::vector<bool>& chunks) { this->Wanted = chunks; }
  const std::vector<bool>& GetWanted() const { return this->Wanted; }
  bool IsWanted(std::size_t point) const
  {
    return this->Wanted.empty() || this->Wanted[point / Chunk];
  }

  /**
   * Solves the wanted and unsolved points in [begin, end), which must consist of whole chunks.
   * Different ranges may run at once.
   */
  virtual void SolvePoints(std::size_t begin, std::size_t end) = 0;

  /** Collects the results of SolvePoints. Cells of wanted points can be mapped afterwards. */
  virtual void FinishPoints() = 0;

  /** State of a point; NotAsked if it has never been wanted. */
  ImageState GetState(std::size_t point) const { return this->States[point]; }
  /** Images of all points; images of the same point follow each other. */
  const std::vector<ImagePoint>& GetPointImages() const { return this->Images; }
  std::size_t GetNumberOfImages(std::size_t point) const
  {
    return this->First[point + 1] - this->First[point];
  }

  /**
   * Adds the images of the cells [begin, end), whose ids are in `names`. Cells that keep their
   * points go to `whole`, which has no points of its own but refers to GetPointImages();
   * others go to `pieces`. `isMapped[i]` becomes 1 if polygon i has been mapped from the membrane,
   * otherwise 0.
   */
  virtual CellReport MapLines(const ObjectCells& cells, const std::int64_t* names,
    std::size_t begin, std::size_t end, ImageMesh& pieces, ImageMesh& whole) const = 0;
  virtual CellReport MapPolygons(const ObjectCells& cells, const std::int64_t* names,
    std::size_t begin, std::size_t end, const Triangulate& triangulate, ImageMesh& pieces,
    ImageMesh& whole, unsigned char* isMapped) const = 0;

  /**
   * Call this after all polygons have been mapped to `pieces` and `whole`. Moves the ends of
   * polygons that have been mapped from the membrane (`isMapped`) onto the common sides as their
   * neighbours draw them: as straight pieces, which may be off by the tolerance. With
   * `closesSeams`, also closes the seams between them. The result does not depend on the threads
   * of `loop`, whose ranges are of blocks of work.
   */
  void MeetNeighbours(const ObjectCells& cells, std::size_t count, const unsigned char* isMapped,
    bool closesSeams, const ImageMesh& whole, ImageMesh& pieces, const RangeLoop& loop) const;

protected:
  /** Moves a point to the place between `low` and `high`, if neighbours draw it on that side. */
  using MoveOntoSide =
    std::function<void(std::int64_t low, std::int64_t high, double place, ImagePoint& point)>;
  /** Makes a function for one thread. */
  virtual MoveOntoSide MakeMove() const = 0;
  /** Place of the eye in world coordinates. */
  virtual glm::dvec3 GetEye() const = 0;

  /** Takes over an object's points (x, y, z each; borrowed), none of them solved. */
  void ResetPoints(const double* points, std::size_t count);
  glm::dvec3 GetPoint(std::int64_t id) const
  {
    const double* p = this->Points + 3 * id;
    return { p[0], p[1], p[2] };
  }
  /** First image of a point that has any. */
  const ImagePoint& GetFirstImage(std::int64_t id) const
  {
    return this->Images[this->First[static_cast<std::size_t>(id)]];
  }
  /** True if the coordinates of all points of a cell are in range; other cells have no image. */
  bool AreInRange(const std::int64_t* ids, std::size_t count) const
  {
    return std::none_of(ids, ids + count,
      [this](std::int64_t id)
      { return this->GetState(static_cast<std::size_t>(id)) == ImageState::NotFinite; });
  }
  /** Adds a cell whose points have one image each. */
  void AddWhole(
    const std::int64_t* ids, std::size_t count, std::int64_t cell, ImageMesh& whole) const;
  MappedTriangle MakeTriangle(const std::array<std::int64_t, 3>& ids) const;
  /**
   * Finds the cells in [begin, end) behind parallel planes, on one leg, whose points have one image
   * each, and that are drawn within half of the tolerance of their sight rays at the middles of
   * their sides and at their own.
   */
  std::vector<bool> FindWholeBehind(const ParallelPlanes& planes, const ObjectCells& cells,
    std::size_t begin, std::size_t end) const;

  double Tolerance = 0.0;   ///< angle in radians at the eye
  std::vector<bool> Wanted; ///< by chunk; empty: all are wanted
  const double* Points = nullptr;
  std::vector<std::uint32_t> Counts;
  std::vector<ImageState> States;
  std::vector<std::size_t> First; ///< by point, and one more: index of its first image
  std::vector<ImagePoint> Images;

private:
  std::size_t CountPlanesBefore(
    const ParallelPlanes& planes, const std::int64_t* ids, std::size_t count) const;
  void AddPlaces(const std::int64_t* ids, std::size_t count, std::size_t number,
    std::size_t planesBefore, const glm::dvec3& eye, PlaneSights& sights) const;
};

}
