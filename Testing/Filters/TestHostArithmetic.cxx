// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Programs that change the arithmetic of their threads, as OSPRay does when it starts.
#include "HostArithmetic.h"
#include "RefractedGeometryTestHelpers.h"

using namespace meniscus::test;

TEST(HostArithmetic, RefractedGeometryIsTheSame)
{
  const auto geometry = MakeGrid(12, 40.0, -20.0);
  const auto membrane = MakeGrid(9, 200.0, 0.0);
  MapPoints(membrane,
    [](const glm::dvec3& point) { return glm::dvec3(point.x, std::sin(0.05 * point.x), point.z); });
  const auto find = [&geometry, &membrane]()
  {
    const auto filter = MakeAllImages(geometry, membrane);
    ExpectQuiet(filter);
    std::vector<Point> points(filter->GetOutput()->GetNumberOfPoints());
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      filter->GetOutput()->GetPoint(static_cast<vtkIdType>(i), points[i].data());
    }
    return points;
  };
  const std::vector<Point> expected = find();
  const FlushedArithmetic host;
  EXPECT_EQ(find(), expected);
  EXPECT_GE(expected.size(), 144u);
  EXPECT_TRUE(FlushesSmallNumbers());
}
