// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Output of the filter: positions, arrays, cells of every kind.
#include "AnalyticMembrane.h"
#include "RefractedGeometryTestHelpers.h"
#include "Refraction/Membrane/Optics.h"
#include "VTKTestBasics.h"

namespace
{

using namespace meniscus::test;

vtkDataArray* PointArray(vtkPolyData* data, const char* name)
{
  return data->GetPointData()->GetArray(name);
}

vtkDataArray* CellArray(vtkPolyData* data, const char* name)
{
  return data->GetCellData()->GetArray(name);
}

std::vector<vtkIdType> CellPoints(vtkCellArray* cells, vtkIdType cell)
{
  vtkNew<vtkIdList> ids;
  cells->GetCellAtId(cell, ids);
  return { ids->begin(), ids->end() };
}

//------------------------------------------------------------------------------
TEST(RefractedGeometryOutput, GridKeepsConnectivityAndArrays)
{
  const auto grid = MakeGrid(9, 80.0, -50.0);
  const auto filter = MakeFilter(grid, MakeFlatMembrane());
  const auto messages = UpdateAndObserve(filter);
  vtkPolyData* output = filter->GetOutput();
  EXPECT_EQ(messages->Errors + messages->Warnings, 0) << messages->Text;
  ASSERT_EQ(output->GetNumberOfPoints(), 81);
  ASSERT_EQ(output->GetNumberOfPolys(), 64);
  EXPECT_EQ(output->GetPoints()->GetDataType(), VTK_DOUBLE);
  for (vtkIdType cell = 0; cell < 64; ++cell)
  {
    EXPECT_EQ(CellPoints(output->GetPolys(), cell), CellPoints(grid->GetPolys(), cell));
    EXPECT_EQ(CellArray(output, "Label")->GetTuple1(cell), 10.0 * static_cast<double>(cell));
    EXPECT_EQ(CellArray(output, "SourceCellId")->GetTuple1(cell), cell);
    EXPECT_EQ(CellArray(output, "ImageOrientation")->GetTuple1(cell), 1.0);
  }
  const meniscus::reference::AnalyticMembrane exact{ 0.0, 1.0, 1.333 };
  for (vtkIdType i = 0; i < 81; ++i)
  {
    double p[3];
    double s[3];
    double v[3];
    grid->GetPoint(i, p);
    output->GetPoint(i, v);
    PointArray(output, "SightPoint")->GetTuple(i, s);
    // Interpolation, over facets of 25 units, of a map whose radius of curvature is the eye's
    // height of 300: the error is at most size^2 / (8 radius).
    const auto truth = exact.FindSightPoints({ 20.0, 300.0, 10.0 }, { p[0], p[1], p[2] });
    ASSERT_EQ(truth.size(), 1u);
    EXPECT_LT(glm::length(truth[0] - glm::dvec3(s[0], s[1], s[2])), 25.0 * 25.0 / (8.0 * 300.0));
    const double depth = PointArray(output, "RefractionDepth")->GetTuple1(i);
    EXPECT_NEAR(depth, std::sqrt(vtkMath::Distance2BetweenPoints(p, s)), 1e-11);
    EXPECT_NEAR(std::sqrt(vtkMath::Distance2BetweenPoints(v, s)), depth / 1.333, 1e-11);
    // The reported facet contains the sight point: 16 by 8 facets of squares of 25 units.
    const auto facet = static_cast<vtkIdType>(PointArray(output, "SightFacet")->GetTuple1(i));
    EXPECT_GE(s[0], -100.0 + 25.0 * static_cast<double>(facet / 2 % 8) - 1e-9);
    EXPECT_LE(s[0], -75.0 + 25.0 * static_cast<double>(facet / 2 % 8) + 1e-9);
    EXPECT_GE(s[2], -100.0 + 25.0 * static_cast<double>(facet / 16) - 1e-9);
    EXPECT_LE(s[2], -75.0 + 25.0 * static_cast<double>(facet / 16) + 1e-9);
    const double cosine =
      300.0 / std::sqrt(vtkMath::Distance2BetweenPoints(s, filter->GetEyePosition()));
    EXPECT_NEAR(PointArray(output, "Reflectance")->GetTuple1(i),
      meniscus::FresnelReflectance(cosine, 1.0, 1.333), 1e-12);
    EXPECT_EQ(PointArray(output, "SourcePointId")->GetTuple1(i), i);
    EXPECT_EQ(PointArray(output, "Rank")->GetTuple1(i), i);
  }
  auto* without =
    vtkIdTypeArray::SafeDownCast(output->GetFieldData()->GetAbstractArray("PointsWithoutImage"));
  ASSERT_NE(without, nullptr);
  EXPECT_EQ(without->GetNumberOfTuples(), 0);
}

//------------------------------------------------------------------------------
TEST(RefractedGeometryOutput, PointsWithoutImageTakeTheirCellsWithThem)
{
  // Two of the three columns are below the membrane.
  auto grid = MakePoints({ { 0, -10, 0 }, { 10, -10, 0 }, { 0, 50, 0 }, { 10, -10, 10 },
    { 0, -10, 10 }, { 20, -10, 0 } });
  vtkNew<vtkCellArray> polys;
  const vtkIdType good[3] = { 0, 1, 3 };
  const vtkIdType bad[3] = { 0, 1, 2 };
  const vtkIdType quad[4] = { 0, 1, 3, 4 };
  polys->InsertNextCell(3, bad);
  polys->InsertNextCell(3, good);
  polys->InsertNextCell(4, quad);
  grid->SetPolys(polys);
  vtkNew<vtkCellArray> lines;
  lines->InsertNextCell({ 5, 2, 0 });
  lines->InsertNextCell(2, good);
  grid->SetLines(lines);
  vtkNew<vtkStringArray> names;
  names->SetName("Names");
  for (const char* name : { "a", "b", "c", "d", "e", "f" })
  {
    names->InsertNextValue(name);
  }
  grid->GetPointData()->AddArray(names);

  const auto filter = MakeFilter(grid, MakeFlatMembrane());
  filter->Update();
  vtkPolyData* output = filter->GetOutput();
  EXPECT_EQ(output->GetNumberOfPoints(), 5);
  EXPECT_EQ(output->GetNumberOfLines(), 1);
  EXPECT_EQ(output->GetNumberOfPolys(), 2);
  EXPECT_EQ(filter->GetStatistic("NumberOfSkippedCells"), 2);
  EXPECT_EQ(filter->GetStatistic("NumberOfVerticesWithoutImage"), 1);
  EXPECT_EQ(filter->GetNumberOfFailedSolves(), 0);
  EXPECT_EQ(filter->GetNumberOfSolvedVertices(), 6);
  auto* without =
    vtkIdTypeArray::SafeDownCast(output->GetFieldData()->GetAbstractArray("PointsWithoutImage"));
  ASSERT_NE(without, nullptr);
  ASSERT_EQ(without->GetNumberOfTuples(), 1);
  EXPECT_EQ(without->GetValue(0), 2);
  // Cells: lines before polygons. The indices of points 3, 4, 5 are one lower.
  EXPECT_EQ(CellArray(output, "SourceCellId")->GetTuple1(0), 1);
  EXPECT_EQ(CellArray(output, "SourceCellId")->GetTuple1(1), 3);
  EXPECT_EQ(CellArray(output, "SourceCellId")->GetTuple1(2), 4);
  EXPECT_EQ(CellPoints(output->GetPolys(), 0), (std::vector<vtkIdType>{ 0, 1, 2 }));
  EXPECT_EQ(CellPoints(output->GetPolys(), 1), (std::vector<vtkIdType>{ 0, 1, 2, 3 }));
  EXPECT_EQ(PointArray(output, "SourcePointId")->GetTuple1(4), 5);
  auto* passed = vtkStringArray::SafeDownCast(output->GetPointData()->GetAbstractArray("Names"));
  ASSERT_NE(passed, nullptr);
  EXPECT_EQ(passed->GetValue(2), "d");
}

//------------------------------------------------------------------------------
TEST(RefractedGeometryOutput, VerticesAreOneCellPerImage)
{
  auto cloud =
    MakePoints({ { 0, -10, 0 }, { 10, -10, 0 }, { 0, 50, 0 }, { 10, -10, 10 }, { 500, -1, 0 } });
  vtkNew<vtkCellArray> verts;
  const vtkIdType several[4] = { 3, 2, 1, 0 };
  const vtkIdType outside = 4;
  verts->InsertNextCell(4, several);
  verts->InsertNextCell(1, &outside);
  verts->InsertNextCell(1, several);
  cloud->SetVerts(verts);
  const auto filter = MakeFilter(cloud, MakeFlatMembrane());
  filter->Update();
  vtkPolyData* output = filter->GetOutput();
  EXPECT_EQ(output->GetNumberOfPoints(), 3);
  ASSERT_EQ(output->GetNumberOfVerts(), 4);
  EXPECT_EQ(output->GetNumberOfCells(), 4);
  const vtkIdType points[4] = { 2, 1, 0, 2 };
  const vtkIdType sources[4] = { 0, 0, 0, 2 };
  for (vtkIdType i = 0; i < 4; ++i)
  {
    EXPECT_EQ(CellPoints(output->GetVerts(), i), std::vector<vtkIdType>{ points[i] });
    EXPECT_EQ(CellArray(output, "SourceCellId")->GetTuple1(i), sources[i]);
  }
  EXPECT_EQ(filter->GetStatistic("NumberOfSkippedCells"), 2);
  EXPECT_EQ(filter->GetStatistic("NumberOfVerticesWithoutImage"), 2);
}

//------------------------------------------------------------------------------
TEST(RefractedGeometryOutput, StripsKeepTheirPoints)
{
  auto strip =
    MakePoints({ { 0, -10, 0 }, { 0, -10, 10 }, { 10, -10, 0 }, { 10, -10, 10 }, { 20, 90, 0 } });
  vtkNew<vtkCellArray> strips;
  const vtkIdType ids[5] = { 0, 1, 2, 3, 4 };
  strips->InsertNextCell(5, ids);
  strips->InsertNextCell(4, ids);
  strip->SetStrips(strips);
  const auto filter = MakeFilter(strip, MakeFlatMembrane());
  filter->Update();
  vtkPolyData* output = filter->GetOutput();
  ASSERT_EQ(output->GetNumberOfStrips(), 1);
  EXPECT_EQ(CellPoints(output->GetStrips(), 0), (std::vector<vtkIdType>{ 0, 1, 2, 3 }));
  EXPECT_EQ(CellArray(output, "SourceCellId")->GetTuple1(0), 1);
  EXPECT_EQ(filter->GetStatistic("NumberOfSkippedCells"), 1);
}

//------------------------------------------------------------------------------
TEST(RefractedGeometryOutput, PointsWithoutCellsAreSolved)
{
  const auto filter = MakeFilter(MakePoints({ { 0, -10, 0 }, { 5, -20, 5 } }), MakeFlatMembrane());
  filter->Update();
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 2);
  EXPECT_EQ(filter->GetOutput()->GetNumberOfCells(), 0);
}

