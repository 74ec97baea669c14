// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Filters/Output/ImagePolyData.h"
#include "Filters/Output/OutputArrays.h"
#include "Refraction/Stack/StackSolver.h"
#include "Refraction/StackImages/StackImages.h"

#include <cstddef>
#include <vector>

class vtkPolyData;

namespace meniscus
{

/** Results for the points of an input behind several interfaces, in addition to their vertices. */
struct StackDetails
{
  std::vector<StackDetail> Points;
  std::vector<double> Legs; ///< `Interfaces` lengths per point
  std::size_t Interfaces = 0;
};

/**
 * Adds the point arrays of several interfaces to an output whose array SourcePointId tells the
 * points of `input`. With the option, replaces normals as MakeVirtualNormals does, for a light at
 * the eye.
 */
void AddStackArrays(vtkPolyData* input, const std::vector<VirtualVertex>& vertices,
  const StackDetails& details, const OutputOptions& options, vtkPolyData* output);

/**
 * The same for an output of all images that BuildImagePolyData has made from `images` and `cells`.
 * The paths of points that are not points of the input are traced again.
 */
void AddStackImageArrays(vtkPolyData* input, const StackImages& images, const AllImages& cells,
  const StackSolver& solver, const OutputOptions& options, vtkPolyData* output);

}
