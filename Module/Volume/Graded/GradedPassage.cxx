// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Graded/GradedPassage.h"

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
  if (face < 0 && this->Cell.IsFlat)
  {
    // The ray is in the cell's plane, or the cell has no area: any way out is as good.
    face = static_cast<int>(Scatter(step) % 4);
    time = 0.0;
  }
  return face;
}

//------------------------------------------------------------------------------
int GradedPassage::FindExit(std::int64_t step, bool atRandom, double shortTime, double& time)
{
  time = Infinity;
  const int face = this->ChooseExit(step, atRandom, shortTime, time);
  return this->IsCurved && time > 0.0 ? this->FollowCurve(face, time) : face;
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
/** True if the ray has passed a face, by more than rounding. */
bool GradedPassage::IsBeyond(int i) const
{
  const double weight = this->WeightOfWay(i);
  return weight < 0.0 &&
    weight <
    -Rounding * (this->Begin.Weights[i] + SizeOf(this->Cell.Gradients[i]) * SizeOf(this->EndWay));
}

//------------------------------------------------------------------------------
/** Curvature of the parabola that begins alike and has the same weight after a time. */
double GradedPassage::MeanCurvature(int i, double time) const
{
  glm::dvec3 sum(0.0);
  for (int k = this->Order; k > 2; --k)
  {
    sum = time * (sum + this->Terms[static_cast<std::size_t>(k)]);
  }
  return 2.0 * glm::dot(this->Cell.Gradients[i], 0.5 * this->Force + sum);
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
 * Moves from the exit of the parabola to that of the power series: by Newton's method or, if the
 * parabola has led to another face, by parabolas that come nearer.
 */
int GradedPassage::FollowCurve(int face, double& time)
{
  constexpr int attempts = 24;
  if (face < 0)
  {
    time = 2.0 * std::sqrt(this->Cell.SquaredSize / glm::dot(this->Momentum, this->Momentum));
  }
  const double reach = this->Extend(time);
  if (reach < time)
  {
    time = reach;
    face = -1;
  }
  for (int attempt = 0; attempt < attempts && time > 0.0; ++attempt)
  {
    this->MoveTo(time);
    bool isFound = face < 0 || this->Refine(face, time);
    for (int i = 0; i < 4 && isFound; ++i)
    {
      isFound = i == face || !this->IsBeyond(i);
    }
    if (isFound)
    {
      break;
    }
    double nearest = reach;
    int next = -1;
    for (int i = 0; i < 4; ++i)
    {
      const double reached =
        TimeToZero(this->Begin.Weights[i], this->Rates[i], this->MeanCurvature(i, time));
      if (reached < nearest)
      {
        nearest = reached;
        next = i;
      }
    }
    face = next;
    time = nearest;
  }
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
