// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Refraction/Surface/CurveCrossings.h"

#include "Common/PointOrder.h"
#include "Refraction/Surface/BracketedZero.h"
#include "Refraction/Surface/PatchCrossings.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace meniscus
{
namespace
{

constexpr int Steps = 12;

// The guess comes from linear interpolation over a curve of small curvature; an iterate farther
// away than the length of the curve has left it.
constexpr double Reach = 1.0;

constexpr double Epsilon = std::numeric_limits<double>::epsilon();

bool IsNear(double value, double guess)
{
  return std::fabs(value - guess) <= Reach;
}

}

//------------------------------------------------------------------------------
ObjectLine ObjectLine::Order(const glm::dvec3& a, const glm::dvec3& b, bool& turned)
{
  turned = IsBefore(b, a);
  return turned ? ObjectLine{ b, a - b } : ObjectLine{ a, b - a };
}

//------------------------------------------------------------------------------
RefractedPoint RefractAt(const PatchPoint& at, const Media& media)
{
  const RefractionRay ray =
    media.GetRay(glm::normalize(at.Position - media.Eye), glm::normalize(at.Normal));
  return { at, ray.Direction,
    ray.Kind == RayKind::Refracted && glm::length(at.Normal) > CurvedPatch::ShortestNormal };
}

//------------------------------------------------------------------------------
double GetParameter(const ObjectLine& line, const RefractedPoint& from)
{
  // p + t r = o + l d, so (p - o) x r = l d x r.
  const glm::dvec3 across = glm::cross(line.Direction, from.Ray);
  const double squared = glm::dot(across, across);
  return squared > 0.0
    ? glm::dot(glm::cross(from.At.Position - line.Origin, from.Ray), across) / squared
    : 0.0;
}

//------------------------------------------------------------------------------
SubCellSide::SubCellSide(const CurvedPatch& patch, const glm::dvec2& a, const glm::dvec2& b)
  : Patch(patch)
{
  const double first[3] = { 1.0 - a.x - a.y, a.x, a.y };
  const double last[3] = { 1.0 - b.x - b.y, b.x, b.y };
  for (int k = 0; k < 3; ++k)
  {
    if (first[k] == 0.0 && last[k] == 0.0)
    {
      this->Edge = k;
    }
  }
  if (this->Edge < 0)
  {
    this->Turned = std::tie(b.x, b.y) < std::tie(a.x, a.y);
    this->From = this->Turned ? b : a;
    this->To = this->Turned ? a : b;
    return;
  }
  // x is the weight of the edge's end with the greater coordinates; it grows along the side.
  const int i = (this->Edge + 1) % 3;
  const int j = (this->Edge + 2) % 3;
  this->FarIsFirst = IsBefore(patch.Corner[j], patch.Corner[i]);
  const int far = this->FarIsFirst ? i : j;
  this->Turned = last[far] < first[far];
  this->From.x = std::min(first[far], last[far]);
  this->To.x = std::max(first[far], last[far]);
}

//------------------------------------------------------------------------------
PatchPoint SubCellSide::Evaluate(double s) const
{
  if (this->Edge < 0)
  {
    return this->Patch.Evaluate(this->From + s * (this->To - this->From));
  }
  const double far = this->From.x + s * (this->To.x - this->From.x);
  return this->FarIsFirst ? this->Patch.EvaluateEdge(this->Edge, far, 1.0 - far)
                          : this->Patch.EvaluateEdge(this->Edge, 1.0 - far, far);
}

//------------------------------------------------------------------------------
RefractedPoint MeetLine(const SubCellSide& side, const Media& media, const ObjectLine& line,
  const RefractedPoint& a, const RefractedPoint& b, double& zero)
{
  const RefractedPoint& start = side.IsTurned() ? b : a;
  const RefractedPoint& end = side.IsTurned() ? a : b;
  const double length = glm::length(line.Direction);
  zero = FindZero(GetMoment(line, start), GetMoment(line, end),
    [&side, &media, &line, length](double s, double& value)
    {
      const RefractedPoint from = RefractAt(side.Evaluate(s), media);
      value = GetMoment(line, from);
      // The moment is a sum of products of three lengths, each rounded a few times.
      return std::fabs(value) <=
        4.0 * Epsilon * length * glm::length(from.At.Position - line.Origin);
    });
  return zero == 0.0 ? start : (zero == 1.0 ? end : RefractAt(side.Evaluate(zero), media));
}

//------------------------------------------------------------------------------
RefractedPoint MeetPlane(const SubCellSide& side, const Media& media, const glm::dvec3& point,
  const glm::dvec3& normal, const RefractedPoint& a, const RefractedPoint& b)
{
  const RefractedPoint& start = side.IsTurned() ? b : a;
  const RefractedPoint& end = side.IsTurned() ? a : b;
  const double length = glm::length(normal);
  const double zero =
    FindZero(glm::dot(normal, start.At.Position - point), glm::dot(normal, end.At.Position - point),
      [&side, &point, &normal, length](double s, double& value)
      {
        const glm::dvec3 away = side.Evaluate(s).Position - point;
        value = glm::dot(normal, away);
        return std::fabs(value) <= 4.0 * Epsilon * length * glm::length(away);
      });
  return zero == 0.0 ? start : (zero == 1.0 ? end : RefractAt(side.Evaluate(zero), media));
}

//------------------------------------------------------------------------------
// Both the place's distance from the plane and the ray's slope against it vanish. Derivatives are
// central differences; their error, of the order of the square of their width, slows the
// convergence down by that factor a step and does not change the result.
bool MeetPlaneLengthwise(const CurvedPatch& patch, const Media& media, const glm::dvec3& point,
  const glm::dvec3& normal, glm::dvec2& b, RefractedPoint& from)
{
  constexpr double width = 0x1p-16;
  const auto measure = [&patch, &media, &point, &normal](const glm::dvec2& place)
  {
    const RefractedPoint at = RefractAt(patch.Evaluate(place), media);
    return glm::dvec2(glm::dot(normal, at.At.Position - point), glm::dot(normal, at.Ray));
  };
  glm::dvec2 place = b;
  for (int i = 0; i < Steps; ++i)
  {
    const glm::dvec2 rest = measure(place);
    const glm::dvec2 byX =
      (measure(place + glm::dvec2(width, 0.0)) - measure(place - glm::dvec2(width, 0.0))) /
      (2.0 * width);
    const glm::dvec2 byY =
      (measure(place + glm::dvec2(0.0, width)) - measure(place - glm::dvec2(0.0, width))) /
      (2.0 * width);
    const double inverse = -1.0 / (byX.x * byY.y - byX.y * byY.x);
    const glm::dvec2 move(
      inverse * (rest.x * byY.y - rest.y * byY.x), inverse * (byX.x * rest.y - byX.y * rest.x));
    place += move;
    if (!IsNear(place.x, b.x) || !IsNear(place.y, b.y))
    {
      return false;
    }
    if (std::max(std::fabs(move.x), std::fabs(move.y)) < PatchCrossings::LastStep)
    {
      b = place;
      from = RefractAt(patch.Evaluate(place), media);
      return from.IsValid;
    }
  }
  return false;
}

//------------------------------------------------------------------------------
bool MeetPatch(const CurvedPatch& patch, const ObjectLine& line, glm::dvec2& b, double& l)
{
  glm::dvec3 normal;
  return MeetPatch(patch, line, b, l, normal);
}

//------------------------------------------------------------------------------
bool MeetPatchAgain(const CurvedPatch& patch, const ObjectLine& line, glm::dvec2& b, double& l)
{
  if (!MeetPatch(patch, line, b, l))
  {
    return false;
  }
  constexpr double grid = 1024.0; // fine enough that two or three Newton steps suffice
  glm::dvec2 again = glm::round(grid * b) / grid;
  double alongAgain = std::round(grid * l) / grid;
  if (MeetPatch(patch, line, again, alongAgain))
  {
    b = again;
    l = alongAgain;
  }
  return true;
}

//------------------------------------------------------------------------------
bool MeetPatch(
  const CurvedPatch& patch, const ObjectLine& line, glm::dvec2& b, double& l, glm::dvec3& normal)
{
  PatchJet jet;
  const bool isMet = MeetPatch(patch, line, b, l, jet);
  normal = isMet ? jet.Normal : normal;
  return isMet;
}

//------------------------------------------------------------------------------
bool MeetPatch(
  const CurvedPatch& patch, const ObjectLine& line, glm::dvec2& b, double& l, PatchJet& jet)
{
  glm::dvec2 atB = b;
  double atL = l;
  for (int i = 0; i < Steps; ++i)
  {
    patch.Evaluate(atB, jet);
    // Cramer's rule for by0 x + by1 y - direction l = rest.
    const glm::dvec3 rest = line.Origin + atL * line.Direction - jet.Position;
    const glm::dvec3 byX = glm::cross(jet.PositionBy[1], line.Direction);
    const double inverse = 1.0 / glm::dot(jet.PositionBy[0], byX);
    const glm::dvec2 moveB(inverse * glm::dot(rest, byX),
      inverse * glm::dot(jet.PositionBy[0], glm::cross(rest, line.Direction)));
    const double moveL =
      -inverse * glm::dot(rest, glm::cross(jet.PositionBy[0], jet.PositionBy[1]));
    atB += moveB;
    atL += moveL;
    if (!IsNear(atB.x, b.x) || !IsNear(atB.y, b.y) || !IsNear(atL, l))
    {
      return false;
    }
    if (std::max({ std::fabs(moveB.x), std::fabs(moveB.y), std::fabs(moveL) }) <
      PatchCrossings::LastStep)
    {
      b = atB;
      l = atL;
      // The step is so short that the patch is linear within rounding.
      jet.Position += moveB.x * jet.PositionBy[0] + moveB.y * jet.PositionBy[1];
      jet.Normal = jet.Normal + moveB.x * jet.NormalBy[0] + moveB.y * jet.NormalBy[1];
      return true;
    }
  }
  return false;
}

}
