// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Snell's law between eye and point at a point S of a patch, without the root of Eq. 2.2 and
 * without unit vectors. With a = S - eye and p = point - S,
 *
 *   h(S) = n1 |p| a - n2 |a| p
 *
 * is parallel to the normal where the ray along a is refracted along p. It is |a| |p| times the
 * difference in the tangential part of Eq. 2.2, stays smooth beyond the critical angle and where
 * the surface faces away, and has no pole at the eye or at the point. It is also the derivative of
 * the optical path n1 |a| + n2 |p| along the surface, times |a| |p|.
 *
 * A mirror has the same equation with n1 = n2: |p| a - |a| p is parallel to the normal where the
 * tangential parts of the two directions are equal, for the straight ray and for the reflected one.
 * The side that the point lies on tells them apart: it is the eye's for a reflection.
 */
#pragma once

#include "Refraction/Membrane/CurvedPatch.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <limits>

namespace meniscus
{

/** Result of Newton's method. */
struct SightRoot
{
  enum class End
  {
    Converged, ///< converged, anywhere in the plane of barycentric coordinates
    Left,      ///< left the facet by more than the allowed distance
    Failed,    ///< the Jacobian is singular, or the limit of steps is reached
    Open       ///< more steps are needed
  };
  End End;
  glm::dvec2 B;
  PatchPoint At;      ///< point of the patch at the root, if converged
  double Determinant; ///< determinant of the Jacobian in the tangent plane; its sign changes at
                      ///< caustics
};

class SightEquation
{
public:
  /**
   * With `reflects` and equal indices, the equation of a reflection. Vectors are copied by
   * component, for loops over lanes.
   */
  SightEquation(const glm::dvec3& eye, const glm::dvec3& point, double exterior, double interior,
    bool reflects = false)
    : Eye(eye.x, eye.y, eye.z)
    , Point(point.x, point.y, point.z)
    , Exterior(exterior)
    , Interior(interior)
    , Reflects(reflects)
  {
  }

  /** Two vectors of equal lengths in the plane of a facet, at right angles. */
  struct Plane
  {
    glm::dvec3 First;
    glm::dvec3 Second;
  };

  /**
   * Component of h tangential to the surface, in the two directions of the facet's plane and
   * multiplied by the square of the normal's length; zero at a sight point. `nearest` is set to the
   * distance from the eye or from the point, whichever is nearer.
   */
  glm::dvec2 GetResidual(
    const CurvedPatch& patch, const Plane& plane, const glm::dvec2& b, double& nearest) const;

  /**
   * Derivative of the residual with respect to the distance from the eye or from the point,
   * whichever is nearer. Of the residual's factors, this one is not smooth where that distance is
   * small.
   */
  double GetConeSlope(const CurvedPatch& patch, const Plane& plane, const glm::dvec2& b) const;

  /**
   * Newton's method from `b` with at most `steps` steps; an iterate may leave the facet by `reach`
   * at most.
   */
  SightRoot Solve(const CurvedPatch& patch, const glm::dvec2& b, int steps, double reach) const;

  /** A step of Newton's method. */
  struct Iterate
  {
    PatchJet Jet; ///< the patch before the step
    glm::dvec2 Move;
    glm::dvec2 B; ///< after the step
    double Determinant;
    bool IsFinite;
    bool IsLast;
    bool HasLeft; ///< the facet, by more than the allowed distance

    enum SightRoot::End GetEnd() const
    {
      using End = enum SightRoot::End;
      return !this->IsFinite
        ? End::Failed
        : (this->IsLast ? End::Converged : (this->HasLeft ? End::Left : End::Open));
    }
    /**
     * Place of the patch after the last step, which is so short that the patch is linear within
     * rounding; before any other step.
     */
    PatchPoint GetPlace() const
    {
      const double x = this->IsLast ? this->Move.x : 0.0;
      const double y = this->IsLast ? this->Move.y : 0.0;
      return { this->Jet.Position + x * this->Jet.PositionBy[0] + y * this->Jet.PositionBy[1],
        this->Jet.Normal + x * this->Jet.NormalBy[0] + y * this->Jet.NormalBy[1] };
    }
  };
  /** The step from `b`; an iterate may leave the facet by `reach` at most. */
  Iterate Advance(const CurvedPatch& patch, const glm::dvec2& b, double reach) const;

