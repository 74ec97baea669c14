// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Input that is missing, empty or invalid: an error or a counted skip, a defined output, no crash.
#include "RefractedGeometryTestHelpers.h"
#include "VTKTestBasics.h"

namespace
{

using namespace meniscus::test;

const double NaN = std::numeric_limits<double>::quiet_NaN();
const double Infinity = std::numeric_limits<double>::infinity();

bool HasNoGeometry(vtkPolyData* data)
{
  return data->GetNumberOfPoints() == 0 && data->GetNumberOfCells() == 0;
}

//------------------------------------------------------------------------------
TEST(RefractedGeometryBadInput, InputsThatAreMissing)
{
  vtkNew<vtkRefractedGeometryFilter> filter;
  const auto messages = UpdateAndObserve(filter);
  EXPECT_GE(messages->Errors, 1);
  EXPECT_TRUE(HasNoGeometry(filter->GetOutput()));
  messages->Errors = 0;
  filter->SetInputData(0, MakeGrid(3, 10.0, -5.0));
  filter->Update();
  EXPECT_GE(messages->Errors, 1);
  EXPECT_TRUE(HasNoGeometry(filter->GetOutput()));
}

TEST(RefractedGeometryBadInput, EmptyGeometry)
{
  vtkNew<vtkPolyData> empty;
  const auto filter = MakeFilter(empty, MakeFlatMembrane());
  const auto messages = UpdateAndObserve(filter);
  EXPECT_EQ(messages->Errors, 0) << messages->Text;
  EXPECT_TRUE(HasNoGeometry(filter->GetOutput()));
  EXPECT_NE(filter->GetOutput()->GetPointData()->GetArray("SightPoint"), nullptr);
}

TEST(RefractedGeometryBadInput, MembraneWithoutTriangles)
{
  vtkNew<vtkPolyData> empty;
  const auto pointsOnly = MakePoints({ { 0, 0, 0 }, { 1, 0, 0 }, { 0, 0, 1 } });
  const auto line = MakePoints({ { 0, 0, 0 }, { 1, 0, 0 }, { 2, 0, 0 } });
  vtkNew<vtkCellArray> polys;
  polys->InsertNextCell({ 0, 1, 2 });
  line->SetPolys(polys);
  for (vtkPolyData* membrane : { empty.Get(), pointsOnly.Get(), line.Get() })
  {
    const auto filter = MakeFilter(MakeGrid(3, 10.0, -5.0), membrane);
    const auto messages = UpdateAndObserve(filter);
    EXPECT_EQ(messages->Errors, 1) << messages->Text;
    EXPECT_TRUE(HasText(messages->Text, "no usable triangle"));
    EXPECT_EQ(filter->GetStatistic("NumberOfSkippedFacets"), membrane == line ? 1 : 0);
    EXPECT_TRUE(HasNoGeometry(filter->GetOutput()));
  }
}

//------------------------------------------------------------------------------
TEST(RefractedGeometryBadInput, BadFacetsAreSkippedAndCounted)
{
  const auto membrane = MakeFlatMembrane();
  const vtkIdType bad = membrane->GetPoints()->InsertNextPoint(NaN, 0.0, 0.0);
  membrane->GetPointData()->GetNormals()->InsertNextTuple3(0.0, 1.0, 0.0);
  const vtkIdType notFinite[3] = { 0, 1, bad };
  const vtkIdType outOfRange[3] = { 0, 1, 100000 };
  const vtkIdType negative[4] = { 0, 1, 10, -1 };
  const vtkIdType notFiniteQuad[4] = { 0, 1, 10, bad };
  const vtkIdType noArea[3] = { 0, 1, 2 };
  const vtkIdType noAreaQuad[4] = { 0, 1, 2, 3 };
  const vtkIdType two[2] = { 0, 1 };
  vtkCellArray* polys = membrane->GetPolys();
  polys->InsertNextCell(3, notFinite);
  polys->InsertNextCell(3, outOfRange);
  polys->InsertNextCell(4, negative);
  polys->InsertNextCell(4, notFiniteQuad);
  polys->InsertNextCell(3, noArea);
  polys->InsertNextCell(4, noAreaQuad);
  polys->InsertNextCell(2, two);
  vtkNew<vtkCellArray> strips;
  const vtkIdType strip[4] = { 0, 1, 100000, 2 };
  strips->InsertNextCell(4, strip);
  membrane->SetStrips(strips);
  const auto filter = MakeFilter(MakeGrid(5, 80.0, -50.0), membrane);
  const auto messages = UpdateAndObserve(filter);
  EXPECT_EQ(messages->Errors, 0) << messages->Text;
  EXPECT_EQ(messages->Warnings, 1) << messages->Text;
  // The quad without area yields one or two triangles, the strip two.
  EXPECT_GE(filter->GetStatistic("NumberOfSkippedFacets"), 9);
  EXPECT_LE(filter->GetStatistic("NumberOfSkippedFacets"), 10);
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 25);
}

