// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// The Hilbert curve, and orders in which each point is near the one before.
#include "Common/CoherentOrder.h"
#include "Common/HilbertCurve.h"
#include "TestBasics.h"

using namespace meniscus;

namespace
{

constexpr std::size_t Side = 24;
constexpr std::size_t Count = Side * Side * Side;

/** A grid of points with distance 1, row by row. */
std::vector<double> MakeGrid()
{
  std::vector<double> points;
  for (std::size_t i = 0; i < Count; ++i)
  {
    points.insert(
      points.end(), { double(i % Side), double(i / Side % Side), double(i / (Side * Side)) });
  }
  return points;
}

std::vector<double> Shuffled(const std::vector<double>& points)
{
  std::vector<std::size_t> order(points.size() / 3);
  std::iota(order.begin(), order.end(), std::size_t{ 0 });
  std::shuffle(order.begin(), order.end(), std::mt19937(5));
  std::vector<double> shuffled;
  for (const std::size_t i : order)
  {
    shuffled.insert(shuffled.end(), points.begin() + 3 * i, points.begin() + 3 * i + 3);
  }
  return shuffled;
}

double MeanStep(const std::vector<double>& points, const std::vector<std::uint32_t>& order)
{
  double sum = 0.0;
  for (std::size_t i = 1; i < order.size(); ++i)
  {
    const double* const a = points.data() + 3 * order[i - 1];
    const double* const b = points.data() + 3 * order[i];
    sum += glm::length(glm::dvec3(b[0] - a[0], b[1] - a[1], b[2] - a[2]));
  }
  return sum / static_cast<double>(order.size() - 1);
}

bool HasAllIndices(std::vector<std::uint32_t> order, std::size_t count)
{
  std::sort(order.begin(), order.end());
  for (std::size_t i = 0; i < order.size(); ++i)
  {
    if (order[i] != i)
    {
      return false;
    }
  }
  return order.size() == count;
}

}

TEST(HilbertCurve, VisitsEachCellOnceAndGoesToANeighbour)
{
  // The cells next to the origin are the first of the curve.
  constexpr std::uint32_t side = 32;
  std::vector<glm::ivec3> visited(side * side * side, glm::ivec3(-1));
  for (std::uint32_t i = 0; i < visited.size(); ++i)
  {
    const std::uint32_t cell[3] = { i % side, i / side % side, i / (side * side) };
    const std::uint32_t code = HilbertCode(cell);
    ASSERT_LT(code, visited.size());
    ASSERT_EQ(visited[code].x, -1);
    visited[code] = glm::ivec3(cell[0], cell[1], cell[2]);
  }
  for (std::size_t i = 1; i < visited.size(); ++i)
  {
    const glm::ivec3 step = glm::abs(visited[i] - visited[i - 1]);
    EXPECT_EQ(step.x + step.y + step.z, 1) << i;
  }
}

TEST(HilbertCurve, ClampsToTheBoxAndTakesFlatBoxes)
{
  const HilbertCurve cube(glm::dvec3(-1.0), glm::dvec3(1.0));
  EXPECT_EQ(cube.Code(glm::dvec3(-7.0)), cube.Code(glm::dvec3(-1.0)));
  EXPECT_EQ(cube.Code(glm::dvec3(7.0)), cube.Code(glm::dvec3(1.0)));
  const HilbertCurve flat(glm::dvec3(0.0), glm::dvec3(4.0, 2.0, 0.0));
  EXPECT_NE(flat.Code(glm::dvec3(3.0, 1.0, 0.0)), flat.Code(glm::dvec3(1.0, 1.0, 0.0)));
  const HilbertCurve point(glm::dvec3(2.0), glm::dvec3(2.0));
  EXPECT_EQ(point.Code(glm::dvec3(2.0)), 0u);
  // 1024 cells per 1e-310 are beyond the range of double, and so is the length of the other box.
  const HilbertCurve tiny(glm::dvec3(0.0), glm::dvec3(1e-310));
  EXPECT_EQ(tiny.Code(glm::dvec3(0.0)), 0u);
  EXPECT_EQ(tiny.Code(glm::dvec3(1e-310)), cube.Code(glm::dvec3(1.0)));
  const HilbertCurve vast(glm::dvec3(-1e308), glm::dvec3(1e308));
  EXPECT_EQ(vast.Code(glm::dvec3(1e308)), 0u);
}

TEST(CoherentOrder, RowsOfAGridAreKept)
{
  const std::vector<double> grid = MakeGrid();
  EXPECT_TRUE(FindCoherentOrder(grid.data(), Count).empty());
  EXPECT_TRUE(FindCoherentOrder(grid.data(), 0).empty());
  EXPECT_TRUE(FindCoherentOrder(grid.data(), 1).empty());
  const std::vector<double> same(3 * 500, 2.0);
  EXPECT_TRUE(FindCoherentOrder(same.data(), 500).empty());
}

TEST(CoherentOrder, ScatteredPointsComeWithSmallSteps)
{
  const std::vector<double> points = Shuffled(MakeGrid());
  const std::vector<std::uint32_t> order = FindCoherentOrder(points.data(), Count);
  EXPECT_TRUE(HasAllIndices(order, Count));
  std::vector<std::uint32_t> given(Count);
  std::iota(given.begin(), given.end(), 0u);
  // Points on a line have a mean distance of a third of its length.
  EXPECT_GT(MeanStep(points, given), Side / 3.0);
  // A curve from each point to a neighbour has 1.
  EXPECT_LT(MeanStep(points, order), 1.2);
  // Blocks in reverse, as threads might take them, give the same order.
  const RangeLoop reverse = [](std::size_t count, const RangeBody& body)
  {
    for (std::size_t i = count; i > 0; --i)
    {
      body(i - 1, i);
    }
  };
  EXPECT_EQ(FindCoherentOrder(points.data(), Count, reverse), order);
}

TEST(CoherentOrder, PointsThatAreNotFiniteAreKeptInTheOrder)
{
  std::vector<double> points = Shuffled(MakeGrid());
  points[30] = std::numeric_limits<double>::quiet_NaN();
  points[301] = std::numeric_limits<double>::infinity();
  const std::vector<std::uint32_t> order = FindCoherentOrder(points.data(), Count);
  EXPECT_TRUE(HasAllIndices(order, Count));
  const std::vector<double> all(3 * 64, std::numeric_limits<double>::quiet_NaN());
  EXPECT_TRUE(FindCoherentOrder(all.data(), 64).empty());
}

TEST(CoherentOrder, AnswersGoToThePlacesOfTheirPoints)
{
  const std::vector<double> points = Shuffled(MakeGrid());
  const auto sum = [](const double* some, std::size_t begin, std::size_t end, double* answers)
  {
    for (std::size_t i = begin; i < end; ++i)
    {
      answers[i] = some[3 * i] + 100.0 * some[3 * i + 1] + 10000.0 * some[3 * i + 2];
    }
  };
  std::vector<double> expected(Count);
  sum(points.data(), 0, Count, expected.data());
  const std::vector<std::uint32_t> order = FindCoherentOrder(points.data(), Count);
  ASSERT_FALSE(order.empty());
  std::vector<double> answers(Count, -1.0);
  SolveInOrder<100>(points.data(), order, 0, 1000, answers.data(), sum);
  SolveInOrder<100>(points.data(), order, 1000, Count, answers.data(), sum);
  EXPECT_EQ(answers, expected);
  std::vector<double> given(Count, -1.0);
  SolveInOrder<100>(points.data(), {}, 0, Count, given.data(), sum);
  EXPECT_EQ(given, expected);
}
