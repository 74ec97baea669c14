// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// vtkRefractedGeometryFilter with several interfaces: output, caches, and input that cannot be
// used.
#include "StackFilterHelpers.h"

namespace
{

using namespace meniscus::test;

const double Eye[3] = { 20.0, 300.0, 10.0 };

// A filter without surfaces, and an empty list.
vtkSmartPointer<vtkRefractedGeometryFilter> MakeStackFilter(vtkPolyData* geometry)
{
  auto filter = vtkSmartPointer<vtkRefractedGeometryFilter>::New();
  vtkNew<vtkRefractingInterfaceCollection> list;
  filter->SetInputData(0, geometry);
  filter->SetInterfaces(list);
  filter->SetEyePosition(Eye[0], Eye[1], Eye[2]);
  filter->SetImagesToFirstImage();
  filter->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  return filter;
}

// Air, glass from 0 to -10, and water.
vtkSmartPointer<vtkRefractedGeometryFilter> MakeAquarium(vtkPolyData* geometry)
{
  auto filter = MakeStackFilter(geometry);
  AddInterface(filter, MakePlaneAt(0.0), 1.0, 1.5);
  AddInterface(filter, MakePlaneAt(-10.0), 1.5, 1.333);
  return filter;
}

double GetValue(vtkPolyData* data, const char* name, vtkIdType point, int component = 0)
{
  return data->GetPointData()->GetArray(name)->GetComponent(point, component);
}

void ExpectError(vtkRefractedGeometryFilter* filter, const std::string& text)
{
  const auto messages = UpdateAndObserve(filter);
  EXPECT_EQ(messages->Errors, 1) << messages->Text;
  EXPECT_TRUE(HasText(messages->Text, text));
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 0);
}

}

//------------------------------------------------------------------------------
TEST(RefractedGeometryStack, PointBelowTheEyeAppearsAtTheSumOfItsLayers)
{
  const auto filter = MakeAquarium(MakePoints({ { Eye[0], -30.0, Eye[2] } }));
  ExpectQuiet(filter);
  vtkPolyData* output = filter->GetOutput();
  ASSERT_EQ(output->GetNumberOfPoints(), 1);
  // Rounding of sums of numbers up to 300.
  EXPECT_NEAR(output->GetPoint(0)[1], -(10.0 / 1.5 + 20.0 / 1.333), 1e-11);
  EXPECT_NEAR(GetValue(output, "RefractionDepth", 0), 30.0, 1e-11);
  EXPECT_NEAR(GetValue(output, "LegLengths", 0, 0), 10.0, 1e-11);
  EXPECT_NEAR(GetValue(output, "LegLengths", 0, 1), 20.0, 1e-11);
  EXPECT_NEAR(GetValue(output, "SightPoint", 0, 1), 0.0, 1e-11);
  EXPECT_NEAR(GetValue(output, "LastSightPoint", 0, 1), -10.0, 1e-11);
  // Fresnel at vertical incidence: ((n1 - n2) / (n1 + n2))^2.
  const double first = std::pow(0.5 / 2.5, 2.0);
  const double second = std::pow((1.5 - 1.333) / (1.5 + 1.333), 2.0);
  EXPECT_NEAR(GetValue(output, "Reflectance", 0), first, 1e-14);
  // With all reflections between both.
  const double passed = (1.0 - first) * (1.0 - second) / (1.0 - first * second);
  EXPECT_NEAR(GetValue(output, "Transmittance", 0), passed, 1e-14);
  EXPECT_NEAR(GetValue(output, "InnerReflectance", 0), 1.0 - passed / (1.0 - first), 1e-14);
}

