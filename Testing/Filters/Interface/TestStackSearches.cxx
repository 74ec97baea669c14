// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// ALL_IMAGES through lists: searches that are undecided, and cells that keep their points.
#include "StackFilterHelpers.h"

#include "vtkReverseSense.h"

namespace
{

using namespace meniscus::test;

vtkSmartPointer<vtkPolyData> MakeSquare(double half, double z, int cells)
{
  vtkNew<vtkPlaneSource> source;
  source->SetOrigin(-half, -half, z);
  source->SetPoint1(half, -half, z);
  source->SetPoint2(-half, half, z);
  source->SetResolution(cells, cells);
  source->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  source->Update();
  return source->GetOutput();
}

// A square with waves; normals are computed by the filter.
vtkSmartPointer<vtkPolyData> MakeWavySquare(double half, double z, double amplitude, int cells)
{
  const auto surface = MakeSquare(half, z, cells);
  surface->GetPointData()->SetNormals(nullptr);
  MapPoints(surface,
    [=](const glm::dvec3& p) {
      return glm::dvec3(p.x, p.y, z + amplitude * std::sin(5.0 * p.x + 0.3) * std::cos(4.0 * p.y));
    });
  return surface;
}

vtkSmartPointer<vtkPolyData> MakeBall(
  double z, double radius, int cells, double startPhi = 0.0, double endPhi = 180.0, double x = 0.0)
{
  vtkNew<vtkSphereSource> source;
  source->SetCenter(x, 0.0, z);
  source->SetRadius(radius);
  source->SetThetaResolution(2 * cells);
  source->SetPhiResolution(cells);
  source->SetStartPhi(startPhi);
  source->SetEndPhi(endPhi);
  source->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  source->Update();
  return source->GetOutput();
}

vtkSmartPointer<vtkPolyData> TurnInside(vtkPolyData* surface)
{
  vtkNew<vtkReverseSense> reverse;
  reverse->SetInputData(surface);
  reverse->ReverseCellsOn();
  reverse->ReverseNormalsOn();
  reverse->Update();
  return reverse->GetOutput();
}

struct Scene
{
  std::string Name;
  Point Eye;
  std::function<vtkSmartPointer<vtkPolyData>()> MakeObject;
  std::function<void(vtkRefractedGeometryFilter*)> AddSurfaces;
};

std::ostream& operator<<(std::ostream& out, const Scene& scene)
{
  return out << scene.Name;
}

void AddPane(vtkRefractedGeometryFilter* filter)
{
  AddInterface(filter, MakeSquare(3.0, 0.0, 10), 1.0, 1.5);
  AddInterface(filter, MakeSquare(3.0, -0.1, 10), 1.5, 1.333);
}

void AddGlassBall(vtkRefractedGeometryFilter* filter, int cells)
{
  const auto ball = MakeBall(0.0, 1.0, cells);
  AddInterface(filter, ball, 1.0, 1.5);
  AddInterface(filter, ball, 1.0, 1.5);
}

vtkSmartPointer<vtkRefractedGeometryFilter> MakeStack(const Scene& scene)
{
  auto filter = vtkSmartPointer<vtkRefractedGeometryFilter>::New();
  vtkNew<vtkRefractingInterfaceCollection> list;
  filter->SetInterfaces(list);
  filter->SetInputData(scene.MakeObject());
  filter->SetEyePosition(scene.Eye[0], scene.Eye[1], scene.Eye[2]);
  filter->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  scene.AddSurfaces(filter);
  return filter;
}

const Point AboveWater{ 0.3, -2.0, 2.0 };

std::vector<Scene> MakeRightScenes()
{
  const auto ballBelow = [] { return MakeBall(-1.0, 0.4, 24, 0.0, 180.0, 0.013); };
  const auto board = [] { return MakeSquare(0.4, -1.5, 20); };
  const auto addCaps = [](vtkRefractedGeometryFilter* filter)
  {
    AddInterface(filter, MakeBall(-2.7, 3.0, 24, 0.0, 25.0), 1.0, 1.5);
    AddInterface(filter, MakeBall(2.7, 3.0, 24, 155.0, 180.0), 1.0, 1.5);
  };
  const auto addDome = [](vtkRefractedGeometryFilter* filter)
  {
    AddInterface(filter, TurnInside(MakeBall(0.0, 1.0, 24)), 1.0, 1.5);
    AddInterface(filter, TurnInside(MakeBall(0.0, 1.1, 24)), 1.5, 1.333);
  };
  return { { "BoardBehindAPane", AboveWater, [] { return MakeSquare(0.5, -1.0, 20); }, AddPane },
    { "BallBehindAPane", AboveWater, ballBelow, AddPane },
    { "BallBehindAPaneOfTwoFacets", AboveWater, ballBelow,
      [](vtkRefractedGeometryFilter* filter)
      {
        AddInterface(filter, MakeSquare(3.0, 0.0, 1), 1.0, 1.5);
        AddInterface(filter, MakeSquare(3.0, -0.1, 1), 1.5, 1.333);
      } },
    { "BallBehindThreePlanes", AboveWater, [] { return MakeBall(-1.2, 0.4, 24); },
      [](vtkRefractedGeometryFilter* filter)
      {
        AddInterface(filter, MakeSquare(3.0, 0.0, 10), 1.0, 1.333);
        AddInterface(filter, MakeSquare(3.0, -0.3, 10), 1.333, 1.5);
        AddInterface(filter, MakeSquare(3.0, -0.4, 10), 1.5, 1.1);
      } },
    { "BallBehindASmallPane", AboveWater, ballBelow,
      [](vtkRefractedGeometryFilter* filter)
      {
        AddInterface(filter, MakeSquare(3.0, 0.0, 10), 1.0, 1.5);
        AddInterface(filter, MakeSquare(0.5, -0.1, 10), 1.5, 1.333);
      } },
    { "BallBelowWavesAndAPlane", AboveWater, ballBelow,
      [](vtkRefractedGeometryFilter* filter)
      {
        AddInterface(filter, MakeWavySquare(3.0, 0.0, 0.02, 40), 1.0, 1.333);
        AddInterface(filter, MakeSquare(3.0, -0.3, 10), 1.333, 1.5);
      } },
    { "BallBelowTwoWavySurfaces", AboveWater, ballBelow,
      [](vtkRefractedGeometryFilter* filter)
      {
        AddInterface(filter, MakeWavySquare(3.0, 0.0, 0.02, 40), 1.0, 1.333);
        AddInterface(filter, MakeWavySquare(3.0, -0.3, 0.01, 30), 1.333, 1.5);
      } },
    { "BoardBehindALens", { 0.0, -0.5, 10.0 }, board, addCaps },
    { "BallBehindALens", { 0.0, -0.5, 10.0 }, [] { return MakeBall(-1.5, 0.3, 24); }, addCaps },
    { "BoardBehindAGlassBall", { 0.3, 0.2, 6.0 }, [] { return MakeSquare(2.0, -3.0, 6); },
      [](vtkRefractedGeometryFilter* filter)
      {
        filter->SetAngularTolerance(0.2);
        AddGlassBall(filter, 16);
      } },
    { "BallInADomePort", { 0.1, 0.05, 0.02 },
      [] { return MakeBall(-3.0, 0.6, 24, 0.0, 180.0, 0.5); }, addDome } };
}

class RightScenes : public ::testing::TestWithParam<Scene>
{
};

}

