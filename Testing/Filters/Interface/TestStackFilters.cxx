// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Error volumes through several interfaces: planes and spheres in closed form, and lists that
// cannot be used.
#include "ExactStack.h"
#include "StackFilterHelpers.h"

#include "vtkRefractionErrorVolume.h"

namespace
{

using namespace meniscus::test;
namespace reference = meniscus::reference;

const glm::dvec3 Eye(20.0, 300.0, 10.0);
const glm::dvec3 Up(0.0, 1.0, 0.0);

vtkSmartPointer<vtkRefractionErrorVolume> MakeVolume()
{
  auto volume = vtkSmartPointer<vtkRefractionErrorVolume>::New();
  volume->SetEyePosition(Eye.x, Eye.y, Eye.z);
  volume->SetModelBounds(-50.0, 50.0, -70.0, -12.0, -50.0, 50.0);
  volume->SetSampleDimensions(10, 10, 10);
  volume->SetInterfaces(vtkNew<vtkRefractingInterfaceCollection>());
  return volume;
}

double ErrorOf(vtkRefractionErrorVolume* volume, vtkIdType i)
{
  return volume->GetOutput()->GetPointData()->GetArray("RefractionError")->GetTuple1(i);
}

int SampleStateOf(vtkRefractionErrorVolume* volume, vtkIdType i)
{
  return static_cast<int>(
    volume->GetOutput()->GetPointData()->GetArray("SampleState")->GetTuple1(i));
}

/**
 * A cap of the sphere of this radius below (0, 0, 0), and its function. The normals are turned by
 * up to 0.01; computed ones would be exact.
 */
constexpr double CapRadius = 300.0;
const glm::dvec3 CapCentre(0.0, -CapRadius, 0.0);
vtkSmartPointer<vtkPolyData> MakeRoughCap(int cells)
{
  auto mesh =
    reference::MakeCap(CapCentre, CapRadius, Up, glm::dvec3(0.0, 1000.0, 0.0), 200.0, cells);
  for (std::size_t i = 0; i < mesh.Normals.size(); i += 3)
  {
    mesh.Normals[i] += 0.01 * std::sin(static_cast<double>(i));
    mesh.Normals[i + 2] += 0.01 * std::cos(2.0 * static_cast<double>(i));
  }
  return MakeMembrane(mesh);
}
const std::vector<reference::ExactSurface> CapOnWater{ { 1.0, 1.5, CapCentre, CapRadius },
  { 1.5, 1.333, glm::dvec3(0.0, -50.0, 0.0), 0.0, Up } };

/** The rough cap above a plane; its error below the plane is that of its normals and patches. */
vtkSmartPointer<vtkRefractionErrorVolume> MakeCapVolume()
{
  auto volume = MakeVolume();
  volume->SetModelBounds(-40.0, 40.0, -90.0, -52.0, -40.0, 40.0);
  AddInterface(volume.Get(), MakeRoughCap(8), 1.0, 1.5);
  AddInterface(volume.Get(), MakePlaneAt(-50.0), 1.5, 1.333);
  return volume;
}

} // anonymous namespace

//------------------------------------------------------------------------------
TEST(StackErrorVolume, PlanesHaveNoError)
{
  const auto volume = MakeVolume();
  for (const double y : { 0.0, -10.0 })
  {
    AddInterface(volume.Get(), MakePlaneAt(y), y < 0.0 ? 1.5 : 1.0, y < 0.0 ? 1.333 : 1.5);
    vtkNew<vtkPlane> plane;
    plane->SetOrigin(0.0, y, 0.0);
    plane->SetNormal(0.0, y < 0.0 ? -2.0 : 1.0, 0.0); // to either side
    volume->GetInterfaces()->GetInterface(y < 0.0 ? 1 : 0)->SetExactSurface(plane);
  }
  ExpectQuiet(volume);
  EXPECT_EQ(volume->GetNumberOfMeasuredSamples(), 1000);
  EXPECT_LT(volume->GetLargestError(), 1e-10);
  EXPECT_EQ(volume->GetNumberOfPatchBuilds(), 2);
}

/**
 * Independent of the volume: the filter's virtual points, traced through the exact sphere and
 * plane, whose path ends where the depth convention puts the point.
 */
TEST(StackErrorVolume, IsThatOfAnExactTrace)
{
  const auto volume = MakeCapVolume();
  vtkNew<vtkSphere> sphere;
  sphere->SetCenter(CapCentre.x, CapCentre.y, CapCentre.z);
  sphere->SetRadius(CapRadius);
  vtkNew<vtkPlane> plane;
  plane->SetOrigin(0.0, -50.0, 0.0);
  plane->SetNormal(0.0, 1.0, 0.0);
  volume->GetInterfaces()->GetInterface(0)->SetExactSurface(sphere);
  volume->GetInterfaces()->GetInterface(1)->SetExactSurface(plane);
  volume->Update();
  ASSERT_EQ(volume->GetNumberOfMeasuredSamples(), 1000);

  std::vector<Point> samples;
  for (vtkIdType i = 0; i < 1000; ++i)
  {
    const glm::dvec3 sample = PointOf(volume->GetOutput(), i);
    samples.push_back({ sample.x, sample.y, sample.z });
  }
  vtkNew<vtkRefractedGeometryFilter> forward;
  forward->SetInputData(0, MakePoints(samples));
  forward->SetEyePosition(Eye.x, Eye.y, Eye.z);
  forward->SetImagesToFirstImage();
  forward->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  forward->SetInterfaces(vtkNew<vtkRefractingInterfaceCollection>());
  AddInterface(forward.Get(), MakeRoughCap(8), 1.0, 1.5); // as meshes, not made exact
  AddInterface(forward.Get(), MakePlaneAt(-50.0), 1.5, 1.333);
  forward->Update();
  ASSERT_EQ(forward->GetOutput()->GetNumberOfPoints(), 1000);
  double largest = 0.0;
  for (vtkIdType i = 0; i < 1000; ++i)
  {
    const glm::dvec3 seen = PointOf(forward->GetOutput(), i);
    const auto path = reference::TraceExactly(CapOnWater, Eye, seen - Eye);
    ASSERT_TRUE(path.has_value());
    const double sum = glm::length(seen - path->Points[0]);
    const double behind = (sum - glm::length(path->Points[1] - path->Points[0]) / 1.5) * 1.333;
    const glm::dvec3 truth = path->Points[1] + behind * path->Directions[2];
    const double error = glm::length(truth - PointOf(volume->GetOutput(), i));
    EXPECT_NEAR(ErrorOf(volume, i), error, 1e-9);
    largest = std::max(largest, error);
  }
  EXPECT_GT(largest, 1e-3); // a rough mesh: there is an error to measure
  EXPECT_NEAR(volume->GetLargestError(), largest, 1e-9);
}

