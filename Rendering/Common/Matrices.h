// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkMatrix4x4.h"

#include <glm/gtc/type_ptr.hpp>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>

namespace meniscus
{

inline glm::dmat4 ToGlm(vtkMatrix4x4* matrix)
{
  return glm::transpose(glm::make_mat4(matrix->GetData())); // VTK stores rows, GLM columns
}

}
