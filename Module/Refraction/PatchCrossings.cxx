// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Refraction/PatchCrossings.h"

#include <algorithm>
#include <cmath>

namespace meniscus
{
namespace
{

// Derivatives that differ from those in the middle by less than 1, relative to these, make X
// injective. A little less, for rounding.
constexpr double LargestSlope = 0.95;

// Newton's method converges in three or four steps from there, or rounding forbids it.
constexpr int NewtonSteps = 12;

// Quadratic convergence leaves the square of the last step, in parts.
constexpr double LastStep = 1e-6;

double Cross(const glm::dvec2& a, const glm::dvec2& b)
{
  return a.x * b.y - a.y * b.x;
}

/// A function of b near the middle of a part: bounds of itself and its derivatives.
struct Bounds
{
  double value;
  double first;
  double second;
};

/// Bounds of a polynomial of third degree within `reach` (sum of absolute values) of a place, from
/// its largest derivatives there.
Bounds Extend(double value, double first, double second, double third, double reach)
{
  return { value + reach * (first + reach * (second / 2.0 + reach * third / 6.0)),
    first + reach * (second + reach * third / 2.0), second + reach * third };
}

/// Bounds of g = 2 q / (l (1 + l)) for bounds of q and of the normal n with l = |n| >= shortest.
/// The derivatives of 1 / (l + l^2) are -(1 + 2 l) / (l + l^2)^2 and
/// 2 (1 + 3 l + 3 l^2) / (l + l^2)^3; those of l are at most |n'| and |n''| + |n'|^2 / l.
Bounds BoundShift(const Bounds& q, const Bounds& n, double shortest)
{
  const double l = shortest;
  const double product = l * (1.0 + l);
  const double psi = 1.0 / product;
  const double psiFirst = (1.0 + 2.0 * l) * psi * psi;
  const double psiSecond = 2.0 * (1.0 + 3.0 * l * (1.0 + l)) * psi * psi * psi;
  const double lFirst = n.first;
  const double lSecond = n.second + n.first * n.first / l;
  const double byFirst = psiFirst * lFirst;
  return { 2.0 * q.value * psi, 2.0 * (q.first * psi + q.value * byFirst),
    2.0 *
      (q.second * psi + 2.0 * q.first * byFirst +
        q.value * (psiSecond * lFirst * lFirst + psiFirst * lSecond)) };
}

/// Bounds of a product's derivatives.
Bounds Multiply(const Bounds& g, const Bounds& n)
{
  return { g.value * n.value, g.first * n.value + g.value * n.first,
    g.second * n.value + 2.0 * g.first * n.first + g.value * n.second };
}

/// The normal's derivatives; the second ones are constant.
struct NormalJet
{
  glm::dvec3 value;
  glm::dvec3 first[2];
  glm::dvec3 second[3];

  NormalJet(const CurvedPatch& patch, const glm::dvec2& b)
    : value(patch.GetNormal(b))
  {
    const double c = 1.0 - b.x - b.y;
    this->first[0] = patch.normal[1] - patch.normal[0] + b.y * (patch.bend[0] - patch.bend[1]) +
      (c - b.x) * patch.bend[2];
    this->first[1] = patch.normal[2] - patch.normal[0] + b.x * (patch.bend[0] - patch.bend[2]) +
      (c - b.y) * patch.bend[1];
    this->second[0] = -2.0 * patch.bend[2];
    this->second[1] = patch.bend[0] - patch.bend[1] - patch.bend[2];
    this->second[2] = -2.0 * patch.bend[1];
  }

