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
 * length, or alpha) and colour, ascending. Empty if nothing is visible: no opacity node. Where
 * property and points differ between two nodes, linear interpolation is off by less than 1/32768 in
 * colour and in alpha (over the unit distance).
 */
std::vector<TransferFunctionPoint> ReducePropertyToPoints(
  vtkVolumeProperty* property, int component, OpacityMeaning meaning);

/** Colour and alpha of a property at a scalar. */
TransferFunctionPoint EvaluateProperty(vtkVolumeProperty* property, double scalar);

/**
 * The gradient opacity function of a property's first component, likewise: Attenuation holds the
 * factor, >= 0; Scalar the gradient's magnitude. Empty without a node, which means a factor of 0,
 * as vtkPiecewiseFunction evaluates and as VTK's mappers of image data draw.
 */
std::vector<TransferFunctionPoint> ReduceGradientOpacityToPoints(vtkVolumeProperty* property);

}

#endif
