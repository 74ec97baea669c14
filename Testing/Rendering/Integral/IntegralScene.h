// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "RayCastScene.h"

#include <vtkTetrahedraRayIntegral.h>

namespace meniscus::test
{

using Filter = vtkSmartPointer<vtkTetrahedraRayIntegral>;

/** A ray in world coordinates; the direction has length 1. */
struct WorldRay
{
  glm::dvec3 Origin;
  glm::dvec3 Direction;
};

/** Part of a ray; empty if it ends before it begins. */
struct Stretch
{
  double Begin;
  double End;

  double GetLength() const { return this->End > this->Begin ? this->End - this->Begin : 0.0; }
};

/** A convex solid: the points p with dot(normal, p) <= offset for all planes. */
struct ConvexSolid
{
  struct Plane
  {
    glm::dvec3 Normal;
    double Offset;
  };
  std::vector<Plane> Planes;

  /** Part of a ray in the solid, from `from` on. */
  Stretch Clip(const WorldRay& ray, double from = -1.0e30) const;
};

/** A tetrahedral mesh that fills a convex solid. */
struct SolidMesh
{
  std::string Name;
  Grid Mesh;
  ConvexSolid Solid;
};

/** Corner tetrahedron, block with displaced inner points, and a ball of flat facets. */
std::vector<SolidMesh> MakeSolids(const Field& field);

/** Filter with only the named arrays on. */
Filter MakeFilter(
  vtkDataObject* input, int width, int height, const std::vector<const char*>& arrays = {});
void Enable(vtkTetrahedraRayIntegral* filter, const std::vector<const char*>& arrays);
/** Sets a rectangle, seen along a direction, around the cube [-half, half]^3. */
void SetRectangle(vtkTetrahedraRayIntegral* filter, const glm::dvec3& direction, double half);

/** The ray of a pixel, computed from the filter's rectangle or its perspective camera. */
WorldRay RayOf(vtkTetrahedraRayIntegral* filter, int column, int row);

/** Values of an array of the output; empty if there is none. */
std::vector<double> ValuesOf(vtkTetrahedraRayIntegral* filter, const char* name);

/**
 * Largest difference between an array of one component and the truth of each pixel's ray, divided
 * by the largest truth. NaN must meet NaN; pixels for which the truth is infinite are skipped.
 */
double WorstError(vtkTetrahedraRayIntegral* filter, const char* name,
  const std::function<double(const WorldRay&)>& truth);

/** Sum over the tetrahedra of a grid: volume times the mean of the scalars, or of 1. */
double IntegrateCells(vtkUnstructuredGrid* grid, bool scalars);

} // namespace meniscus::test
