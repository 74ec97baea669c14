// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// ALL_IMAGES in a pipeline: points, lines and polygons, objects that cross the membrane, caches.
#include "RefractedGeometryTestHelpers.h"
#include "VTKTestBasics.h"

namespace
{

using namespace meniscus::test;
using meniscus::reference::HeightField;

const double Pi = std::acos(-1.0);
const HeightField Waves{ HeightField::Shape::Waves, 200.0, 5.0, 0.03 * Pi, 1.0, 1.333 };
const glm::dvec3 Eye(20.0, 300.0, 10.0);

/** A vertical polygon at x = 7, from `low` to `high`. */
vtkSmartPointer<vtkPolyData> MakeWall(double low, double high)
{
  auto wall = MakePoints(
    { { 7.0, low, -30.0 }, { 7.0, high, -30.0 }, { 7.0, high, 40.0 }, { 7.0, low, 40.0 } });
  vtkNew<vtkCellArray> polys;
  polys->InsertNextCell({ 0, 1, 2, 3 });
  wall->SetPolys(polys);
  AddTruth(wall);
  return wall;
}

// Area of the true polygons that correspond to the output's polygons with (or without) a sight
// facet.
double GetTrueArea(vtkPolyData* output, bool inFront)
{
  vtkDataArray* truth = output->GetPointData()->GetArray("Truth");
  vtkDataArray* facet = output->GetPointData()->GetArray("SightFacet");
  double area = 0.0;
  vtkNew<vtkIdList> ids;
  for (vtkIdType cell = 0; cell < output->GetNumberOfPolys(); ++cell)
  {
    output->GetPolys()->GetCellAtId(cell, ids);
    glm::dvec3 sum(0.0);
    for (vtkIdType k = 2; k < ids->GetNumberOfIds(); ++k)
    {
      const glm::dvec3 first = TupleOf(truth, ids->GetId(0));
      sum += 0.5 *
        glm::cross(
          TupleOf(truth, ids->GetId(k - 1)) - first, TupleOf(truth, ids->GetId(k)) - first);
    }
    area += (facet->GetTuple1(ids->GetId(0)) < 0.0) == inFront ? glm::length(sum) : 0.0;
  }
  return area;
}

//------------------------------------------------------------------------------
TEST(RefractedGeometryImages, VerticesAreOnePerImage)
{
  std::vector<Point> positions;
  for (int i = 0; i < 200; ++i)
  {
    positions.push_back({ -70.0 + 0.7 * i, -60.0 - i % 7 * 25.0, -40.0 + i % 13 * 6.0 });
  }
  const auto points = MakePoints(positions);
  vtkNew<vtkCellArray> verts;
  for (vtkIdType i = 0; i < 200; ++i)
  {
    verts->InsertNextCell(1, &i);
  }
  points->SetVerts(verts);
  AddTruth(points);
  const auto filter = MakeAllImages(points, MakeMembrane(Waves.MakeMesh(64)));
  ExpectQuiet(filter);
  vtkPolyData* output = filter->GetOutput();
  EXPECT_EQ(output->GetNumberOfVerts(), output->GetNumberOfPoints());
  std::vector<int> images(200, 0);
  vtkDataArray* source = output->GetPointData()->GetArray("SourcePointId");
  vtkDataArray* sight = output->GetPointData()->GetArray("SightPoint");
  for (vtkIdType i = 0; i < output->GetNumberOfPoints(); ++i)
  {
    const auto id = static_cast<vtkIdType>(source->GetTuple1(i));
    ++images[static_cast<std::size_t>(id)];
    EXPECT_EQ(output->GetCellData()->GetArray("SourceCellId")->GetTuple1(i), id);
    // Eq. 2.4.
    EXPECT_NEAR(glm::length(PointOf(output, i) - TupleOf(sight, i)) * 1.333,
      glm::length(PointOf(points, id) - TupleOf(sight, i)), 1e-9);
  }
  int several = 0;
  int without = 0;
  for (std::size_t i = 0; i < 200; ++i)
  {
    const glm::dvec3 p = PointOf(points, static_cast<vtkIdType>(i));
    const auto exact = Waves.FindSightPoints(Eye, p);
    several += images[i] > 1;
    without += images[i] == 0;
    // One pair of images more or less near a caustic.
    EXPECT_LE(std::abs(images[i] - static_cast<int>(exact.size())), 2) << i;
  }
  EXPECT_GT(several, 10);
  EXPECT_EQ(filter->GetStatistic("NumberOfVerticesWithoutImage"), without);
  EXPECT_EQ(filter->GetNumberOfSolvedVertices(), 200);
}

//------------------------------------------------------------------------------
// The thesis's Fig. 3.2 shows 30 virtual vertices of one point. Short waves have more: all that a
// dense search for stationary paths finds, each once.
TEST(RefractedGeometryImages, TensOfImagesOfOnePoint)
{
  const HeightField waves{ HeightField::Shape::Waves, 200.0, 4.0, 0.09 * Pi, 1.0, 1.333 };
  constexpr int cells = 128;
  // Sight points are farther apart than two cells, and the patches' error is far below one.
  const double nearby = 0.1 * waves.Side / cells;
  const auto membrane = MakeMembrane(waves.MakeMesh(cells));
  for (const glm::dvec3& point :
    { glm::dvec3(0.0, -150.0, 0.0), { 3.0, -200.0, 5.0 }, { 8.0, -300.0, 2.0 } })
  {
    const auto filter = MakeAllImages(MakePoints({ { point.x, point.y, point.z } }), membrane);
    filter->SetEyePosition(Eye.x, Eye.y, Eye.z);
    filter->Update();
    vtkPolyData* output = filter->GetOutput();
    const auto exact = waves.FindSightPoints(Eye, point, 400);
    EXPECT_GT(exact.size(), 30u);
    ASSERT_EQ(static_cast<std::size_t>(output->GetNumberOfPoints()), exact.size()) << point.y;
    for (const glm::dvec3& sight : exact)
    {
      int found = 0;
      for (vtkIdType i = 0; i < output->GetNumberOfPoints(); ++i)
      {
        const auto own = TupleOf(output->GetPointData()->GetArray("SightPoint"), i);
        found += glm::distance(own, sight) < nearby;
      }
      EXPECT_EQ(found, 1) << point.y;
    }
  }
}

//------------------------------------------------------------------------------
// Behind a flat membrane every point has one image: the pieces of a tile cover it once.
TEST(RefractedGeometryImages, PiecesCoverThePolygonOnce)
{
  const auto wall = MakeWall(-80.0, -20.0);
  const auto filter = MakeAllImages(wall, MakeFlatMembrane());
  const glm::dvec3 eye(150.0, 60.0, 10.0);
  filter->SetEyePosition(eye.x, eye.y, eye.z);
  filter->Update();
  vtkPolyData* output = filter->GetOutput();
  EXPECT_GT(output->GetNumberOfPolys(), 10);
  EXPECT_NEAR(GetTrueArea(output, false), 60.0 * 70.0, 1e-8);
  vtkDataArray* truth = output->GetPointData()->GetArray("Truth");
  vtkDataArray* sight = output->GetPointData()->GetArray("SightPoint");
  vtkDataArray* depth = output->GetPointData()->GetArray("RefractionDepth");
  for (vtkIdType i = 0; i < output->GetNumberOfPoints(); ++i)
  {
    // The new point is on the polygon, and its sight point sees it.
    const glm::dvec3 t = TupleOf(truth, i);
    EXPECT_NEAR(glm::length(t - TupleOf(sight, i)), depth->GetTuple1(i), 1e-9);
    const glm::dvec3 a = glm::normalize(TupleOf(sight, i) - eye);
    const glm::dvec3 b = glm::normalize(t - TupleOf(sight, i));
    EXPECT_NEAR(a.x, 1.333 * b.x, 1e-7);
    EXPECT_NEAR(a.z, 1.333 * b.z, 1e-7);
  }
  for (vtkIdType i = 0; i < output->GetNumberOfCells(); ++i)
  {
    EXPECT_EQ(output->GetCellData()->GetArray("ImageOrientation")->GetTuple1(i), 1.0);
    EXPECT_EQ(output->GetCellData()->GetArray("SourceCellId")->GetTuple1(i), 0.0);
  }
}

//------------------------------------------------------------------------------
TEST(RefractedGeometryImages, SimpleCellsPassWhole)
{
  const auto grid = MakeGrid(9, 20.0, -50.0);
  const auto filter = MakeAllImages(grid, MakeFlatMembrane());
  filter->SetAngularTolerance(1.0);
  filter->Update();
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 81);
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPolys(), 64);
  EXPECT_EQ(filter->GetOutput()->GetPointData()->GetArray("Rank")->GetTuple1(40), 40.0);
}

