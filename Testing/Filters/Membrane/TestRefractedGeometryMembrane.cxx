// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Membranes that are closed, inverted, one-sided or of unusual cells, and swapped ports.
#include "AbortedUpdate.h"
#include "AnalyticMembrane.h"
#include "RefractedGeometryTestHelpers.h"

#include "VTKTestBasics.h"
#include "vtkCharArray.h"
#include "vtkShortArray.h"

namespace
{

using namespace meniscus::test;
using namespace meniscus::reference;

const double Pi = std::acos(-1.0);

/**
 * A whole sphere about the origin with exact normals, outward or inward; the winding is outward.
 */
MembraneMesh MakeSphere(double radius, int rings, double sign)
{
  MembraneMesh mesh;
  const int around = 2 * rings;
  const auto add = [&mesh, radius, sign](double polar, double azimuth)
  {
    const glm::dvec3 n(
      std::sin(polar) * std::cos(azimuth), std::cos(polar), std::sin(polar) * std::sin(azimuth));
    mesh.AddPoint(radius * n, sign * n);
  };
  add(0.0, 0.0);
  for (const auto& [i, k] : Product(Numbers(1, rings), around))
  {
    add(Pi * i / rings, 2.0 * Pi * k / around);
  }
  add(Pi, 0.0);
  const auto at = [around, rings](int i, int k) -> std::int64_t
  {
    return i == 0 ? 0 : (i == rings ? 1 + (rings - 1) * around : 1 + (i - 1) * around + k % around);
  };
  for (const auto& [i, k] : Product(rings, around))
  {
    if (i > 0)
    {
      mesh.AddTriangle(at(i, k), at(i, k + 1), at(i + 1, k));
    }
    if (i + 1 < rings)
    {
      mesh.AddTriangle(at(i, k + 1), at(i + 1, k + 1), at(i + 1, k));
    }
  }
  return mesh;
}

vtkSmartPointer<vtkPolyData> MakeVertices(const std::vector<Point>& positions)
{
  auto points = MakePoints(positions);
  vtkNew<vtkCellArray> verts;
  for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i)
  {
    verts->InsertNextCell(1, &i);
  }
  points->SetVerts(verts);
  return points;
}

/**
 * Largest violation of Snell's law at a sphere about the origin, with outward (1) or inward
 * normals.
 */
double GetWorstSnell(vtkPolyData* output, const glm::dvec3& eye, double sign)
{
  double worst = 0.0;
  for (vtkIdType i = 0; i < output->GetNumberOfPoints(); ++i)
  {
    const glm::dvec3 s = TupleOf(output->GetPointData()->GetArray("SightPoint"), i);
    const double depth = output->GetPointData()->GetArray("RefractionDepth")->GetTuple1(i);
    glm::dvec3 v(0.0);
    output->GetPoint(i, &v.x);
    const glm::dvec3 truth = TupleOf(output->GetPointData()->GetArray("Truth"), i);
    const glm::dvec3 n = sign * glm::normalize(s);
    const glm::dvec3 in = glm::normalize(s - eye);
    const glm::dvec3 out = glm::normalize(truth - s);
    worst = std::max(worst, glm::length(glm::cross(in, n) - 1.333 * glm::cross(out, n)));
    worst = std::max(worst, std::fabs(glm::length(truth - s) - depth));
    EXPECT_LT(glm::dot(in, n), 0.0);
    EXPECT_LT(glm::dot(out, n), 0.0);
  }
  return worst;
}

