// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Cameras at different windows of one tank: a surface of a list may have several pieces.
#include "RefractedGeometryTestHelpers.h"

#include "VTKTestBasics.h"
#include "vtkAppendPolyData.h"
#include "vtkRefractingInterface.h"
#include "vtkRefractingInterfaceCollection.h"
#include "vtkTriangulatedPositionFilter.h"

namespace
{

using namespace meniscus::test;

/** Windows of a tank in x < 0, y < 0: one towards x and one towards y, of a given depth inside. */
vtkSmartPointer<vtkPolyData> MakeWindows(double inside)
{
  vtkNew<vtkAppendPolyData> windows;
  for (const bool isSide : { true, false })
  {
    vtkNew<vtkPlaneSource> window;
    const double at = -inside;
    window->SetOrigin(isSide ? at : -50.0, isSide ? -50.0 : at, isSide ? -20.0 : 20.0);
    window->SetPoint1(isSide ? at : -5.0, isSide ? -5.0 : at, isSide ? -20.0 : 20.0);
    window->SetPoint2(isSide ? at : -50.0, isSide ? -50.0 : at, isSide ? 20.0 : -20.0);
    window->Update();
    windows->AddInputData(window->GetOutput());
  }
  windows->Update();
  return windows->GetOutput();
}

vtkSmartPointer<vtkRefractingInterfaceCollection> MakeTank()
{
  auto tank = vtkSmartPointer<vtkRefractingInterfaceCollection>::New();
  tank->AddInterface(1.0, 1.5);
  tank->AddInterface(1.5, 1.333);
  return tank;
}

TEST(TankWindows, CamerasAtSeveralWindowsAreTriangulatedTogether)
{
  const glm::dvec3 truth(-24.0, -27.0, 3.0);
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkDoubleArray> eyes;
  eyes->SetName("Eye");
  eyes->SetNumberOfComponents(3);
  vtkNew<vtkIdTypeArray> ids;
  ids->SetName("PointId");
  for (const glm::dvec3& eye : { glm::dvec3(40.0, -20.0, 5.0), glm::dvec3(-30.0, 45.0, -4.0) })
  {
    vtkNew<vtkRefractedGeometryFilter> camera;
    camera->SetInputData(MakePoints({ { truth.x, truth.y, truth.z } }));
    camera->SetInterfaces(MakeTank());
    camera->AddMembraneData(MakeWindows(0.0));
    camera->AddMembraneData(MakeWindows(2.0));
    camera->SetEyePosition(eye.x, eye.y, eye.z);
    camera->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
    camera->Update();
    ASSERT_EQ(camera->GetOutput()->GetNumberOfPoints(), 1);
    points->InsertNextPoint(camera->GetOutput()->GetPoint(0));
    eyes->InsertNextTuple(&eye.x);
    ids->InsertNextValue(0);
  }
  vtkNew<vtkPolyData> seen;
  seen->SetPoints(points);
  seen->GetPointData()->AddArray(eyes);
  seen->GetPointData()->AddArray(ids);
  vtkNew<vtkTriangulatedPositionFilter> found;
  found->SetInputData(seen);
  found->SetInterfaces(MakeTank());
  found->AddMembraneData(MakeWindows(0.0));
  found->AddMembraneData(MakeWindows(2.0));
  found->Update();
  ASSERT_EQ(found->GetOutput()->GetNumberOfPoints(), 1);
  const glm::dvec3 position = PointOf(found->GetOutput(), 0);
  EXPECT_LT(glm::length(position - truth), 1e-9);
}

}