//------------------------------------------------------------------------------
// The part in front is unchanged, the part behind is refracted, and nothing is lost or duplicated.
TEST(RefractedGeometryImages, PolygonsAreCutWhereTheyCrossAFlatMembrane)
{
  const auto filter = MakeAllImages(MakeWall(-25.0, 15.0), MakeFlatMembrane());
  filter->Update();
  vtkPolyData* output = filter->GetOutput();
  EXPECT_NEAR(GetTrueArea(output, true), 15.0 * 70.0, 1e-8);
  EXPECT_NEAR(GetTrueArea(output, false), 25.0 * 70.0, 1e-8);
  vtkDataArray* truth = output->GetPointData()->GetArray("Truth");
  vtkDataArray* facet = output->GetPointData()->GetArray("SightFacet");
  int crossing = 0;
  for (vtkIdType i = 0; i < output->GetNumberOfPoints(); ++i)
  {
    const glm::dvec3 t = TupleOf(truth, i);
    if (facet->GetTuple1(i) < 0.0)
    {
      EXPECT_GE(t.y, -1e-9);
      EXPECT_LT(glm::length(PointOf(output, i) - t), 1e-9);
    }
    else
    {
      EXPECT_LE(t.y, 1e-9);
    }
    crossing += std::fabs(t.y) < 1e-9;
  }
  EXPECT_GT(crossing, 10);
}