//------------------------------------------------------------------------------
TEST(RefractedGeometryOutput, PrecisionFollowsTheInputUnlessSet)
{
  auto grid = MakeGrid(3, 20.0, -5.0);
  vtkNew<vtkPoints> floats;
  floats->SetDataTypeToFloat();
  for (vtkIdType i = 0; i < grid->GetNumberOfPoints(); ++i)
  {
    floats->InsertNextPoint(grid->GetPoint(i));
  }
  grid->SetPoints(floats);
  const auto filter = MakeFilter(grid, MakeFlatMembrane());
  filter->Update();
  EXPECT_EQ(filter->GetOutput()->GetPoints()->GetDataType(), VTK_FLOAT);
  EXPECT_EQ(PointArray(filter->GetOutput(), "SightPoint")->GetDataType(), VTK_DOUBLE);
  filter->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  filter->Update();
  EXPECT_EQ(filter->GetOutput()->GetPoints()->GetDataType(), VTK_DOUBLE);
  filter->SetOutputPointsPrecision(vtkAlgorithm::SINGLE_PRECISION);
  filter->Update();
  EXPECT_EQ(filter->GetOutput()->GetPoints()->GetDataType(), VTK_FLOAT);
}

//------------------------------------------------------------------------------
double DoubleAreaFromAbove(vtkDataArray* positions, const std::vector<vtkIdType>& ids)
{
  double p[3][3];
  for (std::size_t i = 0; i < 3; ++i)
  {
    positions->GetTuple(ids[i], p[i]);
  }
  return (p[1][2] - p[0][2]) * (p[2][0] - p[0][0]) - (p[1][0] - p[0][0]) * (p[2][2] - p[0][2]);
}