//------------------------------------------------------------------------------
// All images, the default: behind planes there is one per point, the one that FIRST_IMAGE finds.
TEST(RefractedGeometryStack, AllImagesBehindPlanesAreTheFirstImages)
{
  const auto one = MakeAquarium(MakeGrid(9, 60.0, -40.0));
  const auto all = MakeAquarium(MakeGrid(9, 60.0, -40.0));
  all->SetImagesToAllImages();
  all->SetAngularTolerance(1e-5); // so that cells are divided
  const auto messages = Observe(all);
  one->Update();
  all->Update();
  EXPECT_EQ(messages->Errors + messages->Warnings, 0) << messages->Text;
  vtkPolyData* output = all->GetOutput();
  ASSERT_GT(output->GetNumberOfPoints(), 81);
  EXPECT_EQ(all->GetNumberOfSolvedVertices(), 81);
  EXPECT_EQ(all->GetStatistic("NumberOfSkippedCells"), 0);
  EXPECT_EQ(output->GetFieldData()->GetAbstractArray("PointsWithoutImage")->GetNumberOfTuples(), 0);
  for (vtkIdType i = 0; i < 81; ++i)
  {
    EXPECT_EQ(GetValue(output, "SourcePointId", i), static_cast<double>(i));
    for (int k = 0; k < 3; ++k)
    {
      // Newton's error, 1e-12 of a facet of 20.
      EXPECT_NEAR(output->GetPoint(i)[k], one->GetOutput()->GetPoint(i)[k], 1e-10);
      EXPECT_NEAR(GetValue(output, "LastSightPoint", i, k),
        GetValue(one->GetOutput(), "LastSightPoint", i, k), 1e-10);
    }
    // The cosines of the first images are those before Newton's last step, 1e-6 of a facet of 20
    // at a distance of 300.
    EXPECT_NEAR(
      GetValue(output, "Transmittance", i), GetValue(one->GetOutput(), "Transmittance", i), 1e-9);
  }
  // All points obey Snell's law twice; those in between have interpolated arrays.
  for (vtkIdType i = 0; i < output->GetNumberOfPoints(); ++i)
  {
    double sight[3];
    double last[3];
    output->GetPointData()->GetArray("SightPoint")->GetTuple(i, sight);
    output->GetPointData()->GetArray("LastSightPoint")->GetTuple(i, last);
    const auto sine = [](const double a[3], const double b[3])
    {
      const double across = std::hypot(b[0] - a[0], b[2] - a[2]);
      return across / std::hypot(across, b[1] - a[1]);
    };
    EXPECT_NEAR(sine(Eye, sight), 1.5 * sine(sight, last), 1e-12);
    if (i < 81)
    {
      EXPECT_NEAR(sine(Eye, output->GetPoint(i)), sine(Eye, sight), 1e-12);
      const double* p = vtkPolyData::SafeDownCast(all->GetInput(0))->GetPoint(i);
      EXPECT_NEAR(1.5 * sine(sight, last), 1.333 * sine(last, p), 1e-12);
    }
    EXPECT_NEAR(GetValue(output, "LegLengths", i, 0) + GetValue(output, "LegLengths", i, 1),
      GetValue(output, "RefractionDepth", i), 1e-9);
  }
  std::vector<char> isSeen(64, 0);
  for (vtkIdType i = 0; i < output->GetNumberOfCells(); ++i)
  {
    const auto cell =
      static_cast<std::size_t>(output->GetCellData()->GetArray("SourceCellId")->GetComponent(i, 0));
    isSeen[cell] = 1;
    EXPECT_EQ(output->GetCellData()->GetArray("Label")->GetComponent(i, 0), 10.0 * double(cell));
  }
  EXPECT_EQ(std::count(isSeen.begin(), isSeen.end(), 1), 64);
}

//------------------------------------------------------------------------------
// From one image to all of them and back: nothing of the other kind is kept, and nothing is solved
// twice.
TEST(RefractedGeometryStack, AllImagesAreKeptWhileNothingChanges)
{
  const auto filter = MakeAquarium(MakeGrid(5, 60.0, -40.0));
  filter->Update();
  const vtkIdType whole = filter->GetOutput()->GetNumberOfPoints();
  filter->SetImagesToAllImages();
  filter->SetAngularTolerance(1e-5);
  filter->Update();
  EXPECT_EQ(filter->GetNumberOfSolvedVertices(), 50);
  const vtkIdType divided = filter->GetOutput()->GetNumberOfPoints();
  EXPECT_GT(divided, whole);
  filter->SetAngularTolerance(0.5);
  filter->Update();
  EXPECT_EQ(filter->GetNumberOfSolvedVertices(), 50);
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), whole); // straight within the tolerance
  filter->SetImagesToFirstImage();
  filter->Update();
  EXPECT_EQ(filter->GetNumberOfSolvedVertices(), 75);
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), whole);
}

