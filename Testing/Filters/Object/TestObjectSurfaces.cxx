// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Geometry that is no vtkPolyData or has polygons that are not convex, cameras without an eye, and
// ids of cells that are cut.
#include "RefractedGeometryTestHelpers.h"

#include "VTKTestBasics.h"
#include "vtkRefractingInterfaceCollection.h"

#include <vtkImageData.h>

#include <array>
#include <set>

namespace
{

using namespace meniscus::test;

vtkSmartPointer<vtkRefractedGeometryFilter> MakeView(vtkDataObject* geometry)
{
  auto filter = vtkSmartPointer<vtkRefractedGeometryFilter>::New();
  filter->SetInputDataObject(0, geometry);
  filter->SetMembraneData(MakeFlatMembrane());
  filter->SetEyePosition(20.0, 300.0, 10.0);
  filter->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  return filter;
}

/** A row of two hexahedra in the water, with the point and cell arrays "Rank". */
vtkSmartPointer<vtkUnstructuredGrid> MakeHexahedra()
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  for (const double x : { -10.0, 0.0, 10.0 })
  {
    for (const auto& [y, z] :
      { std::pair{ -30.0, 0.0 }, { -20.0, 0.0 }, { -20.0, 10.0 }, { -30.0, 10.0 } })
    {
      points->InsertNextPoint(x, y, z);
    }
  }
  grid->SetPoints(points);
  for (const vtkIdType first : { 0, 4 })
  {
    vtkIdType ids[8];
    std::generate(ids, ids + 8, [next = first]() mutable { return next++; });
    grid->InsertNextCell(VTK_HEXAHEDRON, 8, ids);
  }
  for (vtkDataSetAttributes* data : { static_cast<vtkDataSetAttributes*>(grid->GetPointData()),
         static_cast<vtkDataSetAttributes*>(grid->GetCellData()) })
  {
    data->AddArray(MakeArray<vtkIdTypeArray>(
      "Rank", (data == grid->GetPointData() ? 12 : 2), [&](vtkIdType i) { return 100 + i; }));
  }
  return grid;
}

/** Compares ids with the array "Rank" of the input, and points with images of single points. */
void ExpectImagesOf(vtkPointSet* input, vtkPolyData* output)
{
  vtkNew<vtkPolyData> points;
  points->SetPoints(input->GetPoints());
  const auto single = MakeView(points);
  single->Update();
  ASSERT_GT(output->GetNumberOfPoints(), 0);
  auto* ids = output->GetPointData()->GetArray("SourcePointId");
  auto* ranks = output->GetPointData()->GetArray("Rank");
  for (vtkIdType i = 0; i < output->GetNumberOfPoints(); ++i)
  {
    const auto id = static_cast<vtkIdType>(ids->GetTuple1(i));
    EXPECT_EQ(ranks->GetTuple1(i), 100.0 + id);
    EXPECT_LT(glm::length(PointOf(output, i) - PointOf(single->GetOutput(), id)), 1e-9);
  }
  for (vtkIdType i = 0; i < output->GetNumberOfCells(); ++i)
  {
    EXPECT_EQ(output->GetCellData()->GetArray("Rank")->GetTuple1(i),
      100.0 + output->GetCellData()->GetArray("SourceCellId")->GetTuple1(i));
  }
}

TEST(ObjectSurfaces, GridsAreSeenByTheirSurface)
{
  const auto grid = MakeHexahedra();
  const auto view = MakeView(grid);
  ExpectQuiet(view);
  EXPECT_EQ(view->GetOutput()->GetNumberOfPolys(), 10); // of twelve faces, two are inside
  ExpectImagesOf(grid, view->GetOutput());
  const vtkTypeInt64 solved = view->GetNumberOfSolvedVertices();
  view->SetReflectanceModelToSchlick();
  view->Update();
  EXPECT_EQ(view->GetNumberOfSolvedVertices(), solved) << "the surface is kept";
  view->SetImagesToFirstImage();
  view->Update();
  EXPECT_EQ(view->GetOutput()->GetNumberOfPolys(), 10);

  vtkNew<vtkImageData> image;
  image->SetDimensions(3, 3, 3);
  image->SetOrigin(0.0, -40.0, 0.0);
  const auto box = MakeView(image);
  box->Update();
  EXPECT_EQ(box->GetOutput()->GetNumberOfPolys(), 24);

  vtkNew<vtkRefractedLightFilter> light;
  light->SetInputDataObject(0, grid);
  light->SetMembraneData(MakeFlatMembrane());
  light->SetLightPosition(0.0, 1.0, 0.0);
  light->Update();
  EXPECT_EQ(light->GetOutput()->GetNumberOfCells(), 10);
}

