// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Images of an object: of its points, lines and polygons. A cell is simple, and keeps its points,
 * if each of them has one image and the images of the middles of its sides lie on the virtual cell
 * within a tolerance. A cell whose image is curved is divided if no point of it can have several
 * images. All other cells are mapped from the membrane.
 */
#pragma once

#include "Common/RangeLoop.h"
#include "Refraction/Curved/CurvedMembraneSolver.h"
#include "Refraction/Curved/InjectivityGrid.h"
#include "Refraction/Images/CellImages.h"
#include "Refraction/Images/EdgeSubdivision.h"
#include "Refraction/Images/ImageMesh.h"
#include "Refraction/Images/PrimitiveMapper.h"
#include "Refraction/Images/SeamClosure.h"
#include "Refraction/Images/SharedNodes.h"
#include "Refraction/Stack/ParallelPlanes.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

namespace meniscus
{

class ObjectImages : public CellImages
{
public:
  /**
   * The eye and the membrane of `geometry` must not change afterwards. `plane` is the membrane as a
   * list of one, if it is an exact plane and the eye is in front of it; it must outlive this
   * object.
   */
  explicit ObjectImages(CurvedMembraneSolver& geometry, const ParallelPlanes* plane = nullptr)
    : Geometry(geometry)
    , Plane(plane)
  {
  }

  void SetTolerance(double tolerance) override
  {
    this->Tolerance = tolerance;
    this->ForgetNodes();
  }

  /**
   * Sets the object's points (x, y, z each; borrowed). `mayCross` must be true if any of them may
   * be on the other side of the membrane than its rays. Computes no image.
   */
  void SetPoints(const double* points, std::size_t count, bool mayCross);

  /**
   * Determines where points have at most one image, if the expected saving for `wanted` points and
   * for `cells` lines and polygons exceeds the cost and the membrane is neither closed nor an exact
   * plane, behind which a point has one image at most. Call the
   * geometry's PrepareField() before. Images of points are the same with and without it, up to
   * rounding; pieces of cells differ within the tolerance.
   */
  void PrepareUnique(std::size_t wanted, std::size_t cells, const RangeLoop& loop);

  void SolvePoints(std::size_t begin, std::size_t end) override;
  void FinishPoints() override;
  CellReport MapLines(const ObjectCells& cells, const std::int64_t* names, std::size_t begin,
    std::size_t end, ImageMesh& pieces, ImageMesh& whole) const override;
  CellReport MapPolygons(const ObjectCells& cells, const std::int64_t* names, std::size_t begin,
    std::size_t end, const Triangulate& triangulate, ImageMesh& pieces, ImageMesh& whole,
    unsigned char* isMapped) const override;

protected:
  MoveOntoSide MakeMove() const override;
  glm::dvec3 GetEye() const override;

private:
  enum class Side
  {
    Behind,
    InFront,
    Both
  };

  /** Bounds of the points in reach: of their heights, and of their local coordinates. */
  struct Extent
  {
    double Lowest = std::numeric_limits<double>::max();
    double Highest = std::numeric_limits<double>::lowest();
    glm::dvec3 Low{ std::numeric_limits<double>::max() };
    glm::dvec3 High{ std::numeric_limits<double>::lowest() };
  };
  void ForgetNodes();
  Extent FindExtent() const;
  bool IsProofWorthwhile(const Extent& extent, std::size_t wanted, std::size_t cells) const;
  bool IsUnique(const std::int64_t* ids, std::size_t count) const;
  bool IsUniqueTriangle(const std::array<glm::dvec3, 3>& corners, int halvings) const;
  /**
   * True if a cell whose image is curved may be divided instead of mapped from the membrane. Behind
   * other membranes than convex fields, pieces of cells do not depend on whether the object has
   * enough points for PrepareUnique: its parts on several computers have the same.
   */
  bool MayBeDivided(const std::int64_t* ids, const std::vector<std::int64_t>& triangles) const;
  bool MayLineBeDivided(const std::int64_t* ids) const
  {
    return (this->Plane || this->Geometry.HasConvexField()) && this->IsUnique(ids, 2);
  }
  /** How the images of a point are found. */
  enum class Way : unsigned char
  {
    None,     ///< not wanted, or already solved
    Straight, ///< the point is seen unrefracted
    Unique,   ///< at most one image
    Search
  };
  void ChooseWays(std::size_t begin, std::size_t end, Way* ways) const;
  void SolveChunks(std::size_t begin, std::size_t end);
  Side FindSide(const std::int64_t* ids, std::size_t count) const;
  bool MayCrossMembrane(Side side) const
  {
    return side == Side::Both || (this->MayCross && this->Geometry.GetMedia().Reflects);
  }
  bool HaveOneImage(const std::int64_t* ids, std::size_t count) const;
  bool HaveOneRefractedImage(const std::int64_t* ids, std::size_t count) const
  {
    return this->FindSide(ids, count) == Side::Behind && this->HaveOneImage(ids, count) &&
      this->AreInRange(ids, count);
  }
  void FindStraight(const ObjectCells& cells, std::size_t begin, std::size_t end, bool areClosed,
    const std::vector<bool>::const_iterator& keepsPoints, EdgeSubdivision& division,
    std::vector<bool>& areStraight) const;
  bool HasSimpleMiddle(const std::int64_t* ids, std::size_t count) const;
  std::vector<bool> FindWhole(const ObjectCells& cells, std::size_t begin, std::size_t end) const;
  ImagedPoint GetImagedPoint(std::int64_t id) const;
  bool DividePolygon(const std::int64_t* ids, const std::vector<std::int64_t>& triangles,
    std::int64_t cell, EdgeSubdivision& division, ImageMesh& pieces) const;
  /** A cell whose image is not that of its points alone. */
  struct CellToMap
  {
    std::size_t Index;
    const std::int64_t* Ids;
    std::size_t Count;
    std::int64_t Name;
    Side At;
    /** True if each of its points has one image, behind the membrane. */
    bool IsOne;
  };
  template <typename MapCell>
  CellReport MapCells(const ObjectCells& cells, const std::int64_t* names, std::size_t begin,
    std::size_t end, bool arePolygons, ImageMesh& pieces, ImageMesh& whole,
    const MapCell& mapCell) const;

  CurvedMembraneSolver& Geometry;
  const ParallelPlanes* Plane;             ///< may be null
  const InjectivityGrid* Unique = nullptr; ///< null if there is no proof; the geometry's
  double Nearest = 0.0;
  double Farthest = 0.0;
  bool MayCross = false;
  std::vector<std::vector<VirtualVertex>> Chunks;
  std::vector<bool> InFront;
  /** For the tolerance and the distances of the images; mapping adds to it. */
  std::unique_ptr<SharedNodes> Nodes;
};

}
