// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkMatrix4x4.h"

#include <glm/gtc/type_ptr.hpp>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>

#include <cmath>

namespace meniscus
{

inline glm::dmat4 ToGlm(vtkMatrix4x4* matrix)
{
  return glm::transpose(glm::make_mat4(matrix->GetData())); // VTK stores rows, GLM columns
}

/** False if a matrix makes everything flat, as with a scale of 0, or is not finite. */
inline bool HasInverse(const glm::dmat4& matrix)
{
  return std::isnormal(glm::determinant(matrix));
}

}
