// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Refraction/Membrane/HeightField.h"
#include "Refraction/Stack/PlaneLanes.h"
#include "Refraction/Stack/RefractionStack.h"

#include <glm/vec2.hpp>
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
  /**
   * Sets the planes of a stack, which must outlive this object or its next change; none if the
   * stack has other surfaces or another order along its axis.
   */
  void Set(const RefractionStack& stack);
  void Clear() { this->Layers.clear(); }

  bool IsEmpty() const { return this->Layers.empty(); }

  /** The stack that the planes are of, unless there are none. */
  const RefractionStack& GetStack() const { return *this->Stack; }

  /** True if a point, relative to the stack's origin, is finite and not too far to be solved. */
  bool IsInReach(const glm::dvec3& point) const;

  /** True if the surfaces deviate from planes by rounding in double precision only. */
  bool AreExact() const { return !this->IsEmpty() && this->Exact; }

  /** Unit vector along which the planes follow each other, away from the eye. */
  const glm::dvec3& GetAxis() const { return this->Frame.Axis; }
  /** The axis, and coordinates across it. */
  const HeightFrame& GetFrame() const { return this->Frame; }

  /** Layers in front of, between and behind all planes. */
  const std::vector<PlaneLayer>& GetLayers() const { return this->Layers.back(); }
  /** The same for the first `count` planes alone. */
  const std::vector<PlaneLayer>& GetLayers(std::size_t count) const { return this->Layers[count]; }

  /** Instruction set for loops over points. */
  InstructionSet GetInstructionSet() const { return this->Instructions; }

  /**
   * Number of planes in front of a point, 0 behind the eye; -1 if there are no planes, or if the
   * point is on one within rounding.
   */
  int CountInFront(const glm::dvec3& point) const;

  /**
   * True if all places between two corners, in the frame from the axis through the eye on, are
   * known to be inside of the outline of a plane.
   */
  bool IsInside(std::size_t plane, const glm::dvec2& low, const glm::dvec2& high) const
  {
    const Rectangle& inner = this->Inner[plane];
    return low.x >= inner.Low.x && low.y >= inner.Low.y && high.x <= inner.High.x &&
      high.y <= inner.High.y;
  }

  /** True if a point at a depth along the axis, from the eye, is behind all planes. */
  bool IsBehindAll(double depth) const
  {
    return depth - this->GetLayers().back().Begin > this->Slack;
  }

  /** Unit direction of the sight ray to a point behind `count` planes, at least one. */
  glm::dvec3 FindSight(const glm::dvec3& point, std::size_t count) const;

  /**
   * Path to a point behind `count` planes, at least one. Its places are exact within rounding of
   * their coordinates, at any slant of the rays between. Returns false if it misses one of the
   * planes.
   */
  bool FindPath(const glm::dvec3& point, std::size_t count, StackPath& path) const;

private:
  struct Rectangle
  {
    glm::dvec2 Low;
    glm::dvec2 High;
  };
  Rectangle FindInner(const RefractionStack::Link& link, const PlaneLayer& inFront) const;
  /**
   * Tangent of LateralSum, in a layer of the smallest index of those in front of the point.
   * `straight` is the tangent of the straight way to the point.
   */
  double FindTangent(double depth, double straight, std::size_t count) const;
  void Refract(std::size_t plane, const glm::dvec3& direction, RayJet& ray) const;

  const RefractionStack* Stack = nullptr;
  glm::dvec3 Eye{ 0.0 };
  HeightFrame Frame;
  std::vector<std::vector<PlaneLayer>> Layers; ///< by the number of planes, from 0 to all
  std::vector<Rectangle> Inner;                ///< by plane: rectangles inside of the outlines
  double Slack = 0.0;                          ///< rounding of the planes
  bool Exact = false;
  InstructionSet Instructions = BestInstructionSet();
};

}
