// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Images of a medium that bends light: closed forms, pipeline, input that cannot be used.
#include "AbortedUpdate.h"
#include "HardMeshes.h"
#include "RayCastScene.h"

#include <vtkTetrahedraSchlieren.h>

using namespace meniscus::test;

namespace
{

using Filter = vtkSmartPointer<vtkTetrahedraSchlieren>;

constexpr int Size = 40;
constexpr double Base = 1.6;
constexpr double Slope = 0.1;
const double NaN = std::numeric_limits<double>::quiet_NaN();

/** Index with a linear square along x. */
double IndexAt(double x, double, double)
{
  return std::sqrt(Base + Slope * x);
}

Filter MakeFilter(vtkDataObject* input)
{
  auto filter = Filter::New();
  filter->SetInputDataObject(input);
  filter->SetQuantityToRefractiveIndex();
  filter->SetImageSize(Size, Size);
  return filter;
}

double ValueAt(vtkTetrahedraSchlieren* filter, const char* name, int column, int row, int part = 0)
{
  vtkImageData* image = filter->GetOutput();
  return image->GetPointData()->GetArray(name)->GetComponent(
    vtkIdType{ row } * image->GetDimensions()[0] + column, part);
}

std::vector<double> AllValues(vtkTetrahedraSchlieren* filter)
{
  return ValuesOf(filter->GetOutput()->GetPointData());
}

vtkSmartPointer<vtkImageData> MakeRamp(int width, int height)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(width, height, 1);
  image->AllocateScalars(VTK_FLOAT, 1);
  for (const auto& [j, i] : Product(height, width))
  {
    image->SetScalarComponentFromDouble(i, j, 0, 0, i);
  }
  return image;
}

}

// The block [-1, 1]^3 seen along -z: parabolas of the field's slope.
TEST(Schlieren, LinearFieldHasClosedForms)
{
  Filter filter = MakeFilter(MakeBlock(5, IndexAt));
  const double distance = 3.0;
  filter->SetBackgroundDistance(distance);
  filter->SetKnifeAngle(0.0);
  filter->SetKnifeRange(0.2);
  filter->SetWavelength(0.3);
  filter->SetFringes(5.0, 0.0);
  filter->SetInputDataObject(1, MakeRamp(Size, Size));
  filter->Update();
  const double pixel = 2.0 / Size;
  for (int column = 2; column < Size - 4; ++column)
  {
    const double square = Base + Slope * (-1.0 + pixel * (column + 0.5));
    const double turn = Slope / square;
    const double shift = (turn + turn * distance) / pixel;
    const double path =
      2.0 * std::sqrt(square) + Slope * Slope / 12.0 * 8.0 / std::pow(square, 1.5) - 2.0;
    const int row = 13;
    EXPECT_NEAR(ValueAt(filter, "Deflection", column, row), turn, 1.0e-6);
    EXPECT_NEAR(ValueAt(filter, "Deflection", column, row, 1), 0.0, 1.0e-6);
    EXPECT_NEAR(ValueAt(filter, "OpticalPathDifference", column, row), path, 1.0e-6);
    EXPECT_NEAR(ValueAt(filter, "Displacement", column, row), shift, 1.0e-4);
    EXPECT_NEAR(ValueAt(filter, "Displacement", column, row, 1), 0.0, 1.0e-4);
    EXPECT_NEAR(ValueAt(filter, "Schlieren", column, row), 0.5 + turn / 0.2, 1.0e-5);
    EXPECT_NEAR(ValueAt(filter, "Interferogram", column, row),
      0.5 + 0.5 * std::cos(2.0 * M_PI * (path / 0.3 + 5.0 * (column + 0.5) / Size)), 1.0e-4);
    EXPECT_NEAR(
      ValueAt(filter, "Background", column, row), std::min(column + shift, Size - 1.0), 1.0e-3);
  }
  EXPECT_EQ(filter->GetStatistic("NumberOfRays"), Size * Size);
  EXPECT_EQ(filter->GetStatistic("NumberOfLostRays"), 0);
  EXPECT_EQ(filter->GetStatistic("NumberOfStoppedRays"), 0);
}

