// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Exact places of the corners that clipping makes: where the rays of a sub-cell's side pass a line
 * of the object, and where the side or the patch meets the object.
 *
 * Pieces that share a corner compute it from the same numbers in the same order, whichever patch,
 * sub-cell and triangle they belong to: sides are taken from one end to the other in an order that
 * lies in the ends, and lines of the object too. The results are equal bit by bit.
 */
#ifndef meniscus_Refraction_Curved_CurveCrossings_h
#define meniscus_Refraction_Curved_CurveCrossings_h

#include "Refraction/Curved/SightEquation.h"

namespace meniscus
{

/** A straight line of the object. */
struct ObjectLine
{
  glm::dvec3 Origin;
  glm::dvec3 Direction;

  /** From the end with the smaller coordinates. */
  static ObjectLine Order(const glm::dvec3& a, const glm::dvec3& b, bool& turned);
  glm::dvec3 GetPoint(double l) const
  {
    // The far end as it is, not by way of a difference.
    return (1.0 - l) * this->Origin + l * (this->Origin + this->Direction);
  }
};

struct Media
{
  glm::dvec3 Eye;
  double Exterior;
  double Interior;
};

/** A point of the membrane and the unit direction of its refracted ray. */
struct RefractedPoint
{
  PatchPoint At;
  glm::dvec3 Ray;
  bool IsValid; ///< there is a refracted ray; otherwise it is extrapolated
};

RefractedPoint RefractAt(const PatchPoint& at, const Media& media);

/**
 * How far a ray passes the line, times the lengths of both: their moment about each other, zero
 * where they meet. It is linear in the line's direction and changes sign with it.
 */
inline double GetMoment(const ObjectLine& line, const RefractedPoint& from)
{
  return glm::dot(line.Direction, glm::cross(from.At.Position - line.Origin, from.Ray));
}

/** The line's parameter nearest to a ray that meets it; 0 if they are parallel. */
double GetParameter(const ObjectLine& line, const RefractedPoint& from);

/**
 * A side of a sub-cell, from s = 0 to 1. Sides on an edge of the patch run from the vertex with
 * the smaller coordinates, others from the corner with the smaller barycentric coordinates.
 */
class SubCellSide
{
public:
  SubCellSide(const CurvedPatch& patch, const glm::dvec2& a, const glm::dvec2& b);

  PatchPoint Evaluate(double s) const;
  /** It runs from b to a. */
  bool IsTurned() const { return this->Turned; }

private:
  const CurvedPatch& Patch;
  int Edge = -1; ///< of the patch; -1 for a side in its interior
  bool Turned = false;
  bool FarIsFirst = false;
  glm::dvec2 From;
  glm::dvec2 To;
};

/**
 * Where the rays of the side, with the ends `a` and `b`, pass the line. The ends' rays pass it on
 * different sides; otherwise this is the end that passes it more closely.
 */
RefractedPoint MeetLine(const SubCellSide& side, const Media& media, const ObjectLine& line,
  const RefractedPoint& a, const RefractedPoint& b);

/** Where the side meets the plane through `point` with `normal`, in the same way. */
RefractedPoint MeetPlane(const SubCellSide& side, const Media& media, const glm::dvec3& point,
  const glm::dvec3& normal, const RefractedPoint& a, const RefractedPoint& b);

/**
 * Where the line meets the patch: Newton's method from the guess; false, and nothing changed, if
 * it does not settle near it.
 */
bool MeetPatch(const CurvedPatch& patch, const ObjectLine& line, glm::dvec2& b, double& l);
/** The same bit by bit for all guesses near the place: it starts again from one of a grid. */
bool MeetPatchAgain(const CurvedPatch& patch, const ObjectLine& line, glm::dvec2& b, double& l);
/**
 * The same as MeetPatch with the patch's normal there, not normalised. Newton's method ends with a
 * step shorter than `lastStep`, the square of which is left.
 */
bool MeetPatch(const CurvedPatch& patch, const ObjectLine& line, double lastStep, glm::dvec2& b,
  double& l, glm::dvec3& normal);

}

#endif