// Strong waves have their foci above the grid. If a whole quad is seen in one facet, its sight
// points alone show whether the image is mirrored.
TEST(RefractedGeometryOutput, CausticsMirrorCells)
{
  const auto membrane = MakeMembrane(meniscus::reference::MakeWaves(200.0, 40, 8.0, 3.0));
  const auto grid = MakeGrid(301, 100.0, -110.0);
  const auto filter = MakeFilter(grid, membrane);
  filter->Update();
  vtkPolyData* output = filter->GetOutput();
  int mirrored = 0;
  int upright = 0;
  int wrong = 0;
  for (vtkIdType cell = 0; cell < output->GetNumberOfPolys(); ++cell)
  {
    const double value = CellArray(output, "ImageOrientation")->GetTuple1(cell);
    ASSERT_TRUE(value == 1.0 || value == -1.0);
    const auto ids = CellPoints(output->GetPolys(), cell);
    std::vector<vtkIdType> sources;
    bool oneFacet = true;
    for (const vtkIdType id : ids)
    {
      sources.push_back(static_cast<vtkIdType>(PointArray(output, "SourcePointId")->GetTuple1(id)));
      oneFacet = oneFacet &&
        PointArray(output, "SightFacet")->GetTuple1(id) ==
          PointArray(output, "SightFacet")->GetTuple1(ids[0]);
    }
    if (oneFacet)
    {
      const double seen = DoubleAreaFromAbove(PointArray(output, "SightPoint"), ids);
      const double source = DoubleAreaFromAbove(grid->GetPoints()->GetData(), sources);
      wrong += (seen * source > 0.0) != (value > 0.0);
      mirrored += value < 0.0;
      upright += value > 0.0;
    }
  }
  EXPECT_EQ(wrong, 0);
  EXPECT_GT(mirrored, 50);
  EXPECT_GT(upright, 1000);
}