TEST(Schlieren, SmallAnglesAreNearlyStraight)
{
  Filter filter = MakeFilter(MakeBlock(5,
    [](double x, double y, double z)
    { return 1.0 + 1.0e-5 * std::exp(-2.0 * (x * x + y * y + z * z)); }));
  // Not along rows of cells, in which a slight bend leads to cells with another gradient.
  filter->SetDirection(0.3, -0.4, -1.0);
  filter->Update();
  std::vector<double> bent;
  double largest = 0.0;
  for (int column = 0; column < Size; ++column)
  {
    bent.push_back(ValueAt(filter, "Deflection", column, 15));
    largest = std::max(largest, std::abs(bent.back()));
  }
  filter->BendRaysOff();
  filter->Update();
  for (int column = 0; column < Size; ++column)
  {
    EXPECT_NEAR(ValueAt(filter, "Deflection", column, 15), bent[static_cast<std::size_t>(column)],
      0.01 * largest);
  }
  EXPECT_GT(largest, 1.0e-6);
}

TEST(Schlieren, DensityIsIndexByGladstoneDale)
{
  Filter ofIndex =
    MakeFilter(MakeBlock(3, [](double x, double, double) { return 1.0 + 0.25 * (0.3 + 0.1 * x); }));
  ofIndex->Update();
  Filter ofDensity =
    MakeFilter(MakeBlock(3, [](double x, double, double) { return 0.3 + 0.1 * x; }));
  ofDensity->SetQuantityToDensity();
  EXPECT_NEAR(ofDensity->GetGladstoneDale(), 2.26e-4, 1.0e-6);
  ofDensity->SetGladstoneDale(0.25);
  ofDensity->Update();
  EXPECT_GT(ValueAt(ofIndex, "Deflection", 20, 20), 0.01);
  EXPECT_NEAR(
    ValueAt(ofIndex, "Deflection", 20, 20), ValueAt(ofDensity, "Deflection", 20, 20), 1.0e-6);
}

TEST(Schlieren, LightIsConserved)
{
  // A weak lens in the middle, several cells wide: all of the light lands on the screen, on the
  // axis as in a focus. In a block of 7, 5e-4 of the light lands beyond the image, none of it is
  // lost: Shadowgraph.MissingLightIsBeyondTheImage.
  Filter filter = MakeFilter(MakeBlock(12,
    [](double x, double y, double z)
    { return 1.0 + 0.05 * std::exp(-20.0 * (x * x + y * y + z * z)); }));
  filter->SetScreenDistance(2.0);
  filter->Update();
  double sum = 0.0;
  double most = 0.0;
  for (int i = 0; i < Size * Size; ++i)
  {
    const double light = ValueAt(filter, "Shadowgraph", i % Size, i / Size);
    sum += light;
    most = std::max(most, light);
  }
  EXPECT_NEAR(sum / (Size * Size), 1.0, 1.0e-4);
  EXPECT_GT(most, 1.5);
}

TEST(Schlieren, CameraHasItsOwnRays)
{
  Filter filter = MakeFilter(MakeBlock(5, IndexAt));
  vtkNew<vtkCamera> camera;
  camera->SetPosition(0.0, 0.0, 400.0);
  camera->SetFocalPoint(0.0, 0.0, 0.0);
  camera->SetViewAngle(2.0 * std::atan(1.0 / 400.0) * 180.0 / M_PI);
  filter->SetCamera(camera);
  filter->Update();
  // From afar, nearly parallel rays.
  const double square = Base + Slope * (0.5 / Size * 2.0);
  EXPECT_NEAR(ValueAt(filter, "Deflection", Size / 2, Size / 2), Slope / square, 1.0e-4);
  EXPECT_NEAR(
    ValueAt(filter, "Displacement", Size / 2, Size / 2), 2.0 * Slope / square * Size / 2.0, 0.02);
  const double spacing = filter->GetOutput()->GetSpacing()[0];
  EXPECT_EQ(spacing, 1.0);
  // From inside of the mesh: the rays begin at the camera.
  camera->SetPosition(0.1, 0.05, 0.0);
  camera->SetFocalPoint(0.1, 0.05, -1.0);
  camera->SetViewAngle(30.0);
  filter->Update();
  EXPECT_EQ(filter->GetStatistic("NumberOfRays"), Size * Size);
  const double path = ValueAt(filter, "OpticalPathDifference", Size / 2, Size / 2);
  EXPECT_NEAR(path, std::sqrt(Base + Slope * 0.1) - 1.0, 2.0e-3);
}

