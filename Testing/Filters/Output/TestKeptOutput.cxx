// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Outputs of which a part has not changed: its objects and their modification times stay, so that
// mappers do not upload them again.
#include "RefractedGeometryTestHelpers.h"

#include "VTKTestBasics.h"
#include "vtkRefractingInterfaceCollection.h"

namespace
{

using namespace meniscus::test;
using Filter = vtkRefractedGeometryFilter;

struct Part
{
  vtkSmartPointer<vtkObject> Object;
  vtkMTimeType Time;
  bool operator==(const Part& o) const { return this->Object == o.Object && this->Time == o.Time; }
};

Part MakePart(vtkObject* object)
{
  return { object, object ? object->GetMTime() : 0 };
}

/** Points, polygons and sight points of an output. */
std::vector<Part> GetGeometry(Filter* filter)
{
  vtkPolyData* output = filter->GetOutput();
  return { MakePart(output->GetPoints()), MakePart(output->GetPolys()),
    MakePart(output->GetPointData()->GetArray("SightPoint")) };
}

void SetColors(vtkPolyData* grid, double first)
{
  grid->GetPointData()->AddArray(MakeArray("Color", grid->GetNumberOfPoints(),
    [&](vtkIdType i) { return first + static_cast<double>(i); }));
}

/** Object and filter for one of the ways in which outputs are made. */
struct KeptOutputs : public ::testing::TestWithParam<const char*>
{
  void SetUp() override
  {
    const std::string kind = this->GetParam();
    SetColors(this->Grid, 0.0);
    this->Refraction->SetMembraneModelToCurved();
    if (kind != "FirstImage")
    {
      this->Refraction->SetImagesToAllImages();
    }
    if (kind == "Interfaces")
    {
      auto lower = MakeFlatMembrane();
      MapPoints(lower, [](const glm::dvec3& p) { return p - glm::dvec3(0.0, 10.0, 0.0); });
      this->Refraction->AddMembraneData(lower);
      this->Refraction->GetInterfaces()->AddInterface(1.333, 1.5);
    }
    this->Refraction->Update();
    ASSERT_GT(this->Refraction->GetOutput()->GetNumberOfPolys(), 0);
  }

