// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Refraction/Sight/EyeStatus.h"

#include <cmath>

namespace meniscus
{

//------------------------------------------------------------------------------
EyeStatus CheckEye(const glm::dvec3& eye, double exterior, double interior)
{
  if (!(exterior > 0.0) || !(interior > 0.0) || !std::isfinite(exterior / interior) ||
    !std::isfinite(interior / exterior))
  {
    return EyeStatus::BadIndex;
  }
  return std::isfinite(eye.x) && std::isfinite(eye.y) && std::isfinite(eye.z)
    ? EyeStatus::Ready
    : EyeStatus::NotFinite;
}

}
