// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "RandomNumbers.h"
#include "ReferenceTransferFunction.h"
#include "VTKBasics.h"

namespace meniscus::test
{

/** A transfer function as control points of attenuation and colour, ascending. */
using VolumeFunction = std::vector<reference::TransferFunctionNode>;

struct NamedFunction
{
  std::string Name;
  VolumeFunction Function;
};

/** Smooth, peaked, opaque and sparse functions of TestTransferFunctions.h for a mesh. */
std::vector<NamedFunction> UsualFunctions(vtkUnstructuredGrid* grid);

/**
 * Extreme functions that a user can make, for scalars in a range: none, one point, zero, steps,
 * jumps, many points, all points outside the range, a window too narrow to see, nearly solid.
 * @param length approximate length of a ray in the mesh.
 */
std::vector<NamedFunction> DegenerateFunctions(const double range[2], double length);

/** Up to 12 points at random places, some jumps. */
VolumeFunction RandomFunction(const double range[2], double length, RandomNumbers& random);

/** Largest attenuation, and the largest value of a colour channel where there is attenuation. */
double LargestAttenuation(const VolumeFunction& function);
double BrightestColor(const VolumeFunction& function);

/** A property with a function's attenuation and colour. */
vtkSmartPointer<vtkVolumeProperty> ToProperty(const VolumeFunction& function);

} // namespace meniscus::test
