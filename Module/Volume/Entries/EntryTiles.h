// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Volume_Entries_EntryTiles_h
#define meniscus_Volume_Entries_EntryTiles_h

#include "Common/RangeLoop.h"
#include "Volume/Mesh/TetrahedralMesh.h"
#include "Volume/Rays/FixedPointRays.h"
#include "Volume/Rays/ProjectedFaces.h"

#include <cstdint>
#include <vector>

namespace meniscus
{

/** Sums over the boundary, from which the length of lists per tile can be foretold. */
struct BoundaryMeasure
{
  std::int64_t Faces = 0;
  /** In units of the mesh's radius; the box is the axis-aligned box about the faces. */
  double Area = 0.0;
  double Perimeter = 0.0;
  double BoxArea = 0.0;
};

BoundaryMeasure MeasureBoundary(const TetrahedralMesh& mesh);

/**
 * Number of faces that rays of a tile may enter by, the mean over directions of view and over the
 * tiles that the box of the boundary covers. 0 without a boundary.
 *
 * Seen from a random direction, a convex figure of area A and perimeter P has an area of A / 2 and
 * a perimeter of pi P / 4, and half of the faces are entered by. A square of side t in random
 * orientation meets, of its positions per unit of area, A' + 2 t P' / pi + t^2 for a figure of area
 * A' and perimeter P' (Blaschke). A box of surface B covers B / 4 (Cauchy).
 * @param tileSide  side of a tile at the mesh's centre, in units of the mesh's radius.
 */
double ExpectedEntriesPerTile(const BoundaryMeasure& boundary, double tileSide);

/**
 * Lists of any length of the boundary faces by which rays of a tile of an image may enter the mesh,
 * from near to far. For shaders, whose coordinates about a ray are single-precision numbers.
 */
class EntryTiles
{
public:
  /**
   * Replaces the lists. False, with empty lists, if there would be more than 2^26 faces in them
   * (256 MiB), which faces about the eye make.
   * @param faces     the boundary that rays may enter by.
   * @param tileSize  pixels along a tile's side.
   */
  bool Build(const TetrahedralMesh& mesh, const std::vector<BoundaryFace>& faces,
    const FixedPointRays& rays, int tileSize, const RangeLoop& loop = SerialLoop);

  int GetNumberOfColumns() const { return this->Columns; }
  /** Faces of the tile at column c of row r: [begin[r * columns + c], the next). */
  const std::vector<std::int32_t>& GetBegins() const { return this->Begins; }
  std::int64_t GetBytes() const
  {
    return BytesOf(this->Begins) + BytesOf(this->Faces) + BytesOf(this->NearestDepths);
  }
  /** Indices of faces. */
  const std::vector<std::int32_t>& GetFaces() const { return this->Faces; }
  /**
   * By index of the face, a depth before which no ray enters by it; ascending along each list. Only
   * of faces that are in a list.
   */
  const std::vector<float>& GetNearestDepths() const { return this->NearestDepths; }

private:
  struct Outline;
  std::vector<Outline> OutlineFaces(
    const ProjectedFaces& projected, int tileSize, const RangeLoop& loop) const;
  void SortByDepth(std::vector<Outline>& outlines, const RangeLoop& loop);
  std::vector<std::vector<std::int32_t>> DealToBands(const std::vector<Outline>& outlines) const;
  bool FillTiles(const std::vector<Outline>& outlines, const RangeLoop& loop);

  int Columns = 0;
  int Rows = 0;
  std::vector<std::int32_t> Begins;
  std::vector<std::int32_t> Faces;
  std::vector<float> NearestDepths;
};

}

#endif