//------------------------------------------------------------------------------
// A ball of water: points inside are refracted, points outside are not, on all sides.
TEST(RefractedGeometryMembrane, ClosedMembranesAreBodies)
{
  const auto geometry = MakeVertices({ { 0, 0, 0 }, { 20, 10, -30 }, { -50, 0, 20 }, { 0, 60, 0 },
    { 150, 0, 0 }, { 0, -150, 0 }, { 0, 150, 0 }, { 0, 0, 200 } });
  AddTruth(geometry);
  const auto filter = MakeAllImages(geometry, MakeMembrane(MakeSphere(100.0, 24, 1.0)));
  ExpectQuiet(filter);
  vtkPolyData* output = filter->GetOutput();
  vtkDataArray* source = output->GetPointData()->GetArray("SourcePointId");
  vtkDataArray* facet = output->GetPointData()->GetArray("SightFacet");
  int images[8] = { 0, 0, 0, 0, 0, 0, 0, 0 };
  for (vtkIdType i = 0; i < output->GetNumberOfPoints(); ++i)
  {
    const auto id = static_cast<int>(source->GetTuple1(i));
    ++images[id];
    EXPECT_EQ(facet->GetTuple1(i) < 0.0, id >= 4) << id;
  }
  for (const int count : images)
  {
    EXPECT_EQ(count, 1);
  }
  vtkNew<vtkPolyData> inside;
  filter->SetInputData(0, MakeVertices({ { 0, 0, 0 }, { 20, 10, -30 }, { -50, 0, 20 } }));
  AddTruth(vtkPolyData::SafeDownCast(filter->GetInputDataObject(0, 0)));
  filter->Update();
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 3);
  EXPECT_LT(GetWorstSnell(filter->GetOutput(), { 20.0, 300.0, 10.0 }, 1.0), 1e-8);
}

// A bubble of air around the eye in water.
TEST(RefractedGeometryMembrane, ClosedMembranesAreBubbles)
{
  const auto geometry = MakeVertices({ { 0, 0, 200 }, { 300, 100, -30 }, { 10, 0, 20 } });
  AddTruth(geometry);
  const auto filter = MakeAllImages(geometry, MakeMembrane(MakeSphere(100.0, 24, -1.0)));
  filter->SetEyePosition(5.0, -10.0, 3.0);
  filter->Update();
  vtkPolyData* output = filter->GetOutput();
  ASSERT_EQ(output->GetNumberOfPoints(), 3);
  vtkDataArray* facet = output->GetPointData()->GetArray("SightFacet");
  EXPECT_GE(facet->GetTuple1(0), 0.0);
  EXPECT_GE(facet->GetTuple1(1), 0.0);
  EXPECT_EQ(facet->GetTuple1(2), -1.0);
  const auto behind = MakeVertices({ { 0, 0, 200 }, { 300, 100, -30 } });
  AddTruth(behind);
  filter->SetInputData(0, behind);
  filter->Update();
  EXPECT_LT(GetWorstSnell(filter->GetOutput(), { 5.0, -10.0, 3.0 }, -1.0), 1e-8);
}

//------------------------------------------------------------------------------
// An eye in a body that should be seen from outside: reported when it enters, not again as it
// moves.
TEST(RefractedGeometryMembrane, AnEyeInsideOfABodyIsTold)
{
  const auto filter =
    MakeAllImages(MakeVertices({ { 0, 0, 200 } }), MakeMembrane(MakeSphere(100.0, 24, 1.0)));
  const auto messages = Observe(filter);
  const auto look = [&filter](double height)
  {
    filter->SetEyePosition(20.0, height, 10.0);
    filter->Update();
  };
  look(300.0);
  EXPECT_EQ(messages->Warnings, 0) << messages->Text;
  EXPECT_FALSE(filter->GetStatistic("IsEyeEnclosed"));
  look(30.0);
  EXPECT_EQ(messages->Warnings, 1) << messages->Text;
  EXPECT_TRUE(HasText(messages->Text, "inside of a closed membrane"));
  EXPECT_TRUE(filter->GetStatistic("IsEyeEnclosed"));
  look(20.0);
  EXPECT_EQ(messages->Warnings, 1) << messages->Text;
  look(300.0);
  EXPECT_FALSE(filter->GetStatistic("IsEyeEnclosed"));
  look(30.0);
  EXPECT_EQ(messages->Warnings, 2) << messages->Text;
  filter->SetMembraneData(MakeMembrane(MakeSphere(100.0, 24, -1.0))); // a bubble
  filter->Update();
  EXPECT_FALSE(filter->GetStatistic("IsEyeEnclosed"));
  EXPECT_EQ(messages->Warnings, 2) << messages->Text;
}

