// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Volume/Graded/GradedCell.h"
#include "Volume/Graded/GradedPassage.h"
#include "Volume/Graded/GradedPiece.h"
#include "Volume/Graded/GradedRayWalk.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace meniscus
{

/** State of a ray on its way. */
struct GradedRayWalk::Path
{
  GradedRayResult* Result = nullptr;
  GradedRayStatistics* Statistics = nullptr;
  /** Is told of the pieces of the path; null for none. */
  GradedRayVisitor* Visitor = nullptr;
  /** True if the visitor has ended the ray. */
  bool IsEnded = false;
  /** Outside of the mesh: a place and the direction; unit length. */
  glm::dvec3 Origin{ 0.0 };
  glm::dvec3 Direction{ 0.0 };
  /** Faces of the next entry, and the number of the ray there; null for any. */
  const EntryFaces* Faces = nullptr;
  std::size_t Number = 0;
  /** Inside: the cell, the place in it and the momentum. */
  std::int64_t Cell = -1;
  PlaceInCell Place;
  glm::dvec3 Momentum{ 0.0 };
  std::int64_t Steps = 0;
  /** Integral of grad(n) / n along a straight ray. */
  glm::dvec3 Deflection{ 0.0 };
  /** Length of a straight way to a place that is looked for; infinite for a ray of light. */
  double Limit = std::numeric_limits<double>::infinity();
  bool HasEntered = false;
  /** Place at which the ray entered last. */
  glm::dvec3 PassageBegin{ 0.0 };
  /** Index of refraction on the way to the next entry. */
  double IndexBefore = 1.0;
  /** Faces by which the ray has entered without moving on since. */
  std::vector<std::int32_t> Touched;
  /** True if the last step is short enough for a zigzag. */
  bool IsShort = false;
  /** Short steps in a row, and the cell that was remembered last in their course. */
  std::int64_t ShortSteps = 0;
  std::int64_t Anchor = -1;
  /** Number of faces that the ray must glide along in its next step: 0 to 2. */
  int Constraints = 0;
  /** Constraints that were tried last since the last step that was not short; 0 for none. */
  int LastConstraints = 0;

  bool IsSearching() const { return this->Limit < std::numeric_limits<double>::infinity(); }
  void ForgetZigzag()
  {
    this->ShortSteps = 0;
    this->Anchor = -1;
    this->LastConstraints = 0;
  }
  void AddStraight(const GradedCell& cell, double length, const std::array<double, 4>& end);
  void TellLeg(double length)
  {
    this->IsEnded =
      this->Visitor && !this->Visitor->VisitLeg({ this->Origin, this->Direction, length });
  }
  void NoteConstraints()
  {
    this->LastConstraints = this->Constraints > 0 ? this->Constraints : this->LastConstraints;
    this->Constraints = 0;
  }
};

}
