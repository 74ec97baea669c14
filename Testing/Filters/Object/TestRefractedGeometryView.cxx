// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Cells and points that a camera cannot show through the membrane are left out, and no others.
#include "RefractedGeometryTestHelpers.h"
#include "VTKTestBasics.h"

namespace
{

using namespace meniscus::test;
using namespace meniscus::reference;

constexpr int Side = 41;
constexpr vtkTypeInt64 All = Side * Side;

vtkSmartPointer<vtkCamera> MakeCamera(double x, double z)
{
  auto camera = vtkSmartPointer<vtkCamera>::New();
  camera->SetPosition(20.0, 150.0, 10.0);
  camera->SetFocalPoint(x, 0.0, z);
  camera->SetViewUp(1.0, 0.0, 0.0);
  camera->SetViewAngle(20.0);
  return camera;
}

vtkSmartPointer<vtkRefractedGeometryFilter> MakeViewed(int model, int images, vtkCamera* camera)
{
  auto filter =
    MakeFilter(MakeGrid(Side, 180.0, -60.0), MakeMembrane(MakeWaves(200.0, 32, 3.0, 2.0)));
  filter->SetMembraneModel(model);
  filter->SetImages(images);
  filter->SetAngularTolerance(0.5);
  filter->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  filter->SetCamera(camera);
  filter->SetViewAspectRatio(1.0);
  return filter;
}

/** Source cell, and the position at which its first point is drawn, to 1e-6. */
using Cell = std::tuple<int, long, long, long>;

Cell GetCell(vtkPolyData* output, vtkIdType cell, vtkIdType point)
{
  const glm::dvec3 p = PointOf(output, point);
  return { static_cast<int>(output->GetCellData()->GetArray("SourceCellId")->GetTuple1(cell)),
    std::lround(1e6 * p[0]), std::lround(1e6 * p[1]), std::lround(1e6 * p[2]) };
}

/** The polygons with a point in the camera's view; all polygons for a null camera. */
std::multiset<Cell> GetCells(vtkPolyData* output, vtkCamera* camera)
{
  double planes[24];
  if (camera)
  {
    camera->GetFrustumPlanes(1.0, planes);
  }
  std::multiset<Cell> cells;
  vtkNew<vtkIdList> ids;
  for (vtkIdType i = 0; i < output->GetNumberOfPolys(); ++i)
  {
    output->GetPolys()->GetCellAtId(i, ids);
    bool isInView = !camera;
    for (vtkIdType k = 0; camera && k < ids->GetNumberOfIds(); ++k)
    {
      const glm::dvec3 p = PointOf(output, ids->GetId(k));
      bool inside = true;
      for (int plane = 0; plane < 4; ++plane)
      {
        const double* n = planes + 4 * plane;
        inside = inside && n[0] * p[0] + n[1] * p[1] + n[2] * p[2] + n[3] >= 0.0;
      }
      isInView = isInView || inside;
    }
    if (isInView)
    {
      cells.insert(GetCell(output, i, ids->GetId(0)));
    }
  }
  return cells;
}

class RefractedGeometryView : public ::testing::TestWithParam<std::array<int, 2>>
{
protected:
  vtkSmartPointer<vtkRefractedGeometryFilter> Make(vtkCamera* camera)
  {
    return MakeViewed(this->GetParam()[0], this->GetParam()[1], camera);
  }
};

//------------------------------------------------------------------------------
TEST_P(RefractedGeometryView, NothingInViewIsLost)
{
  const auto camera = MakeCamera(60.0, 50.0);
  const auto whole = this->Make(camera);
  whole->ViewCullingOff();
  whole->Update();
  const auto part = this->Make(camera);
  part->Update();
  EXPECT_EQ(whole->GetStatistic("NumberOfCulledVertices"), 0);
  EXPECT_EQ(whole->GetNumberOfSolvedVertices(), All);
  EXPECT_EQ(part->GetStatistic("NumberOfCulledVertices") + part->GetNumberOfSolvedVertices(), All);
  EXPECT_GT(part->GetStatistic("NumberOfCulledVertices"), All / 4);
  EXPECT_GT(part->GetStatistic("NumberOfCulledCells"), 1600 / 2);

  const auto inView = GetCells(whole->GetOutput(), camera);
  const auto left = GetCells(part->GetOutput(), nullptr);
  const auto all = GetCells(whole->GetOutput(), nullptr);
  EXPECT_GT(inView.size(), 50u);
  EXPECT_LT(left.size(), all.size() / 2);
  for (const Cell& cell : inView)
  {
    EXPECT_EQ(left.count(cell), all.count(cell)) << std::get<0>(cell);
  }
  for (const Cell& cell : left)
  {
    EXPECT_GE(all.count(cell), 1u) << std::get<0>(cell);
  }
}

//------------------------------------------------------------------------------
TEST_P(RefractedGeometryView, ATurnSolvesWhatComesIntoView)
{
  const auto camera = MakeCamera(60.0, 50.0);
  const auto filter = this->Make(camera);
  filter->Update();
  const vtkTypeInt64 first = filter->GetNumberOfSolvedVertices();
  const auto before = GetCells(filter->GetOutput(), nullptr);
  filter->Update();
  camera->SetViewAngle(20.0 + 1e-9); // the view changes, its contents do not
  filter->Update();
  EXPECT_EQ(filter->GetNumberOfSolvedVertices(), first);

  camera->SetFocalPoint(60.0, 0.0, 10.0);
  filter->Update();
  const vtkTypeInt64 second = filter->GetNumberOfSolvedVertices();
  EXPECT_GT(second, first);
  const auto fresh = this->Make(MakeCamera(60.0, 10.0));
  fresh->GetCamera()->SetViewAngle(20.0 + 1e-9);
  fresh->Update();
  EXPECT_LT(second, first + fresh->GetNumberOfSolvedVertices());
  // The output does not depend on the camera's earlier views.
  EXPECT_EQ(GetCells(filter->GetOutput(), nullptr), GetCells(fresh->GetOutput(), nullptr));
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), fresh->GetOutput()->GetNumberOfPoints());

  camera->SetFocalPoint(60.0, 0.0, 50.0);
  filter->Update();
  EXPECT_EQ(filter->GetNumberOfSolvedVertices(), second);
  EXPECT_EQ(GetCells(filter->GetOutput(), nullptr), before);
  EXPECT_EQ(filter->GetNumberOfEyeUpdates(), 1);
}