//------------------------------------------------------------------------------
// A coarse sphere as data, made exact by its implicit function and listed twice: rays through its
// centre go straight on.
TEST(RefractedGeometryStack, ClosedBodyIsListedTwice)
{
  vtkNew<vtkSphereSource> source;
  source->SetRadius(40.0);
  source->SetThetaResolution(48);
  source->SetPhiResolution(24);
  source->Update();
  vtkNew<vtkSphere> sphere;
  sphere->SetRadius(40.0);
  const auto filter =
    MakeStackFilter(MakePoints({ { -10.0, -150.0, -5.0 }, { 5.0, 75.0, 2.5 }, { 0.0, 0.0, 0.0 } }));
  AddInterface(filter, source->GetOutput(), 1.0, 1.5);
  AddInterface(filter, source->GetOutput(), 1.0, 1.5);
  filter->GetInterfaces()->GetInterface(0)->SetExactSurface(sphere);
  filter->GetInterfaces()->GetInterface(1)->SetExactSurface(sphere);
  filter->Update();
  EXPECT_EQ(filter->GetNumberOfPatchBuilds(), 1);
  vtkPolyData* output = filter->GetOutput();
  ASSERT_EQ(output->GetNumberOfPoints(), 3);
  const double toEye = std::sqrt(20.0 * 20.0 + 300.0 * 300.0 + 10.0 * 10.0);
  const auto alongAxis = [output, toEye](vtkIdType i)
  {
    const glm::dvec3 p = PointOf(output, i);
    EXPECT_NEAR(p[0] * 300.0 - p[1] * 20.0, 0.0, 1e-6);
    EXPECT_NEAR(p[2] * 300.0 - p[1] * 10.0, 0.0, 1e-6);
    return (p[0] * 20.0 + p[1] * 300.0 + p[2] * 10.0) / toEye;
  };
  const double behind = std::sqrt(10.0 * 10.0 + 150.0 * 150.0 + 5.0 * 5.0) - 40.0;
  EXPECT_NEAR(alongAxis(0), 40.0 - 80.0 / 1.5 - behind, 1e-8);
  EXPECT_EQ(output->GetPoint(1)[1], 75.0);            // in front of the ball
  EXPECT_NEAR(alongAxis(2), 40.0 - 40.0 / 1.5, 1e-8); // in it
}

//------------------------------------------------------------------------------
TEST(RefractedGeometryStack, EqualIndicesAreTheIdentityWithoutWork)
{
  const auto grid = MakeGrid(5, 60.0, -9.7);
  for (const bool all : { false, true })
  {
    const auto filter = MakeStackFilter(grid);
    filter->SetImages(
      all ? vtkRefractedGeometryFilter::ALL_IMAGES : vtkRefractedGeometryFilter::FIRST_IMAGE);
    for (const double y : { 0.0, -10.0, -20.0 })
    {
      AddInterface(filter, MakePlaneAt(y), 1.333, 1.333);
    }
    filter->Update();
    vtkPolyData* output = filter->GetOutput();
    ASSERT_EQ(output->GetNumberOfPoints(), 25);
    EXPECT_EQ(output->GetNumberOfPolys(), 16);
    for (vtkIdType i = 0; i < 25; ++i)
    {
      EXPECT_EQ(PointOf(output, i), PointOf(grid, i));
      EXPECT_EQ(GetValue(output, "SightFacet", i), -1.0);
      EXPECT_EQ(GetValue(output, "Transmittance", i), 1.0);
    }
  }

  // Between others they change no bit.
  const auto plain = MakeAquarium(MakeGrid(5, 60.0, -40.0));
  const auto padded = MakeStackFilter(MakeGrid(5, 60.0, -40.0));
  AddInterface(padded, MakePlaneAt(0.0), 1.0, 1.5);
  AddInterface(padded, MakePlaneAt(-3.0), 1.5, 1.5);
  AddInterface(padded, MakePlaneAt(-10.0), 1.5, 1.333);
  plain->Update();
  padded->Update();
  ASSERT_EQ(padded->GetOutput()->GetNumberOfPoints(), 25);
  for (const auto& [i, k] : Product(Below<vtkIdType>(25), 3))
  {
    EXPECT_EQ(padded->GetOutput()->GetPoint(i)[k], plain->GetOutput()->GetPoint(i)[k]);
  }
}