TEST(StackErrorVolume, AFinerMeshOfEachSurfaceReplacesTheFormula)
{
  const auto exact = MakeCapVolume();
  vtkNew<vtkSphere> sphere;
  sphere->SetCenter(CapCentre.x, CapCentre.y, CapCentre.z);
  sphere->SetRadius(CapRadius);
  exact->GetInterfaces()->GetInterface(0)->SetExactSurface(sphere);
  exact->Update(); // the plane is compared with itself
  const auto finer = MakeCapVolume();
  finer->AddReferenceData(MakeMembrane(
    reference::MakeCap(CapCentre, CapRadius, Up, glm::dvec3(0.0, 1000.0, 0.0), 200.0, 64)));
  finer->AddReferenceData(MakePlaneAt(-50.0));
  finer->Update();
  for (vtkIdType i = 0; i < 1000; ++i)
  {
    EXPECT_NEAR(ErrorOf(finer, i), ErrorOf(exact, i), 1e-8); // spheres are exact as patches
  }
  finer->RemoveAllReferences();
  const auto messages = UpdateAndObserve(finer);
  EXPECT_TRUE(HasText(messages->Text, "compared with themselves"));
  EXPECT_LT(finer->GetLargestError(), 1e-9);
  finer->AddReferenceData(MakePlaneAt(-50.0));
  finer->Update();
  EXPECT_TRUE(HasText(messages->Text, "port 1 has 1 surfaces"));
}

TEST(StackErrorVolume, SamplesInFrontAndBesideAreNotMeasured)
{
  const auto volume = MakeVolume();
  AddInterface(volume.Get(), MakePlaneAt(0.0), 1.0, 1.5);
  AddInterface(volume.Get(), MakePlaneAt(-10.0), 1.5, 1.333);
  volume->SetModelBounds(0.0, 500.0, -20.0, 20.0, 0.0, 0.0);
  volume->SetSampleDimensions(2, 2, 1);
  volume->Update();
  EXPECT_EQ(SampleStateOf(volume, 0), vtkRefractionErrorVolume::MEASURED);
  for (const vtkIdType i : { 1, 2, 3 })
  {
    EXPECT_EQ(SampleStateOf(volume, i), vtkRefractionErrorVolume::NO_IMAGE) << i;
  }
}

/**
 * Behind a ball, next to its axis: rays near the axis cross it 35 behind the ball, and those near
 * the rim right behind it. Between these places a point has an image of both kinds of rays, and
 * farther away only one.
 */
TEST(StackErrorVolume, SamplesWithSeveralImagesAreNotMeasured)
{
  const auto volume = MakeVolume();
  const auto ball = MakeMembrane(reference::MakeSphere(glm::dvec3(0.0), 40.0, 3, true));
  AddInterface(volume.Get(), ball, 1.0, 1.5);
  AddInterface(volume.Get(), ball, 1.0, 1.5);
  volume->SetEyePosition(0.0, 300.0, 0.0);
  volume->SetModelBounds(0.5, 0.5, -150.0, -60.0, 0.2, 0.2);
  volume->SetSampleDimensions(1, 2, 1);
  volume->Update();
  EXPECT_EQ(SampleStateOf(volume, 0), vtkRefractionErrorVolume::MEASURED);
  EXPECT_EQ(SampleStateOf(volume, 1), vtkRefractionErrorVolume::SEVERAL_IMAGES);
  EXPECT_TRUE(std::isnan(ErrorOf(volume, 1)));
}

TEST(StackErrorVolume, ResultsDoNotDependOnTheNumberOfThreads)
{
  ExpectSameOnThreads(
    []
    {
      const auto volume = MakeCapVolume();
      volume->AddReferenceData(MakeRoughCap(16));
      volume->AddReferenceData(MakePlaneAt(-50.0));
      volume->Update();
      return ValuesOf(volume->GetOutput()->GetPointData()->GetArray("RefractionError"));
    });
}

TEST(StackErrorVolume, FlatFacetsAreAnError)
{
  const auto volume = MakeCapVolume();
  volume->SetMembraneModelToFlatFacets();
  const auto messages = UpdateAndObserve(volume);
  EXPECT_TRUE(HasText(messages->Text, "need the membrane model CURVED"));
  EXPECT_EQ(volume->GetNumberOfMeasuredSamples(), 0);
}

//------------------------------------------------------------------------------
TEST(StackErrorVolume, ListsThatCannotBeUsed)
{
  ExpectBadLists([]() { return MakeVolume(); },
    [](vtkRefractionErrorVolume* volume) { return volume->GetNumberOfMeasuredSamples(); });
}