// Two sheets, one above the other or side by side.
TEST(RefractedGeometryMembrane, SheetsInSequenceAreTold)
{
  for (const bool isStacked : { true, false })
  {
    MembraneMesh sheets = MakeSquare(200.0, 8, 0.0);
    MembraneMesh second = MakeSquare(200.0, 8, 0.0);
    second.Translate(isStacked ? glm::dvec3(0.0, -30.0, 0.0) : glm::dvec3(201.0, 0.0, 0.0));
    const auto first = static_cast<std::int64_t>(sheets.Points.size() / 3);
    sheets.Points.insert(sheets.Points.end(), second.Points.begin(), second.Points.end());
    sheets.Normals.insert(sheets.Normals.end(), second.Normals.begin(), second.Normals.end());
    for (const std::int64_t id : second.Triangles)
    {
      sheets.Triangles.push_back(first + id);
    }
    const auto filter =
      MakeAllImages(MakeVertices({ { 0, -60, 0 }, { 5, -80, 3 } }), MakeMembrane(sheets));
    const auto messages = UpdateAndObserve(filter);
    EXPECT_EQ(messages->Warnings, isStacked ? 1 : 0) << messages->Text;
    EXPECT_EQ(filter->GetStatistic("NumberOfMembranePointsBehind") > 0, isStacked);
    filter->SetEyePosition(25.0, 310.0, 12.0);
    filter->Update();
    EXPECT_EQ(messages->Warnings, isStacked ? 1 : 0) << messages->Text;
  }
}

//------------------------------------------------------------------------------
// Facets with random winding, without normals: oriented as most of them are.
TEST(RefractedGeometryMembrane, InconsistentFacetsAreTurned)
{
  const MembraneMesh bowl = MakeDisc(141.5, 5, 400.0);
  MembraneMesh mixed = bowl;
  std::size_t turned = 0;
  for (std::size_t i = 0; i < mixed.Triangles.size(); i += 3)
  {
    if (i % 7 < 3)
    {
      std::swap(mixed.Triangles[i + 1], mixed.Triangles[i + 2]);
      ++turned;
    }
  }
  ASSERT_LT(2 * turned, mixed.GetNumberOfFacets());
  const auto run = [](const MembraneMesh& mesh, MessageCounter** counter)
  {
    const auto filter = MakeAllImages(MakeGrid(9, 80.0, -50.0), MakeMembrane(mesh, false));
    static vtkSmartPointer<MessageCounter> messages;
    messages = Observe(filter);
    filter->Update();
    *counter = messages;
    vtkSmartPointer<vtkPolyData> output = filter->GetOutput();
    return output;
  };
  MessageCounter* messages = nullptr;
  const auto expected = run(bowl, &messages);
  EXPECT_EQ(messages->Warnings, 0) << messages->Text;
  const auto output = run(mixed, &messages);
  EXPECT_EQ(messages->Warnings, 1) << messages->Text;
  EXPECT_TRUE(HasText(messages->Text, std::to_string(turned) + " of 184"));
  ASSERT_EQ(output->GetNumberOfPoints(), expected->GetNumberOfPoints());
  for (vtkIdType i = 0; i < output->GetNumberOfPoints(); ++i)
  {
    const glm::dvec3 a = PointOf(output, i);
    const glm::dvec3 b = PointOf(expected, i);
    EXPECT_NEAR(a[0], b[0], 1e-9);
    EXPECT_NEAR(a[1], b[1], 1e-9);
    EXPECT_NEAR(a[2], b[2], 1e-9);
  }
}

