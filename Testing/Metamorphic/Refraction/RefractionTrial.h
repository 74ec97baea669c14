// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "MembraneMeshes.h"
#include "RandomNumbers.h"
#include "Refraction/Curved/CurvedMembraneSolver.h"
#include "Relation.h"

namespace meniscus::test
{

/** A membrane, an eye and points on both sides of it, a few units wide. */
struct RefractionScene
{
  std::string Family;
  reference::MembraneMesh Mesh;
  /** Approximate length of a facet's sides. */
  double FacetSize = 1.0;
  glm::dvec3 Eye{ 0.0 };
  double Exterior = 1.0;
  double Interior = 1.333;
  std::vector<glm::dvec3> Points;
  /** True for spheres and planes with their normals, which patches reproduce for any division. */
  bool IsExact = false;
};

/** A scene of any family: waves, paraboloids of up to 80 degrees, spheres, noise, planes. */
RefractionScene RandomScene(RandomNumbers& random);

/** The scene's membrane and eye as the kernel's geometry; null if it rejects them. */
std::unique_ptr<CurvedMembraneSolver> MakeGeometry(const RefractionScene& scene);

/** A change of coordinates: maps places and directions, and both back. */
struct Motion
{
  double Scale = 1.0;
  glm::dmat3 Turn{ 1.0 }; ///< orthogonal
  glm::dvec3 Offset{ 0.0 };

  glm::dvec3 Apply(const glm::dvec3& p) const { return Scale * (Turn * p) + Offset; }
  glm::dvec3 Undo(const glm::dvec3& p) const
  {
    return glm::transpose(Turn) * ((p - Offset) / Scale);
  }
  RefractionScene Apply(const RefractionScene& scene) const;
};

/**
 * Compares images and sides of points between a scene and a changed scene.
 *
 * Newton's method leaves an error of 1e-10 of a facet in a sight point (SightEquation::Solve), and
 * coordinates of magnitude M are rounded to M 2^-53 a few times; positions of vertices change the
 * curvature of patches by that over a facet, which rays carry to the depth of the point. The error
 * of a point is therefore within e = 1e-9 f + 64 eps M (1 + depth / f), with the size f of a facet.
 * Patches store the deflections of their normals in single precision, which rounds each component
 * to 2^-24 of them: that tilts rays by as much, 2^-24 |deflection| (f + depth). An image's position
 * changes by that times its sensitivity, which is measured by moving the point. An image or side
 * that changes under moves of 1000 e is at a border, on a caustic or at the critical angle, and is
 * not compared.
 */
class RefractionTrial
{
public:
  explicit RefractionTrial(const RefractionScene& scene);

  /** Adds to the tally. `shows` returns true for images that the changed scene shows; null: all. */
  void Compare(const RefractionScene& changed, const Motion& motion,
    const std::function<bool(const VirtualVertex&)>& shows = nullptr);
  /** As above, for given geometry; `magnitude` is the magnitude of its coordinates. */
  void Compare(const CurvedMembraneSolver& changed, const Motion& motion, double magnitude,
    const std::function<bool(const VirtualVertex&)>& shows = nullptr);
  /**
   * Checks that the single image of each point, solved in a given order, is one of all its images.
   */
  void CompareFirst(const std::vector<std::size_t>& order);

  /** Error of a point with coordinates of a magnitude, for an image in a facet. */
  double ErrorOf(double magnitude, double depth, std::int32_t facet) const;
  /**
   * True if the image of a point stays near and keeps its orientation under moves of 1000 errors.
   * Raises `sensitivity` to the largest ratio of the image's move to the point's.
   */
  bool IsSteady(
    const glm::dvec3& point, const VirtualVertex& image, double error, double& sensitivity) const;

  void Fail(const std::string& words);
  const RefractionScene& MakeScene() const { return this->Scene; }
  RelationTally& GetTally() { return this->Tally; }

private:
  bool IsSideSteady(const glm::dvec3& point, double error) const;

  RefractionScene Scene;
  std::unique_ptr<CurvedMembraneSolver> Geometry;
  RelationTally Tally;
};

} // namespace meniscus::test