//------------------------------------------------------------------------------
TEST(RefractedGeometryBadInput, CellsThatNamePointsThatDoNotExist)
{
  auto grid = MakeGrid(3, 10.0, -5.0);
  const vtkIdType high[3] = { 0, 1, 9 };
  const vtkIdType negative[3] = { 0, -5, 1 };
  grid->GetPolys()->InsertNextCell(3, high);
  vtkNew<vtkCellArray> verts;
  verts->InsertNextCell(3, negative);
  grid->SetVerts(verts);
  grid->GetCellData()->Initialize();
  const auto filter = MakeFilter(grid, MakeFlatMembrane());
  const auto messages = UpdateAndObserve(filter);
  EXPECT_EQ(messages->Errors, 1) << messages->Text;
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPolys(), 4);
  EXPECT_EQ(filter->GetOutput()->GetNumberOfVerts(), 2);
  EXPECT_EQ(filter->GetStatistic("NumberOfSkippedCells"), 2);
}

TEST(RefractedGeometryBadInput, ArraysOfTheWrongSizeAreNotPassed)
{
  auto grid = MakeGrid(3, 10.0, -5.0);
  grid->GetPointData()->AddArray(MakeArray<vtkFloatArray>("Short", 2, 1.0));
  grid->GetPoints()->SetPoint(0, 0.0, 50.0, 0.0); // no image: arrays are copied tuple by tuple
  const auto filter = MakeFilter(grid, MakeFlatMembrane());
  const auto messages = UpdateAndObserve(filter);
  EXPECT_EQ(messages->Warnings, 1) << messages->Text;
  EXPECT_EQ(filter->GetOutput()->GetPointData()->GetArray("Short"), nullptr);
  EXPECT_NE(filter->GetOutput()->GetPointData()->GetArray("Rank"), nullptr);
}

//------------------------------------------------------------------------------
TEST(RefractedGeometryBadInput, IndicesOfRefraction)
{
  for (const auto& [index, exterior] : Product(List(0.0, -1.333, NaN, Infinity), List(true, false)))
  {
    const auto filter = MakeFilter(MakeGrid(3, 10.0, -5.0), MakeFlatMembrane());
    const auto messages = Observe(filter);
    filter->SetExteriorIndexOfRefraction(exterior ? index : 1.0);
    filter->SetInteriorIndexOfRefraction(exterior ? 1.0 : index);
    filter->Update();
    EXPECT_GE(messages->Errors, 1) << index;
    EXPECT_TRUE(HasNoGeometry(filter->GetOutput())) << index;
    // The filter recovers afterwards.
    filter->SetExteriorIndexOfRefraction(1.0);
    filter->SetInteriorIndexOfRefraction(1.333);
    filter->Update();
    EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 9) << index;
  }
}