TEST(RefractedGeometryMembrane, NormalsOfAnotherSurfaceAreToldOf)
{
  const auto bowl = MakeMembrane(MakeDisc(141.5, 5, 400.0));
  bowl->GetPointData()->SetNormals(
    MakeMembrane(MakeDisc(141.5, 5, 0.0))->GetPointData()->GetNormals());
  const auto filter = MakeAllImages(MakeGrid(9, 80.0, -50.0), bowl);
  const auto messages = UpdateAndObserve(filter);
  EXPECT_EQ(messages->Warnings, 1) << messages->Text;
  EXPECT_TRUE(HasText(messages->Text, "do not fit the triangles"));
  bowl->GetPointData()->SetNormals(nullptr);
  filter->Update();
  EXPECT_EQ(messages->Warnings, 1) << messages->Text;
}

TEST(RefractedGeometryMembrane, NormalsOnTheWrongSideAreTurned)
{
  const auto membrane = MakeMembrane(MakeDisc(141.5, 5, 400.0));
  const auto expected = MakeAllImages(MakeGrid(9, 80.0, -50.0), membrane);
  expected->Update();
  const auto wrong = MakeMembrane(MakeDisc(141.5, 5, 400.0));
  vtkDataArray* normals = wrong->GetPointData()->GetNormals();
  for (const vtkIdType i : { 0, 30, 31, 77 })
  {
    const double* n = normals->GetTuple3(i);
    normals->SetTuple3(i, -n[0], -n[1], -n[2]);
  }
  const auto filter = MakeAllImages(MakeGrid(9, 80.0, -50.0), wrong);
  const auto messages = UpdateAndObserve(filter);
  EXPECT_EQ(messages->Warnings, 1);
  EXPECT_TRUE(HasText(messages->Text, "4 of 125"));
  ASSERT_EQ(filter->GetOutput()->GetNumberOfPoints(), expected->GetOutput()->GetNumberOfPoints());
  for (vtkIdType i = 0; i < filter->GetOutput()->GetNumberOfPoints(); ++i)
  {
    EXPECT_NEAR(filter->GetOutput()->GetPoint(i)[1], expected->GetOutput()->GetPoint(i)[1], 1e-12);
  }
}

TEST(RefractedGeometryMembrane, OneSidedMembranesAreAnError)
{
  constexpr int count = 24;
  std::vector<Point> positions;
  for (int i = 0; i < count; ++i)
  {
    const double around = 2.0 * Pi * i / count;
    for (const double side : { -20.0, 20.0 })
    {
      const double radius = 80.0 + side * std::cos(0.5 * around);
      positions.push_back(
        { radius * std::cos(around), side * std::sin(0.5 * around), radius * std::sin(around) });
    }
  }
  const auto band = MakePoints(positions);
  vtkNew<vtkCellArray> polys;
  for (int i = 0; i < count; ++i)
  {
    const int next = (i + 1) % count;
    const bool turns = next == 0; // half a turn: the sides are exchanged
    const vtkIdType a = 2 * i;
    const vtkIdType c = 2 * next + (turns ? 1 : 0);
    const vtkIdType d = 2 * next + (turns ? 0 : 1);
    const vtkIdType first[3] = { a, a + 1, c };
    const vtkIdType second[3] = { a + 1, d, c };
    polys->InsertNextCell(3, first);
    polys->InsertNextCell(3, second);
  }
  band->SetPolys(polys);
  const auto filter = MakeAllImages(MakeGrid(5, 40.0, -50.0), band);
  const auto messages = UpdateAndObserve(filter);
  EXPECT_EQ(messages->Errors, 1);
  EXPECT_TRUE(HasText(messages->Text, "one-sided"));
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 0);
  filter->SetInputData(1, MakeFlatMembrane());
  filter->Update();
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPolys() > 0, true);
}

