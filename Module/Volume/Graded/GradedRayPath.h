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
  /** True if the ray has passed an inverted cell, and if it has done so since it last entered. */
  bool HasPassedFold = false;
  bool IsFolded = false;
  /** True if the visitor has ended the ray. */
  bool IsEnded = false;
  /** Outside of the mesh: a place and the direction; unit length. */
  glm::dvec3 Origin{ 0.0 };
  glm::dvec3 Direction{ 0.0 };
  /** Faces of the next entry, and the number of the ray there; null for any. */
  const EntryFaces* Faces = nullptr;
  std::size_t Number = 0;
  /** Drawn boundary, by which entries are ruled out after the first one; null for none. */
  const EntryRaster* Raster = nullptr;
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
  /** Largest error of the distances at which it has entered by the faces that it touches. */
  double TouchError = 0.0;
  /** True if the last step is short enough for a zigzag. */
  bool IsShort = false;
  /** Short steps in a row, and the cell that was remembered last in their course. */
  std::int64_t ShortSteps = 0;
  std::int64_t Anchor = -1;
  /** Number of faces that the ray must glide along in its next step: 0 to 2. */
  int Constraints = 0;
  /** Constraints that were tried last since the last step that was not short; 0 for none. */
  int LastConstraints = 0;
  /** Faces by which the ray has entered without moving on since. */
  std::vector<std::int32_t> Touched;
  /**
   * Faces by which the ray has entered since it last left a fold, and those before. Light goes
   * backwards in inverted cells: a ray that leaves after one may be in front of the faces that it
   * has entered by, and passes over them. A straight ray crosses each face once.
   */
  std::vector<std::int32_t> Entered;
  std::vector<std::int32_t> Passed;

  /** Makes this the state of a ray that has not begun; keeps the memory of its lists. */
  void Restart()
  {
    this->HasPassedFold = false;
    this->IsFolded = false;
    this->IsEnded = false;
    this->Steps = 0;
    this->Deflection = glm::dvec3(0.0);
    this->Limit = std::numeric_limits<double>::infinity();
    this->HasEntered = false;
    this->TouchError = 0.0;
    this->IsShort = false;
    this->Constraints = 0;
    this->ForgetZigzag();
    this->Touched.clear();
    this->Entered.clear();
    this->Passed.clear();
  }
  void PassOverEntries()
  {
    this->Passed.insert(this->Passed.end(), this->Entered.begin(), this->Entered.end());
    this->Entered.clear();
    this->IsFolded = false;
  }
  void SetFaces(const EntryFaces* faces, std::size_t number)
  {
    this->Faces = faces;
    this->Number = number;
    this->Raster = faces ? faces->GetRaster() : nullptr;
  }
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