  vtkSmartPointer<vtkPolyData> Grid = MakeGrid(9, 80.0, -50.0);
  vtkSmartPointer<Filter> Refraction = MakeFilter(this->Grid, MakeFlatMembrane());
};

TEST_P(KeptOutputs, NewColorsKeepTheGeometry)
{
  const std::vector<Part> before = GetGeometry(this->Refraction);
  vtkPolyData* output = this->Refraction->GetOutput();
  const Part colors = MakePart(output->GetPointData()->GetArray("Color"));
  SetColors(this->Grid, 1000.0);
  this->Refraction->Update();
  EXPECT_EQ(GetGeometry(this->Refraction), before);
  EXPECT_FALSE(MakePart(output->GetPointData()->GetArray("Color")) == colors);
  EXPECT_EQ(output->GetPointData()->GetArray("Color")->GetComponent(3, 0), 1003.0);
}

TEST_P(KeptOutputs, MovedPointsAreNew)
{
  const std::vector<Part> before = GetGeometry(this->Refraction);
  const glm::dvec3 p = PointOf(this->Grid, 40);
  this->Grid->GetPoints()->SetPoint(40, p[0], p[1] - 5.0, p[2]);
  this->Grid->GetPoints()->Modified();
  this->Refraction->Update();
  const std::vector<Part> after = GetGeometry(this->Refraction);
  EXPECT_FALSE(after[0] == before[0]);
  EXPECT_FALSE(after[2] == before[2]);
}

TEST_P(KeptOutputs, ChangesByConsumersAreNotKept)
{
  // A consumer that writes to the output in place must not change the next one.
  vtkPolyData* output = this->Refraction->GetOutput();
  const glm::dvec3 expected = PointOf(output, 5);
  output->GetPoints()->SetPoint(5, 1.0, 2.0, 3.0);
  SetColors(this->Grid, 1000.0);
  this->Refraction->Update();
  const glm::dvec3 found = PointOf(output, 5);
  for (int axis = 0; axis < 3; ++axis)
  {
    EXPECT_EQ(found[axis], expected[axis]);
  }
}

TEST_P(KeptOutputs, NamesOfComponentsAndKeysAreThoseOfTheInput)
{
  vtkDataArray* colors = this->Grid->GetPointData()->GetArray("Color");
  colors->SetComponentName(0, "Shade");
  this->Grid->Modified();
  this->Refraction->Update();
  vtkDataArray* found = this->Refraction->GetOutput()->GetPointData()->GetArray("Color");
  ASSERT_NE(found, nullptr);
  EXPECT_TRUE(found->HasAComponentName());
}

INSTANTIATE_TEST_SUITE_P(Kinds, KeptOutputs,
  ::testing::Values("FirstImage", "AllImages", "Interfaces"),
  [](const auto& kind) { return std::string(kind.param); });

//------------------------------------------------------------------------------
void ExpectSameArrays(vtkDataSetAttributes* found, vtkDataSetAttributes* expected)
{
  ASSERT_EQ(found->GetNumberOfArrays(), expected->GetNumberOfArrays());
  for (int k = 0; k < expected->GetNumberOfArrays(); ++k)
  {
    vtkDataArray* a = found->GetArray(k);
    vtkDataArray* b = expected->GetArray(k);
    ASSERT_STREQ(a->GetName(), b->GetName());
    ASSERT_EQ(a->GetDataType(), b->GetDataType());
    ASSERT_EQ(a->GetNumberOfValues(), b->GetNumberOfValues());
    for (const auto& [i, c] :
      Product(Below<vtkIdType>(a->GetNumberOfTuples()), a->GetNumberOfComponents()))
    {
      ASSERT_EQ(a->GetComponent(i, c), b->GetComponent(i, c)) << a->GetName();
    }
  }
}

// While nothing but arrays of the input changes, the rest of the output is kept. Each setting that
// it depends on makes it new.
TEST(KeptAssembly, IsThatOfTheCurrentSettings)
{
  const auto grid = MakeGrid(9, 80.0, -50.0);
  grid->GetPointData()->SetNormals(
    MakeArray<vtkFloatArray>("Normals", grid->GetNumberOfPoints(), glm::dvec3(0.1, 1.0, 0.0)));
  const auto water = MakeFlatMembrane();
  const auto make = [&grid, &water]()
  {
    auto filter = MakeFilter(grid, water);
    filter->SetMembraneModelToCurved();
    filter->SetImagesToAllImages();
    filter->SetAngularTolerance(0.001);
    return filter;
  };
  const std::vector<std::function<void(Filter*)>> changes = { [](Filter*) {},
    [](Filter* filter) { filter->SetReflectanceModel(Filter::SCHLICK); },
    [](Filter* filter) { filter->SetOutputPointsPrecision(vtkAlgorithm::SINGLE_PRECISION); },
    [](Filter* filter) { filter->SetTrueGeometry(true); },
    [](Filter* filter) { filter->SetVirtualNormals(true); },
    [](Filter* filter) { filter->SetLightDirection(0.3, 1.0, 0.0); },
    [](Filter* filter) { filter->SetAngularTolerance(0.05); },
    [](Filter* filter) { filter->SetEyePosition(0.0, 200.0, 0.0); },
    [](Filter* filter) { filter->SetInteriorIndexOfRefraction(1.5); } };
  const auto kept = make();
  for (std::size_t last = 0; last < changes.size(); ++last)
  {
    changes[last](kept);
    for (int run = 0; run < 3; ++run)
    {
      SetColors(grid, 100.0 * static_cast<double>(last) + run);
      kept->Update();
    }
    const auto fresh = make();
    for (std::size_t k = 0; k <= last; ++k)
    {
      changes[k](fresh);
    }
    fresh->Update();
    vtkPolyData* found = kept->GetOutput();
    vtkPolyData* expected = fresh->GetOutput();
    ASSERT_GT(expected->GetNumberOfPolys(), 0);
    ASSERT_EQ(found->GetPoints()->GetDataType(), expected->GetPoints()->GetDataType()) << last;
    ASSERT_EQ(found->GetNumberOfPoints(), expected->GetNumberOfPoints()) << last;
    ASSERT_EQ(found->GetNumberOfPolys(), expected->GetNumberOfPolys()) << last;
    ExpectSameArrays(found->GetPointData(), expected->GetPointData());
    ExpectSameArrays(found->GetCellData(), expected->GetCellData());
  }
}

// The object's normals stay the normals of the image.
TEST(KeptOutput, RolesOfArraysStay)
{
  auto grid = MakeGrid(5, 80.0, -50.0);
  grid->GetPointData()->SetNormals(
    MakeArray<vtkFloatArray>("N", grid->GetNumberOfPoints(), glm::dvec3(0.0, 1.0, 0.0)));
  auto filter = MakeFilter(grid, MakeFlatMembrane());
  filter->SetMembraneModelToCurved();
  filter->SetImagesToAllImages();
  filter->Update();
  vtkDataArray* first = filter->GetOutput()->GetPointData()->GetNormals();
  ASSERT_NE(first, nullptr);
  const Part before = MakePart(first);
  SetColors(grid, 1.0);
  filter->Update();
  ASSERT_NE(filter->GetOutput()->GetPointData()->GetNormals(), nullptr);
  EXPECT_EQ(MakePart(filter->GetOutput()->GetPointData()->GetNormals()), before);
}

} // namespace