TEST(RefractedGeometryImages, PolygonsAreCutWhereTheyCrossWaves)
{
  const auto filter = MakeAllImages(MakeWall(-8.0, 15.0), MakeMembrane(Waves.MakeMesh(96)));
  filter->Update();
  vtkPolyData* output = filter->GetOutput();
  double exact = 0.0; // area of the wall above the waves
  constexpr int steps = 7000;
  for (int i = 0; i < steps; ++i)
  {
    exact += (15.0 - Waves.GetHeight(7.0, -30.0 + 70.0 * (i + 0.5) / steps)) * 70.0 / steps;
  }
  // Straight cuts over facets of 2 units: sagitta 2^2 / 8 times a curvature of 0.04.
  EXPECT_NEAR(GetTrueArea(output, true), exact, 0.02 * 70.0);
  vtkDataArray* truth = output->GetPointData()->GetArray("Truth");
  vtkDataArray* facet = output->GetPointData()->GetArray("SightFacet");
  int wrong = 0;
  for (vtkIdType i = 0; i < output->GetNumberOfPoints(); ++i)
  {
    const glm::dvec3 t = TupleOf(truth, i);
    const double height = t.y - Waves.GetHeight(t.x, t.z);
    if (facet->GetTuple1(i) < 0.0)
    {
      EXPECT_GE(height, -0.01) << i;
    }
    // A ray that leaves through the membrane again sees up to the crest of the waves; its hits in
    // front are dropped piece by piece.
    wrong += facet->GetTuple1(i) >= 0.0 && height > 0.1;
  }
  EXPECT_LT(wrong, output->GetNumberOfPoints() / 50);
}

TEST(RefractedGeometryImages, ObjectsInFrontPassUnchanged)
{
  const auto grid = MakeGrid(5, 40.0, 30.0);
  const auto filter = MakeAllImages(grid, MakeMembrane(Waves.MakeMesh(32)));
  filter->Update();
  vtkPolyData* output = filter->GetOutput();
  ASSERT_EQ(output->GetNumberOfPoints(), 25);
  EXPECT_EQ(output->GetNumberOfPolys(), 16);
  for (vtkIdType i = 0; i < 25; ++i)
  {
    EXPECT_EQ(PointOf(output, i), PointOf(grid, i));
    EXPECT_EQ(output->GetPointData()->GetArray("RefractionDepth")->GetTuple1(i), 0.0);
  }
}

