// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Refraction/Curved/PatchRoots.h"

#include "Refraction/Curved/TriangleMap.h"
#include "Refraction/Surface/PatchCrossings.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace meniscus
{
namespace
{

// Roots closer than this are the same, in units of the facet or, where that is smaller, of the
// distance from the eye or the point: near a caustic two roots merge, and Newton's last step of
// 1e-5 of the same units leaves an error of that order.
constexpr double SameRoot = 1e-5;

// Parts have at least 2^-14 of the facet's size, or of that distance. A smaller undecided triangle
// holds a double root, on a caustic, and Newton's method decides.
constexpr int DeepestLevel = 14;

// Level of the smallest parts, wherever eye and point are. Their sides still have 13 exact binary
// digits.
constexpr int LastLevel = 40;

// Isolated roots take at most a dozen divisions each, a few more near a caustic. A ring of roots
// would need a division of every triangle that it crosses, on every level. Triangles that are wider
// than their distance from eye or point are few on each level, and do not count.
constexpr int MostDivisions = 1000;

// Newton's method starts from the root of a nearly linear map.
constexpr int NewtonSteps = 12;

// A root farther outside of a triangle than this, in units of the triangle, is no evidence about
// the triangle.
constexpr double FarthestRoot = 0.5;

// Size of the part of second degree, relative to the linear part, above which the interpolant is
// only a guess.
constexpr double LargestDeflection = 0.5;

// As PatchRoots::HigherDegree, where the interpolant is a guess.
constexpr double HigherDegreeOfGuess = 2.0;

// Distance of the nearest of six places from the apex of a cone, in longest sides, above which the
// part of higher degree of the cone is within HigherDegree. No point of the triangle is farther
// than 0.29 sides from one of the places (the circumradius of a quarter). At a distance d of a
// quarter of a side, the distance from the apex, sqrt(d^2 + x^2) along a side, leaves 0.41 of the
// part of second degree at most, wherever its foot is; at half a side 0.17.
constexpr double NearestCone = 0.29 + 0.25;

// Deviation of any distance from its interpolant, in longest sides: found by trial, 0.218 in an
// equilateral triangle with the apex on it, less in others.
constexpr double ConeDeviation = 0.22;

// True if the corners alone keep the map away from zero, provided that its part of second degree is
// within LargestDeflection: control points of edges are then within twice that distance of the
// midpoints of the edges.
bool IsFarFromZero(const TriangleMap& f)
{
  const double size =
    std::max({ glm::length(f[1] - f[0]), glm::length(f[2] - f[1]), glm::length(f[0] - f[2]) });
  TriangleMap corners = f;
  std::copy(f.begin(), f.begin() + 3, corners.begin() + 3);
  return IsSeparated(corners, (2.0 * LargestDeflection + PatchRoots::HigherDegree) * size);
}

}

//------------------------------------------------------------------------------
void PatchRoots::Find()
{
  Triangle whole;
  whole.B = { glm::dvec2(0.0, 0.0), glm::dvec2(1.0, 0.0), glm::dvec2(0.0, 1.0),
    glm::dvec2(0.5, 0.5), glm::dvec2(0.0, 0.5), glm::dvec2(0.5, 0.0) };
  this->Count = 0;
  this->Divisions = 0;
  this->Complete = true;
  this->Shape = FacetShape(this->Patch);
  if (this->Shape.GetArea() == 0.0)
  {
    return;
  }
  const glm::dvec3& first = this->Shape.GetFirst();
  this->Plane = { first, glm::cross(this->Shape.GetNormal() / this->Shape.GetArea(), first) };
  for (std::size_t i = 0; i < 3; ++i)
  {
    this->Evaluate(whole, i);
  }
  if (this->IsFar() && IsFarFromZero(whole.F))
  {
    return;
  }
  for (std::size_t i = 3; i < 6; ++i)
  {
    this->Evaluate(whole, i);
  }
  whole.Size = this->Shape.GetSize();
  this->Search(whole);
}

//------------------------------------------------------------------------------
// True if the eye and the point are so far away that lines of sight turn by less than half a radian
// over the patch, and the patch's normals, which are almost constant on the way, turn as little:
// the second-degree part of the map is then below LargestDeflection.
bool PatchRoots::IsFar() const
{
  const glm::dvec3 first = this->Patch.Corner[1] - this->Patch.Corner[0];
  const glm::dvec3 second = this->Patch.Corner[2] - this->Patch.Corner[0];
  const double squared = 4.0 * (glm::dot(first, first) + glm::dot(second, second));
  constexpr double smallest = 0.875;  // cos 0.5
  constexpr double straightest = 0.1; // a quarter of the largest bulge of an edge
  const auto turns = [this](int i, int j)
  {
    const glm::dvec3& bend = this->Patch.Bend[3 - i - j];
    return glm::dot(this->Patch.Normal[i], this->Patch.Normal[j]) < smallest ||
      glm::dot(bend, bend) > straightest * straightest;
  };
  return this->Equation.GetSquaredDistance(this->Patch.Corner[0]) > squared && !turns(0, 1) &&
    !turns(1, 2) && !turns(2, 0);
}

//------------------------------------------------------------------------------
void PatchRoots::Evaluate(Triangle& triangle, std::size_t place) const
{
  triangle.F[place] = this->Equation.GetResidual(
    this->Patch, this->Plane, triangle.B[place], triangle.Nearest[place]);
}

//------------------------------------------------------------------------------
// By how much the interpolant may be off for a cone that it does not show; 0 if there is none.
double PatchRoots::BoundCone(const Triangle& triangle) const
{
  const double size = triangle.Size;
  const double nearest = *std::min_element(triangle.Nearest.begin(), triangle.Nearest.end());
  if (nearest >= NearestCone * size)
  {
    return 0.0;
  }
  double slope = 0.0;
  for (std::size_t k = 0; k < 3; ++k)
  {
    slope = std::max(slope, this->Equation.GetConeSlope(this->Patch, this->Plane, triangle.B[k]));
  }
  return ConeDeviation * size * slope;
}

//------------------------------------------------------------------------------
PatchRoots::Verdict PatchRoots::Judge(const Triangle& triangle, double cone)
{
  TriangleMap control = triangle.F;
  double bend = 0.0;
  double size = 0.0;
  double reach = 0.0;
  for (std::size_t k = 0; k < 3; ++k)
  {
    const glm::dvec2& a = triangle.F[(k + 1) % 3];
    const glm::dvec2& b = triangle.F[(k + 2) % 3];
    control[k + 3] = 2.0 * triangle.F[k + 3] - 0.5 * (a + b);
    bend = std::max(bend, glm::length(triangle.F[k + 3] - 0.5 * (a + b)));
    size = std::max(size, glm::length(b - a));
    reach = std::max(reach, glm::length(a));
  }
  const bool isGuess = !(bend <= LargestDeflection * size);
  // A residual is a difference of products of two lengths: its error is a few roundings of the
  // largest.
  constexpr double rounding = 16.0 * std::numeric_limits<double>::epsilon();
  const double margin =
    (isGuess ? HigherDegreeOfGuess : HigherDegree) * bend + rounding * reach + cone;
  if (IsSeparated(control, margin))
  {
    return Verdict::None;
  }
  return !isGuess && cone == 0.0 && IsInjective(control, margin) ? Verdict::AtMostOne
                                                                 : Verdict::Unknown;
}

//------------------------------------------------------------------------------
bool PatchRoots::IsDeepest(const Triangle& triangle) const
{
  const double nearest = *std::min_element(triangle.Nearest.begin(), triangle.Nearest.end());
  return triangle.Size <= std::ldexp(this->Shape.GetSize(), -DeepestLevel) &&
    (triangle.Size <= std::ldexp(this->Shape.GetSize(), -LastLevel) ||
      std::ldexp(triangle.Size, DeepestLevel) <= nearest);
}

//------------------------------------------------------------------------------
void PatchRoots::Search(const Triangle& triangle)
{
  const bool isDeepest = this->IsDeepest(triangle);
  const bool isLast = isDeepest || this->Divisions >= MostDivisions;
  // At the last level a cone is as small as the resolution of Newton's method.
  const Verdict verdict = Judge(triangle, isLast ? 0.0 : this->BoundCone(triangle));
  if (verdict == Verdict::None)
  {
    return;
  }
  if (!isLast && verdict == Verdict::Unknown)
  {
    this->Divide(triangle);
    return;
  }
  const bool isAnswered = this->TakeRoot(triangle);
  if (!isLast && !isAnswered)
  {
    this->Divide(triangle);
    return;
  }
  // At the deepest level two roots are one within SameRoot; above it, there may be any number.
  this->Complete = this->Complete && isAnswered && (isDeepest || verdict == Verdict::AtMostOne);
}

//------------------------------------------------------------------------------
// Returns false if Newton's method gives no answer. A root just outside the triangle is an answer:
// there is none inside.
bool PatchRoots::TakeRoot(const Triangle& triangle)
{
  const glm::dvec2 u = triangle.F[1] - triangle.F[0];
  const glm::dvec2 v = triangle.F[2] - triangle.F[0];
  const double determinant = Cross(u, v);
  double s = Cross(-triangle.F[0], v) / determinant;
  double t = Cross(u, -triangle.F[0]) / determinant;
  if (!(std::min({ s, t, 1.0 - s - t }) > -1.0))
  {
    s = 1.0 / 3.0;
    t = 1.0 / 3.0;
  }
  const glm::dvec2 side1 = triangle.B[1] - triangle.B[0];
  const glm::dvec2 side2 = triangle.B[2] - triangle.B[0];
  const SightRoot root =
    this->Equation.Solve(this->Patch, triangle.B[0] + s * side1 + t * side2, NewtonSteps, 2.0);
  if (root.End != SightRoot::End::Converged)
  {
    return false;
  }
  const double area = Cross(side1, side2);
  const glm::dvec2 inside(
    Cross(root.B - triangle.B[0], side2) / area, Cross(side1, root.B - triangle.B[0]) / area);
  // Newton's method may have converged to another root far away; the map is known near the triangle
  // only.
  if (FindOutside(inside).Least < -FarthestRoot)
  {
    return false;
  }
  // The border of a triangle is as wide as the facet's, whatever the triangle's size.
  const double border = PatchCrossings::Border / std::sqrt(std::fabs(area));
  if (FindOutside(inside).Least >= -border && FindOutside(root.B).Least >= -PatchCrossings::Border)
  {
    this->Add(root);
  }
  return true;
}

//------------------------------------------------------------------------------
void PatchRoots::Divide(const Triangle& triangle)
{
  const double nearest = *std::min_element(triangle.Nearest.begin(), triangle.Nearest.end());
  this->Divisions += triangle.Size <= nearest ? 1 : 0;
  std::size_t corner = 0;
  if (this->Shape.IsSlender({ triangle.B[0], triangle.B[1], triangle.B[2] }, corner))
  {
    this->Halve(triangle, corner);
  }
  else
  {
    this->Quarter(triangle);
  }
}

//------------------------------------------------------------------------------
// Two children on both sides of the line from a corner to the middle of the opposite edge.
void PatchRoots::Halve(const Triangle& t, std::size_t corner)
{
  const std::size_t i = (corner + 1) % 3;
  const std::size_t j = (corner + 2) % 3;
  const glm::dvec2 middle = 0.5 * (t.B[corner] + t.B[corner + 3]);
  const auto copy = [&t](std::size_t from, Triangle& child, std::size_t to)
  {
    child.B[to] = t.B[from];
    child.F[to] = t.F[from];
    child.Nearest[to] = t.Nearest[from];
  };
  for (const bool isFirst : { true, false })
  {
    // The corner, and the ends of a half of the edge.
    Triangle child;
    copy(corner, child, 0);
    copy(isFirst ? i : corner + 3, child, 1);
    copy(isFirst ? corner + 3 : j, child, 2);
    copy(isFirst ? j + 3 : i + 3, child, isFirst ? 5 : 4);
    child.B[3] = 0.5 * (child.B[1] + child.B[2]);
    child.B[isFirst ? 4 : 5] = middle;
    this->Evaluate(child, 3);
    this->Evaluate(child, isFirst ? 4 : 5);
    child.Size = this->Shape.MeasureSize({ child.B[0], child.B[1], child.B[2] });
    this->Search(child);
  }
}

//------------------------------------------------------------------------------
void PatchRoots::Quarter(const Triangle& t)
{
  // Three children at the corners, and one in the middle whose corners are the midpoints of the
  // edges.
  Triangle middle;
  for (std::size_t k = 0; k < 3; ++k)
  {
    middle.B[k] = t.B[k + 3];
    middle.F[k] = t.F[k + 3];
    middle.Nearest[k] = t.Nearest[k + 3];
  }
  for (std::size_t k = 0; k < 3; ++k)
  {
    middle.B[k + 3] = 0.5 * (middle.B[(k + 1) % 3] + middle.B[(k + 2) % 3]);
    this->Evaluate(middle, k + 3);
  }
  middle.Size = 0.5 * t.Size;
  this->Search(middle);
  for (std::size_t k = 0; k < 3; ++k)
  {
    const std::size_t i = (k + 1) % 3;
    const std::size_t j = (k + 2) % 3;
    Triangle child;
    child.B = { t.B[k], t.B[j + 3], t.B[i + 3], middle.B[k + 3], 0.5 * (t.B[k] + t.B[i + 3]),
      0.5 * (t.B[k] + t.B[j + 3]) };
    child.F = { t.F[k], t.F[j + 3], t.F[i + 3], middle.F[k + 3] };
    child.Nearest = { t.Nearest[k], t.Nearest[j + 3], t.Nearest[i + 3], middle.Nearest[k + 3] };
    this->Evaluate(child, 4);
    this->Evaluate(child, 5);
    child.Size = 0.5 * t.Size;
    this->Search(child);
  }
}

//------------------------------------------------------------------------------
void PatchRoots::Add(const SightRoot& root)
{
  const double nearest = std::sqrt(this->Equation.GetSquaredDistance(root.At.Position));
  const double same = SameRoot * std::min(1.0, nearest / this->Shape.GetSize());
  for (const SightRoot& other : *this)
  {
    if (std::max(std::fabs(root.B.x - other.B.x), std::fabs(root.B.y - other.B.y)) < same)
    {
      return;
    }
  }
  if (this->Count == Capacity)
  {
    this->Complete = false;
    return;
  }
  this->Roots[this->Count++] = root;
}

}