//------------------------------------------------------------------------------
// The same surface as quads, as strips, and as triangles preceded by vertices and lines.
TEST(RefractedGeometryOutput, MembraneMayBePolygonsOrStrips)
{
  const auto grid = MakeGrid(9, 80.0, -50.0);
  const auto quads = MakeGrid(9, 200.0, 0.0); // facing the eye, without normals
  const auto byQuads = MakeFilter(grid, quads);
  byQuads->Update();
  ASSERT_EQ(byQuads->GetOutput()->GetNumberOfPoints(), 81);

  auto strips = MakePoints({});
  strips->SetPoints(quads->GetPoints());
  vtkNew<vtkCellArray> cells;
  for (vtkIdType row = 0; row < 8; ++row)
  {
    std::vector<vtkIdType> ids;
    for (vtkIdType i = 0; i < 9; ++i)
    {
      ids.push_back(9 * row + i);
      ids.push_back(9 * (row + 1) + i);
    }
    cells->InsertNextCell(static_cast<vtkIdType>(ids.size()), ids.data());
  }
  strips->SetStrips(cells);
  vtkNew<vtkCellArray> verts;
  const vtkIdType zero = 0;
  verts->InsertNextCell(1, &zero);
  strips->SetVerts(verts);
  const auto byStrips = MakeFilter(grid, strips);
  byStrips->Update();
  ASSERT_EQ(byStrips->GetOutput()->GetNumberOfPoints(), 81);
  for (vtkIdType i = 0; i < 81; ++i)
  {
    double a[3];
    double b[3];
    PointArray(byQuads->GetOutput(), "SightPoint")->GetTuple(i, a);
    PointArray(byStrips->GetOutput(), "SightPoint")->GetTuple(i, b);
    // Diagonals may differ: twice the interpolation error.
    EXPECT_LT(std::sqrt(vtkMath::Distance2BetweenPoints(a, b)), 0.2);
    // Cell ids: quads from 0; strips after the one vertex.
    const double quad = PointArray(byQuads->GetOutput(), "SightFacet")->GetTuple1(i);
    const double strip = PointArray(byStrips->GetOutput(), "SightFacet")->GetTuple1(i);
    EXPECT_LE(std::abs(std::floor((a[2] + 100.0) / 25.0) + 1.0 - strip), 1.0);
    EXPECT_LE(std::abs(std::floor((a[2] + 100.0) / 25.0) - std::floor(quad / 8.0)), 1.0);
  }
}

