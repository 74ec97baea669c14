// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Refraction/MappingPlace.h"

#include <cmath>

namespace meniscus
{
namespace
{

constexpr int Steps = 12;

// Quadratic convergence leaves the square of the last step.
constexpr double LastStep = 1e-7;

// The guess comes from linear interpolation over a curve that bends little; what goes farther than
// the length of the curve has left it.
constexpr double Reach = 1.0;

bool IsNear(double value, double guess)
{
  return std::fabs(value - guess) <= Reach;
}

}

//------------------------------------------------------------------------------
bool LookAlong(const CurvedPatch& patch, const Media& media, const PatchLine& curve,
  const ObjectLine& line, double& s, double& l)
{
  double atS = s;
  double atL = l;
  PatchJet jet;
  for (int i = 0; i < Steps; ++i)
  {
    patch.Evaluate(curve.origin + atS * curve.direction, jet);
    const glm::dvec3 by =
      curve.direction.x * jet.positionBy[0] + curve.direction.y * jet.positionBy[1];
    const glm::dvec3 normalBy =
      curve.direction.x * jet.normalBy[0] + curve.direction.y * jet.normalBy[1];
    const glm::dvec3 a = jet.position - media.eye;
    const glm::dvec3 p = line.origin + atL * line.direction - jet.position;
    const double outer = media.exterior * glm::length(p);
    const double inner = media.interior * glm::length(a);
    if (!(outer > 0.0) || !(inner > 0.0))
    {
      return false;
    }
    // As in SightEquation; the point moves as well.
    const glm::dvec3 h = outer * a - inner * p;
    const double eta = glm::dot(h, jet.normal) / glm::dot(jet.normal, jet.normal);
    const glm::dvec3 alongP = (media.exterior * media.exterior / outer) * p;
    const glm::dvec3 alongA = (media.interior * media.interior / inner) * a;
    const glm::dvec3 byS =
      (outer + inner) * by - glm::dot(alongP, by) * a - glm::dot(alongA, by) * p - eta * normalBy;
    const glm::dvec3 byL = glm::dot(alongP, line.direction) * a - inner * line.direction;
    const glm::dvec3 first = glm::cross(byL, jet.normal);
    const double determinant = glm::dot(byS, first);
    const double moveS = -glm::dot(h, first) / determinant;
    const double moveL = -glm::dot(h, glm::cross(jet.normal, byS)) / determinant;
    atS += moveS;
    atL += moveL;
    if (!IsNear(atS, s) || !IsNear(atL, l))
    {
      return false;
    }
    if (std::fabs(moveS) < LastStep && std::fabs(moveL) < LastStep)
    {
      s = atS;
      l = atL;
      return true;
    }
  }
  return false;
}

//------------------------------------------------------------------------------
bool MeetPlane(const CurvedPatch& patch, const PatchLine& curve, const glm::dvec3& point,
  const glm::dvec3& normal, double& s)
{
  double at = s;
  PatchJet jet;
  for (int i = 0; i < Steps; ++i)
  {
    patch.Evaluate(curve.origin + at * curve.direction, jet);
    const glm::dvec3 by =
      curve.direction.x * jet.positionBy[0] + curve.direction.y * jet.positionBy[1];
    const double move = glm::dot(normal, point - jet.position) / glm::dot(normal, by);
    at += move;
    if (!IsNear(at, s))
    {
      return false;
    }
    if (std::fabs(move) < LastStep)
    {
      s = at;
      return true;
    }
  }
  return false;
}

//------------------------------------------------------------------------------
bool MeetPatch(const CurvedPatch& patch, const ObjectLine& line, glm::dvec2& b, double& l)
{
  glm::dvec3 normal;
  return MeetPatch(patch, line, LastStep, b, l, normal);
}

//------------------------------------------------------------------------------
bool MeetPatch(const CurvedPatch& patch, const ObjectLine& line, double lastStep, glm::dvec2& b,
  double& l, glm::dvec3& normal)
{
  glm::dvec2 atB = b;
  double atL = l;
  PatchJet jet;
  for (int i = 0; i < Steps; ++i)
  {
    patch.Evaluate(atB, jet);
    // Cramer's rule for by0 x + by1 y - direction l = rest.
    const glm::dvec3 rest = line.origin + atL * line.direction - jet.position;
    const glm::dvec3 byX = glm::cross(jet.positionBy[1], line.direction);
    const double inverse = 1.0 / glm::dot(jet.positionBy[0], byX);
    const glm::dvec2 moveB(inverse * glm::dot(rest, byX),
      inverse * glm::dot(jet.positionBy[0], glm::cross(rest, line.direction)));
    const double moveL =
      -inverse * glm::dot(rest, glm::cross(jet.positionBy[0], jet.positionBy[1]));
    atB += moveB;
    atL += moveL;
    if (!IsNear(atB.x, b.x) || !IsNear(atB.y, b.y) || !IsNear(atL, l))
    {
      return false;
    }
    if (std::max({ std::fabs(moveB.x), std::fabs(moveB.y), std::fabs(moveL) }) < lastStep)
    {
      b = atB;
      l = atL;
      // Over so short a step the normal is as good as linear.
      normal = jet.normal + moveB.x * jet.normalBy[0] + moveB.y * jet.normalBy[1];
      return true;
    }
  }
  return false;
}

}
