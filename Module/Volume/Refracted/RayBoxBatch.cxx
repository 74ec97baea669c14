// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Refracted/RayBoxBatch.h"

#include "Simd/LaneLoop.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace meniscus
{
namespace
{

/**
 * Relative error of a depth at which a side of the box is met: a difference, a reciprocal and a
 * product, each rounded by half an epsilon.
 */
constexpr double Rounding = 2.0 * std::numeric_limits<double>::epsilon();

struct BoxKernel
{
  glm::dvec3 Low;
  glm::dvec3 High;

  void operator()(RayBoxBatch& lanes, int i) const
  {
    double near = lanes.First[i];
    double far = lanes.Last[i];
    for (int axis = 0; axis < 3; ++axis)
    {
      const double start = lanes.Start[axis][i];
      const double inverse = lanes.Inverse[axis][i];
      const double a = (this->Low[axis] - start) * inverse;
      const double b = (this->High[axis] - start) * inverse;
      near = std::max(near, std::min(a, b));
      far = std::min(far, std::max(a, b));
    }
    const double nearest = near - Rounding * std::fabs(near);
    const double farthest = far + Rounding * std::fabs(far);
    lanes.Meets[i] = nearest <= farthest ? 1 : 0;
  }
};

}

//------------------------------------------------------------------------------
void RayBoxBatch::Add(const glm::dvec3& start, const glm::dvec3& direction, double first)
{
  constexpr double smallest = 1e-300;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double component = direction[axis];
    this->Start[axis][this->Count] = start[axis];
    this->Direction[axis][this->Count] = component;
    this->Inverse[axis][this->Count] =
      1.0 / (std::fabs(component) < smallest ? std::copysign(smallest, component) : component);
  }
  this->First[this->Count] = first;
  this->Last[this->Count] = std::numeric_limits<double>::infinity();
  ++this->Count;
}

//------------------------------------------------------------------------------
bool MeetBox(const glm::dvec3& low, const glm::dvec3& high, InstructionSet set, RayBoxBatch& lanes)
{
  RunLanes(BoxKernel{ low, high }, set, lanes);
  std::int64_t any = 0;
  for (int i = 0; i < lanes.Count; ++i)
  {
    any |= lanes.Meets[i];
  }
  return any != 0;
}

}
