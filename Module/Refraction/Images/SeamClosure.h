// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Closes what neighbours leave open along their common side, the seam. Each draws it as a chain of
 * straight parts between images of points of the side, but not always the same points: a neighbour
 * that is whole draws one part, one that is divided draws its own halves, and two mapped ones may
 * put an end of the side into different sub-cells. Parts that both draw cancel out. The others form
 * closed loops, no wider than the tolerances of the two, which become cells. Then each part of a
 * seam belongs to two cells with the same ends bit by bit, so no pixel between them stays open.
 */
#ifndef meniscus_Refraction_Images_SeamClosure_h
#define meniscus_Refraction_Images_SeamClosure_h

#include "Refraction/Images/ImageMesh.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace meniscus
{

/** A side of polygons of the object by its ends' points, the lower one first. */
struct Seam
{
  std::int64_t Low;
  std::int64_t High;
  std::int32_t Cells; ///< that have it

  bool operator<(const Seam& other) const
  {
    return this->Low != other.Low ? this->Low < other.Low : this->High < other.High;
  }
};

class SeamClosure
{
public:
  /**
   * `seams` in order, borrowed. `hasDiagonals` if polygons have been split: then all sides between
   * two points that are no seams are diagonals, which two parts of one polygon have in common.
   * `tolerance` is an angle in radians at `eye`, in world coordinates.
   */
  SeamClosure(
    const std::vector<Seam>& seams, bool hasDiagonals, const glm::dvec3& eye, double tolerance);

  /** Takes the cells of a mesh; polygons that are drawn as they are, or pieces of others. */
  void Collect(const ImageMesh& mesh, const std::vector<ImagePoint>& points, bool areWhole);

  /** Adds the cells that are missing. `mesh` may be one that has been collected. */
  void Close(ImageMesh& mesh);

private:
  /** A part of a seam as a cell draws it. Points are copied: closing may move them. */
  struct Part
  {
    std::int64_t Low;
    std::int64_t High;
    ImagePoint From;
    ImagePoint To;
    std::int64_t Cell;
    signed char Orientation;
    bool IsWhole; ///< a side of a polygon that is drawn as it is
  };
  using Parts = std::vector<const Part*>;

  void AddPart(const ImageMesh& mesh, std::size_t cell, const ImagePoint& a, const ImagePoint& b,
    bool isWhole);
  void CloseSeam(Parts parts, ImageMesh& mesh) const;
  void CloseLoops(Parts parts, ImageMesh& mesh) const;
  void Fill(const std::vector<const ImagePoint*>& loop, const Part& first, bool mustBeThin,
    ImageMesh& mesh) const;
  bool IsThin(const std::vector<const ImagePoint*>& loop) const;

  const std::vector<Seam>& Seams;
  bool HasDiagonals;
  std::vector<char> HasSeam; ///< by points of the object
  glm::dvec3 Eye;
  double Tolerance;
  std::vector<Part> All;
};

}

#endif
