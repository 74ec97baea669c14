// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Exact positions of the corners that clipping makes: points where the rays of a sub-cell's side
 * cross a line of the object, and where the side or the patch meets the object.
 *
 * Pieces that share a corner compute it from the same numbers in the same order, whichever patch,
 * sub-cell and triangle they belong to: each side and each line of the object has a canonical
 * direction that depends on its two ends only. The results are equal bit by bit.
 */
#pragma once

#include "Refraction/Membrane/Optics.h"
#include "Refraction/Sight/SightEquation.h"

namespace meniscus
{

/** A straight line of the object. */
struct ObjectLine
{
  glm::dvec3 Origin;
  glm::dvec3 Direction;

  /**
   * The line from the end with the smaller coordinates to the other one. `turned` is set if that is
   * `b`.
   */
  static ObjectLine Order(const glm::dvec3& a, const glm::dvec3& b, bool& turned);
  glm::dvec3 GetPoint(double l) const
  {
    // Uses the far end as it is, rather than a scaled difference.
    return (1.0 - l) * this->Origin + l * (this->Origin + this->Direction);
  }
};

/** An eye, the two media, and the kind of rays to follow from the surface between them. */
struct Media
{
  glm::dvec3 Eye;
  double Exterior;
  double Interior;
  bool Reflects = false; ///< true: rays are reflected; false: they are refracted

  /** The ray that a sight ray becomes at a place with a unit normal. */
  RefractionRay GetRay(const glm::dvec3& sight, const glm::dvec3& normal) const
  {
    return this->Reflects ? ComputeReflectionRay(sight, normal)
                          : ComputeRefractionRay(sight, normal, this->Exterior / this->Interior);
  }
  /**
   * The media of Snell's law that leads to the point: two equal ones for a reflection, which does
   * not change the medium.
   */
  Media GetLaw() const
  {
    return { this->Eye, this->Reflects ? 1.0 : this->Exterior,
      this->Reflects ? 1.0 : this->Interior, this->Reflects };
  }
  /** True if rays pass straight through the surface. */
  bool IsIdentity() const { return !this->Reflects && this->Exterior == this->Interior; }
  /** Equation of the sight points of a point in the coordinates of the eye. */
  SightEquation MakeEquation(const glm::dvec3& point) const
  {
    const Media law = this->GetLaw();
    return { law.Eye, point, law.Exterior, law.Interior, law.Reflects };
  }
};

/** A point of the membrane and the unit direction of its refracted or reflected ray. */
struct RefractedPoint
{
  PatchPoint At;
  glm::dvec3 Ray;
  bool IsValid; ///< true: the ray exists; false: its direction is extrapolated
};

RefractedPoint RefractAt(const PatchPoint& at, const Media& media);

/**
 * Signed distance between a ray and the line, times the lengths of both direction vectors: their
 * mutual moment, which is zero where they meet. It is linear in the line's direction and changes
 * sign with it.
 */
inline double GetMoment(const ObjectLine& line, const RefractedPoint& from)
{
  return glm::dot(line.Direction, glm::cross(from.At.Position - line.Origin, from.Ray));
}

/**
 * Parameter of the point of the line that is nearest to a ray that meets it; 0 if they are
 * parallel.
 */
double GetParameter(const ObjectLine& line, const RefractedPoint& from);

/**
 * One side of a sub-cell, parametrised from s = 0 to 1. A side on an edge of the patch runs from
 * the vertex with the smaller coordinates, any other from the corner with the smaller barycentric
 * coordinates.
 */
class SubCellSide
{
public:
  SubCellSide(const CurvedPatch& patch, const glm::dvec2& a, const glm::dvec2& b);

  PatchPoint Evaluate(double s) const;
  /** True if the side runs from b to a. */
  bool IsTurned() const { return this->Turned; }
  /** Edge of the patch that the side lies on; -1 for a side in the interior. */
  int GetEdge() const { return this->Edge; }
  /**
   * Places of the ends in the direction of the side: barycentric coordinates, or, on an edge, the
   * weight of its far vertex and 0. They are the same in both patches of an edge.
   */
  const glm::dvec2& GetFrom() const { return this->From; }
  const glm::dvec2& GetTo() const { return this->To; }

private:
  const CurvedPatch& Patch;
  int Edge = -1;
  bool Turned = false;
  bool FarIsFirst = false;
  glm::dvec2 From{ 0.0 };
  glm::dvec2 To{ 0.0 };
};

/**
 * Point of the side, with the ends `a` and `b`, whose ray meets the line. The rays of the two ends
 * must pass the line on different sides; otherwise the result is the end whose ray passes it more
 * closely. `zero` becomes the point's parameter in the direction of the side, from 0 to 1.
 */
RefractedPoint MeetLine(const SubCellSide& side, const Media& media, const ObjectLine& line,
  const RefractedPoint& a, const RefractedPoint& b, double& zero);

/**
 * Point where the side meets the plane through `point` with `normal`. The two ends must lie on
 * different sides of it; otherwise the result is the nearer end.
 */
RefractedPoint MeetPlane(const SubCellSide& side, const Media& media, const glm::dvec3& point,
  const glm::dvec3& normal, const RefractedPoint& a, const RefractedPoint& b);

/**
 * Place of a patch whose refracted ray lies in the plane through `point` with `normal`, by Newton's
 * method from the guess in `b`. Returns false, and changes nothing, if the method does not converge
 * near the guess.
 */
bool MeetPlaneLengthwise(const CurvedPatch& patch, const Media& media, const glm::dvec3& point,
  const glm::dvec3& normal, glm::dvec2& b, RefractedPoint& from);

/**
 * Intersection of the line and the patch by Newton's method from the guess in `b` and `l`. Returns
 * false, and changes nothing, if the method does not converge near the guess.
 */
bool MeetPatch(const CurvedPatch& patch, const ObjectLine& line, glm::dvec2& b, double& l);
/**
 * As MeetPatch, but with the same result bit by bit for all guesses near the intersection: it
 * starts again from a point of a grid.
 */
bool MeetPatchAgain(const CurvedPatch& patch, const ObjectLine& line, glm::dvec2& b, double& l);
/** As MeetPatch, and returns the patch's normal at the intersection, not normalised. */
bool MeetPatch(
  const CurvedPatch& patch, const ObjectLine& line, glm::dvec2& b, double& l, glm::dvec3& normal);
/**
 * As MeetPatch, and returns the patch at the intersection with derivatives. These are taken one
 * step before the last, so their error is of the order of that step, 1e-7 of the patch.
 */
bool MeetPatch(
  const CurvedPatch& patch, const ObjectLine& line, glm::dvec2& b, double& l, PatchJet& jet);

}
