// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Common/FiniteVector.h"

#include <glm/common.hpp>
#include <glm/vec3.hpp>

#include <limits>
#include <vector>

namespace meniscus
{

/** Bounding box of points; empty at first. */
struct PointBox
{
  glm::dvec3 Lower{ std::numeric_limits<double>::infinity() };
  glm::dvec3 Upper{ -std::numeric_limits<double>::infinity() };

  void Add(const glm::dvec3& point)
  {
    this->Lower = glm::min(this->Lower, point);
    this->Upper = glm::max(this->Upper, point);
  }
  void Add(const PointBox& box)
  {
    this->Lower = glm::min(this->Lower, box.Lower);
    this->Upper = glm::max(this->Upper, box.Upper);
  }
  bool IsEmpty() const { return !(this->Lower.x <= this->Upper.x); }
  glm::dvec3 GetCenter() const { return 0.5 * this->Lower + 0.5 * this->Upper; }
  glm::dvec3 GetHalfSize() const { return 0.5 * this->Upper - 0.5 * this->Lower; }
};

/** Box around several boxes. */
inline PointBox Enclose(const std::vector<PointBox>& boxes)
{
  PointBox all;
  for (const PointBox& box : boxes)
  {
    all.Add(box);
  }
  return all;
}

}
