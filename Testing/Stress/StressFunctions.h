// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_StressFunctions_h
#define meniscus_StressFunctions_h

#include "StressCase.h"

#include <string>
#include <vector>

namespace meniscus
{
namespace test
{

struct NamedFunction
{
  std::string Name;
  StressFunction Function;
};

/// Smooth, peaked, opaque and sparse functions of TestTransferFunctions.h for a mesh.
std::vector<NamedFunction> usualFunctions(vtkUnstructuredGrid* grid);

/**
 * Functions at the edge of what a user can make, for scalars in a range: none, one point, zero,
 * steps, jumps, many points, all out of range, a window too narrow to see, all but solid.
 * @param length  about the length of a ray in the mesh.
 */
std::vector<NamedFunction> degenerateFunctions(const double range[2], double length);

/// Up to 12 points at random places, some jumps.
StressFunction randomFunction(const double range[2], double length, StressRandom& random);

/// Largest attenuation, and the largest value of a colour channel where there is attenuation.
double largestAttenuation(const StressFunction& function);
double brightestColor(const StressFunction& function);

} // namespace test
} // namespace meniscus

#endif