//------------------------------------------------------------------------------
TEST(RefractedGeometryStack, WorkIsDoneWhereItsInputChanges)
{
  const auto filter = MakeAquarium(MakeGrid(5, 60.0, -40.0));
  filter->Update();
  EXPECT_EQ(filter->GetNumberOfPatchBuilds(), 2);
  EXPECT_EQ(filter->GetNumberOfEyeUpdates(), 1);
  EXPECT_EQ(filter->GetNumberOfSolvedVertices(), 25);
  filter->SetReflectanceModelToSchlick(); // solves nothing
  filter->Update();
  EXPECT_EQ(filter->GetNumberOfSolvedVertices(), 25);
  filter->SetEyePosition(0.0, 250.0, 0.0);
  filter->Update();
  EXPECT_EQ(filter->GetNumberOfPatchBuilds(), 2);
  EXPECT_EQ(filter->GetNumberOfEyeUpdates(), 2);
  EXPECT_EQ(filter->GetNumberOfSolvedVertices(), 50);
  // The same values in other objects are no change.
  filter->GetInterfaces()->GetInterface(1)->Modified();
  filter->Update();
  EXPECT_EQ(filter->GetNumberOfSolvedVertices(), 50);
  filter->GetInterfaces()->GetInterface(1)->SetInteriorIndexOfRefraction(1.4);
  filter->Update();
  EXPECT_EQ(filter->GetNumberOfPatchBuilds(), 2);
  EXPECT_EQ(filter->GetNumberOfSolvedVertices(), 75);
}

//------------------------------------------------------------------------------
// From one interface to two and back: nothing of the other kind is kept.
TEST(RefractedGeometryStack, ListMayChangeItsLength)
{
  const auto filter = MakeStackFilter(MakePoints({ { Eye[0], -30.0, Eye[2] } }));
  AddInterface(filter, MakePlaneAt(0.0), 1.0, 1.5);
  filter->Update();
  EXPECT_NEAR(filter->GetOutput()->GetPoint(0)[1], -20.0, 1e-11);
  AddInterface(filter, MakePlaneAt(-10.0), 1.5, 1.333);
  filter->Update();
  EXPECT_NEAR(filter->GetOutput()->GetPoint(0)[1], -(10.0 / 1.5 + 20.0 / 1.333), 1e-11);
  filter->GetInterfaces()->RemoveItem(1);
  filter->RemoveInputConnection(1, 1);
  filter->Update();
  EXPECT_NEAR(filter->GetOutput()->GetPoint(0)[1], -20.0, 1e-11);
}

//------------------------------------------------------------------------------
TEST(RefractedGeometryStack, NormalsForALightAtTheEyeKeepTheirAngleToTheRay)
{
  const auto grid = MakeGrid(5, 60.0, -40.0);
  grid->GetPointData()->SetNormals(MakeArray("Normals", 25, glm::dvec3(0.6, 0.8, 0.0)));
  const auto filter = MakeAquarium(grid);
  filter->VirtualNormalsOn();
  filter->Update();
  vtkPolyData* output = filter->GetOutput();
  vtkDataArray* seen = output->GetPointData()->GetNormals();
  ASSERT_NE(seen, nullptr);
  EXPECT_STREQ(seen->GetName(), "VirtualNormals");
  for (vtkIdType i = 0; i < 25; ++i)
  {
    double p[3];
    double at[3];
    double last[3];
    double n[3];
    grid->GetPoint(i, p);
    output->GetPoint(i, at);
    output->GetPointData()->GetArray("LastSightPoint")->GetTuple(i, last);
    seen->GetTuple(i, n);
    const auto cosine = [](const double a[3], const double from[3], const double to[3])
    {
      const double d[3] = { to[0] - from[0], to[1] - from[1], to[2] - from[2] };
      return (a[0] * d[0] + a[1] * d[1] + a[2] * d[2]) / std::hypot(d[0], d[1], d[2]);
    };
    const double own[3] = { 0.6, 0.8, 0.0 };
    EXPECT_NEAR(cosine(n, at, Eye), cosine(own, p, last), 1e-12);
  }
}

