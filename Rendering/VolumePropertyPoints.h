// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef VolumePropertyPoints_h
#define VolumePropertyPoints_h

#include "Volume/TransferFunction.h"

#include <vector>

class vtkVolumeProperty;

namespace meniscus
{

/**
 * The transfer function of a property's first component as control points of attenuation (per world
 * length) and colour, ascending. Empty if nothing is visible: no opacity node. Where property and
 * points differ between two nodes, linear interpolation is off by less than 1/32768 in colour and
 * in alpha over the unit distance.
 * @param opacityPerUnitDistance  opacity is the alpha of one unit distance, not a coefficient.
 */
std::vector<TransferFunctionPoint> ReducePropertyToPoints(
  vtkVolumeProperty* property, bool opacityPerUnitDistance);

}

#endif
