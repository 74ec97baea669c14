// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Refraction/Stack/PlaneLanes.h"
#include "Refraction/Stack/RefractionStack.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <vector>

namespace meniscus
{

/**
 * A stack of parallel planes with convex outlines. A point behind them has one image at most, since
 * n sin t is the same in all layers and the lateral distance, the sum of d_i tan t_i, increases
 * with it. Its sight ray is the root of one equation. Positions are relative to the stack's origin.
 */
class ParallelPlanes
{
public:
  /** Sets the planes; none if the stack has other surfaces or another order along its axis. */
  void Set(const RefractionStack& stack);
  void Clear() { this->Layers.clear(); }

  bool IsEmpty() const { return this->Layers.empty(); }

  /** True if the surfaces deviate from planes by rounding in double precision only. */
  bool AreExact() const { return !this->IsEmpty() && this->Exact; }

  /** Unit vector along which the planes follow each other, away from the eye. */
  const glm::dvec3& GetAxis() const { return this->Axis; }

  /** Layers in front of, between and behind the planes. */
  const std::vector<PlaneLayer>& GetLayers() const { return this->Layers; }

  /** Instruction set for loops over points. */
  InstructionSet GetInstructionSet() const { return this->Instructions; }

  /**
   * Number of planes in front of a point; -1 if there are no planes, or if the point is on one
   * within rounding, or behind the eye.
   */
  int CountInFront(const glm::dvec3& point) const;

  /**
   * Unit direction of the sight ray to a point behind `count` planes, at least one. `near` is a
   * direction to begin the search at, of any length; the result depends on it within rounding only.
   */
  glm::dvec3 FindSight(
    const glm::dvec3& point, std::size_t count, const glm::dvec3& near = glm::dvec3(0.0)) const;

  /**
   * Path to a point behind `count` planes, at least one, of the stack that these planes are of. Its
   * places are exact within rounding of their coordinates, at any slant of the rays between.
   * Returns false if it misses one of the planes.
   */
  bool FindPath(const RefractionStack& stack, const glm::dvec3& point, std::size_t count,
    StackPath& path) const;

private:
  /**
   * Tangent of LateralSum, in a layer of the smallest index of those in front of the point.
   * `straight` is the tangent of the straight way to the point.
   */
  double FindTangent(
    double depth, double straight, std::size_t count, double least, const glm::dvec3& near) const;
  void Refract(std::size_t plane, const glm::dvec3& direction, RayJet& ray) const;

  glm::dvec3 Eye{ 0.0 };
  glm::dvec3 Axis{ 0.0 };
  std::vector<PlaneLayer> Layers;
  double Slack = 0.0; ///< rounding of the planes
  bool Exact = false;
  InstructionSet Instructions = BestInstructionSet();
};

}