//------------------------------------------------------------------------------
TEST(RefractedGeometryMembrane, SwappedPortsSaySo)
{
  const auto object = MakeGrid(9, 40.0, -50.0);
  const auto membrane = MakeFlatMembrane();
  for (const bool curved : { true, false })
  {
    const auto filter = MakeAllImages(membrane, object);
    filter->SetMembraneModel(
      curved ? vtkRefractedGeometryFilter::CURVED : vtkRefractedGeometryFilter::FLAT_FACETS);
    filter->SetImagesToFirstImage();
    const auto messages = UpdateAndObserve(filter);
    EXPECT_EQ(messages->Warnings, 1) << messages->Text;
    EXPECT_TRUE(HasText(messages->Text, "None of the 81 points"));
    EXPECT_EQ(filter->GetStatistic("NumberOfVerticesWithoutImage"), 81);
    filter->SetEyePosition(0.0, 250.0, 0.0);
    filter->Update();
    EXPECT_EQ(messages->Warnings, 1); // once per membrane
    filter->SetInputData(0, object);
    filter->SetInputData(1, membrane);
    filter->Update();
    EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 81);
  }
}

TEST(RefractedGeometryMembrane, EyesBehindSaySoAndEyesOnItAreAnError)
{
  for (const int images :
    { vtkRefractedGeometryFilter::FIRST_IMAGE, vtkRefractedGeometryFilter::ALL_IMAGES })
  {
    const auto filter = MakeAllImages(MakeGrid(5, 40.0, -30.0), MakeFlatMembrane());
    filter->SetImages(images);
    const auto messages = Observe(filter);
    filter->SetEyePosition(0.0, -100.0, 0.0);
    filter->Update();
    EXPECT_EQ(messages->Errors, 0);
    EXPECT_EQ(messages->Warnings, 1) << messages->Text;
    EXPECT_EQ(filter->GetOutput()->GetNumberOfCells(), 0);
    filter->SetEyePosition(3.0, 0.0, 5.0);
    filter->Update();
    EXPECT_GE(messages->Errors, 1);
    EXPECT_TRUE(HasText(messages->Text, "lies on the membrane"));
    filter->SetEyePosition(20.0, 300.0, 10.0);
    filter->Update();
    EXPECT_EQ(filter->GetOutput()->GetNumberOfPolys() > 0, true);
  }
}

TEST(RefractedGeometryMembrane, FailedSolvesAreWarnedOfWithNumbers)
{
  using Filter = vtkRefractedGeometryFilter;
  for (const auto& [model, images] : { std::pair(Filter::FLAT_FACETS, Filter::FIRST_IMAGE),
         std::pair(Filter::CURVED, Filter::FIRST_IMAGE),
         std::pair(Filter::CURVED, Filter::ALL_IMAGES) })
  {
    auto grid = MakeGrid(3, 10.0, -5.0);
    grid->GetPoints()->SetPoint(0, std::numeric_limits<double>::quiet_NaN(), -5.0, 0.0);
    grid->GetPoints()->SetPoint(2, 0.0, -std::numeric_limits<double>::infinity(), 0.0);
    const auto filter = MakeAllImages(grid, MakeFlatMembrane());
    filter->SetMembraneModel(model);
    filter->SetImages(images);
    const auto messages = UpdateAndObserve(filter);
    EXPECT_EQ(filter->GetNumberOfFailedSolves(), 2);
    EXPECT_EQ(filter->GetStatistic("NumberOfVerticesWithoutImage"), 0);
    EXPECT_EQ(filter->GetStatistic("NumberOfSkippedCells"), 2);
    EXPECT_EQ(filter->GetOutput()->GetNumberOfPolys(), 2);
    for (vtkIdType i = 0; i < filter->GetOutput()->GetNumberOfPoints(); ++i)
    {
      EXPECT_TRUE(std::isfinite(glm::length(PointOf(filter->GetOutput(), i))));
    }
    EXPECT_EQ(messages->Warnings, 1);
    EXPECT_TRUE(HasText(messages->Text, "2 of 9 points"));
    filter->Update();
    filter->SetOutputPointsPrecision(vtkAlgorithm::SINGLE_PRECISION);
    filter->Update(); // nothing is solved again
    EXPECT_EQ(messages->Warnings, 1);
  }
}

