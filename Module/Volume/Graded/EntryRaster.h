// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Common/GroupedItems.h"
#include "Common/RangeLoop.h"
#include "Volume/Graded/RayImage.h"
#include "Volume/Mesh/BoundaryTree.h"
#include "Volume/Mesh/TetrahedralMesh.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace meniscus
{

class EntryRaster;

/** Faces that may be the first by which a ray enters the mesh, by the ray's number. */
class EntryFaces
{
public:
  /** Number of a ray's first entry in the list; -1 for none. */
  std::int32_t GetFirst(std::size_t ray) const { return this->Heads[ray]; }
  std::int32_t GetNext(std::int32_t entry) const { return this->Entries[entry].Next; }
  /** Number of a face in BoundaryTree::GetFaces(). */
  std::int32_t GetFace(std::int32_t entry) const { return this->Entries[entry].Face; }
  /** The raster that has collected them, which must outlive this object. */
  const EntryRaster* GetRaster() const { return this->Raster; }
  /** Removes the rays without faces. Returns the former numbers of the others, ascending. */
  std::vector<std::size_t> KeepRaysWithFaces();

private:
  friend class EntryRaster;
  struct Entry
  {
    std::int32_t Face;
    std::int32_t Next;
  };
  std::vector<std::int32_t> Heads;
  std::vector<Entry> Entries;
  const EntryRaster* Raster = nullptr;
};

/**
 * Draws the boundary of a mesh to find the faces by which the rays of an image may enter, and the
 * rays that do not enter again after they have left.
 */
class EntryRaster
{
public:
  EntryRaster(const TetrahedralMesh& mesh, const BoundaryTree& tree, const RayImage& image,
    const RangeLoop& loop = SerialLoop);

  /**
   * False if a corner has no place in the image; nothing can be collected then. If true, no ray
   * begins in the mesh.
   */
  bool IsUsable() const { return this->Usable; }

  /**
   * Collects the faces of a rectangle of pixels, whose ends are excluded.
   * @param numberOf number of the ray at a column and a row.
   */
  EntryFaces Collect(const glm::ivec2& first, const glm::ivec2& end,
    const std::function<std::size_t(int, int)>& numberOf) const;

  /**
   * False if a ray that has left the mesh does not enter it again: it is still close to a ray of
   * the image, and all faces by which such rays may enter are in front of it or far to its side.
   * @param place where it has left the mesh.
   * @param direction unit vector.
   */
  bool MayEnterAfter(const glm::dvec3& place, const glm::dvec3& direction) const;

private:
  struct Drawn
  {
    std::array<glm::dvec2, 3> Corners;
    glm::dvec2 Least;
    glm::dvec2 Most;
    /** Largest depth of a corner. */
    double Depth = 0.0;
    bool IsEntry = false;
    /** True if a ray that is turned by less than LargestTurn may enter. */
    bool IsNearlyEntry = false;
  };
  Drawn Draw(const BoundaryFace& face, const TetrahedralMesh& mesh) const;
  void FillTiles();
  void GroupEntries();

  RayImage Image;
  glm::dvec3 Axis;
  std::vector<Drawn> Faces;
  /** Faces that are entries, by rows of tiles. */
  GroupedItems EntriesOfRows;
  bool Usable = true;
  /** Largest depth of the faces that nearly are entries, by tiles of the image, and of all faces.
   */
  std::vector<double> DepthsOfTiles;
  int TilesPerRow = 0;
  double LargestDepth = 0.0;
};

}