//------------------------------------------------------------------------------
TEST(RefractedGeometryStack, ListsThatCannotBeUsed)
{
  ExpectBadLists([] { return MakeStackFilter(MakeGrid(3, 10.0, -40.0)); },
    [](vtkRefractedGeometryFilter* filter) { return filter->GetOutput()->GetNumberOfPoints(); });
}

TEST(RefractedGeometryStack, PropertiesThatAreNotAvailableAreAnError)
{
  const auto flat = MakeAquarium(MakeGrid(3, 10.0, -40.0));
  flat->SetMembraneModelToFlatFacets();
  ExpectError(flat, "need the membrane model CURVED");
  const auto light = MakeAquarium(MakeGrid(3, 10.0, -40.0));
  light->VirtualNormalsOn();
  light->SetLightDirection(0.0, 1.0, 0.0);
  ExpectError(light, "need a light at the eye");
}

TEST(RefractedGeometryStack, EyeOnASurfaceOrNotFiniteIsAnError)
{
  const auto on = MakeAquarium(MakeGrid(3, 10.0, -40.0));
  on->SetEyePosition(1.0, -10.0, 2.0);
  ExpectError(on, "lies on the membrane");
  const auto nowhere = MakeAquarium(MakeGrid(3, 10.0, -40.0));
  nowhere->SetEyePosition(1.0, std::nan(""), 2.0);
  ExpectError(nowhere, "is not finite");
}

//------------------------------------------------------------------------------
TEST(RefractedGeometryStack, WrongOrderWarnsAndCountsPointsWithoutImage)
{
  const auto filter = MakeStackFilter(MakeGrid(3, 10.0, -40.0));
  AddInterface(filter, MakePlaneAt(-10.0), 1.0, 1.5);
  AddInterface(filter, MakePlaneAt(0.0), 1.5, 1.333);
  filter->SetEyePosition(0.0, -5.0, 0.0); // in front of the first one, and behind the second one
  const auto messages = UpdateAndObserve(filter);
  EXPECT_TRUE(HasText(messages->Text, "No ray from the eye passes"));
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 0);
  EXPECT_EQ(filter->GetStatistic("NumberOfVerticesWithoutImage"), 9);
}

TEST(RefractedGeometryStack, PointsBesideALaterSurfaceAreCounted)
{
  const auto filter =
    MakeAquarium(MakePoints({ { 0.0, -40.0, 0.0 }, { 500.0, -40.0, 0.0 }, { 0.0, -5.0, 0.0 } }));
  filter->Update();
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 2);
  EXPECT_EQ(filter->GetStatistic("NumberOfVerticesWithoutImage"), 1);
  EXPECT_EQ(
    filter->GetOutput()->GetFieldData()->GetArray("PointsWithoutImage")->GetComponent(0, 0), 1.0);
}

TEST(RefractedGeometryStack, EyeBetweenSurfacesUsesTheRest)
{
  const auto filter = MakeAquarium(MakePoints({ { 5.0, -40.0, 3.0 } }));
  filter->SetEyePosition(5.0, -2.0, 3.0);
  filter->Update();
  ASSERT_EQ(filter->GetOutput()->GetNumberOfPoints(), 1);
  EXPECT_NEAR(filter->GetOutput()->GetPoint(0)[1], -10.0 - 30.0 * 1.5 / 1.333, 1e-11);
  EXPECT_EQ(GetValue(filter->GetOutput(), "LegLengths", 0, 0), 0.0);
  EXPECT_NEAR(GetValue(filter->GetOutput(), "LegLengths", 0, 1), 30.0, 1e-11);
}