//------------------------------------------------------------------------------
TEST(RefractedGeometryImages, LinesAreDividedAndCut)
{
  const auto line = MakePoints({ { -40.0, -60.0, 5.0 }, { 30.0, 20.0, 8.0 } });
  vtkNew<vtkCellArray> lines;
  lines->InsertNextCell({ 0, 1 });
  line->SetLines(lines);
  AddTruth(line);
  const auto filter = MakeAllImages(line, MakeFlatMembrane());
  filter->Update();
  vtkPolyData* output = filter->GetOutput();
  double behind = 0.0;
  double front = 0.0;
  vtkDataArray* truth = output->GetPointData()->GetArray("Truth");
  vtkDataArray* facet = output->GetPointData()->GetArray("SightFacet");
  vtkNew<vtkIdList> points;
  for (vtkIdType i = 0; i < output->GetNumberOfLines(); ++i)
  {
    output->GetLines()->GetCellAtId(i, points);
    ASSERT_EQ(points->GetNumberOfIds(), 2);
    const double length =
      glm::length(TupleOf(truth, points->GetId(1)) - TupleOf(truth, points->GetId(0)));
    (facet->GetTuple1(points->GetId(0)) < 0.0 ? front : behind) += length;
  }
  const double whole = glm::length(glm::dvec3(70.0, 80.0, 3.0));
  EXPECT_NEAR(behind, 0.75 * whole, 1e-8);
  EXPECT_NEAR(front, 0.25 * whole, 1e-8);
}

//------------------------------------------------------------------------------
TEST(RefractedGeometryImages, NothingIsComputedAgainWithoutNeed)
{
  const auto grid = MakeGrid(9, 80.0, -100.0);
  const auto filter = MakeAllImages(grid, MakeMembrane(Waves.MakeMesh(32)));
  filter->Update();
  const auto expect = [&filter](vtkTypeInt64 patches, vtkTypeInt64 eyes, vtkTypeInt64 vertices)
  {
    filter->Update();
    EXPECT_EQ(filter->GetNumberOfPatchBuilds(), patches);
    EXPECT_EQ(filter->GetNumberOfEyeUpdates(), eyes);
    EXPECT_EQ(filter->GetNumberOfSolvedVertices(), vertices);
  };
  expect(1, 1, 81);
  grid->GetPointData()->AddArray(MakeArray<vtkFloatArray>("Colour", 81, 0.5));
  expect(1, 1, 81);
  EXPECT_NE(filter->GetOutput()->GetPointData()->GetArray("Colour"), nullptr);
  const vtkIdType cells = filter->GetOutput()->GetNumberOfCells();
  filter->SetAngularTolerance(1.0);
  expect(1, 1, 81); // cells only
  EXPECT_LT(filter->GetOutput()->GetNumberOfCells(), cells);
  grid->GetPolys()->Reset();
  grid->GetCellData()->Initialize();
  grid->Modified();
  expect(1, 1, 81);
  EXPECT_EQ(filter->GetOutput()->GetNumberOfCells(), 0);
  filter->SetEyePosition(0.0, 250.0, 0.0);
  expect(1, 2, 162);
  filter->SetImagesToFirstImage();
  expect(1, 2, 243);
  filter->SetImagesToAllImages();
  expect(1, 2, 324);
}

//------------------------------------------------------------------------------
// A bowl that is a sphere shows a point on its axis as a ring: not all of its images can be found.
// That is counted, and reported once.
TEST(RefractedGeometryImages, CountsSearchesAtAFocus)
{
  const auto filter = MakeAllImages(MakePoints({ { 0.0, -550.0, 0.0 }, { 30.0, -60.0, 7.0 } }),
    MakeMembrane(meniscus::reference::MakeDisc(100.0, 12, 200.0)));
  filter->SetExteriorIndexOfRefraction(1.5);
  filter->SetInteriorIndexOfRefraction(1.0);
  filter->SetEyePosition(0.0, 2000.0, 0.0);
  const auto messages = UpdateAndObserve(filter);
  EXPECT_EQ(filter->GetStatistic("NumberOfUndecidedSearches"), 1);
  EXPECT_EQ(messages->Warnings, 1);
  EXPECT_TRUE(HasText(messages->Text, "undecided"));
  filter->SetEyePosition(0.0, 1990.0, 0.0);
  filter->Update();
  EXPECT_EQ(filter->GetStatistic("NumberOfUndecidedSearches"), 2);
  EXPECT_EQ(messages->Warnings, 1);
}

//------------------------------------------------------------------------------
TEST(RefractedGeometryImages, EyeFromBehindSeesNothingBehind)
{
  const auto filter = MakeAllImages(MakeGrid(5, 40.0, -30.0), MakeFlatMembrane());
  filter->SetEyePosition(0.0, -100.0, 0.0);
  filter->Update();
  EXPECT_EQ(filter->GetOutput()->GetNumberOfCells(), 0);
  EXPECT_EQ(filter->GetStatistic("NumberOfVerticesWithoutImage"), 25);
  EXPECT_EQ(filter->GetStatistic("NumberOfSkippedCells"), 16);
}

}
