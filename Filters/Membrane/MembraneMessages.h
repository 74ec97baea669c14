// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/** Messages about membranes and eyes. */
#pragma once

#include "Refraction/Membrane/Membrane.h"
#include "Refraction/Sight/EyeStatus.h"
#include "Refraction/Stack/RefractionStack.h"

#include <string>

class vtkObject;

namespace meniscus
{

/** Messages for the owner of a scene to report; empty if there are none. */
struct SceneMessages
{
  std::string Error;
  std::string Warning;
};

/** Reports error and warning by an object whose output is empty after an error. */
void Report(vtkObject* owner, const SceneMessages& messages);

/**
 * Text of the warning for an eye that sees no point at all through a surface: it is totally
 * reflected everywhere, or why else it may be so.
 * @param eye local coordinates of the surface
 * @param side of the surface on which the eye is: +1 for the side of its normals, otherwise -1
 * @param before and `behind`: indices of refraction
 */
std::string DescribeNoImage(
  const Membrane& surface, const glm::dvec3& eye, double side, double before, double behind);

/**
 * Text of the warning that all sight rays which a list lets pass to an interface are totally
 * reflected at it; empty if some of a few hundred rays pass all interfaces.
 */
std::string DescribeReflection(const RefractionStack& stack);

/** Text of the error for an eye that is not `Ready`. */
std::string DescribeBadEye(EyeStatus status, const glm::dvec3& eye);

}
