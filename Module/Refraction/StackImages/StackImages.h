// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Refraction/Images/CellImages.h"
#include "Refraction/StackImages/StackMapper.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace meniscus
{

/**
 * Images of an object through several interfaces: of its points, lines and polygons. A cell keeps
 * its points if they are all seen in front of the interfaces, and nowhere else. So does a polygon
 * that is seen once, on one leg, and whose image is straight within the tolerance. All others are
 * mapped from the first surface.
 */
class StackImages : public CellImages
{
public:
  /** The eye and the interfaces of `solver` must not change afterwards. */
  explicit StackImages(const StackSolver& solver)
    : Solver(solver)
  {
  }

  /** Sets the object's points (x, y, z each; borrowed). Computes no image. */
  void SetPoints(const double* points, std::size_t count);

  /** All points are solved, whether they are wanted or not. */
  void SolvePoints(std::size_t begin, std::size_t end) override;
  void FinishPoints() override;
  void SetTolerance(double tolerance) override;
  /** Details of each image of GetPointImages(). */
  const std::vector<StackDetail>& GetDetails() const { return this->Details; }
  /** Lengths of its legs, as StackSolver::Solve writes them. */
  const std::vector<double>& GetLegs() const { return this->Legs; }

  CellReport MapLines(const ObjectCells& cells, const std::int64_t* names, std::size_t begin,
    std::size_t end, ImageMesh& pieces, ImageMesh& whole) const override;
  CellReport MapPolygons(const ObjectCells& cells, const std::int64_t* names, std::size_t begin,
    std::size_t end, const Triangulate& triangulate, ImageMesh& pieces, ImageMesh& whole,
    unsigned char* isMapped) const override;

protected:
  MoveOntoSide MakeMove() const override;
  glm::dvec3 GetEye() const override;

private:
  /** A triangle of a polygon, and the parts of it that are seen. */
  struct Triangle
  {
    MappedTriangle Corners;
    std::vector<StackMapper::Part> Parts;
  };

  /** Images of a chunk of points. */
  struct ChunkImages
  {
    std::vector<ImagePoint> Images;
    std::vector<StackDetail> Details;
    std::vector<double> Legs;
  };

  void SolveChunk(std::size_t begin, std::size_t end);
  bool ClipTriangles(
    const StackMapper& mapper, std::int64_t name, std::vector<Triangle>& triangles) const;
  void MoveOntoEdge(
    const ImagePoint& low, const ImagePoint& high, double place, ImagePoint& point) const;
  std::vector<bool> FindWhole(const ObjectCells& cells, std::size_t begin, std::size_t end) const;
  bool AreInFront(const std::int64_t* ids, std::size_t count) const;

  const StackSolver& Solver;
  std::unique_ptr<SightSheet> Sheet;
  double Farthest = 0.0; ///< largest distance of a point from the eye
  std::vector<ChunkImages> Chunks;
  std::vector<StackDetail> Details;
  std::vector<double> Legs;
};

}
