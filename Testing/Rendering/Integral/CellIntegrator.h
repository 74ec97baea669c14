// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IntegralScene.h"

#include <vtkGenericCell.h>

namespace meniscus::test
{

/** Integrates along rays through one cell by its shape functions, in double precision. */
class CellIntegrator
{
public:
  CellIntegrator(vtkUnstructuredGrid* grid, vtkIdType cell);

  /** Scalar times length, and the length, in the cell. */
  glm::dvec2 Integrate(const WorldRay& ray);

private:
  glm::dvec3 Position(const glm::dvec3& place);
  void Weigh(const glm::dvec3& place);
  bool Invert(const WorldRay& ray, double s);
  double DepthInside(const WorldRay& ray, double s);
  double FindEnd(const WorldRay& ray, double outside, double inside);
  glm::dvec2 Sum(const WorldRay& ray, double begin, double end);

  vtkDataArray* Scalars;
  vtkNew<vtkGenericCell> Cell;
  std::vector<double> Weights;
  /** Parametric coordinates at which Newton's method begins. */
  glm::dvec3 Start{ 0.0 };
  /** Bounds of the cell with a margin; points outside are outside of the cell. */
  double Bounds[6];
  glm::dvec3 Place{ 0.0 };
};

/** Integral of the trilinear field of an image of n^3 voxels in [-1, 1]^3: a cubic in each. */
double IntegrateImage(vtkImageData* image, int n, const WorldRay& ray);

}