//------------------------------------------------------------------------------
TEST_P(RefractedGeometryView, SwitchingItOffAndOnAgain)
{
  const auto filter = this->Make(MakeCamera(60.0, 50.0));
  filter->Update();
  const auto part = GetCells(filter->GetOutput(), nullptr);
  filter->ViewCullingOff();
  filter->Update();
  EXPECT_EQ(filter->GetNumberOfSolvedVertices(), All);
  const auto whole = this->Make(nullptr);
  whole->SetEyePosition(20.0, 150.0, 10.0);
  whole->Update();
  EXPECT_EQ(GetCells(filter->GetOutput(), nullptr), GetCells(whole->GetOutput(), nullptr));
  filter->ViewCullingOn();
  filter->Update();
  EXPECT_EQ(GetCells(filter->GetOutput(), nullptr), part);
  // Objects and membranes may change under a view.
  filter->SetInputData(0, MakeGrid(5, 20.0, -30.0));
  filter->Update();
  filter->SetInputData(1, MakeFlatMembrane());
  filter->Update();
  const auto other = this->Make(MakeCamera(60.0, 50.0));
  other->SetInputData(0, MakeGrid(5, 20.0, -30.0));
  other->SetInputData(1, MakeFlatMembrane());
  other->Update();
  EXPECT_EQ(GetCells(filter->GetOutput(), nullptr), GetCells(other->GetOutput(), nullptr));
}

//------------------------------------------------------------------------------
TEST_P(RefractedGeometryView, WideViewsCullNothing)
{
  const auto camera = MakeCamera(20.0, 10.0);
  camera->SetViewAngle(120.0);
  const auto filter = this->Make(camera);
  filter->Update();
  EXPECT_EQ(filter->GetNumberOfSolvedVertices(), All);
  EXPECT_EQ(
    filter->GetStatistic("NumberOfCulledVertices") + filter->GetStatistic("NumberOfCulledCells"),
    0);
}

