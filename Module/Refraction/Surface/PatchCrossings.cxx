// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Refraction/Surface/PatchCrossings.h"

#include "Refraction/Membrane/CrossProduct.h"

#include <algorithm>
#include <cmath>

namespace meniscus
{
namespace
{

// A map X is injective if its derivatives differ from given ones by less than 1, relative to these.
// The bound is a little smaller to allow for rounding.
constexpr double LargestSlope = 0.95;

// Newton's method converges in three or four steps from such a start, unless rounding prevents it.
constexpr int NewtonSteps = 12;

constexpr double Largest(const std::array<double, 3>& values)
{
  return std::max({ values[0], values[1], values[2] });
}

// A map is injective if its derivatives along two sides differ from vectors u and v by less than
// these as matrices. Let U and V bound the differences. By Cramer's rule, in coordinates along u
// and v, the first difference is at most U |v| and U |u|, divided by |u x v|, and the second one is
// at most V |v| and V |u|. With the coordinates multiplied by U and V, both differences are at most
// U |v| + V |u|, as sums of absolute values: that over |u x v| bounds the norm of the matrix.
double Deflect(double u, double v, double byU, double byV)
{
  return byU * v + byV * u;
}

/**
 * Bounds of the magnitude of a function and of its first and second derivatives along the edges.
 */
struct Bounds
{
  double Value = 0.0;
  std::array<double, 3> First{};
  std::array<double, 3> Second{};
};

/** Bounds of the product of two functions. */
Bounds Multiply(const Bounds& f, const Bounds& g)
{
  Bounds result;
  result.Value = f.Value * g.Value;
  for (std::size_t k = 0; k < 3; ++k)
  {
    result.First[k] = f.First[k] * g.Value + f.Value * g.First[k];
    result.Second[k] =
      f.Second[k] * g.Value + 2.0 * f.First[k] * g.First[k] + f.Value * g.Second[k];
  }
  return result;
}

/** A triangle around a part: its three corners, then the midpoints of its edges. */
using Around = std::array<glm::dvec2, 6>;

/**
 * Control points of the function of second degree with the given values at the corners and edge
 * midpoints.
 */
std::array<double, 6> GetControls(const std::array<double, 6>& f)
{
  return { f[0], f[1], f[2], 2.0 * f[3] - 0.5 * (f[1] + f[2]), 2.0 * f[4] - 0.5 * (f[2] + f[0]),
    2.0 * f[5] - 0.5 * (f[0] + f[1]) };
}

/** Gradient of q by b.x and b.y. */
glm::dvec2 GetFormGradient(const CurvedPatch& patch, const glm::dvec2& b)
{
  const double c = 1.0 - b.x - b.y;
  const double* s = patch.Symmetric;
  const double* d = patch.Asymmetric;
  const double bc[3] = { b.x * b.y, b.y * c, c * b.x };
  const double form[3] = { s[0] + d[0] * (b.x - b.y), s[1] + d[1] * (b.y - c),
    s[2] + d[2] * (c - b.x) };
  return { b.y * (form[0] - form[1]) + (c - b.x) * form[2] + bc[0] * d[0] + bc[1] * d[1] -
      2.0 * bc[2] * d[2],
    b.x * (form[0] - form[2]) + (c - b.y) * form[1] - bc[0] * d[0] + 2.0 * bc[1] * d[1] -
      bc[2] * d[2] };
}

double GetForm(const CurvedPatch& patch, const glm::dvec2& b)
{
  const double c = 1.0 - b.x - b.y;
  return b.x * b.y * (patch.Symmetric[0] + patch.Asymmetric[0] * (b.x - b.y)) +
    b.y * c * (patch.Symmetric[1] + patch.Asymmetric[1] * (b.y - c)) +
    c * b.x * (patch.Symmetric[2] + patch.Asymmetric[2] * (c - b.x));
}

/**
 * Bounds of q over a triangle whose sides are `size` times those of the facet. The derivatives of q
 * along edges are of second degree and within their control points; the second derivatives are
 * differences of control points. No point is farther from the middle than two thirds of the edges.
 */
Bounds BoundForm(const CurvedPatch& patch, const Around& around, double size)
{
  std::array<glm::dvec2, 6> gradient;
  std::transform(around.begin(), around.end(), gradient.begin(),
    [&patch](const glm::dvec2& b) { return GetFormGradient(patch, b); });
  Bounds result;
  for (std::size_t k = 0; k < 3; ++k)
  {
    const std::size_t i = (k + 1) % 3;
    const std::size_t j = (k + 2) % 3;
    const glm::dvec2 edge = (around[j] - around[i]) / size;
    std::array<double, 6> along;
    std::transform(gradient.begin(), gradient.end(), along.begin(),
      [&edge](const glm::dvec2& g) { return glm::dot(g, edge); });
    const std::array<double, 6> c = GetControls(along);
    for (const double control : c)
    {
      result.First[k] = std::max(result.First[k], std::fabs(control));
    }
    result.Second[k] = 2.0 / size *
      std::max(
        { std::fabs(c[k + 3] - c[i]), std::fabs(c[j] - c[k + 3]), std::fabs(c[i + 3] - c[j + 3]) });
  }
  const glm::dvec2 middle = (around[0] + around[1] + around[2]) / 3.0;
  result.Value = std::fabs(GetForm(patch, middle)) + 2.0 / 3.0 * size * Largest(result.First);
  return result;
}

/** Values of the normal at corners, control points of edges, and derivatives along the edges. */
struct NormalControls
{
  std::array<glm::dvec3, 6> Control;
  std::array<std::array<glm::dvec3, 2>, 3> First; ///< by edge, at its two ends
  std::array<glm::dvec3, 3> Opposite;             ///< by edge, at the other corner
  std::array<glm::dvec3, 3> Second;

