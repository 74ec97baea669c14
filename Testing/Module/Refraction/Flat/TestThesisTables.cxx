// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// The thesis's own measurements, repeated.
#include "TestBasics.h"
#include "ThesisTables.h"

namespace
{

using namespace meniscus::reference;

double PercentOff(double ours, double printed)
{
  return 100.0 * (ours / printed - 1.0);
}

/**
 * True for the row at the onset of convergence, where 376 of 64,000 points are left: the thesis
 * calls it irregular, since points with several virtual vertices are discarded, by a rule that it
 * does not give.
 */
bool IsIrregular(const meniscus::reference::ThesisRow& row)
{
  return std::strcmp(row.Table, "4.4") == 0 && row.Exterior == 1.4;
}

/** True for the row next to it, whose number of points depends on that rule as well. */
bool HasDiscardedPoints(const meniscus::reference::ThesisRow& row)
{
  return std::strcmp(row.Table, "4.4") == 0 && row.Exterior == 1.8;
}

/** Largest differences of a table's rows from the printed numbers, in per cent. */
struct TableBound
{
  const char* Table;
  double Mean;
  double Deviation;
  double Points;
};

// Measured once and rounded up. The eye low and aside (4.1) and the corners of the square
// hemispheres (4.5) have the largest differences: the thesis does not give their set-up to the
// last detail.
constexpr TableBound Bounds[] = { { "4.1", 6.2, 4.7, 4.1 }, { "4.2", 0.5, 0.8, 1.1 },
  { "4.3", 2.0, 1.5, 1.5 }, { "4.4", 2.1, 4.2, 1.0 }, { "4.5", 4.0, 7.7, 0.0 } };

TableBound BoundOf(const char* table)
{
  for (const TableBound& bound : Bounds)
  {
    if (std::strcmp(bound.Table, table) == 0)
    {
      return bound;
    }
  }
  return {};
}

/** True for the deviation 0.0319 of Table 4.1; Table 4.2 prints 0.0519 for the same row. */
bool HasMisprint(const meniscus::reference::ThesisRow& row)
{
  return row.Deviation == 0.0319;
}

// Every printed number of Tables 4.1 to 4.5, but for the irregular row. The thesis does not say how
// points near the border of the visible volume are treated, and prints rounded numbers: most
// columns agree to a few tenths of a per cent, a few rows only to several.
TEST(RefractionThesis, ReproducesTheTables)
{
  int rows = 0;
  int closeMeans = 0;
  int closeDeviations = 0;
  int printedPoints = 0;
  int closePoints = 0;
  for (const auto& row : GetThesisRows())
  {
    if (IsIrregular(row))
    {
      continue;
    }
    ++rows;
    const TableBound bound = BoundOf(row.Table);
    const auto ours = MeasureThesisRow(row);
    const double mean = PercentOff(ours.Mean, row.Mean);
    const double deviation = HasMisprint(row) ? PercentOff(ours.Deviation, 0.0519)
                                              : PercentOff(ours.Deviation, row.Deviation);
    const auto number = static_cast<double>(ours.Points);
    const double points = row.Points > 0 ? PercentOff(number, row.Points) : 0.0;
    closeMeans += std::fabs(mean) <= 2.0;
    closeDeviations += std::fabs(deviation) <= 2.0;
    printedPoints += row.Points > 0;
    closePoints += row.Points > 0 && std::fabs(points) <= 1.5;
    const auto name = ::testing::Message()
      << "Table " << row.Table << ", h = " << row.EyeHeight << ", offset " << row.EyeOffset
      << ", sphere " << row.SphereRatio << ", " << row.SquareCells << " cells, " << row.Exterior
      << " / " << row.Interior;
    EXPECT_LE(std::fabs(mean), bound.Mean) << name;
    EXPECT_LE(std::fabs(deviation), bound.Deviation) << name;
    EXPECT_LE(std::fabs(points), HasDiscardedPoints(row) ? 15.0 : bound.Points) << name;
  }
  EXPECT_EQ(rows, 53);
  EXPECT_EQ(closeMeans, 44);
  EXPECT_EQ(closeDeviations, 44);
  EXPECT_EQ(printedPoints, 41);
  EXPECT_EQ(closePoints, 36);
}

// The one row that is not reproduced, as Documentation/refraction-measurements.md has it.
TEST(RefractionThesis, TheIrregularRowHasFewPointsAndLargeErrors)
{
  int rows = 0;
  for (const auto& row : GetThesisRows())
  {
    if (IsIrregular(row))
    {
      const auto ours = MeasureThesisRow(row);
      EXPECT_EQ(row.Points, 376);
      EXPECT_EQ(ours.Points, 232u);
      EXPECT_NEAR(PercentOff(ours.Mean, row.Mean), 74.16, 0.01);
      EXPECT_NEAR(PercentOff(ours.Deviation, row.Deviation), 6.33, 0.01);
      ++rows;
    }
  }
  EXPECT_EQ(rows, 1);
}

// Table 4.4 up to the index 1.1, where the membrane still spreads the view, has no such rule.
TEST(RefractionThesis, ReproducesTheHemispheresInEveryColumn)
{
  int rows = 0;
  for (const auto& row : GetThesisRows())
  {
    const bool isHigh = std::strcmp(row.Table, "4.4") == 0 && row.Exterior < 1.4;
    const bool isLow = std::strcmp(row.Table, "4.3") == 0 && row.SphereRatio > 0.0;
    if (isHigh || isLow)
    {
      const auto ours = MeasureThesisRow(row);
      const auto points = static_cast<double>(ours.Points);
      EXPECT_NEAR(ours.Mean / row.Mean, 1.0, 0.001) << row.Exterior << " " << row.Interior;
      EXPECT_NEAR(ours.Deviation / row.Deviation, 1.0, 0.001)
        << row.Exterior << " " << row.Interior;
      EXPECT_NEAR(points / row.Points, 1.0, 0.001) << row.Exterior << " " << row.Interior;
      ++rows;
    }
  }
  EXPECT_EQ(rows, 13);
}

// The set-up of bowls on the axis has no unexplained rule: mean, deviation and number of points can
// be compared.
TEST(RefractionThesis, ReproducesTheBowlsInEveryColumn)
{
  int rows = 0;
  for (const auto& row : GetThesisRows())
  {
    if (std::strcmp(row.Table, "4.2") == 0 && row.SphereRatio > 0.0)
    {
      const auto ours = MeasureThesisRow(row);
      EXPECT_NEAR(ours.Mean / row.Mean, 1.0, 0.002) << row.SphereRatio;
      EXPECT_NEAR(ours.Deviation / row.Deviation, 1.0, 0.01) << row.SphereRatio;
      EXPECT_NEAR(static_cast<double>(ours.Points) / row.Points, 1.0, 0.001) << row.SphereRatio;
      ++rows;
    }
  }
  EXPECT_EQ(rows, 5);
}

}
