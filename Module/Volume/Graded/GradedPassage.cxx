// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Graded/GradedPassage.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
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

/** Rounding of a sum of a few numbers, relative to the largest of them. */
constexpr double Rounding = 0x1p-51;

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
    this->WeightTerms[1][i] =
      this->IsHeld[i] ? 0.0 : glm::dot(this->Cell.Gradients[i], this->Momentum);
    this->WeightTerms[2][i] =
      this->IsHeld[i] ? 0.0 : 0.5 * glm::dot(this->Cell.Gradients[i], this->Force);
  }
  // A ray that has entered by a face moves away from it or along it.
  if (this->Begin.Entry >= 0)
  {
    this->WeightTerms[1][this->Begin.Entry] =
      std::max(this->WeightTerms[1][this->Begin.Entry], 0.0);
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
  const auto& rates = this->WeightTerms[1];
  const auto& halves = this->WeightTerms[2];
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
  const double rounding = 0.5 * Rounding * SizeOf(this->Momentum);
  double power = time;
  bool isSmall[2] = { false, false };
  this->Order = 2;
  while (this->Order < HighestOrder && !(isSmall[0] && isSmall[1]))
  {
    const int k = ++this->Order;
    power *= time;
    const glm::dvec3 term = 0.5 / (k * (k - 1.0)) *
      this->Cell.AddGradients(this->Cell.ApplyEdges(this->WeightTerms[k - 2]));
    this->Terms[k] = term;
    for (int i = 0; i < 4; ++i)
    {
      this->WeightTerms[k][i] = glm::dot(this->Cell.Gradients[i], term);
    }
    // Even and odd terms are two series.
    isSmall[k % 2] = SizeOf(term) * power <= rounding;
  }
  // Without both small, the series reaches so far that its last terms are small.
  for (int k = this->Order - 1; !(isSmall[0] && isSmall[1]) && k <= this->Order; ++k)
  {
    const double size = SizeOf(this->Terms[k]);
    time = std::min(time, std::pow(rounding / size, 1.0 / (k - 1)));
  }
  return time;
}

//------------------------------------------------------------------------------
double GradedPassage::WeightAfter(int i, double time) const
{
  double sum = this->WeightTerms[this->Order][i];
  for (int k = this->Order - 1; k > 0; --k)
  {
    sum = sum * time + this->WeightTerms[k][i];
  }
  return this->Begin.Weights[i] + time * sum;
}

//------------------------------------------------------------------------------
double GradedPassage::RateAfter(int i, double time) const
{
  double sum = this->Order * this->WeightTerms[this->Order][i];
  for (int k = this->Order - 1; k > 0; --k)
  {
    sum = sum * time + k * this->WeightTerms[k][i];
  }
  return sum;
}

//------------------------------------------------------------------------------
/** Curvature of the parabola that begins alike and has the same weight after a time. */
double GradedPassage::MeanCurvature(int i, double time) const
{
  double sum = this->WeightTerms[this->Order][i];
  for (int k = this->Order - 1; k > 1; --k)
  {
    sum = sum * time + this->WeightTerms[k][i];
  }
  return 2.0 * sum;
}

//------------------------------------------------------------------------------
/** Moves the time to the zero of a weight by Newton's method. Returns false if there is none near.
 */
bool GradedPassage::Refine(int face, double& time) const
{
  constexpr int steps = 8;
  // The error of a step is about the square of the change: this one is the last.
  constexpr double lastChange = 0x1p-27;
  const double weight = this->Begin.Weights[face];
  double at = time;
  for (int step = 0; step < steps; ++step)
  {
    const double rest = this->WeightAfter(face, at);
    const double rate = this->RateAfter(face, at);
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
    const double size = weight + at * std::abs(this->WeightTerms[1][face]);
    if (std::abs(change) <= lastChange * at || std::abs(rest) <= Rounding * size)
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
  for (int attempt = 0; attempt < attempts; ++attempt)
  {
    bool isFound = face < 0 || this->Refine(face, time);
    for (int i = 0; i < 4 && isFound; ++i)
    {
      isFound = i == face || this->WeightAfter(i, time) >= 0.0;
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
        TimeToZero(this->Begin.Weights[i], this->WeightTerms[1][i], this->MeanCurvature(i, time));
      if (reached < nearest)
      {
        nearest = reached;
        next = i;
      }
    }
    face = next;
    time = nearest;
    if (time == 0.0)
    {
      break;
    }
  }
  return face;
}

//------------------------------------------------------------------------------
std::array<double, 4> GradedPassage::WeightsAfter(double time, int face) const
{
  std::array<double, 4> weights;
  double sum = 0.0;
  for (int i = 0; i < 4; ++i)
  {
    weights[i] = i == face ? 0.0 : std::max(this->WeightAfter(i, time), 0.0);
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
glm::dvec3 GradedPassage::MomentumAfter(double time) const
{
  glm::dvec3 sum(0.0);
  for (int k = this->Order; k > 2; --k)
  {
    sum = time * (sum + static_cast<double>(k) * this->Terms[k]);
  }
  return this->Momentum + time * (this->Force + sum);
}

//------------------------------------------------------------------------------
double GradedPassage::IntegrateSquare(double time, double square) const
{
  // With y = place - x: d(p y)/ds = n^2 + y grad(n^2) / 2, and n^2 = square + 2 Force y + y A y.
  // The integrals of y A y cancel.
  glm::dvec3 way(0.0);
  glm::dvec3 mean(0.0);
  for (int k = this->Order; k > 2; --k)
  {
    way = time * (way + this->Terms[k]);
    mean = time * (mean + this->Terms[k] / (k + 1.0));
  }
  way = time * (this->Momentum + time * (0.5 * this->Force + way));
  mean = time * time * (0.5 * this->Momentum + time * (this->Force / 6.0 + mean));
  return 0.5 *
    (square * time + glm::dot(this->Force, mean) + glm::dot(this->MomentumAfter(time), way));
}

}