TEST(ObjectSurfaces, BlocksAreOneOutputOrSeveral)
{
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, MakeHexahedra());
  blocks->SetBlock(2, MakeGrid(3, 20.0, -10.0));
  const auto view = MakeView(blocks);
  ExpectQuiet(view);
  ASSERT_TRUE(vtkMultiBlockDataSet::SafeDownCast(view->GetOutputDataObject(0)));
  ASSERT_NE(view->GetOutput(), nullptr);
  EXPECT_EQ(view->GetOutput()->GetNumberOfPolys(), 14);
  view->SetInputDataObject(0, MakeGrid(3, 20.0, -10.0));
  view->Update();
  EXPECT_EQ(view->GetOutput()->GetNumberOfPolys(), 4);
}

TEST(ObjectSurfaces, LitBlocksAreOneOutputOrSeveral)
{
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, MakeHexahedra());
  blocks->SetBlock(2, MakeGrid(3, 20.0, -10.0));
  vtkNew<vtkRefractedLightFilter> light;
  light->SetInputDataObject(0, blocks);
  light->SetMembraneData(MakeFlatMembrane());
  light->SetLightPosition(0.0, 1.0, 0.0);
  ExpectQuiet(light);
  ASSERT_TRUE(vtkMultiBlockDataSet::SafeDownCast(light->GetOutputDataObject(0)));
  ASSERT_NE(light->GetOutput(), nullptr);
  EXPECT_EQ(light->GetOutput()->GetNumberOfPolys(), 14);
  EXPECT_NE(light->GetOutput()->GetCellData()->GetArray("RefractionIrradiance"), nullptr);
}

TEST(ObjectSurfaces, NoBlocksAreAnEmptyOutput)
{
  const auto view = MakeView(vtkNew<vtkMultiBlockDataSet>());
  ExpectQuiet(view);
  ASSERT_NE(view->GetOutput(), nullptr);
  EXPECT_EQ(view->GetOutput()->GetNumberOfPoints(), 0);
}

/** A polygon in the shape of a U, and a square with one of its corners pushed inside. */
vtkSmartPointer<vtkPolyData> MakeConcave()
{
  auto data = MakePoints({ { 0.0, -20.0, 0.0 }, { 30.0, -20.0, 0.0 }, { 30.0, -20.0, 30.0 },
    { 20.0, -20.0, 30.0 }, { 20.0, -20.0, 10.0 }, { 10.0, -20.0, 10.0 }, { 10.0, -20.0, 30.0 },
    { 0.0, -20.0, 30.0 }, { -5.0, -20.0, 5.0 } });
  vtkNew<vtkCellArray> polygons;
  const vtkIdType triangle[3] = { 0, 7, 8 };
  const vtkIdType letter[8] = { 0, 1, 2, 3, 4, 5, 6, 7 };
  polygons->InsertNextCell(3, triangle);
  polygons->InsertNextCell(8, letter);
  polygons->InsertNextCell(3, triangle);
  data->SetPolys(polygons);
  data->GetCellData()->SetGlobalIds(
    MakeArray<vtkIdTypeArray>("Rank", 3, [&](vtkIdType i) { return 100 + i; }));
  return data;
}

double AreaOfTriangles(vtkPolyData* data, vtkIdType source)
{
  double area = 0.0;
  for (vtkIdType i = 0; i < data->GetNumberOfCells(); ++i)
  {
    vtkCell* cell = data->GetCell(i);
    EXPECT_EQ(cell->GetNumberOfPoints(), 3);
    if (data->GetCellData()->GetArray("SourceCellId")->GetTuple1(i) == source)
    {
      const glm::dvec3 first = PointOf(data, cell->GetPointId(0));
      area += 0.5 *
        glm::length(glm::cross(
          PointOf(data, cell->GetPointId(1)) - first, PointOf(data, cell->GetPointId(2)) - first));
    }
  }
  return area;
}

