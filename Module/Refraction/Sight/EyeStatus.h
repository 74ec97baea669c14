// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <glm/vec3.hpp>

namespace meniscus
{

enum class EyeStatus
{
  Ready,
  BadIndex,     ///< an index of refraction that is not a positive finite number
  NotFinite,    ///< an eye coordinate that is NaN or infinite
  OnTheMembrane ///< the eye lies on a facet, so there is no sight ray
};

/** Checks an eye and two indices without a membrane; never returns OnTheMembrane. */
EyeStatus CheckEye(const glm::dvec3& eye, double exterior, double interior);

}