TEST(RefractedGeometryBadInput, EyesOnTheMembraneOrNowhere)
{
  const double eyes[][3] = { { 0.0, 0.0, 0.0 }, { 12.5, 0.0, 0.0 }, { 7.0, 0.0, 3.0 },
    { NaN, 1.0, 0.0 }, { 0.0, Infinity, 0.0 } };
  for (const auto& eye : eyes)
  {
    const auto filter = MakeFilter(MakeGrid(3, 10.0, -5.0), MakeFlatMembrane());
    const auto messages = Observe(filter);
    filter->SetEyePosition(eye[0], eye[1], eye[2]);
    filter->Update();
    EXPECT_GE(messages->Errors, 1) << eye[0] << " " << eye[1] << " " << eye[2];
    EXPECT_TRUE(HasNoGeometry(filter->GetOutput()));
    filter->SetEyePosition(0.0, 100.0, 0.0);
    filter->Update();
    EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 9);
  }
}

//------------------------------------------------------------------------------
TEST(RefractedGeometryBadInput, NormalsOfTheWrongSizeAreComputed)
{
  const auto membrane = MakeFlatMembrane();
  vtkNew<vtkDoubleArray> normals;
  normals->SetNumberOfComponents(3);
  normals->SetNumberOfTuples(7);
  normals->Fill(0.3);
  membrane->GetPointData()->SetNormals(normals);
  const auto filter = MakeFilter(MakeGrid(3, 10.0, -5.0), membrane);
  const auto messages = UpdateAndObserve(filter);
  EXPECT_EQ(messages->Warnings, 1) << messages->Text;

  const auto reference = MakeFilter(MakeGrid(3, 10.0, -5.0), MakeFlatMembrane());
  reference->Update();
  const glm::dvec3 a = PointOf(filter->GetOutput(), 4);
  const glm::dvec3 b = PointOf(reference->GetOutput(), 4);
  EXPECT_NEAR(a[1], b[1], 1e-12);
}

TEST(RefractedGeometryBadInput, NormalsOfNoLengthAreComputed)
{
  const auto membrane = MakeFlatMembrane();
  vtkDataArray* normals = membrane->GetPointData()->GetNormals();
  normals->SetTuple3(40, 0.0, 0.0, 0.0);
  normals->SetTuple3(41, NaN, 0.0, 0.0);
  const auto filter = MakeFilter(MakeGrid(3, 10.0, -5.0), membrane);
  const auto messages = UpdateAndObserve(filter);
  EXPECT_EQ(messages->Warnings, 1) << messages->Text;
  EXPECT_TRUE(HasText(messages->Text, "2 of 81"));

  const auto reference = MakeFilter(MakeGrid(3, 10.0, -5.0), MakeFlatMembrane());
  reference->Update();
  for (vtkIdType i = 0; i < 9; ++i)
  {
    const glm::dvec3 a = PointOf(filter->GetOutput(), i);
    const glm::dvec3 b = PointOf(reference->GetOutput(), i);
    EXPECT_NEAR(a[1], b[1], 1e-12);
  }
}

TEST(RefractedGeometryBadInput, EyeBehindTheMembrane)
{
  const auto filter = MakeFilter(MakeGrid(3, 10.0, -5.0), MakeFlatMembrane());
  filter->SetEyePosition(0.0, -100.0, 0.0);
  filter->Update(); // extrapolated by Eq. 3.1; must only be finite
  for (vtkIdType i = 0; i < filter->GetOutput()->GetNumberOfPoints(); ++i)
  {
    const glm::dvec3 p = PointOf(filter->GetOutput(), i);
    EXPECT_TRUE(std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]));
  }
  EXPECT_EQ(filter->GetNumberOfSolvedVertices(), 9);
}

//------------------------------------------------------------------------------
TEST(RefractedGeometryBadInput, MissingModesWarnOnce)
{
  const auto filter = MakeFilter(MakeGrid(3, 10.0, -5.0), MakeFlatMembrane());
  const auto messages = UpdateAndObserve(filter);
  EXPECT_EQ(messages->Warnings, 0) << messages->Text;
  filter->SetImagesToAllImages();
  filter->Update();
  EXPECT_EQ(messages->Warnings, 1);
  EXPECT_TRUE(HasText(messages->Text, "FIRST_IMAGE"));
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 9);
}

}