// Vertical sight lines keep the shape: the eye is far above.
TEST(ObjectSurfaces, ConcavePolygonsAreDividedAndTheirGlobalIdsAreNot)
{
  for (const bool all : { true, false })
  {
    const auto view = MakeView(MakeConcave());
    view->SetEyePosition(15.0, 1e6, 15.0);
    view->SetImages(
      all ? vtkRefractedGeometryFilter::ALL_IMAGES : vtkRefractedGeometryFilter::FIRST_IMAGE);
    view->Update();
    vtkPolyData* seen = view->GetOutput();
    EXPECT_EQ(seen->GetNumberOfPolys(), 8);
    EXPECT_NEAR(AreaOfTriangles(seen, 1), 700.0, 1e-2);
    EXPECT_EQ(seen->GetCellData()->GetGlobalIds(), nullptr);
    ASSERT_NE(seen->GetCellData()->GetArray("Rank"), nullptr);
    for (vtkIdType i = 0; i < seen->GetNumberOfCells(); ++i)
    {
      EXPECT_EQ(seen->GetCellData()->GetArray("Rank")->GetTuple1(i),
        100.0 + seen->GetCellData()->GetArray("SourceCellId")->GetTuple1(i));
    }
  }
  const auto whole = MakeGrid(3, 20.0, -20.0);
  whole->GetCellData()->SetGlobalIds(
    MakeArray<vtkIdTypeArray>("Global", 4, [&](vtkIdType i) { return 7 * i; }));
  const auto view = MakeView(whole);
  view->Update();
  EXPECT_NE(view->GetOutput()->GetCellData()->GetGlobalIds(), nullptr) << "no cell is cut";
}

// VTK's division has tolerances that are lengths.
TEST(ObjectSurfaces, ConcavePolygonsOfAnySizeAreDivided)
{
  for (const double unit : { 1e-9, 1e-6, 1e-3, 1e6 })
  {
    const auto scale = [unit](vtkSmartPointer<vtkPolyData> data)
    {
      vtkNew<vtkPoints> points;
      points->SetDataTypeToDouble();
      for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i)
      {
        const glm::dvec3 point = unit * PointOf(data, i);
        points->InsertNextPoint(point.x, point.y, point.z);
      }
      data->SetPoints(points);
      return data;
    };
    const auto view = MakeView(scale(MakeConcave()));
    view->SetMembraneData(scale(MakeFlatMembrane()));
    view->SetEyePosition(15.0 * unit, 1e6 * unit, 15.0 * unit);
    view->Update();
    EXPECT_EQ(view->GetOutput()->GetNumberOfPolys(), 8) << unit;
    EXPECT_NEAR(AreaOfTriangles(view->GetOutput(), 1) / (unit * unit), 700.0, 1e-2) << unit;
  }
}

/** A frame: a square with a square hole that a bridge joins to its border. */
vtkSmartPointer<vtkPolyData> MakeFrame(double half, double y)
{
  vtkSmartPointer<vtkPolyData> data = MakePoints({});
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const double size : { half, half / 3.0 })
  {
    for (const auto& [x, z] :
      { std::pair{ -1.0, -1.0 }, { -1.0, 1.0 }, { 1.0, 1.0 }, { 1.0, -1.0 } })
    {
      points->InsertNextPoint(size * x, y, size * z);
    }
  }
  data->SetPoints(points);
  const vtkIdType corners[10] = { 0, 1, 2, 3, 0, 4, 7, 6, 5, 4 };
  vtkNew<vtkCellArray> polygons;
  polygons->InsertNextCell(10, corners);
  data->SetPolys(polygons);
  return data;
}

// Vertical sight lines keep the shape. VTK's triangulation leaves such polygons out.
TEST(ObjectSurfaces, PolygonsThatTouchOrCrossThemselvesAreSeen)
{
  for (const bool all : { true, false })
  {
    const auto view = MakeView(MakeFrame(15.0, -20.0));
    view->SetEyePosition(0.0, 1e6, 0.0);
    view->SetImages(
      all ? vtkRefractedGeometryFilter::ALL_IMAGES : vtkRefractedGeometryFilter::FIRST_IMAGE);
    view->Update();
    EXPECT_EQ(view->GetOutput()->GetNumberOfPolys(), 8);
    EXPECT_NEAR(AreaOfTriangles(view->GetOutput(), 0), 800.0, 1e-2);
  }
  auto crossed = MakePoints(
    { { 0.0, -20.0, 0.0 }, { 9.0, -20.0, 9.0 }, { 9.0, -20.0, 0.0 }, { 0.0, -20.0, 9.0 } });
  const vtkIdType corners[4] = { 0, 1, 2, 3 };
  vtkNew<vtkCellArray> polygons;
  polygons->InsertNextCell(4, corners);
  crossed->SetPolys(polygons);
  const auto view = MakeView(crossed);
  view->Update();
  EXPECT_GT(view->GetOutput()->GetNumberOfPolys(), 0);
}

