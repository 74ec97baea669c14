// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Every image of an object: of its points, and of its lines and polygons. A cell is simple, and
 * keeps its points, if each of them has one image and if the virtual cell is where the images of
 * the middles of its sides are, within a tolerance. A cell that is bent, but where no point can
 * have several images, is divided. All other cells are mapped from the membrane.
 */
#ifndef meniscus_Refraction_Images_ObjectImages_h
#define meniscus_Refraction_Images_ObjectImages_h

#include "Common/RangeLoop.h"
#include "Refraction/Curved/CurvedMembraneSolver.h"
#include "Refraction/Curved/InjectivityGrid.h"
#include "Refraction/Images/EdgeSubdivision.h"
#include "Refraction/Images/ImageMesh.h"
#include "Refraction/Images/PrimitiveMapper.h"
#include "Refraction/Images/SeamClosure.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace meniscus
{

/**
 * Cells of one kind, borrowed: cell i has the points connectivity[offsets[i]] up to
 * connectivity[offsets[i + 1]], all of which exist.
 */
struct ObjectCells
{
  const std::int64_t* Offsets = nullptr;
  const std::int64_t* Connectivity = nullptr;
};

/** What became of cells. */
struct CellReport
{
  std::size_t Whole = 0;   ///< passed through with its points
  std::size_t Divided = 0; ///< shown once, but bent: divided into several
  std::size_t Mapped = 0;  ///< mapped from the membrane, to any number of pieces
  std::size_t Without = 0; ///< no image at all

  void Count(bool isDivided, bool hasPieces)
  {
    ++(isDivided ? this->Divided : (hasPieces ? this->Mapped : this->Without));
  }
};

class ObjectImages
{
public:
  /** Splits the polygon with these points into triangles, three indices into the polygon each. */
  using Triangulate = std::function<void(
    const std::int64_t* ids, std::size_t count, std::vector<std::int64_t>& triangles)>;

  /** Eye and membrane must not change afterwards. */
  explicit ObjectImages(const CurvedMembraneSolver& geometry)
    : Geometry(geometry)
  {
  }

  /** An angle at the eye in radians. */
  void SetTolerance(double tolerance) { this->Tolerance = tolerance; }

  /**
   * Takes the object's points, x, y, z each, borrowed; `mayCross` if any of them is not behind all
   * of the membrane. Finds no image yet.
   */
  void SetPoints(const double* points, std::size_t count, bool mayCross);

  /**
   * Finds out where points have one image at most, if that costs less than it saves for `wanted`
   * points and the geometry's PrepareField() has found it possible. What is found does not depend
   * on it, but for rounding.
   */
  void PrepareUnique(std::size_t wanted, const RangeLoop& loop);

  /**
   * Chunks of points that are wanted from now on; none: all of them. What is solved is kept, for
   * when it is wanted again, unless all of them were wanted.
   */
  static constexpr std::size_t Chunk = 128;
  void SetWanted(const std::vector<bool>& chunks) { this->Wanted = chunks; }
  const std::vector<bool>& GetWanted() const { return this->Wanted; }
  bool IsWanted(std::size_t point) const
  {
    return this->Wanted.empty() || this->Wanted[point / Chunk];
  }

  /**
   * Images of the points in [begin, end), whole chunks, that are wanted and not solved. Different
   * ranges may run at once.
   */
  void SolvePoints(std::size_t begin, std::size_t end);

  /** Collects what SolvePoints found. Cells of wanted points can be mapped afterwards. */
  void FinishPoints();

  const std::vector<ImagePoint>& GetPointImages() const { return this->Images; }
  std::size_t GetNumberOfImages(std::size_t point) const
  {
    return this->First[point + 1] - this->First[point];
  }
  /** NotAsked if the point has never been wanted. */
  ImageState GetState(std::size_t point) const { return this->States[point]; }

  /**
   * Adds the images of cells [begin, end), called `names`. Cells that pass whole go to `whole`,
   * which has no points of its own but names those of GetPointImages(); others go to `pieces`.
   * `isMapped[i]` becomes 1 if polygon i has been mapped from the membrane, otherwise 0.
   */
  CellReport MapLines(const ObjectCells& cells, const std::int64_t* names, std::size_t begin,
    std::size_t end, ImageMesh& pieces, ImageMesh& whole) const;
  CellReport MapPolygons(const ObjectCells& cells, const std::int64_t* names, std::size_t begin,
    std::size_t end, const Triangulate& triangulate, ImageMesh& pieces, ImageMesh& whole,
    unsigned char* isMapped) const;

  /**
   * After all polygons have been mapped to `pieces` and `whole`: makes those that have been mapped
   * from the membrane, `isMapped`, end where their neighbours do, which draw common sides as
   * straight pieces, up to the tolerance off. With `closesSeams`, closes the seams between them.
   */
  void MeetNeighbours(const ObjectCells& cells, std::size_t count, const unsigned char* isMapped,
    bool closesSeams, const ImageMesh& whole, ImageMesh& pieces) const;

private:
  enum class Side
  {
    Behind,
    InFront,
    Both
  };

  glm::dvec3 GetPoint(std::int64_t id) const;
  bool IsUnique(const std::int64_t* ids, std::size_t count) const;
  void SolveRun(std::size_t begin, std::size_t end, CurvedMembraneSolver::Memory& memory);
  ImageState FindImages(const glm::dvec3& point, bool isUnique,
    CurvedMembraneSolver::Memory& memory, std::vector<VirtualVertex>& images) const;
  Side FindSide(const std::int64_t* ids, std::size_t count) const;
  bool HaveOneImage(const std::int64_t* ids, std::size_t count) const;
  bool IsSimple(
    const std::int64_t* ids, std::size_t count, bool isClosed, EdgeSubdivision& division) const;
  ImagedPoint GetImagedPoint(std::int64_t id) const;
  static std::vector<Seam> FindSeams(
    const ObjectCells& cells, std::size_t count, const unsigned char* isMapped);
  void MoveOntoNeighbours(const ObjectCells& cells, std::size_t count,
    const unsigned char* isMapped, const std::vector<Seam>& seams, ImageMesh& pieces) const;
  MappedTriangle MakeTriangle(const std::array<std::int64_t, 3>& ids) const;
  bool DividePolygon(const std::int64_t* ids, const std::vector<std::int64_t>& triangles,
    std::int64_t cell, EdgeSubdivision& division, ImageMesh& pieces) const;
  void AddWhole(
    const std::int64_t* ids, std::size_t count, std::int64_t cell, ImageMesh& whole) const;

  const CurvedMembraneSolver& Geometry;
  InjectivityGrid Unique;
  double Tolerance = 0.0;
  double Nearest = 0.0;
  double Farthest = 0.0;
  const double* Points = nullptr;
  bool MayCross = false;
  std::vector<std::vector<VirtualVertex>> Chunks;
  std::vector<bool> Wanted; ///< chunks; empty: all
  std::vector<std::uint32_t> Counts;
  std::vector<ImageState> States;
  std::vector<bool> InFront;
  std::vector<std::size_t> First;
  std::vector<ImagePoint> Images;
};

}

#endif
