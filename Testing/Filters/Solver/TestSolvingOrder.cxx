// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Objects whose points come in random order are solved along a curve, with the same images.
#include "RefractedGeometryTestHelpers.h"
#include "VTKTestBasics.h"

namespace
{

using namespace meniscus::test;

constexpr int Side = 16;
constexpr int Count = Side * Side * Side;

Point PlaceOf(int i)
{
  return { 8.0 * (i % Side) - 60.0, -20.0 - 5.0 * (i / Side % Side),
    8.0 * (i / (Side * Side)) - 60.0 };
}

/** Indices of the points of a block of rows, in random order. */
std::vector<int> MakeRandomOrder()
{
  std::vector<int> order(Count);
  std::iota(order.begin(), order.end(), 0);
  std::shuffle(order.begin(), order.end(), std::mt19937(11));
  return order;
}

vtkSmartPointer<vtkRefractedGeometryFilter> MakeCurvedFilter(const std::vector<Point>& points)
{
  const auto filter = MakeFilter(
    MakePoints(points), MakeMembrane(meniscus::reference::MakeWaves(200.0, 32, 3.0, 2.0)));
  filter->SetMembraneModelToCurved();
  filter->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  return filter;
}

class SolvingOrder : public ::testing::Test
{
protected:
  void SetUp() override
  {
    std::vector<Point> rows;
    for (int i = 0; i < Count; ++i)
    {
      rows.push_back(PlaceOf(i));
    }
    std::vector<Point> scattered;
    for (const int i : this->Order)
    {
      scattered.push_back(PlaceOf(i));
    }
    this->Rows = MakeCurvedFilter(rows);
    this->Scattered = MakeCurvedFilter(scattered);
  }

  /** Largest distance between the images of a point in both orders. */
  double GetLargestDifference()
  {
    double largest = 0.0;
    for (int i = 0; i < Count; ++i)
    {
      const glm::dvec3 a = PointOf(this->Scattered->GetOutput(), i);
      const glm::dvec3 b =
        PointOf(this->Rows->GetOutput(), this->Order[static_cast<std::size_t>(i)]);
      for (int k = 0; k < 3; ++k)
      {
        largest = std::max(largest, std::fabs(a[k] - b[k]));
      }
    }
    return largest;
  }

  std::vector<int> Order = MakeRandomOrder();
  vtkSmartPointer<vtkRefractedGeometryFilter> Rows;
  vtkSmartPointer<vtkRefractedGeometryFilter> Scattered;
};

//------------------------------------------------------------------------------
TEST_F(SolvingOrder, ImagesDoNotDependOnTheOrderOfPoints)
{
  this->Rows->Update();
  this->Scattered->Update();
  EXPECT_EQ(this->Scattered->GetNumberOfSolvedVertices(), Count);
  EXPECT_EQ(this->Scattered->GetStatistic("NumberOfVerticesWithoutImage"), 0);
  // One image per point at this depth, found by Newton's method to rounding.
  EXPECT_LT(this->GetLargestDifference(), 1e-9);
}

//------------------------------------------------------------------------------
TEST_F(SolvingOrder, MovedPointsHaveAnOrderOfTheirOwn)
{
  this->Scattered->Update();
  auto* const input = vtkPolyData::SafeDownCast(this->Scattered->GetInput());
  std::shuffle(this->Order.begin(), this->Order.end(), std::mt19937(12));
  for (int i = 0; i < Count; ++i)
  {
    input->GetPoints()->SetPoint(i, PlaceOf(this->Order[static_cast<std::size_t>(i)]).data());
  }
  input->GetPoints()->Modified();
  this->Rows->Update();
  this->Scattered->Update();
  EXPECT_EQ(this->Scattered->GetNumberOfSolvedVertices(), 2 * Count);
  EXPECT_LT(this->GetLargestDifference(), 1e-9);
}

}
