// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Triangles that would need more parts than one may have.
#include "RefractedGeometryTestHelpers.h"
#include "VTKTestBasics.h"

using namespace meniscus::test;

TEST(CoarseTriangles, AreToldOnceAndDrawn)
{
  const auto water = MakeMembrane(meniscus::reference::MakeSquare(200.0, 4, 0.0));
  const auto object =
    MakePoints({ { -60.0, -90.0, -50.0 }, { 70.0, -80.0, -40.0 }, { 0.0, -95.0, 60.0 } });
  const vtkIdType corners[3] = { 0, 1, 2 };
  vtkNew<vtkCellArray> triangles;
  triangles->InsertNextCell(3, corners);
  object->SetVerts(nullptr);
  object->SetPolys(triangles);
  for (const double tolerance : { 0.01, 1.0e-8 })
  {
    const auto view = MakeAllImages(object, water);
    view->SetAngularTolerance(tolerance);
    const auto told = UpdateAndObserve(view);
    const vtkIdType points = view->GetOutput()->GetNumberOfPoints();
    EXPECT_GT(points, 3);
    if (tolerance > 1.0e-6)
    {
      EXPECT_EQ(told->Warnings, 0) << told->Text;
      continue;
    }
    // Those of the object are points of the output, too.
    EXPECT_EQ(points, 65536 + 3);
    EXPECT_TRUE(
      HasText(told->Text, "images of 1 triangles have the largest number of points, 65536"));
    view->Modified();
    view->Update();
    EXPECT_EQ(told->Warnings, 1) << told->Text;
  }
}