  /// Bounds within `reach`; `length` measures vectors.
  template <typename Length>
  Bounds Bound(double reach, const Length& length) const
  {
    return Extend(length(this->value), std::max(length(this->first[0]), length(this->first[1])),
      std::max({ length(this->second[0]), length(this->second[1]), length(this->second[2]) }), 0.0,
      reach);
  }
};

/// Bounds of q within `reach` of b.
/// With p_k = b_i b_j and r_k = b_i - b_j, q is the sum of s_k p_k + d_k p_k r_k over the edges.
Bounds BoundForm(const CurvedPatch& patch, const glm::dvec2& b, double reach)
{
  const double c = 1.0 - b.x - b.y;
  const double at[3] = { c, b.x, b.y };
  // Derivatives of the barycentric coordinates by b.x and b.y.
  constexpr double by[3][2] = { { -1.0, -1.0 }, { 1.0, 0.0 }, { 0.0, 1.0 } };
  double value = 0.0;
  double first[2] = { 0.0, 0.0 };
  double second[3] = { 0.0, 0.0, 0.0 };
  double third = 0.0;
  for (int k = 0; k < 3; ++k)
  {
    const int i = (k + 1) % 3;
    const int j = (k + 2) % 3;
    const double s = patch.symmetric[k];
    const double d = patch.asymmetric[k];
    const double p = at[i] * at[j];
    const double r = at[i] - at[j];
    double pBy[2];
    double rBy[2];
    for (int m = 0; m < 2; ++m)
    {
      pBy[m] = by[i][m] * at[j] + at[i] * by[j][m];
      rBy[m] = by[i][m] - by[j][m];
      first[m] += s * pBy[m] + d * (pBy[m] * r + p * rBy[m]);
    }
    value += p * (s + d * r);
    constexpr int pairs[3][2] = { { 0, 0 }, { 0, 1 }, { 1, 1 } };
    for (int m = 0; m < 3; ++m)
    {
      const int u = pairs[m][0];
      const int v = pairs[m][1];
      const double pByBoth = by[i][u] * by[j][v] + by[i][v] * by[j][u];
      second[m] += s * pByBoth + d * (pByBoth * r + pBy[u] * rBy[v] + pBy[v] * rBy[u]);
    }
    // |d p_k / du dv| is 2 at most, |d r_k / du| as well, and there are three ways to choose u.
    third += 12.0 * std::fabs(d);
  }
  return Extend(std::fabs(value), std::max(std::fabs(first[0]), std::fabs(first[1])),
    std::max({ std::fabs(second[0]), std::fabs(second[1]), std::fabs(second[2]) }), third, reach);
}

}

//------------------------------------------------------------------------------
PatchCrossings::PatchCrossings(const CurvedPatch& patch, const HeightFrame& frame)
  : Patch(patch)
  , Frame(frame)
{
  const glm::dvec3 winding =
    glm::cross(patch.corner[1] - patch.corner[0], patch.corner[2] - patch.corner[0]);
  this->Front =
    glm::dot(winding, patch.normal[0] + patch.normal[1] + patch.normal[2]) < 0.0 ? -1 : 1;
  this->IsFlat = true;
  double reach = 0.0;
  for (int k = 0; k < 3; ++k)
  {
    reach = std::max(reach, glm::length(patch.corner[k]));
    this->IsFlat = this->IsFlat && patch.symmetric[k] == 0.0 && patch.asymmetric[k] == 0.0;
  }
  // A position is a sum of a dozen products of such numbers, three of which make a coordinate.
  this->Rounding = 16.0 * std::numeric_limits<double>::epsilon() * reach;
}

//------------------------------------------------------------------------------
void PatchCrossings::Find(const glm::dvec2& place, double low, double high)
{
  this->Place = place;
  this->Count = 0;
  this->HighestOpen = std::numeric_limits<double>::lowest();
  // Each level leaves three more parts than it takes.
  std::array<Part, 3 * DeepestLevel + 4> parts;
  std::size_t waiting = 0;
  int divisions = 0;
  parts[waiting++] = { { this->MakeCorner({ 0.0, 0.0 }), this->MakeCorner({ 1.0, 0.0 }),
                         this->MakeCorner({ 0.0, 1.0 }) },
    0 };
  while (waiting > 0)
  {
    const Part part = parts[--waiting];
    if (this->Settle(part, low, high) == Verdict::Settled)
    {
      continue;
    }
    if (part.level == DeepestLevel || divisions == MostDivisions)
    {
      this->MarkOpen(part);
      continue;
    }
    ++divisions;
    std::array<Corner, 3> middle; // opposite to the corners
    for (std::size_t k = 0; k < 3; ++k)
    {
      middle[k] = this->MakeCorner(0.5 * (part.corner[(k + 1) % 3].b + part.corner[(k + 2) % 3].b));
    }
    for (std::size_t k = 0; k < 3; ++k)
    {
      std::array<Corner, 3> corner = middle;
      corner[k] = part.corner[k];
      // The corner's part is wound as the whole: middles of the two sides at the corner.
      corner[(k + 1) % 3] = middle[(k + 2) % 3];
      corner[(k + 2) % 3] = middle[(k + 1) % 3];
      parts[waiting++] = { corner, part.level + 1 };
    }
    parts[waiting++] = { middle, part.level + 1 };
  }
}

//------------------------------------------------------------------------------
PatchCrossings::Corner PatchCrossings::MakeCorner(const glm::dvec2& b) const
{
  const glm::dvec3 position = this->Patch.Evaluate(b).position;
  return { b, this->Frame.Project(position) - this->Place, this->Frame.GetHeight(position) };
}

//------------------------------------------------------------------------------
// The linear interpolant of a function f over corners v_i is off by at most the sum of
// w_i |f''[v_i - b, v_i - b]| / 2. With second derivatives by b.x and b.y of at most B that is
// B / 2 times the sum of w_i |v_i - b|^2, distances as sums of absolute values, which is s^2 at
// most (in the middle of the longest side). The same with first derivatives only, H, gives H s:
// that holds where the normal's length is cut off at ShortestNormal, too, and second derivatives
// jump. Derivatives differ from those in the middle by B times the distance from it, or by 2 H.
PatchCrossings::Deviation PatchCrossings::BoundDeviation(const Part& part) const
{
  const double s = std::ldexp(1.0, -part.level);
  const glm::dvec2 middle = (part.corner[0].b + part.corner[1].b + part.corner[2].b) / 3.0;
  PatchJet at;
  this->Patch.Evaluate(middle, at);
  Deviation result{ this->Rounding, this->Rounding, 2.0 * this->Rounding,
    { s * this->Frame.Project(at.positionBy[0]), s * this->Frame.Project(at.positionBy[1]) } };
  if (this->IsFlat)
  {
    return result;
  }
  const double reach = (1.0 + Reach) * s; // of a corner from the middle, and beyond
  const NormalJet jet(this->Patch, middle);
  const Bounds normal = jet.Bound(reach, [](const glm::dvec3& v) { return glm::length(v); });
  const Bounds across =
    jet.Bound(reach, [this](const glm::dvec3& v) { return glm::length(this->Frame.Project(v)); });
  const Bounds along =
    jet.Bound(reach, [this](const glm::dvec3& v) { return std::fabs(this->Frame.GetHeight(v)); });
  const double length = glm::length(jet.value);
  const double shortest = length - (normal.value - length);
  const bool isSmooth = shortest > CurvedPatch::ShortestNormal;
  const Bounds shift = BoundShift(
    BoundForm(this->Patch, middle, reach), normal, std::max(shortest, CurvedPatch::ShortestNormal));
  const Bounds acrossBy = Multiply(shift, across);
  const Bounds alongBy = Multiply(shift, along);
  const auto interpolate = [s, isSmooth](const Bounds& h)
  { return isSmooth ? std::min(0.5 * s * s * h.second, s * h.first) : s * h.first; };
  const double slope = 2.0 * s * acrossBy.first;
  result.across += interpolate(acrossBy);
  result.along += interpolate(alongBy);
  result.slope += isSmooth ? std::min(reach * s * acrossBy.second, slope) : slope;
  return result;
}

//------------------------------------------------------------------------------
// Whether the line is farther than `reach` from the triangle of the corners: beyond one of its
// sides, or, if it is next to a segment, beyond an end of the longest side.
bool PatchCrossings::IsSeparated(const Part& part, double reach)
{
  const auto& c = part.corner;
  const double area = Cross(c[1].x - c[0].x, c[2].x - c[0].x);
  const double sign = area < 0.0 ? -1.0 : 1.0;
  glm::dvec2 longest(0.0);
  double squared = 0.0;
  for (std::size_t k = 0; k < 3; ++k)
  {
    const glm::dvec2& from = c[(k + 1) % 3].x;
    const glm::dvec2 side = c[(k + 2) % 3].x - from;
    const double length = glm::dot(side, side);
    if (sign * Cross(from, side) < -reach * std::sqrt(length))
    {
      return true;
    }
    if (length > squared)
    {
      squared = length;
      longest = side;
    }
  }
  const double slack = reach * std::sqrt(squared);
  double low = std::numeric_limits<double>::max();
  double high = std::numeric_limits<double>::lowest();
  for (const Corner& corner : c)
  {
    const double at = glm::dot(longest, corner.x);
    low = std::min(low, at);
    high = std::max(high, at);
  }
  return low > slack || high < -slack;
}

//------------------------------------------------------------------------------
PatchCrossings::Verdict PatchCrossings::Settle(const Part& part, double low, double high)
{
  const auto& c = part.corner;
  const Deviation deviation = this->BoundDeviation(part);
  if (std::min({ c[0].height, c[1].height, c[2].height }) - deviation.along > high ||
    std::max({ c[0].height, c[1].height, c[2].height }) + deviation.along < low ||
    IsSeparated(part, deviation.across))
  {
    return Verdict::Settled;
  }
  const glm::dvec2& u = deviation.middle[0];
  const glm::dvec2& v = deviation.middle[1];
  // By Cramer's rule the inverse of these takes a vector to one no longer than this times it, as a
  // sum of absolute values. Written so that a NaN fails.
  return (glm::length(u) + glm::length(v)) * deviation.slope <=
        LargestSlope * std::fabs(Cross(u, v)) &&
      this->TakeRoot(part)
    ? Verdict::Settled
    : Verdict::Unknown;
}

//------------------------------------------------------------------------------
// False if Newton's method does not converge to a place where X is known to be injective.
bool PatchCrossings::TakeRoot(const Part& part)
{
  const auto& c = part.corner;
  const double s = std::ldexp(1.0, -part.level);
  const glm::dvec2 first = c[1].x - c[0].x;
  const glm::dvec2 second = c[2].x - c[0].x;
  const double whole = Cross(first, second);
  glm::dvec2 b = c[0].b + (Cross(second, c[0].x) / whole) * (c[1].b - c[0].b) +
    (Cross(c[0].x, first) / whole) * (c[2].b - c[0].b);
  PatchJet jet;
  for (int i = 0; i < NewtonSteps; ++i)
  {
    this->Patch.Evaluate(b, jet);
    const glm::dvec2 x = this->Frame.Project(jet.position) - this->Place;
    const glm::dvec2 u = this->Frame.Project(jet.positionBy[0]);
    const glm::dvec2 v = this->Frame.Project(jet.positionBy[1]);
    const double area = Cross(u, v);
    const glm::dvec2 move(Cross(v, x) / area, Cross(x, u) / area);
    b += move;
    // In the part's coordinates, along the facet's two sides or against them.
    const glm::dvec2 away = (b - c[0].b) / (c[1].b.x - c[0].b.x);
    // Two coordinates may be negative. Written so that a NaN fails.
    if (!(FindOutside(away).least >= -0.5 * Reach))
    {
      return false;
    }
    if (std::max(std::fabs(move.x), std::fabs(move.y)) >= LastStep * s)
    {
      continue;
    }
    const double outside = FindOutside(b).least;
    if (outside < -Border)
    {
      return true; // the root is beyond the patch
    }
    if (this->Count == Capacity)
    {
      return false;
    }
    const double height =
      this->Frame.GetHeight(jet.position + move.x * jet.positionBy[0] + move.y * jet.positionBy[1]);
    this->Crossings[this->Count++] = { height, area < 0.0 ? -this->Front : this->Front, outside };
    return true;
  }
  return false;
}

//------------------------------------------------------------------------------
void PatchCrossings::MarkOpen(const Part& part)
{
  const double along = this->BoundDeviation(part).along;
  for (const Corner& corner : part.corner)
  {
    this->HighestOpen = std::max(this->HighestOpen, corner.height + along);
  }
}

}