//------------------------------------------------------------------------------
TEST(RefractedGeometryMembrane, EqualIndicesAreTheIdentityExactly)
{
  const auto grid = MakeGrid(9, 80.0, -50.0);
  for (const int images :
    { vtkRefractedGeometryFilter::FIRST_IMAGE, vtkRefractedGeometryFilter::ALL_IMAGES })
  {
    const auto filter = MakeAllImages(grid, MakeMembrane(MakeWaves(200.0, 32, 3.0, 2.0)));
    filter->SetImages(images);
    filter->SetInteriorIndexOfRefraction(1.0);
    filter->Update();
    vtkPolyData* output = filter->GetOutput();
    ASSERT_EQ(output->GetNumberOfPoints(), 81);
    EXPECT_EQ(output->GetNumberOfPolys(), 64);
    for (vtkIdType i = 0; i < 81; ++i)
    {
      for (int axis = 0; axis < 3; ++axis)
      {
        EXPECT_EQ(output->GetPoint(i)[axis], grid->GetPoint(i)[axis]);
      }
      EXPECT_EQ(output->GetPointData()->GetArray("Reflectance")->GetTuple1(i), 0.0);
    }
  }
}

//------------------------------------------------------------------------------
TEST(RefractedGeometryMembrane, EmptyAndMissingBlocksOfComposites)
{
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, MakeGrid(5, 40.0, -30.0));
  blocks->SetBlock(1, vtkSmartPointer<vtkPolyData>::New());
  blocks->SetBlock(2, nullptr);
  blocks->SetBlock(3, MakeGrid(5, 40.0, -60.0));
  vtkNew<vtkRefractedGeometryFilter> filter;
  filter->SetEyePosition(20.0, 300.0, 10.0);
  filter->SetInputDataObject(0, blocks);
  filter->SetInputData(1, MakeFlatMembrane());
  ExpectQuiet(filter);
  auto* output = vtkMultiBlockDataSet::SafeDownCast(filter->GetOutputDataObject(0));
  ASSERT_NE(output, nullptr);
  EXPECT_GT(vtkPolyData::SafeDownCast(output->GetBlock(0))->GetNumberOfPolys(), 0);
  EXPECT_EQ(vtkPolyData::SafeDownCast(output->GetBlock(1))->GetNumberOfPoints(), 0);
  EXPECT_GT(vtkPolyData::SafeDownCast(output->GetBlock(3))->GetNumberOfPolys(), 0);
  EXPECT_EQ(filter->GetNumberOfPatchBuilds(), 1);
}

