// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Refraction_Images_CellImages_h
#define meniscus_Refraction_Images_CellImages_h

#include "Refraction/Images/ImageMesh.h"

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
};

/** Number of cells by their treatment. */
struct CellReport
{
  std::size_t Whole = 0;   ///< passed through with their points
  std::size_t Divided = 0; ///< have one image, which is curved: divided into several cells
  std::size_t Mapped = 0;  ///< mapped from the membrane, to any number of pieces
  std::size_t Without = 0; ///< have no image

  void Count(bool isDivided, bool hasPieces)
  {
    ++(isDivided ? this->Divided : (hasPieces ? this->Mapped : this->Without));
  }
};

/** Images of the points and cells of an object, behind one interface or several. */
class CellImages
{
public:
  /**
   * Splits the polygon with these points into triangles; writes three indices into the polygon for
   * each.
   */
  using Triangulate = std::function<void(
    const std::int64_t* ids, std::size_t count, std::vector<std::int64_t>& triangles)>;

  virtual ~CellImages() = default;

  virtual bool IsWanted(std::size_t point) const = 0;

  /** Images of all points, those of the same point in sequence. */
  virtual const std::vector<ImagePoint>& GetPointImages() const = 0;
  virtual std::size_t GetNumberOfImages(std::size_t point) const = 0;

  /**
   * Adds the images of the cells [begin, end), whose ids are in `names`. Cells that keep their
   * points go to `whole`, which has no points of its own but refers to those of GetPointImages();
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
   * `closesSeams`, also closes the seams between them.
   */
  virtual void MeetNeighbours(const ObjectCells& cells, std::size_t count,
    const unsigned char* isMapped, bool closesSeams, const ImageMesh& whole,
    ImageMesh& pieces) const = 0;
};

}

#endif