  NormalControls(const CurvedPatch& patch, const Around& around, double size)
  {
    for (std::size_t k = 0; k < 3; ++k)
    {
      this->Control[k] = patch.GetNormal(around[k]);
      this->Second[k] = -2.0 * patch.Bend[k];
    }
    for (std::size_t k = 0; k < 3; ++k)
    {
      this->Control[k + 3] = 0.5 * (this->Control[(k + 1) % 3] + this->Control[(k + 2) % 3]) -
        0.25 * size * size * this->Second[k];
    }
    for (std::size_t k = 0; k < 3; ++k)
    {
      const std::size_t i = (k + 1) % 3;
      const std::size_t j = (k + 2) % 3;
      const double inverse = 2.0 / size;
      this->First[k] = { inverse * (this->Control[k + 3] - this->Control[i]),
        inverse * (this->Control[j] - this->Control[k + 3]) };
      this->Opposite[k] = inverse * (this->Control[i + 3] - this->Control[j + 3]);
    }
  }

  /** `square` returns the squared length of a vector. */
  template <typename Square>
  Bounds Bound(const Square& square) const
  {
    Bounds result;
    for (const glm::dvec3& c : this->Control)
    {
      result.Value = std::max(result.Value, square(c));
    }
    result.Value = std::sqrt(result.Value);
    for (std::size_t k = 0; k < 3; ++k)
    {
      result.First[k] = std::sqrt(std::max(
        { square(this->First[k][0]), square(this->First[k][1]), square(this->Opposite[k]) }));
      result.Second[k] = std::sqrt(square(this->Second[k]));
    }
    return result;
  }