//------------------------------------------------------------------------------
TEST(RefractedGeometryMembrane, ArraysOfOddTypes)
{
  for (const int images :
    { vtkRefractedGeometryFilter::FIRST_IMAGE, vtkRefractedGeometryFilter::ALL_IMAGES })
  {
    const auto grid = MakeGrid(9, 150.0, -60.0);
    vtkNew<vtkStringArray> names;
    names->SetName("Names");
    vtkNew<vtkCharArray> letters;
    letters->SetName("Letters");
    vtkNew<vtkShortArray> colours;
    colours->SetName("Colours");
    colours->SetNumberOfComponents(4);
    for (int i = 0; i < 81; ++i)
    {
      names->InsertNextValue("p" + std::to_string(i));
      letters->InsertNextValue(static_cast<char>('a' + i % 26));
      const short tuple[4] = { static_cast<short>(i), 1, 2, 3 };
      colours->InsertNextTypedTuple(tuple);
    }
    grid->GetPointData()->AddArray(names);
    grid->GetPointData()->AddArray(letters);
    grid->GetPointData()->SetScalars(colours);
    const auto filter = MakeAllImages(grid, MakeMembrane(MakeWaves(200.0, 32, 3.0, 2.0)));
    filter->SetImages(images);
    ExpectQuiet(filter);
    vtkPolyData* output = filter->GetOutput();
    vtkPointData* data = output->GetPointData();
    for (const char* name : { "Names", "Letters", "Colours", "Rank" })
    {
      vtkAbstractArray* array = data->GetAbstractArray(name);
      ASSERT_NE(array, nullptr) << name;
      EXPECT_EQ(array->GetNumberOfTuples(), output->GetNumberOfPoints()) << name;
    }
    auto* names2 = vtkStringArray::SafeDownCast(data->GetAbstractArray("Names"));
    for (vtkIdType i = 0; i < output->GetNumberOfPoints(); ++i)
    {
      const double source = data->GetArray("SourcePointId")->GetTuple1(i);
      if (source >= 0.0)
      {
        EXPECT_EQ(names2->GetValue(i), "p" + std::to_string(static_cast<int>(source)));
        EXPECT_EQ(data->GetArray("Colours")->GetComponent(i, 0), source);
        EXPECT_EQ(data->GetArray("Rank")->GetTuple1(i), source);
      }
    }
  }
}

//------------------------------------------------------------------------------
TEST(RefractedGeometryMembrane, DataOfThePortsMayChangeBetweenUpdates)
{
  const auto grid = MakeGrid(9, 80.0, -50.0);
  const auto membrane = MakeMembrane(MakeWaves(200.0, 16, 3.0, 2.0));
  const auto filter = MakeAllImages(grid, membrane);
  filter->Update();
  EXPECT_GT(filter->GetOutput()->GetNumberOfPolys(), 0);
  // Fewer points, other cells, another type of points, then nothing, then the first input again.
  grid->ShallowCopy(MakeVertices({ { 0, -50, 0 }, { 10, -40, 3 } }));
  filter->Update();
  EXPECT_EQ(filter->GetOutput()->GetNumberOfVerts(), 2);
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPolys(), 0);
  membrane->ShallowCopy(MakeFlatMembrane());
  filter->Update();
  EXPECT_EQ(filter->GetNumberOfPatchBuilds(), 2);
  EXPECT_EQ(filter->GetOutput()->GetNumberOfVerts(), 2);
  grid->Initialize();
  filter->Update();
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 0);
  membrane->Initialize();
  const auto messages = UpdateAndObserve(filter);
  EXPECT_EQ(messages->Errors, 1) << messages->Text;
  membrane->ShallowCopy(MakeFlatMembrane());
  grid->ShallowCopy(MakeGrid(9, 80.0, -50.0));
  filter->Update();
  EXPECT_EQ(messages->Errors, 1) << messages->Text;
  EXPECT_GT(filter->GetOutput()->GetNumberOfPolys(), 0);
}

//------------------------------------------------------------------------------
// Abort while points are solved, and while cells are mapped: the output is not incomplete, and the
// next update finishes the work.
TEST(RefractedGeometryMembrane, AbortWithAllImages)
{
  const auto grid = MakeGrid(260, 150.0, -60.0);
  const auto expected = MakeAllImages(grid, MakeFlatMembrane());
  expected->SetAngularTolerance(1.0);
  expected->Update();
  for (const double from : { 0.1, 0.6 })
  {
    const auto filter = MakeAllImages(grid, MakeFlatMembrane());
    filter->SetAngularTolerance(1.0);
    UpdateWithAbort(filter, from);
    EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), expected->GetOutput()->GetNumberOfPoints());
    EXPECT_EQ(filter->GetOutput()->GetNumberOfCells(), expected->GetOutput()->GetNumberOfCells());
    EXPECT_EQ(filter->GetNumberOfSolvedVertices(), 260 * 260);
  }
}

}
