// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Objects whose images through several surfaces are compared with rays that are traced one by one
 * and intersected with the object on each leg.
 */
#pragma once

#include "MathBasics.h"
#include "Refraction/StackImages/StackImages.h"

namespace meniscus::test
{

/** An object of triangles and its images. */
struct Object
{
  std::vector<glm::dvec3> Points;
  std::vector<std::int64_t> Connectivity;
  ImageMesh Pieces;
  ImageMesh Whole;
  CellReport Report;
  std::vector<ImagePoint> PointImages;

  void AddTriangle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c)
  {
    for (const glm::dvec3& p : { a, b, c })
    {
      this->Connectivity.push_back(static_cast<std::int64_t>(this->Points.size()));
      this->Points.push_back(p);
    }
  }

  /** A parallelogram of two triangles that share two points. */
  void AddQuad(const glm::dvec3& corner, const glm::dvec3& u, const glm::dvec3& v)
  {
    const auto first = static_cast<std::int64_t>(this->Points.size());
    for (const glm::dvec3& p : { corner, corner + u, corner + u + v, corner + v })
    {
      this->Points.push_back(p);
    }
    for (const std::int64_t i : { 0, 1, 2, 0, 2, 3 })
    {
      this->Connectivity.push_back(first + i);
    }
  }

  std::size_t GetCount() const { return this->Connectivity.size() / 3; }
  const glm::dvec3& GetCorner(std::size_t cell, std::size_t k) const
  {
    return this->Points[static_cast<std::size_t>(this->Connectivity[3 * cell + k])];
  }

  void Map(const StackSolver& solver, double tolerance);

  glm::dvec3 GetPoint(const ImagePoint& image) const
  {
    glm::dvec3 sum(0.0);
    for (std::size_t k = 0; k < image.GetNumberOfSources(); ++k)
    {
      sum += image.Weight[k] * this->Points[static_cast<std::size_t>(image.Source[k])];
    }
    return sum;
  }
};

/** Random rays whose hits are counted in the object and in its image. */
struct Comparison
{
  int Rays = 0; ///< with hits that are all clear
  int Off = 0;  ///< of these: another number of pieces of some triangle
  int Wrong = 0;
  int Hits = 0;
};

/** Half of a pixel of 0.06 degrees. */
constexpr double Tolerance = 5e-4;

/** A piece of an image as a cone of directions. */
struct Piece
{
  std::vector<glm::dvec3> Corners;
  glm::dvec3 Middle{ 0.0 };
  double Cosine = 1.0; ///< of the circular cone around the middle that holds the corners
  std::size_t Cell;
};

/** Pieces of the image, those that keep the object's points as well. */
std::vector<Piece> ListPieces(const Object& object, const glm::dvec3& eye);

/**
 * True if a direction is in the cone over a convex polygon. Corners that coincide within
 * rounding have no side between them.
 */
bool Covers(const std::vector<glm::dvec3>& corners, const glm::dvec3& direction);

/**
 * Shoots random rays to the first surface. A ray is wrong if neither it nor one within the
 * tolerance of it shows each triangle as often as pieces of its image cover the ray.
 */
Comparison Compare(const StackSolver& solver, const Object& object, int rays, unsigned seed);

/** Each point of the output is where its sight ray shows the object's point. */
void ExpectExactPoints(const StackSolver& solver, const Object& object, double largest);
}
