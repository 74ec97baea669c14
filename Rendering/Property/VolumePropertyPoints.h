// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Volume/Optics/BlendModels.h"
#include "Volume/Optics/ScalarNormalization.h"
#include "Volume/Optics/TransferFunction.h"

#include <vector>

class vtkVolumeProperty;

namespace meniscus
{

/** A transfer function as straight pieces. */
struct PropertyPoints
{
  /**
   * Control points of attenuation (per world length, or alpha) and colour, ascending. Empty if
   * nothing is visible: no opacity node.
   */
  std::vector<TransferFunctionPoint> Points;
  /** Features of the opacity and of the colour, each on its own; see FeaturesOf(). */
  std::vector<ScalarFeature> Features;
};

/**
 * The transfer function of a property's component. Opacity and colour are sampled by VTK's tables,
 * once between two nodes of each or in few tables of growing size. Between two nodes, the error of
 * linear interpolation is less than 1/32768 in colour and in alpha (over the unit distance).
 */
PropertyPoints ReducePropertyToPoints(
  vtkVolumeProperty* property, int component, OpacityMeaning meaning);

/** Colours and alphas of a property's first component at scalars in any order. */
std::vector<TransferFunctionPoint> EvaluateProperty(
  vtkVolumeProperty* property, const std::vector<double>& scalars);

/**
 * The gradient opacity function of a property's first component as points: Attenuation holds the
 * factor, >= 0; Scalar the gradient's magnitude. Empty if there is no node, which means a factor of
 * 0, in agreement with vtkPiecewiseFunction and VTK's mappers of image data.
 */
std::vector<TransferFunctionPoint> ReduceGradientOpacityToPoints(vtkVolumeProperty* property);

}
