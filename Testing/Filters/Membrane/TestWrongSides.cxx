// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Surfaces that show the eye the wrong side, or that it sees nothing through: warnings, and
// surfaces that are turned round.
#include "RefractedGeometryTestHelpers.h"

#include "VTKTestBasics.h"
#include "vtkMembraneCellFilter.h"
#include "vtkRefractingInterface.h"
#include "vtkRefractingInterfaceCollection.h"
#include "vtkRefractionErrorVolume.h"
#include "vtkSightRayFilter.h"
#include "vtkTriangulatedPositionFilter.h"
#include "vtkTruePositionFilter.h"

#include <vtkAppendPolyData.h>
#include <vtkTransform.h>
#include <vtkTransformPolyDataFilter.h>

namespace
{

using namespace meniscus::test;
using meniscus::reference::MembraneMesh;

/** Square water in the plane y = 0 whose normals point up, or down for -1. */
vtkSmartPointer<vtkPolyData> MakeWater(double side, double height = 0.0, bool withNormals = true)
{
  MembraneMesh mesh = meniscus::reference::MakeSquare(200.0, 4, 0.0);
  mesh.Translate({ 0.0, height, 0.0 });
  if (side < 0.0)
  {
    for (double& component : mesh.Normals)
    {
      component = -component;
    }
    for (std::size_t i = 0; i < mesh.Triangles.size(); i += 3)
    {
      std::swap(mesh.Triangles[i], mesh.Triangles[i + 1]);
    }
  }
  auto membrane = MakeMembrane(mesh);
  if (!withNormals)
  {
    membrane->GetPointData()->SetNormals(nullptr);
  }
  return membrane;
}

bool Contains(const std::string& text, const char* part)
{
  return text.find(part) != std::string::npos;
}

TEST(WrongSides, EachFilterWarnsOfAMembraneThatTurnsItsBackToTheEye)
{
  const char* const expected = "No facet of the membrane faces the eye";
  for (const bool withNormals : { false, true })
  {
    const auto water = MakeWater(-1.0, 0.0, withNormals);
    const auto points = MakePoints({ { 10.0, -20.0, 5.0 } });
    for (const bool all : { false, true })
    {
      const auto view = MakeAllImages(points, water);
      view->SetImages(
        all ? vtkRefractedGeometryFilter::ALL_IMAGES : vtkRefractedGeometryFilter::FIRST_IMAGE);
      const auto told = UpdateAndObserve(view);
      EXPECT_TRUE(Contains(told->Text, expected)) << told->Text;
      EXPECT_EQ(told->Warnings, 1) << told->Text;
      view->Modified();
      view->Update();
      EXPECT_EQ(told->Warnings, 1) << "repeated: " << told->Text;
    }
    vtkNew<vtkDoubleArray> eyes;
    eyes->SetName("Eye");
    eyes->SetNumberOfComponents(3);
    eyes->InsertNextTuple3(20.0, 300.0, 10.0);
    points->GetPointData()->AddArray(eyes);
    vtkNew<vtkIdTypeArray> ids;
    ids->SetName("PointId");
    ids->InsertNextValue(0);
    points->GetPointData()->AddArray(ids);
    vtkNew<vtkTriangulatedPositionFilter> triangulated;
    vtkNew<vtkSightRayFilter> rays;
    vtkNew<vtkTruePositionFilter> ofEyes;
    vtkNew<vtkTruePositionFilter> truth;
    for (vtkSightRayAlgorithm* filter :
      std::initializer_list<vtkSightRayAlgorithm*>{ triangulated, rays, ofEyes, truth })
    {
      filter->SetEyeArrayName(filter == truth ? "" : "Eye");
      filter->SetEyePosition(20.0, 300.0, 10.0);
      filter->SetInputData(points);
      filter->SetMembraneData(water);
      const auto toldOfEyes = UpdateAndObserve(filter);
      EXPECT_TRUE(Contains(toldOfEyes->Text, "No facet of the first membrane faces an eye"))
        << toldOfEyes->Text;
      filter->Modified();
      filter->Update();
      EXPECT_EQ(toldOfEyes->Warnings, 1);
    }

    vtkNew<vtkMembraneCellFilter> cells;
    cells->AddMembraneData(water);
    cells->SetEyePosition(20.0, 300.0, 10.0);
    const auto toldOfCells = UpdateAndObserve(cells);
    EXPECT_TRUE(Contains(toldOfCells->Text, "No facet of the first membrane faces an eye"))
      << toldOfCells->Text;

    vtkNew<vtkRefractedLightFilter> light;
    light->SetInputData(MakeGrid(5, 50.0, -20.0));
    light->SetMembraneData(water);
    light->SetLightPosition(0.3, 1.0, 0.0);
    const auto toldOfLight = UpdateAndObserve(light);
    EXPECT_TRUE(Contains(toldOfLight->Text, expected)) << toldOfLight->Text;

    vtkNew<vtkRefractionErrorVolume> volume;
    volume->SetInputData(0, water);
    volume->SetEyePosition(20.0, 300.0, 10.0);
    const auto toldOfVolume = UpdateAndObserve(volume);
    EXPECT_TRUE(Contains(toldOfVolume->Text, expected)) << toldOfVolume->Text;
  }
}

// The right way round is that of the eye; when the eye dives, the surface turns again.
TEST(WrongSides, AMembraneIsTurnedTowardsTheEye)
{
  const auto points = MakePoints({ { 10.0, -20.0, 5.0 }, { -30.0, -40.0, 15.0 } });
  const auto right = MakeAllImages(points, MakeWater(1.0));
  right->Update();
  for (const bool withNormals : { false, true })
  {
    const auto turned = MakeAllImages(points, MakeWater(-1.0, 0.0, withNormals));
    turned->GetInterfaces()->GetFirstInterface()->TurnTowardsEyeOn();
    const auto told = UpdateAndObserve(turned);
    EXPECT_EQ(told->Warnings + told->Errors, 0) << told->Text;
    ASSERT_EQ(turned->GetOutput()->GetNumberOfPoints(), 2);
    for (vtkIdType i = 0; i < 2; ++i)
    {
      EXPECT_LT(
        glm::length(PointOf(turned->GetOutput(), i) - PointOf(right->GetOutput(), i)), 1e-10);
    }
    turned->SetEyePosition(20.0, -300.0, 10.0);
    turned->Update(); // the points are on the eye's side now
    EXPECT_EQ(told->Warnings + told->Errors, 0) << told->Text;
    EXPECT_LT(glm::length(PointOf(turned->GetOutput(), 0) - PointOf(points, 0)), 1e-12);
    turned->SetEyePosition(20.0, 300.0, 10.0);
    turned->GetInterfaces()->GetFirstInterface()->TurnTowardsEyeOff();
    turned->Update();
    EXPECT_EQ(told->Warnings, 1);
    EXPECT_LT(glm::length(PointOf(turned->GetOutput(), 0) - PointOf(points, 0)), 1e-12);
  }
}

// A pane of glass, 10 thick, in air.
vtkSmartPointer<vtkRefractedGeometryFilter> MakePane(
  vtkPolyData* geometry, double upperSide, double lowerSide, bool turns)
{
  auto filter = MakeAllImages(geometry, MakeWater(upperSide));
  filter->AddMembraneData(MakeWater(lowerSide, -10.0));
  vtkNew<vtkRefractingInterfaceCollection> pane;
  pane->AddInterface(1.0, 1.5)->SetTurnTowardsEye(turns);
  pane->AddInterface(1.5, 1.0)->SetTurnTowardsEye(turns);
  filter->SetInterfaces(pane);
  return filter;
}

TEST(WrongSides, APaneWithASideUpsideDownIsReportedAndTurned)
{
  const auto points = MakePoints({ { 10.0, -60.0, 5.0 } });
  const auto right = MakePane(points, 1.0, 1.0, false);
  right->Update();
  ASSERT_EQ(right->GetOutput()->GetNumberOfPoints(), 1);
  for (const bool isUpper : { true, false })
  {
    const double upper = isUpper ? -1.0 : 1.0;
    const auto wrong = MakePane(points, upper, -upper, false);
    const auto told = UpdateAndObserve(wrong);
    EXPECT_EQ(told->Warnings, 1) << told->Text;
    EXPECT_TRUE(Contains(told->Text, "The eye is behind interface 0")) << told->Text;
    EXPECT_TRUE(
      Contains(told->Text, isUpper ? "Interface 0 shows the eye" : "Interface 1 shows the eye"))
      << told->Text;

    const auto turned = MakePane(points, upper, -upper, true);
    const auto toldOfTurned = UpdateAndObserve(turned);
    EXPECT_EQ(toldOfTurned->Warnings, 0) << toldOfTurned->Text;
    ASSERT_EQ(turned->GetOutput()->GetNumberOfPoints(), 1);
    EXPECT_LT(glm::length(PointOf(turned->GetOutput(), 0) - PointOf(right->GetOutput(), 0)), 1e-10);
  }
}

TEST(WrongSides, SidesOfAPaneInTheWrongOrderAreReported)
{
  const auto points = MakePoints({ { 10.0, -60.0, 5.0 } });
  auto filter = MakeAllImages(points, MakeWater(1.0, -10.0));
  filter->AddMembraneData(MakeWater(1.0));
  vtkNew<vtkRefractingInterfaceCollection> pane;
  pane->AddInterface(1.0, 1.5);
  pane->AddInterface(1.5, 1.0);
  filter->SetInterfaces(pane);
  const auto told = UpdateAndObserve(filter);
  EXPECT_TRUE(Contains(told->Text, "The eye is behind interface 0")) << told->Text;
}

TEST(WrongSides, TotalReflectionEverywhereIsNamed)
{
  const auto points = MakePoints({ { 10.0, -60.0, 5.0 } });
  const auto view = MakeAllImages(points, MakeWater(1.0));
  view->SetEyePosition(1000.0, 300.0, 0.0); // at least 72 degrees from the normal
  view->SetExteriorIndexOfRefraction(1.333);
  view->SetInteriorIndexOfRefraction(1.0);
  const auto told = UpdateAndObserve(view);
  EXPECT_EQ(view->GetOutput()->GetNumberOfPoints(), 0);
  EXPECT_TRUE(Contains(told->Text, "totally reflected")) << told->Text;
  EXPECT_TRUE(Contains(told->Text, "48.6")) << told->Text;
  EXPECT_FALSE(Contains(told->Text, "port 0")) << told->Text;
}

TEST(WrongSides, AFinOnTheMembraneIsReported)
{
  MembraneMesh mesh = meniscus::reference::MakeSquare(200.0, 4, 0.0);
  mesh.AddPoint({ 0.0, -30.0, 0.0 }, { 1.0, 0.0, 0.0 });
  std::vector<std::int64_t> common; // of the first two facets
  std::copy_if(mesh.Triangles.begin(), mesh.Triangles.begin() + 3, std::back_inserter(common),
    [&mesh](std::int64_t vertex)
    {
      const auto second = mesh.Triangles.begin() + 3;
      return std::find(second, second + 3, vertex) != second + 3;
    });
  ASSERT_EQ(common.size(), 2u);
  mesh.AddTriangle(common[0], common[1], static_cast<std::int64_t>(mesh.Points.size() / 3) - 1);
  const auto view = MakeAllImages(MakePoints({ { 10.0, -60.0, 5.0 } }), MakeMembrane(mesh));
  const auto told = UpdateAndObserve(view);
  EXPECT_TRUE(Contains(told->Text, "three or more of them share")) << told->Text;
}

/** A piece of water with its side, and a second one `x` aside and `height` above it. */
vtkSmartPointer<vtkPolyData> MakeTwoPieces(
  double firstSide, double secondSide, double x, double height)
{
  vtkNew<vtkAppendPolyData> pieces;
  vtkNew<vtkTransform> aside;
  aside->Translate(x, height, 0.0);
  vtkNew<vtkTransformPolyDataFilter> moved;
  moved->SetTransform(aside);
  moved->SetInputData(MakeWater(secondSide));
  pieces->AddInputData(MakeWater(firstSide));
  pieces->AddInputConnection(moved->GetOutputPort());
  pieces->Update();
  return pieces->GetOutput();
}

// Objects behind such a piece are lost. The far wall of a tank turns its back to the eye rightly,
// also if a part of it is seen past the near one.
TEST(WrongSides, APieceUpsideDownIsReported)
{
  const char* const expected = "32 facets belong to pieces";
  const auto points = MakePoints({ { 10.0, -20.0, 5.0 }, { 200.0, -20.0, 5.0 } });
  for (const bool isWrong : { true, false })
  {
    for (const auto& water : isWrong
        ? std::vector{ MakeTwoPieces(1.0, -1.0, 210.0, 0.0) }
        : std::vector{ MakeTwoPieces(1.0, 1.0, 210.0, 0.0), MakeTwoPieces(1.0, -1.0, 0.0, -50.0),
            MakeTwoPieces(1.0, -1.0, 80.0, -150.0) })
    {
      vtkNew<vtkTruePositionFilter> truth;
      truth->SetInputData(points);
      truth->SetMembraneData(water);
      truth->SetEyePosition(20.0, 300.0, 10.0);
      const auto view = MakeAllImages(points, water);
      const auto list = MakeAllImages(points, water);
      list->AddMembraneData(MakeWater(1.0, -80.0));
      vtkNew<vtkRefractingInterfaceCollection> layers;
      layers->AddInterface(1.0, 1.333);
      layers->AddInterface(1.333, 1.5);
      list->SetInterfaces(layers);
      for (vtkAlgorithm* filter : std::initializer_list<vtkAlgorithm*>{ truth, view, list })
      {
        const auto told = UpdateAndObserve(filter);
        EXPECT_EQ(Contains(told->Text, expected), isWrong)
          << filter->GetClassName() << ": " << told->Text;
        const int warnings = told->Warnings;
        filter->Modified();
        filter->Update();
        EXPECT_EQ(told->Warnings, warnings) << "repeated: " << told->Text;
      }
    }
  }
}

// An eye in the water, far to the side, in front of a pane of glass.
TEST(WrongSides, TotalReflectionInAListIsNamed)
{
  const auto view = MakeAllImages(MakePoints({ { 10.0, -60.0, 5.0 } }), MakeWater(1.0));
  view->AddMembraneData(MakeWater(1.0, -10.0));
  view->SetEyePosition(1000.0, 300.0, 0.0);
  vtkNew<vtkRefractingInterfaceCollection> pane;
  pane->AddInterface(1.333, 1.5);
  pane->AddInterface(1.5, 1.0);
  view->SetInterfaces(pane);
  const auto told = UpdateAndObserve(view);
  EXPECT_EQ(view->GetOutput()->GetNumberOfPoints(), 0);
  EXPECT_EQ(told->Warnings, 1) << told->Text;
  EXPECT_TRUE(Contains(told->Text, "Everything is totally reflected")) << told->Text;
  EXPECT_TRUE(Contains(told->Text, "interface 1")) << told->Text;
  view->SetEyePosition(20.0, 300.0, 10.0);
  view->Update();
  EXPECT_EQ(view->GetOutput()->GetNumberOfPoints(), 1);
  EXPECT_EQ(told->Warnings, 1) << told->Text;
}

// All rays lie in the plane of the water: neither is one of them refracted, nor are crossings with
// the facets looked for.
TEST(WrongSides, FlatWaterSeenEdgeOnShowsNothing)
{
  for (const double x : { 150.0, 1e6 })
  {
    const auto view = MakeAllImages(MakePoints({ { 10.0, -60.0, 5.0 } }), MakeWater(1.0));
    view->SetEyePosition(x, 0.0, 0.0);
    const auto told = UpdateAndObserve(view);
    EXPECT_TRUE(Contains(told->Text, "No facet of the membrane faces the eye")) << told->Text;
    vtkNew<vtkTruePositionFilter> truth;
    truth->SetInputData(MakePoints({ { -10.0, 0.0, 5.0 } }));
    truth->SetMembraneData(MakeWater(1.0));
    truth->SetEyePosition(x, 0.0, 0.0);
    truth->Update();
    EXPECT_EQ(truth->GetOutput()->GetPointData()->GetArray("SeenState")->GetTuple1(0),
      vtkTruePositionFilter::UNREFRACTED);
  }
}

}
