// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// CloseSeams: cells between the images of neighbouring polygons.
#include "RefractedGeometryTestHelpers.h"
#include "VTKTestBasics.h"

namespace
{

using namespace meniscus::test;

constexpr double Side = 100.0;

struct Seams
{
  int Open = 0;      ///< sides inside of the object that do not belong to two cells each
  double Area = 0.0; ///< of all cells at their true positions
};

Seams Measure(bool isClosed)
{
  const auto waves = MakeMembrane(meniscus::reference::MakeWaves(200.0, 40, 3.0, 3.0));
  const auto filter = MakeAllImages(MakeGrid(5, Side, -120.0), waves);
  filter->SetAngularTolerance(0.1);
  filter->SetCloseSeams(isClosed);
  filter->TrueGeometryOn();
  filter->Update();
  vtkPolyData* seen = filter->GetOutput();
  vtkDataArray* truth = seen->GetPointData()->GetArray("TruePosition");
  const auto isOnBorder = [truth](vtkIdType a, vtkIdType b)
  {
    bool isOn = false;
    for (const int axis : { 0, 2 })
    {
      const double at = truth->GetComponent(a, axis);
      isOn = isOn ||
        (std::fabs(std::fabs(at) - Side / 2.0) < 1e-9 &&
          std::fabs(at - truth->GetComponent(b, axis)) < 1e-9);
    }
    return isOn;
  };
  Seams seams;
  std::map<std::pair<Point, Point>, int> sides;
  for (vtkIdType i = 0; i < seen->GetNumberOfCells(); ++i)
  {
    vtkCell* cell = seen->GetCell(i);
    glm::dvec3 area(0.0);
    for (vtkIdType k = 0; k < cell->GetNumberOfPoints(); ++k)
    {
      const vtkIdType ids[2] = { cell->GetPointId(static_cast<int>(k)),
        cell->GetPointId(static_cast<int>((k + 1) % cell->GetNumberOfPoints())) };
      Point ends[2];
      glm::dvec3 places[2];
      for (int end = 0; end < 2; ++end)
      {
        seen->GetPoint(ids[end], ends[end].data());
        truth->GetTuple(ids[end], &places[end].x);
      }
      area += 0.5 * glm::cross(places[0], places[1]);
      if (!isOnBorder(ids[0], ids[1]) && ends[0] != ends[1])
      {
        ++sides[std::minmax(ends[0], ends[1])];
      }
    }
    seams.Area += glm::length(area);
  }
  seams.Open = static_cast<int>(std::count_if(
    sides.begin(), sides.end(), [](const auto& side) { return side.second % 2 != 0; }));
  return seams;
}

// Deep below the waves images are mapped from the membrane, each polygon by itself.
TEST(ClosedSeams, EachSideBelongsToTwoCellsAndTheTrueAreaStays)
{
  const Seams open = Measure(false);
  const Seams closed = Measure(true);
  EXPECT_GT(open.Open, 0);
  EXPECT_EQ(closed.Open, 0);
  EXPECT_NEAR(open.Area, Side * Side, 1e-3 * Side * Side);
  EXPECT_NEAR(closed.Area, open.Area, 1e-9 * open.Area);
}

}
