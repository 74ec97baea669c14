// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "ReferenceTransferFunction.h"
#include "VTKBasics.h"

namespace meniscus::test
{

enum class FunctionKind
{
  Smooth, ///< wide ramps, moderately transparent
  Peaked, ///< narrow opacity peaks (1 % of the range to each side) in transparent surroundings
  Sharp,  ///< the same, ten times as dense: float rounding of vertices causes errors above 1e-4
  Opaque, ///< the first part of the mesh occludes the rest
  Sparse  ///< one window of the range, transparent elsewhere
};

/**
 * Transfer function over a scalar range; the unit distance is a fraction of the mesh's diagonal.
 */
vtkSmartPointer<vtkVolumeProperty> MakeProperty(
  FunctionKind kind, const double range[2], double diagonal);
/** The same over the range of a mesh's scalars. */
vtkSmartPointer<vtkVolumeProperty> MakeProperty(
  FunctionKind kind, vtkDataSet* mesh, double diagonal);

/** Gives a property a material that shows all three terms of Phong's model. */
void SetMaterial(vtkVolumeProperty* property, bool shade = true);

/** Scalar and opacity, or scalar and colour. */
using OpacityNodes = std::vector<std::array<double, 2>>;
using ColorNodes = std::vector<std::array<double, 4>>;

/** Piecewise linear functions through nodes; SetPoints() replaces all nodes of a function. */
vtkSmartPointer<vtkPiecewiseFunction> MakeOpacity(const OpacityNodes& nodes);
vtkSmartPointer<vtkColorTransferFunction> MakeColors(const ColorNodes& nodes);
void SetPoints(vtkPiecewiseFunction* function, const OpacityNodes& nodes);
void SetPoints(vtkColorTransferFunction* function, const ColorNodes& nodes);

/** One colour and opacity everywhere. */
vtkSmartPointer<vtkVolumeProperty> MakeConstantProperty(
  double opacity, double red, double green, double blue, double unitDistance);

/** Conversion of opacity to attenuation per world length (see vtkTetrahedraRayCastMapper). */
enum class OpacityModel
{
  AttenuationCoefficient, ///< tau = opacity / unit
  OpacityPerUnitDistance  ///< tau = -log(1 - opacity) / unit
};

/**
 * The reference's nodes for the first component of a property with piecewise linear RGB colour and
 * opacity. Per unit distance, attenuation is not linear in opacity, so pieces are split finely.
 */
reference::ReferenceTransferFunction ToReference(
  vtkVolumeProperty* property, OpacityModel model = OpacityModel::AttenuationCoefficient);

} // namespace meniscus::test
