// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Common/RangeLoop.h"
#include "Volume/Mesh/TetrahedralMesh.h"
#include "Volume/Rays/FixedPointRays.h"
#include "Volume/Rays/ProjectedFaces.h"

#include <cstdint>
#include <vector>

namespace meniscus
{

/** Sums over the boundary, from which the mean length of the lists per tile can be predicted. */
struct BoundaryMeasure
{
  std::int64_t Faces = 0;
  /**
   * Area and perimeter of the faces in units of the mesh's radius. The box is their axis-aligned
   * bounding box.
   */
  double Area = 0.0;
  double Perimeter = 0.0;
  double BoxArea = 0.0;
};

BoundaryMeasure MeasureBoundary(const TetrahedralMesh& mesh);

/**
 * Expected number of faces by which rays of a tile may enter: the mean over view directions and
 * over the tiles that the bounding box of the boundary covers. It is 0 without a boundary.
 *
 * Seen from a random direction, a convex figure of area A and perimeter P has a projected area of A
 * / 2 and a projected perimeter of pi P / 4, and half of the faces are front faces. For a figure of
 * area A' and perimeter P', the measure of the positions in which a square of side t in random
 * orientation meets it is A' + 2 t P' / pi + t^2 (Blaschke). A box of surface B covers B / 4
 * (Cauchy).
 * @param tileSide side of a tile at the mesh's centre, in units of the mesh's radius.
 */
double ExpectedEntriesPerTile(const BoundaryMeasure& boundary, double tileSide);

/**
 * Lists, of any length, of the boundary faces by which rays of a tile of an image may enter the
 * mesh, from near to far. They are made for shaders, whose coordinates about a ray are
 * single-precision numbers.
 */
class EntryTiles
{
public:
  /**
   * Replaces the lists. Returns false, with empty lists, if they would hold more than 2^26 faces
   * (256 MiB), which happens if faces surround the eye.
   * @param faces boundary by which rays may enter.
   * @param tileSize side of a tile in pixels.
   */
  bool Build(const TetrahedralMesh& mesh, const std::vector<BoundaryFace>& faces,
    const FixedPointRays& rays, int tileSize, const RangeLoop& loop = SerialLoop);

  int GetNumberOfColumns() const { return this->Columns; }
  /**
   * Faces of the tile at column c of row r: [begin[r * columns + c], begin[r * columns + c + 1]).
   */
  const std::vector<std::int32_t>& GetBegins() const { return this->Begins; }
  std::int64_t GetBytes() const
  {
    return BytesOf(this->Begins) + BytesOf(this->Faces) + BytesOf(this->NearestDepths);
  }
  /** Indices of faces. */
  const std::vector<std::int32_t>& GetFaces() const { return this->Faces; }
  /**
   * Depth in front of which no ray enters by a face, by index of the face; ascending along each
   * list. Defined for faces that are in a list only.
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