// A mirage: the air's n^2 rises with the height, 100 units of it from one end to the other. Rays
// that go down turn, and come up again, on parabolas.
TEST(Schlieren, MirageIsAParabola)
{
  constexpr double half = 50.0;
  constexpr double eye = 60.0;
  constexpr double rise = 2.4e-4;
  constexpr double tangent = 6.0e-3;
  const Grid air =
    MakeBlock(5, [](double, double y, double) { return std::sqrt(Base + rise * y); });
  MapPoints(air, [](const glm::dvec3& p) { return glm::dvec3(p.x, p.y, half * p.z); });
  Filter filter = MakeFilter(air);
  vtkNew<vtkCamera> camera;
  camera->SetPosition(0.0, 0.0, eye);
  camera->SetViewAngle(2.0 * std::atan(tangent) * 180.0 / M_PI);
  filter->SetCamera(camera);
  filter->SetBackgroundDistance(0.0);
  filter->Update();
  int turned = 0;
  for (int row = 0; row < Size; ++row)
  {
    const double slope = tangent * (2.0 * (row + 0.5) / Size - 1.0);
    const double aside = tangent * (1.0 / Size);
    const double height = slope * (eye - half);
    const double index = std::sqrt(Base + rise * height);
    const double onward = index / std::sqrt(1.0 + slope * slope + aside * aside);
    const double time = 2.0 * half / onward;
    const double end = height + time * (slope * onward + 0.25 * rise * time);
    const double endSlope = slope + 0.5 * rise * time / onward;
    if (std::abs(end) > 0.95)
    {
      continue;
    }
    turned += slope < 0.0 && endSlope > 0.0 ? 1 : 0;
    const double pixel = tangent * 2.0 / Size * (eye + half);
    const int column = Size / 2;
    // Positions of the mesh are rounded to 5e-8.
    EXPECT_NEAR(ValueAt(filter, "Deflection", column, row, 1), endSlope - slope, 1.0e-8);
    EXPECT_NEAR(
      ValueAt(filter, "Displacement", column, row, 1) * pixel, end - slope * (eye + half), 2.0e-7);
    EXPECT_NEAR(ValueAt(filter, "Displacement", column, row, 0), 0.0, 1.0e-4);
  }
  EXPECT_GT(turned, Size / 4);
}

// Layers of 1e-6: depths in double precision need no warning.
TEST(Schlieren, ShortEdgesAreNoMatter)
{
  const Grid layers = MakeLayeredBlock(4, 1.0e-6);
  layers->GetPointData()->GetScalars()->Fill(1.3);
  Filter filter = MakeFilter(layers);
  const auto observer = ObserveErrors(filter);
  filter->Update();
  EXPECT_EQ(observer->Warnings.size(), 0u);
  EXPECT_GT(filter->GetStatistic("NumberOfRays"), 0);
}

TEST(Schlieren, ThreadsDoNotMatter)
{
  ExpectSameOnThreads(
    []
    {
      Filter filter = MakeFilter(MakeBlock(6,
        [](double x, double y, double z)
        { return 1.3 + 0.2 * std::sin(3.0 * x + y) * std::cos(4.0 * z); }));
      filter->SetDirection(0.3, -0.4, -1.0);
      filter->Update();
      return AllValues(filter);
    });
}