//------------------------------------------------------------------------------
TEST(RefractedGeometryOutput, MixedMembranesKeepTheOrderOfTheirCells)
{
  auto membrane = MakePoints({ { -50, 0, -50 }, { 50, 0, -50 }, { 50, 0, 50 }, { -50, 0, 50 },
    { -50, 1, -50 }, { 50, 1, -50 }, { 50, 1, 50 }, { -50, 1, 50 } });
  vtkNew<vtkCellArray> polys;
  const vtkIdType quad[4] = { 0, 3, 2, 1 };
  const vtkIdType upper[3] = { 4, 7, 6 };
  const vtkIdType other[3] = { 4, 6, 5 };
  polys->InsertNextCell(4, quad); // first, although it is split after the triangles have been read
  polys->InsertNextCell(3, upper);
  polys->InsertNextCell(3, other);
  membrane->SetPolys(polys);
  const auto filter =
    MakeFilter(MakePoints({ { 5, -10, 3 }, { -7, -10, 4 }, { 3, -10, -9 } }), membrane);
  filter->Update();
  ASSERT_EQ(filter->GetOutput()->GetNumberOfPoints(), 3);
  for (vtkIdType i = 0; i < 3; ++i)
  {
    EXPECT_EQ(PointArray(filter->GetOutput(), "SightFacet")->GetTuple1(i), 0.0);
  }
}

//------------------------------------------------------------------------------
TEST(RefractedGeometryOutput, DoesNotDependOnTheNumberOfThreads)
{
  const auto membrane = MakeMembrane(meniscus::reference::MakeWaves(200.0, 40, 8.0, 3.0));
  const auto grid = MakeGrid(250, 150.0, -80.0);
  ExpectSameOnThreads(
    [&]
    {
      const auto filter = MakeFilter(grid, membrane);
      filter->Update();
      auto values = ValuesOf(filter->GetOutput()->GetPoints()->GetData());
      EXPECT_GT(values.size(), 3u * 60000u);
      const auto facets = ValuesOf(PointArray(filter->GetOutput(), "SightFacet"));
      values.insert(values.end(), facets.begin(), facets.end());
      return values;
    });
}

//------------------------------------------------------------------------------
// Also between the rays of the vertices: flat facets have an error of half a unit here.
TEST(RefractedGeometryOutput, CurvedPatchesAreExactOnAPlane)
{
  const auto grid = MakeGrid(9, 80.0, -50.0);
  const auto filter = MakeFilter(grid, MakeFlatMembrane());
  filter->SetMembraneModelToCurved();
  ExpectQuiet(filter);
  ASSERT_EQ(filter->GetOutput()->GetNumberOfPoints(), 81);
  const meniscus::reference::AnalyticMembrane exact{ 0.0, 1.0, 1.333 };
  for (vtkIdType i = 0; i < 81; ++i)
  {
    double s[3];
    const glm::dvec3 p = PointOf(grid, i);
    PointArray(filter->GetOutput(), "SightPoint")->GetTuple(i, s);
    const auto truth = exact.FindSightPoints({ 20.0, 300.0, 10.0 }, { p[0], p[1], p[2] });
    ASSERT_EQ(truth.size(), 1u);
    EXPECT_LT(glm::length(truth[0] - glm::dvec3(s[0], s[1], s[2])), 1e-9);
  }
  // Another model reads the membrane again, the same model does not.
  EXPECT_EQ(filter->GetNumberOfPatchBuilds(), 1);
  filter->SetMembraneModelToFlatFacets();
  filter->Update();
  EXPECT_EQ(filter->GetNumberOfPatchBuilds(), 2);
  EXPECT_EQ(filter->GetNumberOfEyeUpdates(), 2);
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 81);
}

//------------------------------------------------------------------------------
TEST(RefractedGeometryOutput, PrintsItsState)
{
  vtkNew<vtkRefractedGeometryFilter> filter;
  EXPECT_EQ(filter->GetMembraneModel(), vtkRefractedGeometryFilter::CURVED);
  EXPECT_EQ(filter->GetImages(), vtkRefractedGeometryFilter::ALL_IMAGES);
  EXPECT_EQ(filter->GetExteriorIndexOfRefraction(), 1.0);
  EXPECT_EQ(filter->GetInteriorIndexOfRefraction(), 1.333);
  std::ostringstream text;
  filter->Print(text);
  for (const char* word : { "EyePosition", "Camera", "ExteriorIndexOfRefraction: 1",
         "InteriorIndexOfRefraction: 1.333", "MembraneModel: CURVED", "Images: ALL_IMAGES",
         "OutputPointsPrecision", "NumberOfPatchBuilds: 0", "NumberOfEyeUpdates: 0",
         "NumberOfSolvedVertices: 0", "NumberOfFailedSolves: 0" })
  {
    EXPECT_TRUE(HasText(text.str(), word)) << word;
  }
}

}
