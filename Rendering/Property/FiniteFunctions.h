// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Numbers of a volume property that are not finite, or not positive where they must be.
#pragma once

#include "Rendering/Input/InputBlocks.h"
#include "Volume/Optics/BlendModels.h"

#include "vtkSmartPointer.h"

class vtkColorTransferFunction;
class vtkPiecewiseFunction;
class vtkVolumeProperty;

namespace meniscus
{

/**
 * The function, or a copy without the nodes that have a number that is not finite. VTK does not
 * interpolate correctly next to such a node.
 */
vtkSmartPointer<vtkPiecewiseFunction> KeepFiniteNodes(vtkPiecewiseFunction* function);
vtkSmartPointer<vtkColorTransferFunction> KeepFiniteNodes(vtkColorTransferFunction* function);

/**
 * Report of the functions of a property's component: an error if its unit distance is no length, or
 * if none of its opacities is finite; a warning about the nodes that KeepFiniteNodes() leaves out,
 * and about curves between nodes whose distance exceeds the largest number, which become straight.
 */
InputReport CheckFunctions(vtkVolumeProperty* property, int component, OpacityMeaning meaning);

/** Warning about isovalues that are not finite, which show no surface; empty if there are none. */
std::string CheckIsovalues(vtkVolumeProperty* property);

}
