// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Refraction/Stack/PlaneSights.h"

#include "Simd/LaneLoop.h"

#include <algorithm>
#include <cmath>

namespace meniscus
{
namespace
{

/** A vector in parts: along the axis, and across it. */
struct AxisParts
{
  double Along;
  double Across[3];
  double Squared; ///< square of the length across the axis

  AxisParts(const double (&axis)[3], const double (&vector)[3][PlaneLanes::Most], int i)
  {
    const double x = vector[0][i];
    const double y = vector[1][i];
    const double z = vector[2][i];
    this->Along = axis[0] * x + axis[1] * y + axis[2] * z;
    this->Across[0] = x - this->Along * axis[0];
    this->Across[1] = y - this->Along * axis[1];
    this->Across[2] = z - this->Along * axis[2];
    this->Squared = this->Across[0] * this->Across[0] + this->Across[1] * this->Across[1] +
      this->Across[2] * this->Across[2];
  }
};

/** Sets a lane to its place, and the tangent to that of the drawn direction, if there is one. */
struct BeginKernel
{
  double Axis[3];
  double Ratio; ///< index of the first layer over the smallest index

  void operator()(DrawnLanes& lanes, int i) const
  {
    const AxisParts place(this->Axis, lanes.Place, i);
    const AxisParts drawn(this->Axis, lanes.Drawn, i);
    lanes.Depth[i] = place.Along;
    lanes.Distance[i] = std::sqrt(place.Squared);
    const double squared = this->Ratio * this->Ratio * drawn.Squared;
    const double rest = drawn.Along * drawn.Along + drawn.Squared - squared;
    const double straight = lanes.Distance[i] / place.Along;
    const double tangent = std::sqrt(squared / (rest > 0.0 ? rest : 1.0));
    lanes.Tangent[i] = drawn.Along > 0.0 && rest > 0.0 ? tangent : straight;
  }
};

/** Compares the drawn directions with the sight rays of the tangents. */
struct CompareKernel
{
  double Axis[3];
  double Ratio;
  double Tolerance;

  void operator()(DrawnLanes& lanes, int i) const
  {
    const AxisParts place(this->Axis, lanes.Place, i);
    const double t = lanes.Tangent[i];
    const double sine = t / (this->Ratio * std::sqrt(1.0 + t * t));
    const double cosine = std::sqrt(std::max(1.0 - sine * sine, 0.0));
    const double distance = lanes.Distance[i];
    const double scale = sine / (distance > 0.0 ? distance : 1.0);
    const double sx = cosine * this->Axis[0] + scale * place.Across[0];
    const double sy = cosine * this->Axis[1] + scale * place.Across[1];
    const double sz = cosine * this->Axis[2] + scale * place.Across[2];
    const double x = lanes.Drawn[0][i];
    const double y = lanes.Drawn[1][i];
    const double z = lanes.Drawn[2][i];
    const double cx = y * sz - z * sy;
    const double cy = z * sx - x * sz;
    const double cz = x * sy - y * sx;
    const double off = cx * cx + cy * cy + cz * cz;
    const double length = x * x + y * y + z * z;
    // Written so that a NaN fails.
    lanes.IsClose[i] = off <= this->Tolerance * this->Tolerance * length ? 1.0 : 0.0;
  }
};

}

//------------------------------------------------------------------------------
void PlaneSights::Add(
  std::size_t number, std::size_t count, const glm::dvec3& place, const glm::dvec3& drawn)
{
  if (this->Lanes.Count == PlaneLanes::Most || this->InFront != count)
  {
    this->Finish();
    this->InFront = count;
  }
  const int lane = this->Lanes.Count++;
  for (int axis = 0; axis < 3; ++axis)
  {
    this->Lanes.Place[axis][lane] = place[axis];
    this->Lanes.Drawn[axis][lane] = drawn[axis];
  }
  this->Numbers[lane] = number;
}

//------------------------------------------------------------------------------
void PlaneSights::Finish()
{
  const int count = this->Lanes.Count;
  if (count == 0)
  {
    return;
  }
  for (int lane = count; lane % LaneGroup != 0; ++lane)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      this->Lanes.Place[axis][lane] = this->Lanes.Place[axis][count - 1];
      this->Lanes.Drawn[axis][lane] = this->Lanes.Drawn[axis][count - 1];
    }
  }
  const std::vector<PlaneLayer>& layers = this->Planes.GetLayers(this->InFront);
  const InstructionSet set = this->Planes.GetInstructionSet();
  const glm::dvec3& axis = this->Planes.GetAxis();
  const double ratio = std::sqrt(layers.front().Squared);
  RunLanes(BeginKernel{ { axis.x, axis.y, axis.z }, ratio }, set, this->Lanes);
  this->Lanes.RefineTangents(layers, set);
  RunLanes(CompareKernel{ { axis.x, axis.y, axis.z }, ratio, this->Tolerance }, set, this->Lanes);
  for (int lane = 0; lane < count; ++lane)
  {
    if (!(this->Lanes.IsClose[lane] > 0.0))
    {
      this->Failed.push_back(this->Numbers[lane]);
    }
  }
  this->Lanes.Count = 0;
}

}