  /**
   * True if a root is an image: the eye is in front of the surface, the point behind it, or in
   * front for a reflection.
   */
  bool IsImage(const PatchPoint& at) const;

  /** Squared distance of a place from the eye or from the point, whichever is nearer. */
  double GetSquaredDistance(const glm::dvec3& place) const
  {
    const glm::dvec3 a = place - this->Eye;
    const glm::dvec3 p = place - this->Point;
    return std::min(glm::dot(a, a), glm::dot(p, p));
  }

  /**
   * Orientation of the image of a facet at a root with this normal and determinant: +1, or -1 where
   * it is mirrored.
   */
  static int GetOrientation(const CurvedPatch& patch, const glm::dvec3& normal, double determinant);

private:
  struct Step
  {
    glm::dvec2 Move;
    double Determinant;
    double Nearest; ///< distance of the nearer of eye and point
  };
  Step GetStep(const PatchJet& jet) const;
  /** h without its part along the normal, in the directions of the plane. */
  static glm::dvec2 GetTangential(
    const Plane& plane, const glm::dvec3& normal, const glm::dvec3& h);

  glm::dvec3 Eye;
  glm::dvec3 Point;
  double Exterior;
  double Interior;
  bool Reflects;
};

//------------------------------------------------------------------------------
inline glm::dvec2 SightEquation::GetResidual(
  const CurvedPatch& patch, const Plane& plane, const glm::dvec2& b, double& nearest) const
{
  const PatchPoint at = patch.Evaluate(b);
  const glm::dvec3 a = at.Position - this->Eye;
  const glm::dvec3 p = this->Point - at.Position;
  const double lengthA = glm::length(a);
  const double lengthP = glm::length(p);
  nearest = std::min(lengthA, lengthP);
  const glm::dvec3 h = (this->Exterior * lengthP) * a - (this->Interior * lengthA) * p;
  return GetTangential(plane, at.Normal, h);
}

//------------------------------------------------------------------------------
inline double SightEquation::GetConeSlope(
  const CurvedPatch& patch, const Plane& plane, const glm::dvec2& b) const
{
  const PatchPoint at = patch.Evaluate(b);
  const glm::dvec3 a = at.Position - this->Eye;
  const glm::dvec3 p = this->Point - at.Position;
  const glm::dvec3 h = glm::dot(p, p) < glm::dot(a, a) ? this->Exterior * a : this->Interior * p;
  return glm::length(GetTangential(plane, at.Normal, h));
}

//------------------------------------------------------------------------------
inline glm::dvec2 SightEquation::GetTangential(
  const Plane& plane, const glm::dvec3& normal, const glm::dvec3& h)
{
  const double squared = glm::dot(normal, normal);
  const double along = glm::dot(h, normal);
  return { squared * glm::dot(h, plane.First) - along * glm::dot(normal, plane.First),
    squared * glm::dot(h, plane.Second) - along * glm::dot(normal, plane.Second) };
}

//------------------------------------------------------------------------------
// Solves for the step where the tangential part of h + dh / du du + dh / dv dv - eta (n + dn), with
// eta = h.n / n.n, vanishes. Terms with the residual times a derivative of n are left out; they
// vanish at a root. Uses Cramer's rule in the tangent plane.
inline SightEquation::Step SightEquation::GetStep(const PatchJet& jet) const
{
  const glm::dvec3 a = jet.Position - this->Eye;
  const glm::dvec3 p = this->Point - jet.Position;
  const double lengthA = glm::length(a);
  const double lengthP = glm::length(p);
  const double outer = this->Exterior * lengthP;
  const double inner = this->Interior * lengthA;
  const glm::dvec3 h = outer * a - inner * p;
  const double eta = glm::dot(h, jet.Normal) / glm::dot(jet.Normal, jet.Normal);
  const glm::dvec3 alongP = (lengthP > 0.0 ? this->Exterior / lengthP : 0.0) * p;
  const glm::dvec3 alongA = (lengthA > 0.0 ? this->Interior / lengthA : 0.0) * a;
  glm::dvec3 by[2];
  for (int k = 0; k < 2; ++k)
  {
    const glm::dvec3& d = jet.PositionBy[k];
    by[k] = (outer + inner) * d - glm::dot(alongP, d) * a - glm::dot(alongA, d) * p -
      eta * jet.NormalBy[k];
  }
  const glm::dvec3 first = glm::cross(by[1], jet.Normal);
  const glm::dvec3 second = glm::cross(jet.Normal, by[0]);
  const double determinant = glm::dot(by[0], first);
  const double inverse = -1.0 / determinant;
  return { { inverse * glm::dot(h, first), inverse * glm::dot(h, second) }, determinant,
    std::min(lengthA, lengthP) };
}

//------------------------------------------------------------------------------
// Written without branches, for SightLanes.
inline SightEquation::Iterate SightEquation::Advance(
  const CurvedPatch& patch, const glm::dvec2& b, double reach) const
{
  // The error after a step is of the order of the step's square, in units of the facet: below 1e-10
  // of a facet, except near a caustic. For a reflection it is below 1e-14, so that plane mirrors
  // are exact within rounding.
  const double lastStep = this->Reflects ? 1e-7 : 1e-5;
  Iterate iterate;
  patch.Evaluate(b, iterate.Jet);
  const PatchJet& jet = iterate.Jet;
  const Step step = this->GetStep(jet);
  iterate.Move = step.Move;
  iterate.B = b + step.Move;
  iterate.Determinant = step.Determinant;
  const double size = std::max(std::fabs(step.Move.x), std::fabs(step.Move.y));
  // Where the eye or the point is closer to the surface than a facet is wide, that distance takes
  // the place of the facet's size.
  const double width = std::max(
    glm::dot(jet.PositionBy[0], jet.PositionBy[0]), glm::dot(jet.PositionBy[1], jet.PositionBy[1]));
  const double longest = lastStep * step.Nearest;
  iterate.IsFinite = size <= std::numeric_limits<double>::max();
  iterate.IsLast = (size < lastStep) & (size * size * width <= longest * longest);
  iterate.HasLeft =
    std::min(std::min(1.0 - iterate.B.x - iterate.B.y, iterate.B.x), iterate.B.y) < -reach;
  return iterate;
}

//------------------------------------------------------------------------------
inline SightRoot SightEquation::Solve(
  const CurvedPatch& patch, const glm::dvec2& b, int steps, double reach) const
{
  SightRoot root{ SightRoot::End::Failed, b, {}, 0.0 };
  for (int i = 0; i < steps; ++i)
  {
    const Iterate iterate = this->Advance(patch, root.B, reach);
    root.B = iterate.B;
    const auto end = iterate.GetEnd();
    if (end != SightRoot::End::Open)
    {
      root.End = end;
      root.At = iterate.GetPlace();
      root.Determinant = iterate.Determinant;
      break;
    }
  }
  return root;
}

//------------------------------------------------------------------------------
inline bool SightEquation::IsImage(const PatchPoint& at) const
{
  return glm::dot(at.Normal, at.Normal) >
    CurvedPatch::ShortestNormal * CurvedPatch::ShortestNormal &&
    glm::dot(at.Position - this->Eye, at.Normal) < 0.0 &&
    (this->Reflects ? glm::dot(this->Point - at.Position, at.Normal) > 0.0
                    : glm::dot(this->Point - at.Position, at.Normal) < 0.0);
}

//------------------------------------------------------------------------------
inline int SightEquation::GetOrientation(
  const CurvedPatch& patch, const glm::dvec3& normal, double determinant)
{
  const glm::dvec3 facet =
    glm::cross(patch.Corner[1] - patch.Corner[0], patch.Corner[2] - patch.Corner[0]);
  return (determinant < 0.0) == (glm::dot(facet, normal) < 0.0) ? 1 : -1;
}

}
