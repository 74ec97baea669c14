// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/** Arrays that every output of vtkRefractedGeometryFilter has, for all image modes. */
#pragma once

#include "Filters/Common/NamedArray.h"
#include "Refraction/Images/ImageMesh.h"
#include "Refraction/Membrane/Membrane.h"
#include "Refraction/Sight/VirtualVertex.h"

#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <cstddef>
#include <functional>
#include <vector>

class vtkDataSetAttributes;
class vtkPolyData;

namespace meniscus
{

/** The user's options for the output, and the scene that it refers to. */
struct OutputOptions
{
  int PointsPrecision = 0; ///< vtkAlgorithm::DesiredOutputPrecision
  bool Schlick = false;
  bool VirtualNormals = false;
  bool TrueGeometry = false;
  bool Reflects = false; ///< true: images of a mirror
  bool IsLightAtEye = true;
  glm::dvec3 Light{ 0.0 }; ///< unit vector to a light at infinity
  glm::dvec3 Eye{ 0.0 };
  double Exterior = 1.0;
  double Interior = 1.0;

  bool operator==(const OutputOptions& other) const;
};

/** Type of the output's points: the type of the input's points, or the requested precision. */
int GetPointType(vtkPolyData* input, int precision);

/**
 * Creates the output points, in the requested precision, and the additional point arrays. `sources`
 * holds the input point of each point, or -1.
 */
void MakePoints(vtkPolyData* input, const std::vector<const VirtualVertex*>& vertices,
  const std::vector<vtkIdType>& sources, const Membrane& membrane, const OutputOptions& options,
  vtkPolyData* output);

/**
 * Adds the arrays TruePosition and, if the output has normals, TrueNormal: these, with length 1
 * where they have one.
 */
void AddTrueGeometry(const std::vector<glm::dvec3>& truePoints, vtkPolyData* output);

/**
 * Replaces the output's normals by normals that preserve the lighting of the true points (x, y, z
 * each); the true normals are kept as an array. Has no effect without normals.
 */
void MakeVirtualNormals(const std::vector<const VirtualVertex*>& vertices,
  const std::vector<glm::dvec3>& truePoints, const OutputOptions& options, vtkPolyData* output);

/**
 * Makes the array VirtualNormals the output's normals; the true ones stay an array. Has no effect
 * without normals. `turn(i, unit, normal)` may replace the normal of point i, whose true direction
 * is `unit`; normals without a direction stay.
 */
void AddVirtualNormals(std::size_t count,
  const std::function<void(std::size_t, const glm::dvec3&, glm::dvec3&)>& turn,
  vtkPolyData* output);

/** The point of the object that an image shows. */
glm::dvec3 FindTruePoint(vtkPolyData* input, const ImagePoint& image);

/** Replaces the output's normals by mirrored ones, in an array of the same name and type. */
void MirrorNormals(const std::vector<const VirtualVertex*>& vertices,
  const std::vector<glm::dvec3>& truePoints, const OutputOptions& options, vtkPolyData* output);

/** True if the options ask for arrays that depend on the true points. */
inline bool NeedsTruePoints(const OutputOptions& options)
{
  return options.VirtualNormals || options.Reflects || options.TrueGeometry;
}

/** Makes the arrays of the true points, and the normals, that the options ask for. */
void UseTruePoints(const std::vector<const VirtualVertex*>& vertices,
  const std::vector<glm::dvec3>& truePoints, const OutputOptions& options, vtkPolyData* output);

/** Creates the additional cell arrays. */
void MakeCellArrays(const std::vector<vtkIdType>& sources,
  const std::vector<signed char>& orientations, vtkPolyData* output);

/**
 * Copies `from` without the arrays whose number of tuples is not `tuples`: reading them by index
 * would go out of bounds. Returns the number of arrays left out.
 */
int TakeFittingArrays(vtkDataSetAttributes* from, vtkIdType tuples, vtkDataSetAttributes* fitting);

/**
 * Copies tuple `sources[i]` to tuple i for all i. Arrays are shared if every tuple keeps its index.
 * Global ids stay in their array but are no longer marked as global if one of them is repeated.
 */
void CopyTuples(vtkDataSetAttributes* from, vtkIdType tuples, const std::vector<vtkIdType>& sources,
  vtkDataSetAttributes* to);

/**
 * Interpolates the tuples of the points' sources, by vtkDataSetAttributes::InterpolatePoint or with
 * the same result.
 */
void InterpolateTuples(vtkDataSetAttributes* from, const std::vector<const ImagePoint*>& points,
  vtkDataSetAttributes* to);

}
