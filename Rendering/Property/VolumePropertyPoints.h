// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Rendering_Property_VolumePropertyPoints_h
#define meniscus_Rendering_Property_VolumePropertyPoints_h

#include "Volume/Optics/BlendModels.h"
#include "Volume/Optics/TransferFunction.h"

#include <vector>

class vtkVolumeProperty;

namespace meniscus
{

/**
 * The transfer function of a property's component as control points of attenuation (per world
 * length, or alpha) and colour, ascending. Empty if nothing is visible: no opacity node. Between
 * two nodes, the error of linear interpolation is less than 1/32768 in colour and in alpha (over
 * the unit distance).
 */
std::vector<TransferFunctionPoint> ReducePropertyToPoints(
  vtkVolumeProperty* property, int component, OpacityMeaning meaning);

/** Colour and alpha of a property at a scalar. */
TransferFunctionPoint EvaluateProperty(vtkVolumeProperty* property, double scalar);

/**
 * The gradient opacity function of a property's first component as points: Attenuation holds the
 * factor, >= 0; Scalar the gradient's magnitude. Empty if there is no node, which means a factor of
 * 0, in agreement with vtkPiecewiseFunction and VTK's mappers of image data.
 */
std::vector<TransferFunctionPoint> ReduceGradientOpacityToPoints(vtkVolumeProperty* property);

}

#endif
