// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "KernelMeshes.h"
#include "RandomNumbers.h"
#include "Volume/Graded/GradedRayWalk.h"
#include "Volume/Graded/QuadraticIndex.h"
#include "Volume/Graded/RefractiveIndex.h"

namespace meniscus::test
{

/** n^2 as a function of the position. */
using SquaredIndexField = std::function<double(const glm::dvec3&)>;

/** A mesh in a field of n^2; rays in the coordinates of its points. */
class GradedScene
{
public:
  /** @param isQuadratic false for an n^2 that is linear in each cell. */
  GradedScene(const MeshArrays& arrays, const SquaredIndexField& field, double outsideIndex = 0.0,
    bool isQuadratic = true)
  {
    this->Mesh.Build(arrays.View());
    for (const std::int32_t point : this->Mesh.GetSourcePoints())
    {
      this->Squares.push_back(field(arrays.PointAt(point)));
    }
    this->Unknown = ActivateCellsWithIndex(this->Mesh, this->Squares);
    this->Tree.Build(this->Mesh);
    if (isQuadratic)
    {
      this->Terms = ComputeEdgeTerms(this->Mesh, this->Squares);
      this->Medium.Terms = &this->Terms;
    }
    this->Medium.Mesh = &this->Mesh;
    this->Medium.Tree = &this->Tree;
    this->Medium.SquaredIndices = &this->Squares;
    this->Medium.OutsideIndex = outsideIndex;
  }
  GradedScene(const GradedScene&) = delete;
  GradedScene& operator=(const GradedScene&) = delete;

  GradedRayResult Trace(const glm::dvec3& origin, const glm::dvec3& direction)
  {
    const double radius = this->Mesh.GetRadius();
    const glm::dvec3 center = this->Mesh.GetCenter();
    GradedRayResult result = this->Walk((origin - center) / radius, direction);
    result.Entry = center + radius * result.Entry;
    result.Exit = center + radius * result.Exit;
    result.OpticalPath *= radius;
    return result;
  }

  /** The same in the units of the walk. */
  GradedRayResult Walk(const glm::dvec3& origin, const glm::dvec3& direction)
  {
    if (!this->InLanes)
    {
      return GradedRayWalk(this->Medium).Walk(origin, direction, this->Statistics);
    }
    this->PrepareLanes();
    GradedRayResult result;
    GradedRayWalk(this->Medium).WalkAll({ { origin, direction } }, this->Statistics, &result);
    return result;
  }

  /** Builds the table of the cells for WalkAll(), once. */
  void PrepareLanes()
  {
    if (!this->Medium.Table)
    {
      this->Table.Build(this->Mesh, this->Squares, this->Medium.Terms);
      this->Medium.Table = &this->Table;
    }
  }

  /** True if rays are walked by WalkAll(), one in each call. */
  bool InLanes = false;
  TetrahedralMesh Mesh;
  BoundaryTree Tree;
  std::vector<double> Squares;
  std::vector<EdgeTerms> Terms;
  GradedCellTable Table;
  std::int64_t Unknown = 0;
  GradedMedium Medium;
  GradedRayStatistics Statistics;
};

/** Moves all points that are not on the boundary of the unit cube. */
inline void JitterInside(MeshArrays& arrays, double amount, RandomNumbers& random)
{
  for (double& coordinate : arrays.Points)
  {
    const double move = random.Uniform(-amount, amount);
    coordinate += coordinate == 0.0 || coordinate == 1.0 ? 0.0 : move;
  }
}

/** A cube [-half, half]^3 of n^3 cubes, each split into 6 tetrahedra. */
inline MeshArrays CenteredGrid(int n, double half)
{
  return Moved(KuhnGrid(n), [half](const glm::dvec3& p) { return half * (2.0 * p - 1.0); });
}

/** The same mapped to a ball of that radius: each cube about the centre becomes a sphere. */
inline MeshArrays BallOfCubes(int n, double radius)
{
  return Moved(CenteredGrid(n, radius),
    [](const glm::dvec3& point)
    {
      const glm::dvec3 size = glm::abs(point);
      const double length = glm::length(point);
      return point * (length > 0.0 ? std::max(size.x, std::max(size.y, size.z)) / length : 0.0);
    });
}

/** Two unit vectors perpendicular to a unit vector and to each other. */
inline void CrossAxes(const glm::dvec3& direction, glm::dvec3& first, glm::dvec3& second)
{
  first = glm::normalize(glm::cross(
    direction, std::abs(direction.x) < 0.5 ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0, 1, 0)));
  second = glm::cross(direction, first);
}

}