/** A concave polygon that is not plane, whose seventh corner repeats the sixth one. */
vtkSmartPointer<vtkPolyData> MakeBent(double height, double size)
{
  std::vector<Point> corners;
  for (const auto& [x, y, z] : { std::array{ 0.0, 0.0, 0.0 }, { 0.0, 0.2, 1.0 }, { 0.5, -0.1, 0.4 },
         { 1.0, 0.0, 1.0 }, { 1.0, 0.2, 0.0 }, { 0.7, 0.1, 0.3 }, { 0.7, 0.1, 0.3 } })
  {
    corners.push_back({ size * x, height + size * y, size * z });
  }
  auto data = MakePoints(corners);
  const vtkIdType ids[7] = { 0, 1, 2, 3, 4, 5, 6 };
  vtkNew<vtkCellArray> polygons;
  polygons->InsertNextCell(7, ids);
  data->SetPolys(polygons);
  return data;
}

/** Component by y of the sum of the area vectors of all triangles, at the true points. */
double SumAreas(vtkPolyData* data)
{
  double sum = 0.0;
  vtkDataArray* places = data->GetPointData()->GetArray("TruePosition");
  for (vtkIdType i = 0; i < data->GetNumberOfCells(); ++i)
  {
    vtkCell* cell = data->GetCell(i);
    EXPECT_EQ(cell->GetNumberOfPoints(), 3);
    glm::dvec3 corner[3];
    for (int k = 0; k < 3; ++k)
    {
      places->GetTuple(cell->GetPointId(k), &corner[k].x);
    }
    sum += 0.5 * glm::cross(corner[1] - corner[0], corner[2] - corner[0]).y;
  }
  return sum;
}

// VTK's division leaves out parts of polygons that are not plane.
TEST(ObjectSurfaces, BentPolygonsAreDividedWhole)
{
  // Half the sum of the cross products of the corners, without the repeated one.
  const double area = 900.0 * 0.55;
  const auto view = MakeView(MakeBent(-20.0, 30.0));
  view->TrueGeometryOn();
  view->CloseSeamsOff();
  for (const bool all : { true, false })
  {
    view->SetImages(
      all ? vtkRefractedGeometryFilter::ALL_IMAGES : vtkRefractedGeometryFilter::FIRST_IMAGE);
    view->Update();
    EXPECT_NEAR(SumAreas(view->GetOutput()), area, 1e-9);
  }
  // A point has one image if a triangle of the divided membrane is above it.
  const auto through = MakeView(MakePoints({ { 44.0, -40.0, 34.0 } }));
  through->SetMembraneData(MakeBent(0.0, 60.0));
  through->SetInteriorIndexOfRefraction(1.001);
  through->SetEyePosition(44.0, 1e4, 34.0);
  through->Update();
  EXPECT_EQ(through->GetOutput()->GetNumberOfPoints(), 1);
}

// Through a list, as through one surface, each cell has the light of its area.
TEST(ObjectSurfaces, ConcavePolygonsHaveTheirLight)
{
  for (const int interfaces : { 1, 2 })
  {
    vtkNew<vtkRefractedLightFilter> light;
    light->SetInputData(MakeConcave());
    light->SetLightPosition(0.0, 1.0, 0.0);
    vtkNew<vtkRefractingInterfaceCollection> list;
    list->AddInterface(1.0, 1.333);
    light->AddMembraneData(MakeFlatMembrane());
    if (interfaces > 1)
    {
      list->AddInterface(1.333, 1.5);
      auto lower = MakeGrid(3, 200.0, -10.0);
      light->AddMembraneData(lower);
    }
    light->SetInterfaces(list);
    ExpectQuiet(light);
    vtkDataArray* irradiance = light->GetOutput()->GetCellData()->GetArray("RefractionIrradiance");
    ASSERT_EQ(irradiance->GetNumberOfTuples(), 3);
    EXPECT_GT(irradiance->GetTuple1(0), 0.9);
    EXPECT_NEAR(irradiance->GetTuple1(1), irradiance->GetTuple1(0), 1e-4);
  }
}

// Points of a grid that are on several of its sides are there several times.
TEST(ObjectSurfaces, RepeatedPointsOfAGridHaveNoGlobalIds)
{
  vtkNew<vtkImageData> image;
  image->SetDimensions(3, 3, 3);
  image->SetSpacing(10.0, 10.0, 10.0);
  image->SetOrigin(-10.0, -40.0, -10.0);
  image->GetPointData()->SetGlobalIds(
    MakeArray<vtkIdTypeArray>("Rank", 27, [](vtkIdType i) { return 100 + i; }));
  const auto view = MakeView(image);
  view->SetImagesToFirstImage();
  view->Update();
  std::set<double> ids;
  vtkPointData* data = view->GetOutput()->GetPointData();
  vtkDataArray* ranks = data->GetArray("Rank");
  ASSERT_NE(ranks, nullptr);
  for (const double rank : ValuesOf(ranks))
  {
    ids.insert(rank);
  }
  const bool areUnique = ids.size() == static_cast<std::size_t>(ranks->GetNumberOfTuples());
  EXPECT_EQ(data->GetGlobalIds() != nullptr, areUnique);
}