// Rays depend on the medium and on the view, not on what stands behind the medium.
TEST(Schlieren, RaysAreCastWhereTheirInputChanges)
{
  const Grid block = MakeBlock(4, IndexAt);
  Filter filter = MakeFilter(block);
  filter->Update();
  // A change of a filter that has an image: work of the medium and of the rays, and equal images.
  const auto expectWork = [&](int media, int casts, const char* change)
  {
    SCOPED_TRACE(change);
    const double before[2] = { filter->GetStatistic("NumberOfMediumUpdates"),
      filter->GetStatistic("NumberOfCasts") };
    filter->Update();
    EXPECT_EQ(filter->GetStatistic("NumberOfMediumUpdates") - before[0], media);
    EXPECT_EQ(filter->GetStatistic("NumberOfCasts") - before[1], casts);
    Filter fresh = MakeFilter(block);
    fresh->SetQuantity(filter->GetQuantity());
    fresh->SetGladstoneDale(filter->GetGladstoneDale());
    fresh->SetKnifeAngle(filter->GetKnifeAngle());
    fresh->SetKnifeCutOff(filter->GetKnifeCutOff());
    fresh->SetKnifeRange(filter->GetKnifeRange());
    fresh->SetWavelength(filter->GetWavelength());
    fresh->SetFringes(filter->GetFringes());
    fresh->SetScreenDistance(filter->GetScreenDistance());
    fresh->SetBackgroundDistance(filter->GetBackgroundDistance());
    fresh->SetReferenceIndex(filter->GetReferenceIndex());
    fresh->SetInputDataObject(1, filter->GetInputDataObject(1, 0));
    fresh->SetCamera(filter->GetCamera());
    fresh->SetDirection(filter->GetDirection());
    fresh->SetOutsideIndex(filter->GetOutsideIndex());
    fresh->SetBendRays(filter->GetBendRays());
    fresh->Update();
    EXPECT_TRUE(AllValues(filter) == AllValues(fresh));
    EXPECT_EQ(filter->GetStatistic("NumberOfRays"), fresh->GetStatistic("NumberOfRays"));
  };
  filter->SetKnifeAngle(30.0);
  filter->SetKnifeCutOff(0.3);
  filter->SetKnifeRange(0.1);
  expectWork(0, 0, "knife");
  filter->SetWavelength(0.2);
  filter->SetFringes(3.0, 1.0);
  filter->SetReferenceIndex(1.2);
  expectWork(0, 0, "interferometer");
  filter->SetScreenDistance(3.0);
  filter->SetBackgroundDistance(2.0);
  expectWork(0, 0, "distances");
  filter->SetInputDataObject(1, MakeRamp(5, 4));
  expectWork(0, 0, "background");
  filter->SetDirection(0.1, 0.2, -1.0);
  expectWork(0, 1, "direction");
  filter->SetOutsideIndex(1.3);
  expectWork(0, 1, "index outside");
  filter->BendRaysOff();
  expectWork(0, 1, "straight rays");
  filter->SetGladstoneDale(0.3);
  expectWork(0, 0, "constant of a gas for values of the index");
  filter->SetQuantityToDensity();
  expectWork(1, 1, "quantity");
  filter->SetGladstoneDale(0.4);
  expectWork(1, 1, "constant of a gas");
  block->Modified();
  expectWork(0, 0, "input without a change");
  block->GetPointData()->GetScalars()->SetComponent(3, 0, 1.1);
  block->GetPointData()->GetScalars()->Modified();
  block->Modified();
  expectWork(1, 1, "values");
  block->GetPoints()->SetPoint(0, -1.1, -1.0, -1.0);
  block->GetPoints()->Modified();
  block->Modified();
  expectWork(1, 1, "points");
}

TEST(Schlieren, CompositeInputIsOneMedium)
{
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, MakeBlock(3, IndexAt));
  Filter whole = MakeFilter(MakeBlock(3, IndexAt));
  Filter parts = MakeFilter(blocks);
  whole->Update();
  parts->Update();
  EXPECT_TRUE(AllValues(whole) == AllValues(parts));
}