  /** Lower bound of the normal's length, if positive. */
  double GetShortest() const
  {
    const glm::dvec3 along = glm::normalize(this->Control[0] + this->Control[1] + this->Control[2]);
    double shortest = std::numeric_limits<double>::max();
    for (const glm::dvec3& c : this->Control)
    {
      shortest = std::min(shortest, glm::dot(c, along));
    }
    return shortest;
  }
};

/**
 * Bounds of 2 / (l + l^2) with l = |n| >= shortest. Its derivatives by l are
 * -2 (1 + 2 l) / (l + l^2)^2 and 4 (1 + 3 l + 3 l^2) / (l + l^2)^3; those of l are at most |n'|
 * and |n''| + |n'|^2 / l.
 */
Bounds BoundFactor(const Bounds& normal, double shortest)
{
  const double l = shortest;
  const double inverse = 1.0 / (l * (1.0 + l));
  const double byLength = 2.0 * (1.0 + 2.0 * l) * inverse * inverse;
  const double byLengthTwice = 4.0 * (1.0 + 3.0 * l * (1.0 + l)) * inverse * inverse * inverse;
  Bounds result;
  result.Value = 2.0 * inverse;
  for (std::size_t k = 0; k < 3; ++k)
  {
    const double first = normal.First[k];
    result.First[k] = byLength * first;
    result.Second[k] =
      byLengthTwice * first * first + byLength * (normal.Second[k] + first * first / l);
  }
  return result;
}

}

//------------------------------------------------------------------------------
PatchCrossings::PatchCrossings(const CurvedPatch& patch, const HeightFrame& frame)
  : Patch(patch)
  , Frame(frame)
{
  const glm::dvec3 winding =
    glm::cross(patch.Corner[1] - patch.Corner[0], patch.Corner[2] - patch.Corner[0]);
  this->Front =
    glm::dot(winding, patch.Normal[0] + patch.Normal[1] + patch.Normal[2]) < 0.0 ? -1 : 1;
  this->IsFlat = true;
  double reach = 0.0;
  for (int k = 0; k < 3; ++k)
  {
    reach = std::max(reach, glm::length(patch.Corner[k]));
    this->IsFlat = this->IsFlat && patch.Symmetric[k] == 0.0 && patch.Asymmetric[k] == 0.0;
  }
  // A position is a sum of a dozen products of such numbers, three of which make one coordinate.
  this->Rounding = 16.0 * std::numeric_limits<double>::epsilon() * reach;
}

//------------------------------------------------------------------------------
void PatchCrossings::Find(const glm::dvec2& place, double low, double high)
{
  this->Place = place;
  this->Count = 0;
  this->HighestOpen = std::numeric_limits<double>::lowest();
  // Each level adds three more parts than it removes.
  std::array<Part, 3 * DeepestLevel + 4> parts;
  std::size_t waiting = 0;
  int divisions = 0;
  parts[waiting++] = { { this->MakeCorner({ 0.0, 0.0 }), this->MakeCorner({ 1.0, 0.0 }),
                         this->MakeCorner({ 0.0, 1.0 }) },
    1.0, Bend::Unknown(), Bend::Unknown() };
  while (waiting > 0)
  {
    Part part = parts[--waiting];
    if (this->Settle(part, low, high) == Verdict::Settled)
    {
      continue;
    }
    if (part.Size <= SmallestPart || divisions == MostDivisions)
    {
      this->MarkOpen(part);
      continue;
    }
    ++divisions;
    std::array<Corner, 3> middle; // opposite the corners
    for (std::size_t k = 0; k < 3; ++k)
    {
      middle[k] =
        this->MakeCorner(0.5 * (part.Corners[(k + 1) % 3].B + part.Corners[(k + 2) % 3].B));
    }
    for (std::size_t k = 0; k < 3; ++k)
    {
      std::array<Corner, 3> corner = middle;
      corner[k] = part.Corners[k];
      // The part at a corner has the winding of the whole: its other corners are the midpoints of
      // the two sides at the corner.
      corner[(k + 1) % 3] = middle[(k + 2) % 3];
      corner[(k + 2) % 3] = middle[(k + 1) % 3];
      parts[waiting++] = { corner, 0.5 * part.Size, part.Across, part.Along };
    }
    parts[waiting++] = { middle, 0.5 * part.Size, part.Across, part.Along };
  }
}

//------------------------------------------------------------------------------
// As in IsInjective, for the whole patch: projected along the line, the facet's sides are no longer
// than before, and its area is divided by the slant.
// The two sides are chosen that give the best bound.
double PatchCrossings::GetLargestSlant(const CurvedPatch& patch, const BySide& bend)
{
  const glm::dvec3 edge[3] = { patch.Corner[2] - patch.Corner[1], patch.Corner[0] - patch.Corner[2],
    patch.Corner[1] - patch.Corner[0] };
  const double length[3] = { glm::length(edge[0]), glm::length(edge[1]), glm::length(edge[2]) };
  const double deflection = std::min({ Deflect(length[0], length[1], bend[0], bend[1]),
    Deflect(length[1], length[2], bend[1], bend[2]),
    Deflect(length[2], length[0], bend[2], bend[0]) });
  return LargestSlope * glm::length(glm::cross(edge[0], edge[1])) / deflection;
}

//------------------------------------------------------------------------------
double PatchCrossings::GetLargestSlant()
{
  Part whole{ { Corner{ { 0.0, 0.0 }, {}, 0.0 }, Corner{ { 1.0, 0.0 }, {}, 0.0 },
                Corner{ { 0.0, 1.0 }, {}, 0.0 } },
    1.0, Bend::Unknown(), Bend::Unknown() };
  this->BoundDeflection(whole);
  for (double& bend : whole.Along.First)
  {
    bend += 2.0 * this->Rounding;
  }
  return GetLargestSlant(this->Patch, whole.Along.First);
}

//------------------------------------------------------------------------------
// The rule for products, with bounds of sums: within Reach of the triangle barycentric coordinates
// are in [-0.1, 1.2] and differ by 1.3 at most, the products of two are in [-0.12, 0.3], and the
// sum of their absolute values is 1.4. Along side k, from corner i to corner j, b_j grows and b_i
// falls by 1: the derivative of q is
//
//   s_k (b_i - b_j) + d_k ((b_i - b_j)^2 - 2 b_i b_j) + b_k (s_i - s_j)
//     + d_i b_k (b_j - b_k + b_j) + d_j b_k (b_i - b_k + b_i)
//
// and that of n is N_j - N_i + m_k (b_i - b_j) + b_k (m_i - m_j), with 4 m for m.
double PatchCrossings::BoundLargestSlant(const CurvedPatch& patch)
{
  const double* s = patch.Symmetric;
  const double* d = patch.Asymmetric;
  const double q = 0.3 * (std::fabs(s[0]) + std::fabs(s[1]) + std::fabs(s[2])) +
    0.3 * 1.3 * (std::fabs(d[0]) + std::fabs(d[1]) + std::fabs(d[2]));
  const auto sum = [](const glm::dvec3& v)
  { return std::fabs(v.x) + std::fabs(v.y) + std::fabs(v.z); };
  double bends = 0.0;
  BySide turn;
  BySide qBy;
  BySide nBy;
  for (std::size_t k = 0; k < 3; ++k)
  {
    const std::size_t i = (k + 1) % 3;
    const std::size_t j = (k + 2) % 3;
    qBy[k] = 1.3 * std::fabs(s[k]) + (1.3 * 1.3 + 2.0 * 0.3) * std::fabs(d[k]) +
      1.2 * std::fabs(s[i] - s[j]) + (1.2 * 1.3 + 0.3) * (std::fabs(d[i]) + std::fabs(d[j]));
    turn[k] = glm::length(patch.Normal[j] - patch.Normal[i]);
    nBy[k] = turn[k] + 1.3 * sum(patch.Bend[k]) + 1.2 * sum(patch.Bend[i] - patch.Bend[j]);
    bends += sum(patch.Bend[k]);
  }
  const double n = 1.4 + 0.3 * bends;
  const double l = std::max(1.0 - 1.4 * Largest(turn) - 0.3 * bends, CurvedPatch::ShortestNormal);
  const double factor = 2.0 / (l * (1.0 + l));
  const double factorBy = 0.5 * (1.0 + 2.0 * l) * factor * factor;
  BySide bend;
  for (std::size_t k = 0; k < 3; ++k)
  {
    bend[k] = factor * (qBy[k] * n + q * nBy[k]) + factorBy * nBy[k] * q * n;
  }
  return GetLargestSlant(patch, bend);
}

//------------------------------------------------------------------------------
PatchCrossings::Corner PatchCrossings::MakeCorner(const glm::dvec2& b) const
{
  const glm::dvec3 position = this->Patch.Evaluate(b).Position;
  return { b, this->Frame.Project(position) - this->Place, this->Frame.GetHeight(position) };
}

//------------------------------------------------------------------------------
// The linear interpolant of a function over an equilateral triangle of side s has an error of at
// most s^2 / 6 times the function's largest second derivative in any direction (half of the squared
// radius of the circumscribed circle). If the second derivatives along the three sides are at most
// M, those in any direction are at most 5 M / 3. If the first derivatives along the sides are at
// most H, the error is at most H s: that bound also holds where the normal's length is cut off at
// ShortestNormal and second derivatives jump. An affine map makes any triangle equilateral.
double PatchCrossings::Bend::GetDeviation(double size) const
{
  return std::min(5.0 / 18.0 * size * size * this->Second, size * Largest(this->First));
}

//------------------------------------------------------------------------------
PatchCrossings::Bend PatchCrossings::Bend::Unknown()
{
  constexpr double any = std::numeric_limits<double>::infinity();
  return { { any, any, any }, any };
}

//------------------------------------------------------------------------------
// Bounds the deflection over the part and its surroundings within Reach.
void PatchCrossings::BoundDeflection(Part& part) const
{
  if (this->IsFlat)
  {
    part.Across = part.Along = { { 0.0, 0.0, 0.0 }, 0.0 };
    return;
  }
  constexpr double widened = 1.0 + 3.0 * Reach;
  const double size = widened * part.Size;
  const glm::dvec2 middle = (part.Corners[0].B + part.Corners[1].B + part.Corners[2].B) / 3.0;
  Around around;
  for (std::size_t k = 0; k < 3; ++k)
  {
    around[k] = middle + widened * (part.Corners[k].B - middle);
  }
  for (std::size_t k = 0; k < 3; ++k)
  {
    around[k + 3] = 0.5 * (around[(k + 1) % 3] + around[(k + 2) % 3]);
  }
  const NormalControls controls(this->Patch, around, size);
  const double shortest = controls.GetShortest();
  const bool isSmooth = shortest > CurvedPatch::ShortestNormal;
  const Bounds normal = controls.Bound([](const glm::dvec3& v) { return glm::dot(v, v); });
  const Bounds across = controls.Bound(
    [this](const glm::dvec3& v)
    {
      const glm::dvec2 seen = this->Frame.Project(v);
      return glm::dot(seen, seen);
    });
  const Bounds shift = Multiply(BoundForm(this->Patch, around, size),
    BoundFactor(normal, std::max(shortest, CurvedPatch::ShortestNormal)));
  const auto bend = [isSmooth](const Bounds& h) {
    return Bend{ h.First, isSmooth ? Largest(h.Second) : std::numeric_limits<double>::infinity() };
  };
  part.Across = bend(Multiply(shift, across));
  part.Along = bend(Multiply(shift, normal));
}

//------------------------------------------------------------------------------
// True if the line is farther than `reach` from the triangle of the corners: beyond one of its
// sides or, if the triangle is nearly a segment, beyond an end of the longest side.
bool PatchCrossings::IsSeparated(const Part& part, double reach)
{
  const auto& c = part.Corners;
  const double area = Cross(c[1].X - c[0].X, c[2].X - c[0].X);
  const double sign = area < 0.0 ? -1.0 : 1.0;
  glm::dvec2 longest(0.0);
  double squared = 0.0;
  for (std::size_t k = 0; k < 3; ++k)
  {
    const glm::dvec2& from = c[(k + 1) % 3].X;
    const glm::dvec2 side = c[(k + 2) % 3].X - from;
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
    const double at = glm::dot(longest, corner.X);
    low = std::min(low, at);
    high = std::max(high, at);
  }
  return low > slack || high < -slack;
}

//------------------------------------------------------------------------------
// True if the line does not meet the part at the heights of interest.
bool PatchCrossings::IsPassed(const Part& part, double low, double high) const
{
  const auto& c = part.Corners;
  const double along = part.Along.GetDeviation(part.Size) + this->Rounding;
  return std::min({ c[0].Height, c[1].Height, c[2].Height }) - along > high ||
    std::max({ c[0].Height, c[1].Height, c[2].Height }) + along < low ||
    IsSeparated(part, part.Across.GetDeviation(part.Size) + this->Rounding);
}

//------------------------------------------------------------------------------
PatchCrossings::Verdict PatchCrossings::Settle(Part& part, double low, double high)
{
  // The test with the bounds of the whole patch is the cheapest.
  if (this->IsPassed(part, low, high))
  {
    return Verdict::Settled;
  }
  this->BoundDeflection(part);
  return this->IsPassed(part, low, high) || (this->IsInjective(part) && this->TakeRoot(part))
    ? Verdict::Settled
    : Verdict::Unknown;
}

//------------------------------------------------------------------------------
// True if the derivatives differ from those of the facet, or from those in the middle of the part,
// by less than these as matrices.
//
// A derivative along a side differs from the one in the middle by at most 2 H, and by at most M
// times the size: mixed derivatives along two sides are at most 3 M / 2, by the derivative along
// the difference of the sides, and no point is farther from the middle than two thirds of the
// sides.
bool PatchCrossings::IsInjective(const Part& part) const
{
  // The comparisons are written so that a NaN fails.
  const double rounding = 2.0 * this->Rounding / part.Size; // of differences
  const auto dominates = [this, rounding](const glm::dvec3& first, const glm::dvec3& second,
                           double byFirst, double bySecond)
  {
    const glm::dvec2 u = this->Frame.Project(first);
    const glm::dvec2 v = this->Frame.Project(second);
    return Deflect(glm::length(u), glm::length(v), byFirst + rounding, bySecond + rounding) <=
      LargestSlope * std::fabs(Cross(u, v));
  };
  // From corner 0, along sides 2 and 1.
  const BySide& bend = part.Across.First;
  if (dominates(this->Patch.Corner[1] - this->Patch.Corner[0],
        this->Patch.Corner[2] - this->Patch.Corner[0], bend[2], bend[1]))
  {
    return true;
  }
  PatchJet middle;
  this->Patch.Evaluate((part.Corners[0].B + part.Corners[1].B + part.Corners[2].B) / 3.0, middle);
  constexpr double widened = 1.0 + 3.0 * Reach;
  const double change = widened * part.Size * part.Across.Second;
  return dominates(middle.PositionBy[0], middle.PositionBy[1], std::min(change, 2.0 * bend[2]),
    std::min(change, 2.0 * bend[1]));
}

//------------------------------------------------------------------------------
// Returns false if Newton's method does not converge to a place where X is known to be injective.
bool PatchCrossings::TakeRoot(const Part& part)
{
  const auto& c = part.Corners;
  const glm::dvec2 first = c[1].X - c[0].X;
  const glm::dvec2 second = c[2].X - c[0].X;
  const double whole = Cross(first, second);
  glm::dvec2 b = c[0].B + (Cross(second, c[0].X) / whole) * (c[1].B - c[0].B) +
    (Cross(c[0].X, first) / whole) * (c[2].B - c[0].B);
  PatchJet jet;
  for (int i = 0; i < NewtonSteps; ++i)
  {
    this->Patch.Evaluate(b, jet);
    const glm::dvec2 x = this->Frame.Project(jet.Position) - this->Place;
    const glm::dvec2 u = this->Frame.Project(jet.PositionBy[0]);
    const glm::dvec2 v = this->Frame.Project(jet.PositionBy[1]);
    const double area = Cross(u, v);
    const glm::dvec2 move(Cross(v, x) / area, Cross(x, u) / area);
    b += move;
    // In the part's coordinates, along the facet's two sides or against them.
    const glm::dvec2 away = (b - c[0].B) / (c[1].B.x - c[0].B.x);
    // Written so that a NaN fails.
    if (!(FindOutside(away).Least >= -Reach))
    {
      return false;
    }
    if (std::max(std::fabs(move.x), std::fabs(move.y)) >= LastStep * part.Size)
    {
      continue;
    }
    const double outside = FindOutside(b).Least;
    if (outside < -Border)
    {
      return true; // the root lies outside the patch
    }
    if (this->Count == Capacity)
    {
      return false;
    }
    // The step is so short that the patch is linear within rounding.
    const glm::dvec3 position =
      jet.Position + move.x * jet.PositionBy[0] + move.y * jet.PositionBy[1];
    const glm::dvec3 normal = jet.Normal + move.x * jet.NormalBy[0] + move.y * jet.NormalBy[1];
    this->Crossings[this->Count++] = { this->Frame.GetHeight(position),
      area < 0.0 ? -this->Front : this->Front, outside, normal, b };
    return true;
  }
  return false;
}

//------------------------------------------------------------------------------
void PatchCrossings::MarkOpen(const Part& part)
{
  const double along = part.Along.GetDeviation(part.Size);
  for (const Corner& corner : part.Corners)
  {
    this->HighestOpen = std::max(this->HighestOpen, corner.Height + along);
  }
}

//------------------------------------------------------------------------------
bool IsOnPatch(const CurvedPatch& patch, const glm::dvec3& local, double slack)
{
  const glm::dvec3 away = local - patch.Corner[0];
  const glm::dvec3 first = patch.Corner[1] - patch.Corner[0];
  const glm::dvec3 second = patch.Corner[2] - patch.Corner[0];
  // The patch bulges by less than half of its longest edge, which is below the sum of two.
  if (glm::dot(away, away) > 8.0 * (glm::dot(first, first) + glm::dot(second, second)))
  {
    return false;
  }
  const HeightFrame frame(glm::normalize(glm::cross(first, second)));
  const double height = frame.GetHeight(local);
  PatchCrossings crossings(patch, frame);
  crossings.Find(frame.Project(local), height - slack, height + slack);
  return !crossings.IsComplete() ||
    std::any_of(crossings.begin(), crossings.end(),
      [height, slack](const PatchCrossing& crossing)
      { return std::fabs(crossing.Height - height) <= slack; });
}

//------------------------------------------------------------------------------
bool PassesNear(const std::array<glm::dvec2, 3>& corners, const glm::dvec2& place, double distance)
{
  const double area = Cross(corners[1] - corners[0], corners[2] - corners[0]);
  for (std::size_t k = 0; k < 3; ++k)
  {
    const glm::dvec2& from = corners[(k + 1) % 3];
    const glm::dvec2 side = corners[(k + 2) % 3] - from;
    // Positive inside: distance times the side's length.
    const double inside = std::copysign(1.0, area) * Cross(from - place, side);
    if (inside < 0.0 && inside * inside > distance * distance * glm::dot(side, side))
    {
      return false;
    }
  }
  return true;
}

}