//------------------------------------------------------------------------------
// No search may have missed an image: there is no warning.
TEST_P(RightScenes, HaveNoUndecidedSearches)
{
  const auto filter = MakeStack(GetParam());
  ExpectQuiet(filter);
  EXPECT_EQ(filter->GetStatistic("NumberOfUndecidedSearches"), 0);
  EXPECT_GT(filter->GetOutput()->GetNumberOfPolys(), 100);
}

INSTANTIATE_TEST_SUITE_P(StackSearches, RightScenes, ::testing::ValuesIn(MakeRightScenes()),
  [](const ::testing::TestParamInfo<Scene>& scene) { return scene.param.Name; });

//------------------------------------------------------------------------------
// A point on the axis, nearer than the focus of the middle rays, is seen as a ring as well: some of
// any number of images.
TEST(StackSearches, ARingOfImagesIsUndecided)
{
  const auto filter = MakeStack({ "", { 0.0, 0.0, 6.0 },
    [] {
      return MakePoints({ { 0.0, 0.0, -1.6 } });
    },
    [](vtkRefractedGeometryFilter* stack) { AddGlassBall(stack, 6); } });
  const auto messages = UpdateAndObserve(filter);
  EXPECT_EQ(filter->GetStatistic("NumberOfUndecidedSearches"), 1);
  EXPECT_EQ(messages->Warnings, 1) << messages->Text;
  EXPECT_GT(filter->GetOutput()->GetNumberOfPoints(), 1);
}

//------------------------------------------------------------------------------
// Cells behind planes whose images are straight keep their points, as with FIRST_IMAGE.
TEST(StackSearches, StraightImagesBehindPlanesKeepTheirCells)
{
  const auto all = MakeStack({ "", AboveWater, [] { return MakeBall(-1.0, 0.4, 64); }, AddPane });
  all->Update();
  const auto first = MakeStack({ "", AboveWater, [] { return MakeBall(-1.0, 0.4, 64); }, AddPane });
  first->SetImagesToFirstImage();
  first->Update();
  vtkPolyData* found = all->GetOutput();
  vtkPolyData* expected = first->GetOutput();
  ASSERT_EQ(found->GetNumberOfPoints(), expected->GetNumberOfPoints());
  ASSERT_EQ(found->GetNumberOfPolys(), expected->GetNumberOfPolys());
  for (const auto& [i, k] : Product(Below<vtkIdType>(expected->GetNumberOfPoints()), 3))
  {
    // The remaining error of Newton's method, 1e-12 of a facet.
    EXPECT_NEAR(found->GetPoint(i)[k], expected->GetPoint(i)[k], 1e-11);
  }
}