TEST_P(RefractedGeometryView, ViewsBesideTheMembraneCullAll)
{
  const auto camera = MakeCamera(900.0, 10.0);
  const auto filter = this->Make(camera);
  const auto messages = UpdateAndObserve(filter);
  EXPECT_EQ(filter->GetNumberOfSolvedVertices(), 0);
  EXPECT_EQ(filter->GetStatistic("NumberOfCulledVertices"), All);
  EXPECT_EQ(filter->GetStatistic("NumberOfCulledCells"), 1600);
  EXPECT_EQ(filter->GetOutput()->GetNumberOfCells(), 0);
  EXPECT_EQ(messages->Warnings, 0) << messages->Text; // the scene is valid
  vtkDataArray* without = filter->GetOutput()->GetFieldData()->GetArray("PointsWithoutImage");
  EXPECT_EQ(without->GetNumberOfTuples(), 0);
}

INSTANTIATE_TEST_SUITE_P(Modes, RefractedGeometryView,
  ::testing::Values(std::array<int, 2>{ vtkRefractedGeometryFilter::FLAT_FACETS,
                      vtkRefractedGeometryFilter::FIRST_IMAGE },
    std::array<int, 2>{
      vtkRefractedGeometryFilter::CURVED, vtkRefractedGeometryFilter::FIRST_IMAGE },
    std::array<int, 2>{
      vtkRefractedGeometryFilter::CURVED, vtkRefractedGeometryFilter::ALL_IMAGES }));

//------------------------------------------------------------------------------
// Without the viewport's aspect ratio only the sides in the direction of the view angle are known.
TEST(RefractedGeometryViews, UnknownAspectRatiosCullTwoSides)
{
  constexpr int model = vtkRefractedGeometryFilter::CURVED;
  constexpr int images = vtkRefractedGeometryFilter::FIRST_IMAGE;
  const auto beside = MakeCamera(20.0, 900.0); // far to the side; the view's up is x
  beside->SetViewUp(1.0, 0.0, 0.0);
  const auto filter = MakeViewed(model, images, beside);
  filter->SetViewAspectRatio(0.0);
  filter->Update();
  const vtkTypeInt64 unknown = filter->GetNumberOfSolvedVertices();
  EXPECT_GT(unknown, 0);
  EXPECT_LT(unknown, All);
  beside->UseHorizontalViewAngleOn(); // now the known sides exclude all of it
  filter->Update();
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPolys(), 0);
}

TEST(RefractedGeometryViews, ParallelProjectionsAndEyesWithoutCameraCullNothing)
{
  const auto camera = MakeCamera(900.0, 10.0);
  camera->ParallelProjectionOn();
  const auto filter =
    MakeViewed(vtkRefractedGeometryFilter::CURVED, vtkRefractedGeometryFilter::FIRST_IMAGE, camera);
  const auto messages = UpdateAndObserve(filter);
  EXPECT_EQ(filter->GetNumberOfSolvedVertices(), All);
  filter->SetCamera(nullptr);
  filter->SetEyePosition(20.0, 150.0, 10.0);
  filter->Update();
  EXPECT_EQ(filter->GetStatistic("NumberOfCulledVertices"), 0);
}

// Geometry on the eye's side is seen without refraction, outside the membrane's bounds as well.
TEST(RefractedGeometryViews, GeometryInFrontIsNeverCulled)
{
  const auto filter = MakeViewed(vtkRefractedGeometryFilter::CURVED,
    vtkRefractedGeometryFilter::ALL_IMAGES, MakeCamera(900.0, 10.0));
  filter->SetInputData(0, MakeGrid(9, 40.0, 30.0));
  filter->Update();
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPolys(), 64);
  EXPECT_EQ(filter->GetStatistic("NumberOfCulledVertices"), 0);
}

// Points that cannot be solved are counted and cause a warning, in view or not.
TEST(RefractedGeometryViews, PointsThatAreNotFiniteAreNotCulled)
{
  const auto filter = MakeViewed(vtkRefractedGeometryFilter::CURVED,
    vtkRefractedGeometryFilter::FIRST_IMAGE, MakeCamera(900.0, 10.0));
  auto grid = MakeGrid(3, 10.0, -30.0);
  grid->GetPoints()->SetPoint(4, 0.0, std::nan(""), 0.0);
  filter->SetInputData(0, grid);
  const auto messages = UpdateAndObserve(filter);
  EXPECT_EQ(filter->GetNumberOfFailedSolves(), 1);
  EXPECT_EQ(messages->Warnings, 1) << messages->Text;
}

}
