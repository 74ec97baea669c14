// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Rows of cells for lanes of bent rays, and the bounds of their steps.
#include "GradedScene.h"

#include "TestBasics.h"
#include "Volume/Graded/GradedCell.h"
#include "Volume/Graded/GradedCellTable.h"
#include "Volume/Graded/GradedPassage.h"

using namespace meniscus;
using namespace meniscus::test;

namespace
{

/** Larger than a bound by what the test itself rounds. */
constexpr double Slack = 1.0 + 1.0e-9;

/** Derivatives of a ray's place by the time, from the first on. */
struct Derivatives
{
  Derivatives(const GradedCell& cell, const std::array<double, 4>& weights,
    const glm::dvec3& direction, const glm::dmat3& matrix)
  {
    this->Values[0] = std::sqrt(cell.GetSquaredIndex(weights)) * direction;
    this->Values[1] = cell.GetForce(weights);
    for (std::size_t k = 2; k < this->Values.size(); ++k)
    {
      this->Values[k] = matrix * this->Values[k - 2];
    }
  }
  /** Sum of the sizes of terms of a component along a vector, or of its rate. */
  double Sum(const glm::dvec3& along, double t, int first, int last, bool isRate) const
  {
    double sum = 0.0;
    for (int k = first; k <= last; ++k)
    {
      sum += std::abs(glm::dot(along, this->Values[static_cast<std::size_t>(k) - 1])) *
        std::pow(t, isRate ? k - 1 : k) / std::tgamma(isRate ? k : k + 1);
    }
    return sum;
  }

  std::array<glm::dvec3, 12> Values;
};

/** Sum of the sizes of the components of a matrix's largest column. */
double NormOf(const glm::dmat3& matrix)
{
  double norm = 0.0;
  for (int axis = 0; axis < 3; ++axis)
  {
    const glm::dvec3 size = glm::abs(matrix[axis]);
    norm = std::max(norm, size.x + size.y + size.z);
  }
  return norm;
}

/** Largest shares of the bounds that were met. */
struct Shares
{
  double Rounding = 0.0;
  double Higher = 0.0;
  double Rate = 0.0;
  double Rest = 0.0;
  double Short = 0.0;

  /** Compares a step of a random ray through a cell with the bounds. */
  void Add(const GradedCell& cell, RandomNumbers& random)
  {
    const glm::dmat3 matrix = cell.GetForceDerivative();
    const GradedStepBounds bounds(cell, NormOf(matrix));
    std::array<double, 4> weights;
    for (double& weight : weights)
    {
      weight = random.Uniform(0.0, 1.0);
    }
    const double sum = (weights[0] + weights[1]) + (weights[2] + weights[3]);
    for (double& weight : weights)
    {
      weight /= sum;
    }
    const Derivatives way(cell, weights, random.GetDirection(), matrix);
    const double speed = glm::length(way.Values[0]);
    const double t = bounds.LongestTime * random.Uniform(0.5, 1.0);
    const double cubic = bounds.Cubic * t * t;
    for (const glm::dvec3& gradient : cell.Gradients)
    {
      this->Note(this->Rounding, 2.0 * GradedPassage::Rounding * speed * glm::length(gradient),
        bounds.Linear);
      this->Note(
        this->Higher, 2.0 * way.Sum(gradient, t, 3, 12, false), t * (bounds.Linear + cubic));
      this->Note(this->Rate, way.Sum(gradient, t, 3, 12, true), 1.25 * cubic);
    }
    for (int axis = 0; axis < 3; ++axis)
    {
      glm::dvec3 unit(0.0);
      unit[axis] = 1.0;
      this->Note(
        this->Rest, way.Sum(unit, t, 6, 12, false), GradedStepBounds::LargestRest * speed * t);
    }
    const double force = glm::length(way.Values[1]);
    const double zigzag =
      std::min(GradedPassage::LongestShare * std::sqrt(cell.SquaredSize) / speed,
        std::sqrt(8.0 * GradedPassage::GlideHeight / force));
    this->Note(this->Short, zigzag, bounds.ShortTime);
  }
  static void Note(double& largest, double value, double bound)
  {
    EXPECT_LE(value, Slack * bound);
    largest = std::max(largest, value / bound);
  }
};

}

TEST(GradedCellRow, PackedNumbersAreRoundedUp)
{
  for (const double first : { 0.0, 1.0, 1.0 + 0x1p-52, 3.7e-9, 2.9e200 })
  {
    for (const double second : { 0.0, 1.0, 7.3e-5, 1.0e300 })
    {
      const double packed = GradedCellRow::PackUpwards(first, second);
      std::uint64_t bits = 0;
      std::memcpy(&bits, &packed, sizeof(bits));
      bits <<= 32;
      double lower = 0.0;
      std::memcpy(&lower, &bits, sizeof(lower));
      EXPECT_GE(packed, first);
      EXPECT_LE(packed, std::max(first * (1.0 + 0x1p-19), 0x1p-1042));
      EXPECT_GE(lower, second);
      EXPECT_LE(lower, second * (1.0 + 0x1p-20));
    }
  }
}

// No bound is exceeded, and each one is met to a good part: by fields of all contrasts.
TEST(GradedStepBounds, StepsKeepWithin)
{
  RandomNumbers random(42);
  Shares shares;
  for (const double contrast : { 1.0e-6, 1.0e-3, 0.3 })
  {
    MeshArrays arrays = KuhnGrid(4);
    JitterInside(arrays, 0.05, random);
    const GradedScene scene(arrays,
      [contrast](const glm::dvec3& p)
      { return 1.0 + contrast * (p.x + std::sin(4.0 * p.y + p.z) + p.z * p.z); });
    const auto cells = static_cast<std::int64_t>(scene.Mesh.GetCells().size());
    for (int i = 0; i < 20000; ++i)
    {
      const GradedCell cell =
        MakeGradedCell(scene.Mesh, scene.Squares, scene.Medium.Terms, i % cells);
      if (!cell.IsFlat)
      {
        shares.Add(cell, random);
      }
    }
  }
  EXPECT_GT(shares.Rounding, 0.9);
  EXPECT_GT(shares.Higher, 0.25);
  EXPECT_GT(shares.Rate, 0.25);
  EXPECT_GT(shares.Rest, 0.05);
  EXPECT_GT(shares.Short, 0.9);
}