TEST(Schlieren, AbortEmptiesTheOutput)
{
  Filter filter = MakeFilter(MakeBlock(4, IndexAt));
  UpdateWithAbort(filter, -1.0);
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), Size * Size);
}

TEST(Schlieren, UnusableValuesAreHolesWithAWarning)
{
  for (const double bad : { NaN, -1.0, 0.0, std::numeric_limits<double>::infinity() })
  {
    Filter filter = MakeFilter(
      MakeBlock(4, [bad](double x, double y, double z) { return x + y + z > 2.5 ? bad : 1.3; }));
    const auto observer = ObserveErrors(filter);
    filter->Update();
    EXPECT_EQ(observer->Errors.size(), 0u);
    EXPECT_EQ(observer->Warnings.size(), 1u) << bad;
    EXPECT_EQ(filter->GetStatistic("NumberOfUnusablePoints"), 1) << bad;
    EXPECT_EQ(filter->GetStatistic("NumberOfLostRays"), 0);
    EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), Size * Size);
  }
}

TEST(Schlieren, OddSettingsAreWarnings)
{
  // Below the index of a vacuum, and a knife edge in front of all light.
  for (const double cutOff : { 0.5, 1.0 })
  {
    Filter filter = MakeFilter(MakeBlock(3, ConstantField(cutOff < 1.0 ? 0.9 : 1.3)));
    filter->SetKnifeCutOff(cutOff);
    const auto observer = ObserveErrors(filter);
    filter->Update();
    EXPECT_EQ(observer->Errors.size(), 0u);
    ASSERT_EQ(observer->Warnings.size(), 1u) << cutOff;
    const char* const text = cutOff < 1.0 ? "below 1" : "cuts off all light";
    EXPECT_TRUE(HasText(observer->Warnings[0], text));
    EXPECT_EQ(ValueAt(filter, "Schlieren", 3, 4), static_cast<float>(1.0 - cutOff));
  }
}

TEST(Schlieren, RaysThatStayAreStoppedWithAWarning)
{
  // A cube of glass with the camera in it: all sides are met beyond the critical angle.
  Filter filter = MakeFilter(MakeBlock(2, ConstantField(3.0)));
  vtkNew<vtkCamera> camera;
  camera->SetPosition(0.1, 0.15, 0.3);
  camera->SetFocalPoint(1.1, 1.25, -0.9);
  camera->SetViewAngle(2.0);
  filter->SetCamera(camera);
  filter->SetImageSize(2, 2);
  filter->SetOutsideIndex(1.0);
  const auto observer = ObserveErrors(filter);
  filter->Update();
  ASSERT_EQ(observer->Warnings.size(), 1u);
  EXPECT_TRUE(HasText(observer->Warnings[0], "4 rays were stopped"));
  EXPECT_EQ(filter->GetStatistic("NumberOfStoppedRays"), 4);
  EXPECT_EQ(filter->GetStatistic("NumberOfRaysStoppedInFolds"), 0);
}

TEST(Schlieren, BadInputIsAnError)
{
  const Grid good = MakeBlock(2, IndexAt);
  Filter filter = MakeFilter(good);
  filter->SetImageSize(0, 5);
  ExpectError(filter, "ImageSize");
  filter = MakeFilter(good);
  filter->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Missing");
  ExpectError(filter, "Missing");
  filter = MakeFilter(MakeBlock(2, ConstantField(-1.0)));
  ExpectError(filter, "No cell has an index");
  filter = MakeFilter(good);
  filter->SetViewUp(filter->GetDirection());
  ExpectError(filter, "parallel");
  filter = MakeFilter(good);
  filter->SetWavelength(0.0);
  ExpectError(filter, "wavelength");
  filter = MakeFilter(good);
  filter->SetScreenDistance(NaN);
  ExpectError(filter, "not finite");
  filter = MakeFilter(good);
  vtkNew<vtkImageData> empty;
  filter->SetInputDataObject(1, empty);
  ExpectError(filter, "no pixels");
  vtkNew<vtkUnstructuredGrid> nothing;
  filter = MakeFilter(nothing);
  ExpectError(filter, "");
}