TEST(ObjectSurfaces, MembranesWithAHoleInAPolygonRefract)
{
  auto points = MakePoints({ { 30.0, -20.0, 10.0 } });
  const vtkIdType id = 0;
  vtkNew<vtkCellArray> vertices;
  vertices->InsertNextCell(1, &id);
  points->SetVerts(vertices);
  const auto view = MakeView(points);
  view->Update();
  ASSERT_EQ(view->GetOutput()->GetNumberOfPoints(), 1);
  const glm::dvec3 behindWhole = PointOf(view->GetOutput(), 0);
  view->SetMembraneData(MakeFrame(60.0, 0.0));
  view->Update();
  ASSERT_EQ(view->GetOutput()->GetNumberOfPoints(), 1);
  EXPECT_LT(glm::distance(PointOf(view->GetOutput(), 0), behindWhole), 1e-6);
}

// Below flat water, a parallel camera sees a point along the direction that Snell's law gives.
TEST(ObjectSurfaces, ParallelCamerasHaveTheirEyeAtInfinity)
{
  vtkNew<vtkCamera> camera;
  camera->ParallelProjectionOn();
  camera->SetParallelScale(50.0);
  camera->SetPosition(40.0, 80.0, 30.0);
  camera->SetFocalPoint(0.0, 0.0, 0.0);
  glm::dvec3 sight;
  camera->GetDirectionOfProjection(&sight.x);
  const auto points = MakePoints({ { 5.0, -20.0, -10.0 }, { -15.0, -35.0, 2.0 } });
  const auto view = MakeView(points);
  view->SetCamera(camera);
  ExpectQuiet(view);
  ASSERT_EQ(view->GetOutput()->GetNumberOfPoints(), 2);
  constexpr double index = 1.333;
  glm::dvec3 refracted(sight.x / index, 0.0, sight.z / index);
  refracted.y = -std::sqrt(1.0 - glm::dot(refracted, refracted));
  for (vtkIdType i = 0; i < 2; ++i)
  {
    const glm::dvec3 truth = PointOf(points, i);
    const double path = truth.y / refracted.y;
    const glm::dvec3 expected = truth - path * refracted + path / index * sight;
    EXPECT_LT(glm::length(PointOf(view->GetOutput(), i) - expected), 1e-3);
  }
  // Moving along keeps the eye.
  const vtkTypeInt64 updates = view->GetNumberOfEyeUpdates();
  camera->SetPosition(41.0, 82.0, 33.0);
  camera->SetFocalPoint(1.0, 2.0, 3.0);
  view->Update();
  EXPECT_EQ(view->GetNumberOfEyeUpdates(), updates);
}

// A line that bends in the picture is divided as finely as in perspective.
TEST(ObjectSurfaces, ParallelPicturesAreDividedAsFinely)
{
  auto line = MakePoints({ { -40.0, -20.0, 0.0 }, { 40.0, -60.0, 0.0 } });
  vtkNew<vtkCellArray> lines;
  lines->InsertNextCell({ 0, 1 });
  line->SetLines(lines);
  const auto waves = MakeMembrane(meniscus::reference::MakeWaves(200.0, 40, 1.0, 4.0));
  vtkIdType points[2];
  for (const bool isParallel : { false, true })
  {
    vtkNew<vtkCamera> camera;
    camera->SetPosition(20.0, 300.0, 10.0);
    camera->SetFocalPoint(0.0, 0.0, 0.0);
    camera->SetParallelProjection(isParallel);
    camera->SetParallelScale(camera->GetDistance() * std::tan(vtkMath::RadiansFromDegrees(15.0)));
    const auto view = MakeView(line);
    view->SetMembraneData(waves);
    view->SetCamera(camera);
    view->Update();
    points[isParallel] = view->GetOutput()->GetNumberOfPoints();
  }
  EXPECT_GT(points[0], 20);
  EXPECT_NEAR(static_cast<double>(points[1]) / static_cast<double>(points[0]), 1.0, 0.4);
}

}
