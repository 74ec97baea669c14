// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/** Pieces of the path of a bent ray, which a visitor receives one by one. */
#pragma once

#include "Volume/Graded/GradedPassage.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>

namespace meniscus
{

/** Straight piece outside of the mesh. Positions are in the units of the walk. */
struct GradedLeg
{
  glm::dvec3 Begin;
  /** Unit length. */
  glm::dvec3 Direction;
  /** Infinite for a ray that does not meet the mesh again. */
  double Length;
};

/**
 * Arc in a cell. The end of a piece is the beginning of the next one, to the bit where both are in
 * the mesh.
 */
class GradedArc
{
public:
  GradedArc(GradedPassage& way, double time)
    : Way(way)
    , Time(time)
    , LargestForce(way.GetLargestForce(time))
  {
  }

  std::int64_t Cell = -1;
  glm::dvec3 Begin{ 0.0 };
  glm::dvec3 End{ 0.0 };
  /** Barycentric weights of the ends in the cell. */
  std::array<double, 4> BeginWeights{};
  std::array<double, 4> EndWeights{};
  /** Optical path of the ray up to the ends. It falls in an inverted cell. */
  double BeginPath = 0.0;
  double EndPath = 0.0;

  /**
   * Largest distance of the part between two shares of the time from its chord, both at the same
   * share of their own time: half of the force times (t - a) (b - t), which is at most (b - a)^2
   * / 4.
   */
  double GetHeight(double from, double to) const
  {
    const double time = (to - from) * this->Time;
    return 0.125 * this->LargestForce * time * time;
  }
  const GradedCell& GetCell() const { return this->Way.GetCell(); }
  /** Time of the whole arc. */
  double GetTime() const { return this->Time; }
  /** At least the size of the force on the arc. */
  double GetLargestForce() const { return this->LargestForce; }
  /** At least the norm of the force's derivative by the place. */
  double GetForceNorm() const { return this->Way.GetForceNorm(); }
  /** Barycentric weights at a share of the time. */
  std::array<double, 4> WeightsAt(double share)
  {
    if (share == 0.0 || share == 1.0)
    {
      return share == 0.0 ? this->BeginWeights : this->EndWeights;
    }
    this->Way.MoveTo(share * this->Time);
    return this->Way.GetWeights(-1);
  }
  /** Place at a share of the time, from 0 to 1. */
  glm::dvec3 At(double share)
  {
    if (share == 0.0 || share == 1.0)
    {
      return share == 0.0 ? this->Begin : this->End;
    }
    this->Way.MoveTo(share * this->Time);
    return this->Begin + this->Way.GetWay();
  }
  /**
   * Direction there: the derivative of the place by the time, of the length n, or 1 for a straight
   * ray. It is against that of the ray in an inverted cell.
   */
  glm::dvec3 DirectionAt(double share)
  {
    this->Way.MoveTo(share * this->Time);
    return this->Way.GetMomentum();
  }

private:
  GradedPassage& Way;
  double Time;
  double LargestForce;
};

/** Is told of the pieces of a path in their order. Each function returns false to end the ray. */
class GradedRayVisitor
{
public:
  virtual ~GradedRayVisitor() = default;
  virtual bool VisitLeg(const GradedLeg& leg) = 0;
  virtual bool VisitArc(GradedArc& arc) = 0;
};

}
