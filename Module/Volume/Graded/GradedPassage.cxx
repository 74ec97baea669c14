// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Graded/GradedPassage.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace meniscus
{
namespace
{

constexpr double Infinity = std::numeric_limits<double>::infinity();

/**
 * Largest squared momentum that a glide may drop, in units of GlideHeight times the force. A zigzag
 * of the height h has p^2 = 2 h |Force|; the force on the other side of the face may be 8 times as
 * large.
 */
constexpr double LargestDrop = 16.0;

/**
 * Largest weight of a vertex opposite a face that the ray is taken to be on. A cell
 * whose height is 2^-20 of the radius has such a weight at GlideHeight.
 */
constexpr double LargestGlidingWeight = 0x1p-11;

/** Random number of a step, the same on every machine. */
std::uint64_t Scatter(std::int64_t step)
{
  std::uint64_t z = static_cast<std::uint64_t>(step) * 0x9e3779b97f4a7c15u;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  return z ^ (z >> 27);
}

/** Replaces two vectors by their components in one or two faces of a cell. */
void HoldFaces(const GradedCell& cell, int first, int second, glm::dvec3& a, glm::dvec3& b)
{
  if (second < 0)
  {
    const glm::dvec3 normal = glm::normalize(cell.Gradients[first]);
    a -= glm::dot(a, normal) * normal;
    b -= glm::dot(b, normal) * normal;
    return;
  }
  const glm::dvec3 edge = glm::normalize(glm::cross(cell.Gradients[first], cell.Gradients[second]));
  a = glm::dot(a, edge) * edge;
  b = glm::dot(b, edge) * edge;
}

/** 1 / k for the orders of the series. */
struct Inverses
{
  constexpr Inverses()
  {
    for (int k = 1; k < Size; ++k)
    {
      this->Values[k] = 1.0 / k;
    }
  }
  constexpr double operator[](int k) const { return this->Values[k]; }

  static constexpr int Size = GradedPassage::HighestOrder + 4;
  double Values[Size] = {};
};
constexpr Inverses Inverse;

/** binomial(j, k) / binomial(degree, k) for k <= j <= degree. */
struct BernsteinRatios
{
  static constexpr int Size = GradedPassage::HighestOrder + 1;
  using Rows = std::array<std::array<double, Size>, Size>;

  BernsteinRatios()
  {
    for (int degree = 1; degree < Size; ++degree)
    {
      for (int j = 0; j <= degree; ++j)
      {
        double ratio = 1.0;
        for (int k = 0; k <= j; ++k)
        {
          this->Values[degree][j][k] = ratio;
          ratio *= static_cast<double>(j - k) / (degree - k);
        }
      }
    }
  }

  std::array<Rows, Size> Values{};
};

/** Coefficients in Bernstein's basis of a polynomial on [begin, begin + length], and its degree. */
struct BernsteinPart
{
  std::array<double, GradedPassage::HighestOrder + 1> Values;
  double Begin;
  double Length;
};

/** The first half; the part becomes the second one (de Casteljau). */
BernsteinPart Split(BernsteinPart& part, int degree)
{
  BernsteinPart first = part;
  for (int k = 1; k <= degree; ++k)
  {
    for (int j = degree; j >= k; --j)
    {
      first.Values[j] = 0.5 * (first.Values[j - 1] + first.Values[j]);
    }
    part.Values[degree - k] = first.Values[degree];
  }
  first.Length = part.Length *= 0.5;
  part.Begin += part.Length;
  return first;
}

/**
 * Smallest number in [0, 1) from which on a polynomial is below 0; 1 if there is none. A polynomial
 * is between the smallest and the largest of its coefficients in Bernstein's basis.
 * @param coefficients of the powers, the first of which is >= 0.
 */
double FirstFall(const double* coefficients, int degree)
{
  // No polynomial falls below the sum of its negative terms at 1 and of its first one.
  double least = coefficients[0];
  for (int k = 1; k <= degree; ++k)
  {
    least += std::min(coefficients[k], 0.0);
  }
  if (least > 0.0)
  {
    return 1.0;
  }
  // Halves of the interval down to the rounding of its end.
  constexpr int depth = 52;
  std::array<BernsteinPart, depth + 1> parts;
  BernsteinPart& whole = parts[0];
  whole.Begin = 0.0;
  whole.Length = 1.0;
  whole.Values.fill(0.0);
  static const BernsteinRatios ratios;
  const BernsteinRatios::Rows& ofDegree = ratios.Values[static_cast<std::size_t>(degree)];
  for (int j = 0; j <= degree; ++j)
  {
    for (int k = 0; k <= j; ++k)
    {
      whole.Values[j] += ofDegree[j][k] * coefficients[k];
    }
  }
  for (int last = 0; last >= 0; --last)
  {
    while (true)
    {
      BernsteinPart& part = parts[last];
      const auto end = part.Values.begin() + degree + 1;
      if (std::all_of(part.Values.begin(), end, [](double value) { return value >= 0.0; }))
      {
        break;
      }
      if (part.Values[0] < 0.0 || last == depth)
      {
        return part.Begin;
      }
      const BernsteinPart first = Split(part, degree);
      parts[++last] = first;
    }
  }
  return 1.0;
}

/** Sum of the sizes of a vector's components. */
double SizeOf(const glm::dvec3& v)
{
  return std::abs(v.x) + std::abs(v.y) + std::abs(v.z);
}

}

//------------------------------------------------------------------------------
GradedPassage::GradedPassage(
  const GradedCell& cell, const PlaceInCell& begin, const glm::dvec3& momentum, bool isBent)
  : Cell(cell)
  , Begin(begin)
  , IsCurved(isBent && cell.IsCurved && !cell.IsFlat)
  , Momentum(momentum)
  , Force(isBent ? cell.GetForce(begin.Weights) : glm::dvec3(0.0))
{
  this->SetRates();
}

//------------------------------------------------------------------------------
void GradedPassage::SetRates()
{
  if (this->Cell.IsFlat)
  {
    this->SetFlatRates();
    return;
  }
  for (int i = 0; i < 4; ++i)
  {
    this->Rates[i] = this->IsHeld[i] ? 0.0 : glm::dot(this->Cell.Gradients[i], this->Momentum);
    this->HalfCurvatures[i] =
      this->IsHeld[i] ? 0.0 : 0.5 * glm::dot(this->Cell.Gradients[i], this->Force);
  }
  // A ray that has entered by a face moves away from it or along it.
  if (this->Begin.Entry >= 0)
  {
    double& rate = this->Rates[static_cast<std::size_t>(this->Begin.Entry)];
    rate = std::max(rate, 0.0);
  }
}

//------------------------------------------------------------------------------
/**
 * Sets the rates in a flat cell, which is passed at one place: to its other side or, for a ray that
 * begins in it, to that ahead. The areas of the faces alone count, not the angle to the cell's
 * plane, which may be 0.
 */
void GradedPassage::SetFlatRates()
{
  const auto& normals = this->Cell.Gradients;
  const glm::dvec3 normal = this->Cell.GetWidestNormal();
  const double onward = this->Begin.Entry >= 0 ? glm::dot(normals[this->Begin.Entry], normal) : 0.0;
  const double side = onward != 0.0 ? onward : glm::dot(this->Momentum, normal);
  const double size = std::copysign(glm::dot(normal, normal), side);
  for (int i = 0; i < 4; ++i)
  {
    this->Rates[i] = size != 0.0 ? glm::dot(normals[i], normal) / size : 0.0;
    this->HalfCurvatures[i] = 0.0;
  }
}

//------------------------------------------------------------------------------
bool GradedPassage::Hold(int constraints)
{
  if (this->Cell.IsFlat || this->Begin.Entry < 0)
  {
    return false;
  }
  double least = LargestDrop * GlideHeight * glm::length(this->Cell.GetForce(this->Begin.Weights));
  int faces[2] = { -1, -1 };
  const glm::dvec3 momentum = this->Momentum;
  const glm::dvec3 force = this->Force;
  const auto attempt = [&](int first, int second)
  {
    glm::dvec3 heldMomentum = momentum;
    glm::dvec3 heldForce = force;
    HoldFaces(this->Cell, first, second, heldMomentum, heldForce);
    const glm::dvec3 dropped = momentum - heldMomentum;
    if (glm::dot(dropped, dropped) <= least)
    {
      least = glm::dot(dropped, dropped);
      this->Momentum = heldMomentum;
      this->Force = heldForce;
      faces[0] = first;
      faces[1] = second;
    }
  };
  for (int i = 0; i < 4; ++i)
  {
    if (this->Begin.Weights[i] > LargestGlidingWeight)
    {
      continue;
    }
    if (constraints == 1)
    {
      attempt(i, -1);
    }
    for (int k = i + 1; k < 4 && constraints == 2; ++k)
    {
      if (this->Begin.Weights[k] <= LargestGlidingWeight)
      {
        attempt(i, k);
      }
    }
  }
  for (const int face : faces)
  {
    if (face >= 0)
    {
      this->IsHeld[face] = true;
      this->IsCurved = false;
    }
  }
  this->SetRates();
  return faces[0] >= 0;
}

//------------------------------------------------------------------------------
/** Chooses the exit of the parabola. */
int GradedPassage::ChooseExit(
  std::int64_t step, bool atRandom, double shortTime, double& time) const
{
  const auto& weights = this->Begin.Weights;
  const auto& rates = this->Rates;
  const auto& halves = this->HalfCurvatures;
  int face = -1;
  std::uint64_t best = 0;
  for (int i = 0; i < 4; ++i)
  {
    // A quadratic is above its tangent if it bends upwards, and has no zero before a place at which
    // it is positive if it bends downwards.
    if (face >= 0 && !atRandom &&
      weights[i] + time * (rates[i] + time * std::min(halves[i], 0.0)) > 0.0)
    {
      continue;
    }
    const double reached = TimeToZero(weights[i], rates[i], 2.0 * halves[i]);
    const bool random = atRandom && reached <= shortTime;
    const std::uint64_t rank = random ? Scatter(4 * step + i) | 1 : 0;
    if (reached < Infinity && (face < 0 || rank > best || (best == 0 && reached < time)))
    {
      face = i;
      time = reached;
      best = rank;
    }
  }
  if (face < 0 && (this->Cell.IsFlat || !this->IsCurved))
  {
    // The cell has no area, or its rates are rounding: any face at which the ray is leads on.
    const int first = static_cast<int>(Scatter(step) % 4);
    face = first;
    for (int i = 1; i < 4; ++i)
    {
      const int other = (first + i) % 4;
      face = weights[other] < weights[face] ? other : face;
    }
    time = 0.0;
  }
  return face;
}

//------------------------------------------------------------------------------
int GradedPassage::FindExit(std::int64_t step, bool atRandom, double shortTime, double& time)
{
  time = Infinity;
  const int face = this->ChooseExit(step, atRandom, shortTime, time);
  const bool isRandom = atRandom && time <= shortTime;
  return this->IsCurved && time > 0.0 && !isRandom ? this->FollowCurve(face, time) : face;
}

//------------------------------------------------------------------------------
/**
 * Computes the terms of the series that count within a time. Returns that time, or the one that the
 * series reaches.
 */
double GradedPassage::Extend(double time)
{
  // The sum of the sizes of the columns is at least the norm.
  const glm::dmat3 columns = this->Cell.GetForceDerivative();
  double norm = 0.0;
  for (int axis = 0; axis < 3; ++axis)
  {
    norm = std::max(norm, SizeOf(columns[axis]));
  }
  this->Norm = norm;
  double exponent = norm * time * time;
  if (exponent > LargestExponent)
  {
    time = std::sqrt(LargestExponent / norm);
    exponent = LargestExponent;
  }
  this->Order = 2;
  glm::dvec3 odd = this->Momentum;
  glm::dvec3 even = 0.5 * this->Force;
  // Terms of the orders k + 1 and k + 2 are at most this share of those of the orders 1 and 2.
  double share = exponent / 6.0;
  while (share > 0.5 * Rounding && this->Order < HighestOrder)
  {
    const int k = this->Order;
    odd =
      Inverse[k] * Inverse[k + 1] * (odd.x * columns[0] + odd.y * columns[1] + odd.z * columns[2]);
    even = Inverse[k + 1] * Inverse[k + 2] *
      (even.x * columns[0] + even.y * columns[1] + even.z * columns[2]);
    this->Terms[static_cast<std::size_t>(k + 1)] = odd;
    this->Terms[static_cast<std::size_t>(k + 2)] = even;
    this->Order += 2;
    share *= exponent * Inverse[k + 2] * Inverse[k + 3];
  }
  return time;
}

//------------------------------------------------------------------------------
void GradedPassage::MoveTo(double time)
{
  if (time == this->EndTime)
  {
    return;
  }
  glm::dvec3 way(0.0);
  glm::dvec3 change(0.0);
  for (int k = this->Order; k > 2; --k)
  {
    const glm::dvec3& term = this->Terms[static_cast<std::size_t>(k)];
    way = time * (way + term);
    change = time * (change + static_cast<double>(k) * term);
  }
  this->EndTime = time;
  this->EndWay = time * (this->Momentum + time * (0.5 * this->Force + way));
  this->EndMomentum = this->Momentum + time * (this->Force + change);
}

//------------------------------------------------------------------------------
double GradedPassage::WeightOfWay(int i) const
{
  return this->Begin.Weights[i] + glm::dot(this->Cell.Gradients[i], this->EndWay);
}

//------------------------------------------------------------------------------
/**
 * True if it is certain that no weight falls below 0 before a time at which that of a face does.
 *
 * Without its terms from the third order on, a weight is above the smaller of its tangent and its
 * chord, which both begin at 0 or above; its rate is between the rates at the beginning and at the
 * end. The terms are largest at the end. The sum of their absolute values there bounds how much
 * they change the weight before the end, and again at the end; their rates are bounded likewise.
 */
bool GradedPassage::IsFirst(int face, double time) const
{
  const glm::dvec3 way = time * (glm::abs(this->Momentum) + time * glm::abs(this->Force));
  for (int i = 0; i < 4; ++i)
  {
    const glm::dvec3& gradient = this->Cell.Gradients[i];
    double higher = 0.0;
    double higherRate = 0.0;
    double power = time * time;
    for (int k = 3; k <= this->Order; ++k)
    {
      power *= time;
      const double term = power * std::abs(glm::dot(gradient, this->Terms[k]));
      higher += term;
      higherRate += k * term;
    }
    const double rounding = Rounding * glm::dot(glm::abs(gradient), way);
    if (i == face)
    {
      const double rate = time * glm::dot(gradient, this->EndMomentum);
      if (std::max(time * this->Rates[i], rate) > -(2.0 * higherRate + rounding))
      {
        return false;
      }
    }
    else if (std::min(this->Begin.Weights[i] + time * this->Rates[i], this->WeightOfWay(i)) <
      2.0 * higher + rounding)
    {
      return false;
    }
  }
  return true;
}

//------------------------------------------------------------------------------
/** Searches the first face that the power series passes before a time, which is lowered. */
int GradedPassage::SearchExit(double& time) const
{
  int face = -1;
  for (int i = 0; i < 4; ++i)
  {
    std::array<double, HighestOrder + 1> weight{};
    weight[0] = this->Begin.Weights[i];
    weight[1] = time * this->Rates[i];
    weight[2] = time * time * this->HalfCurvatures[i];
    double power = time * time;
    for (int k = 3; k <= this->Order; ++k)
    {
      power *= time;
      weight[k] = power * glm::dot(this->Cell.Gradients[i], this->Terms[k]);
    }
    const double share = FirstFall(weight.data(), this->Order);
    if (share < 1.0)
    {
      time *= share;
      face = i;
    }
  }
  return face;
}

//------------------------------------------------------------------------------
/**
 * Moves to the zero of a weight near a time by Newton's method. Returns false if there is none
 * near.
 */
bool GradedPassage::Refine(int face, double& time)
{
  constexpr int steps = 8;
  const glm::dvec3& gradient = this->Cell.Gradients[face];
  const double size = this->Begin.Weights[face] + SizeOf(gradient) * SizeOf(this->EndWay);
  double at = time;
  for (int step = 0; step < steps; ++step)
  {
    const double rest = this->WeightOfWay(face);
    const double rate = glm::dot(gradient, this->EndMomentum);
    if (!(rate < 0.0))
    {
      return false;
    }
    const double change = rest / rate;
    at -= change;
    if (!(at > 0.0 && at < 2.0 * time))
    {
      return false;
    }
    this->MoveTo(at);
    if (std::abs(change) <= LastChange * at || std::abs(rest) <= Rounding * size)
    {
      time = at;
      return true;
    }
  }
  return false;
}

//------------------------------------------------------------------------------
/**
 * Moves from the exit of the parabola to that of the power series: by Newton's method or, if it is
 * not certain that no face was passed before, by a search for the first one.
 */
int GradedPassage::FollowCurve(int face, double& time)
{
  const double reach = this->Extend(1.5 *
    (face < 0 ? 2.0 * std::sqrt(this->Cell.SquaredSize / glm::dot(this->Momentum, this->Momentum))
              : time));
  if (face >= 0 && time < reach)
  {
    this->MoveTo(time);
    if (this->Refine(face, time) && time <= reach && this->IsFirst(face, time))
    {
      return face;
    }
  }
  time = reach;
  face = this->SearchExit(time);
  this->MoveTo(time);
  return face;
}

//------------------------------------------------------------------------------
std::array<double, 4> GradedPassage::GetWeights(int face) const
{
  std::array<double, 4> weights;
  double sum = 0.0;
  const double time = this->EndTime;
  for (int i = 0; i < 4; ++i)
  {
    const double weight = this->Order > 2
      ? this->WeightOfWay(i)
      : this->Begin.Weights[i] + time * (this->Rates[i] + time * this->HalfCurvatures[i]);
    weights[i] = i == face ? 0.0 : std::max(weight, 0.0);
    sum += weights[i];
  }
  // 1 / sum, without a division if it is that to rounding.
  const double excess = sum - 1.0;
  const double scale = std::abs(excess) < 0x1p-27 ? 1.0 - excess : 1.0 / sum;
  for (double& weight : weights)
  {
    weight *= scale;
  }
  return weights;
}

//------------------------------------------------------------------------------
double GradedPassage::GetLargestForce(double time) const
{
  // The force is Force + A way, and the way at most 1.2 times its terms of the first two orders:
  // with the exponent E of the series, at most 0.7, sinh(sqrt(E)) / sqrt(E) is at most 1.13, and
  // 2 (cosh(sqrt(E)) - 1) / E at most 1.06. A way without a series has a constant force.
  const double force = glm::length(this->Force);
  return force + 1.2 * this->Norm * time * (glm::length(this->Momentum) + 0.5 * time * force);
}

//------------------------------------------------------------------------------
double GradedPassage::IntegrateSquare(double square) const
{
  // With y = place - x: d(p y)/ds = n^2 + y grad(n^2) / 2, and n^2 = square + 2 Force y + y A y.
  // The integrals of y A y cancel.
  const double time = this->EndTime;
  glm::dvec3 mean(0.0);
  for (int k = this->Order; k > 2; --k)
  {
    mean = time * (mean + Inverse[k + 1] * this->Terms[static_cast<std::size_t>(k)]);
  }
  mean = time * time * (0.5 * this->Momentum + time * (this->Force / 6.0 + mean));
  return 0.5 *
    (square * time + glm::dot(this->Force, mean) + glm::dot(this->EndMomentum, this->EndWay));
}

}
