// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/** A board of letters with a striped ring, for pictures of places. */
#pragma once

#include "VTKBasics.h"

namespace meniscus::test
{

/** A rectangle of squares; U and V are its sides, to the right and up for a reader. */
struct Board
{
  glm::dvec3 Centre;
  glm::dvec3 U;
  glm::dvec3 V;
  int Squares = 8; ///< along each side

  glm::dvec3 GetNormal() const { return glm::normalize(glm::cross(this->U, this->V)); }

  /** Squares of changing hue; each bright one has a letter of the project's name. */
  glm::dvec3 GetColour(const glm::dvec3& place) const;
};

/** A square at height `y` for readers who look down, with z up in the picture. */
Board MakeBoard(double y, double size);

/** A torus. */
struct Ring
{
  glm::dvec3 Centre;
  glm::dvec3 Axis; ///< of unit length
  double Radius;   ///< of the circle in the middle of the tube
  double Tube;     ///< radius of the tube
};

struct BoardScene
{
  test::Board Board;
  std::optional<test::Ring> Ring;

  /** Triangles with the point array "Place". */
  vtkSmartPointer<vtkPolyData> MakeData() const;

  /** Places off the board are on the ring. */
  glm::dvec3 GetColour(const glm::dvec3& place) const;
};

}
