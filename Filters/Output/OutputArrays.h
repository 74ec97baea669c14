// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * What every output of vtkRefractedGeometryFilter has, whichever images it shows.
 */
#ifndef meniscus_Filters_Output_OutputArrays_h
#define meniscus_Filters_Output_OutputArrays_h

#include "Refraction/Flat/FlatMembraneSolver.h"

#include "vtkType.h"

#include <vector>

class vtkDataSetAttributes;
class vtkPolyData;

namespace meniscus
{

/** What the user wants to have of the output, and the scene that it is about. */
struct OutputOptions
{
  int PointsPrecision = 0; ///< vtkAlgorithm::DesiredOutputPrecision
  bool Schlick = false;
  bool VirtualNormals = false;
  bool IsLightAtEye = true;
  glm::dvec3 Light{ 0.0 }; ///< unit vector to a light at infinity
  glm::dvec3 Eye{ 0.0 };
  double Exterior = 1.0;
  double Interior = 1.0;
};

/**
 * Points of the output, in the precision that is asked for, and the point arrays that are added.
 * `sources` has the point of the input per point, or -1.
 */
void MakePoints(vtkPolyData* input, const std::vector<const VirtualVertex*>& vertices,
  const std::vector<vtkIdType>& sources, const Membrane& membrane, const OutputOptions& options,
  vtkPolyData* output);

/**
 * Makes the output's normals those that keep the lighting of the true points (x, y, z each); the
 * true normals stay as an array. Does nothing without normals.
 */
void MakeVirtualNormals(const std::vector<const VirtualVertex*>& vertices,
  const std::vector<glm::dvec3>& truePoints, const OutputOptions& options, vtkPolyData* output);

/** The cell arrays that are added. */
void MakeCellArrays(const std::vector<vtkIdType>& sources,
  const std::vector<signed char>& orientations, vtkPolyData* output);

/**
 * Copies `from` without the arrays that do not have `tuples` tuples: reading these by index would
 * leave them. Returns how many were left out.
 */
int TakeFittingArrays(vtkDataSetAttributes* from, vtkIdType tuples, vtkDataSetAttributes* fitting);

/** Tuple `sources[i]` to tuple i for all i; arrays are shared if every tuple stays in its place. */
void CopyTuples(vtkDataSetAttributes* from, vtkIdType tuples, const std::vector<vtkIdType>& sources,
  vtkDataSetAttributes* to);

}

#endif
