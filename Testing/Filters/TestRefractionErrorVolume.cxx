// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Error volumes compared with the thesis's tables, measured by other means; exact surfaces of every
// kind; and invalid input.
#include "RefractedGeometryTestHelpers.h"
#include "Refraction/Flat/FlatMembraneSolver.h"
#include "ThesisTables.h"

#include "VTKTestBasics.h"
#include "vtkImplicitFunction.h"
#include "vtkObjectFactory.h"
#include "vtkRefractingInterface.h"
#include "vtkRefractingInterfaceCollection.h"
#include "vtkRefractionErrorVolume.h"

namespace
{

using namespace meniscus::test;
using namespace meniscus::reference;

const double NaN = std::numeric_limits<double>::quiet_NaN();
const double Pi = std::acos(-1.0);
const HeightField Waves{ HeightField::Shape::Waves, 200.0, 3.0, 0.02 * Pi, 1.0, 1.333 };

/** y - f(x, z) of the waves. */
class WavesFunction : public vtkImplicitFunction
{
public:
  static WavesFunction* New();
  vtkTypeMacro(WavesFunction, vtkImplicitFunction);
  using vtkImplicitFunction::EvaluateFunction;
  double EvaluateFunction(double x[3]) override { return x[1] - Waves.GetHeight(x[0], x[2]); }
  void EvaluateGradient(double x[3], double g[3]) override
  {
    double dx = 0.0;
    double dz = 0.0;
    Waves.GetSlopes(x[0], x[2], dx, dz);
    g[0] = -dx;
    g[1] = 1.0;
    g[2] = -dz;
  }
};
vtkStandardNewMacro(WavesFunction);

vtkSmartPointer<vtkSphere> MakeSphere(double radius)
{
  auto sphere = vtkSmartPointer<vtkSphere>::New();
  sphere->SetCenter(0.0, radius, 0.0);
  sphere->SetRadius(radius);
  return sphere;
}

vtkSmartPointer<vtkRefractionErrorVolume> MakeVolume(vtkPolyData* membrane)
{
  auto volume = vtkSmartPointer<vtkRefractionErrorVolume>::New();
  volume->SetInputData(0, membrane);
  volume->SetEyePosition(20.0, 300.0, 10.0);
  volume->SetModelBounds(-80.0, 80.0, -150.0, -10.0, -80.0, 80.0);
  volume->SetSampleDimensions(12, 12, 12);
  return volume;
}

/** The thesis's box: 40 samples along a side, 20 apart. */
vtkSmartPointer<vtkRefractionErrorVolume> MakeThesisVolume(const ThesisRow& row)
{
  const double radius = row.SphereRatio * 141.5;
  auto volume = MakeVolume(
    MakeMembrane(row.Shape == MembraneShape::Disc ? MakeDisc(141.5, 5, radius)
                                                  : MakeSquare(200.0, row.SquareCells, radius)));
  volume->SetMembraneModelToFlatFacets();
  volume->SetEyePosition(row.EyeOffset, row.EyeHeight, 0.0);
  volume->SetExteriorIndexOfRefraction(row.Exterior);
  volume->SetInteriorIndexOfRefraction(row.Interior);
  volume->SetModelBounds(-400.0, 380.0, -800.0, -20.0, -400.0, 380.0);
  volume->SetSampleDimensions(40, 40, 40);
  if (radius > 0.0)
  {
    volume->SetExactMembrane(MakeSphere(radius));
  }
  else
  {
    vtkNew<vtkPlane> plane;
    plane->SetNormal(0.0, -2.0, 0.0); // away from the eye, of any length
    volume->SetExactMembrane(plane);
  }
  return volume;
}

std::vector<double> GetErrors(vtkRefractionErrorVolume* volume)
{
  return ValuesOf(volume->GetOutput()->GetPointData()->GetArray("RefractionError"));
}

/** Angle between two directions in degrees. */
double AngleOf(const glm::dvec3& a, const glm::dvec3& b)
{
  return 180.0 / Pi * std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

//------------------------------------------------------------------------------
// The sight point of each sample on the exact plane or sphere, by bracketed roots.
TEST(RefractionErrorVolume, AnglesAtTheEye)
{
  int compared = 0;
  for (const ThesisRow& row : GetThesisRows())
  {
    const bool chosen = std::strcmp(row.Table, "4.2") == 0 || std::strcmp(row.Table, "4.1") == 0;
    if (!chosen || row.EyeHeight != 450.0)
    {
      continue;
    }
    const double radius = row.SphereRatio * 141.5;
    const auto volume = MakeThesisVolume(row);
    volume->SetSampleDimensions(9, 8, 9);
    volume->AngularErrorsOn();
    volume->Update();
    meniscus::FlatMembraneSolver solver;
    solver.SetMembrane(MakeDisc(141.5, 5, radius).AsInput());
    const glm::dvec3 eye(row.EyeOffset, row.EyeHeight, 0.0);
    solver.SetEye(eye, row.Exterior, row.Interior);
    const AnalyticMembrane exact{ radius, row.Exterior, row.Interior };
    vtkImageData* output = volume->GetOutput();
    vtkDataArray* angles = output->GetPointData()->GetArray("AngularError");
    ASSERT_TRUE(angles);
    vtkDataArray* states = output->GetPointData()->GetArray("SampleState");
    for (vtkIdType i = 0; i < output->GetNumberOfPoints(); ++i)
    {
      const glm::dvec3 point = PointOf(output, i);
      const auto sights = exact.FindSightPoints(eye, point);
      if (states->GetTuple1(i) != vtkRefractionErrorVolume::MEASURED || sights.size() != 1)
      {
        EXPECT_TRUE(sights.size() == 1 || std::isnan(angles->GetTuple1(i)));
        continue;
      }
      ++compared;
      // Rounding of 1e-13 of a distance of about 1000, at an angle of incidence of up to 85
      // degrees.
      const double truth = AngleOf(solver.SolvePoint(point).Position - eye, sights[0] - eye);
      EXPECT_NEAR(angles->GetTuple1(i), truth, 1e-9) << row.EyeOffset << " " << radius;
    }
  }
  EXPECT_GT(compared, 800);
}

//------------------------------------------------------------------------------
// A list whose second interface changes nothing.
TEST(RefractionErrorVolume, AnglesThroughAList)
{
  const auto membrane = MakeMembrane(Waves.MakeMesh(16));
  vtkNew<WavesFunction> function;
  std::vector<double> angles[2];
  for (const bool list : { false, true })
  {
    const auto volume = MakeVolume(membrane);
    if (list)
    {
      vtkNew<vtkRefractingInterfaceCollection> interfaces;
      interfaces->AddInterface(1.0, 1.333)->SetExactSurface(function);
      interfaces->AddInterface(1.333, 1.333);
      volume->SetInterfaces(interfaces);
      volume->AddMembraneData(MakeMembrane(MakeSquare(200.0, 4, 0.0)));
    }
    else
    {
      volume->SetExactMembrane(function);
    }
    volume->AngularErrorsOn();
    volume->Update();
    vtkDataArray* array = volume->GetOutput()->GetPointData()->GetArray("AngularError");
    ASSERT_TRUE(array);
    for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i)
    {
      angles[list].push_back(array->GetTuple1(i));
    }
  }
  int compared = 0;
  double largest = 0.0;
  ASSERT_EQ(angles[0].size(), angles[1].size());
  for (std::size_t i = 0; i < angles[0].size(); ++i)
  {
    if (std::isfinite(angles[0][i]) && std::isfinite(angles[1][i]))
    {
      ++compared;
      largest = std::max(largest, angles[0][i]);
      EXPECT_NEAR(angles[0][i], angles[1][i], 1e-8);
    }
  }
  EXPECT_GT(compared, 1000);
  EXPECT_GT(largest, 1e-4); // the mesh is coarse
}

//------------------------------------------------------------------------------
TEST(RefractionErrorVolume, ColorsFollowTheLimits)
{
  const auto volume = MakeThesisVolume(GetThesisRows()[17]); // the hemisphere of Table 4.2
  volume->SetColorLimits(2.0, 5.0, 8.0);
  volume->Update();
  const std::vector<double> errors = GetErrors(volume);
  vtkDataArray* colors = volume->GetOutput()->GetPointData()->GetArray("ErrorColor");
  ASSERT_TRUE(colors);
  ASSERT_EQ(colors->GetNumberOfComponents(), 3);
  int found[5] = { 0, 0, 0, 0, 0 };
  for (std::size_t i = 0; i < errors.size(); ++i)
  {
    double rgb[3];
    colors->GetTuple(static_cast<vtkIdType>(i), rgb);
    const double e = errors[i];
    double expected[3] = { 255.0, 255.0, 255.0 };
    int band = 3;
    if (!(e >= 8.0))
    {
      band = std::isnan(e) ? 4 : (e < 2.0 ? 0 : (e < 5.0 ? 1 : 2));
      const int channel = band == 0 ? 1 : (band == 1 ? 2 : 0);
      const double limits[3] = { 2.0, 5.0, 8.0 };
      std::fill(expected, expected + 3, 0.0);
      expected[channel] = band == 4 ? 0.0 : std::floor(80.0 + 175.0 * e / limits[band]);
    }
    ++found[band];
    EXPECT_TRUE(std::equal(rgb, rgb + 3, expected)) << e;
  }
  for (const int number : found)
  {
    EXPECT_GT(number, 100);
  }
}

//------------------------------------------------------------------------------
// Rows whose mean the references measure without this class agree to rounding; the printed ones
// agree within the figures that Documentation/refraction-measurements.md states for them.
TEST(RefractionErrorVolume, ReproducesTheThesis)
{
  int rows = 0;
  for (const ThesisRow& row : GetThesisRows())
  {
    const bool bowl = std::strcmp(row.Table, "4.2") == 0 && row.SphereRatio > 0.0;
    const bool square = std::strcmp(row.Table, "4.5") == 0 && row.SphereRatio == 0.0;
    if (!bowl && !square)
    {
      continue;
    }
    ++rows;
    const auto volume = MakeThesisVolume(row);
    ExpectQuiet(volume);
    const ErrorStatistics expected = MeasureThesisRow(row);
    EXPECT_EQ(volume->GetNumberOfMeasuredSamples(), static_cast<vtkTypeInt64>(expected.Points));
    EXPECT_NEAR(volume->GetMeanError(), expected.Mean, 1e-9 * expected.Mean);
    EXPECT_NEAR(volume->GetStandardDeviation(), expected.Deviation, 1e-7 * expected.Mean);
    EXPECT_NEAR(volume->GetLargestError(), expected.Largest, 1e-9 * expected.Largest);
    EXPECT_NEAR(volume->GetMeanError(), row.Mean, 0.0025 * row.Mean) << rows;
    EXPECT_NEAR(volume->GetStandardDeviation(), row.Deviation, 0.009 * row.Deviation) << rows;
  }
  EXPECT_EQ(rows, 11);
}

//------------------------------------------------------------------------------
TEST(RefractionErrorVolume, CurvedPatchesReproduceSpheres)
{
  const ThesisRow& row = GetThesisRows()[14]; // Table 4.2, radius 355
  ASSERT_EQ(row.SphereRatio, 2.5);
  const auto volume = MakeThesisVolume(row);
  volume->SetMembraneModelToCurved();
  volume->Update();
  EXPECT_GT(volume->GetNumberOfMeasuredSamples(), 20000);
  EXPECT_LT(volume->GetMeanError(), 1e-11);
  // Its own patches are the exact surface of its facets.
  volume->SetMembraneModelToFlatFacets();
  volume->Update();
  const double mean = volume->GetMeanError();
  const vtkTypeInt64 count = volume->GetNumberOfMeasuredSamples();
  volume->SetExactMembrane(nullptr);
  volume->Update();
  // Samples at the border of the mesh have no exact image in one of the two.
  EXPECT_NEAR(
    static_cast<double>(volume->GetNumberOfMeasuredSamples()), static_cast<double>(count), 300.0);
  EXPECT_NEAR(volume->GetMeanError(), mean, 0.01 * mean);
}

//------------------------------------------------------------------------------
// A finer mesh is as good as the function, in proportion to its resolution.
TEST(RefractionErrorVolume, AFinerMeshStandsForTheSurface)
{
  const auto volume = MakeVolume(MakeMembrane(Waves.MakeMesh(24)));
  vtkNew<WavesFunction> function;
  for (const int model :
    { vtkRefractionErrorVolume::FLAT_FACETS, vtkRefractionErrorVolume::CURVED })
  {
    volume->SetMembraneModel(model);
    volume->SetExactMembrane(function);
    volume->Update();
    const auto exact = GetErrors(volume);
    const double mean = volume->GetMeanError();
    EXPECT_GT(volume->GetNumberOfMeasuredSamples(), 200);
    EXPECT_GT(mean, 1e-4);
    volume->SetExactMembrane(nullptr);
    volume->SetReferenceData(MakeMembrane(Waves.MakeMesh(192)));
    volume->Update();
    const auto fine = GetErrors(volume);
    ASSERT_EQ(fine.size(), exact.size());
    std::size_t both = 0;
    double worst = 0.0;
    for (std::size_t i = 0; i < fine.size(); ++i)
    {
      if (std::isfinite(fine[i]) && std::isfinite(exact[i]))
      {
        ++both;
        worst = std::max(worst, std::fabs(fine[i] - exact[i]));
      }
    }
    EXPECT_GT(both, 200u);
    // Third order: the error of the finer mesh is (24 / 192)^3 times that of CURVED on the coarse
    // one.
    EXPECT_LT(worst, 0.01 * volume->GetLargestError()) << model;
    EXPECT_NEAR(volume->GetMeanError(), mean, 0.01 * mean) << model;
  }
}

//------------------------------------------------------------------------------
TEST(RefractionErrorVolume, CurvedAgainstItselfIsExactAndWarnsOnce)
{
  const auto volume = MakeVolume(MakeMembrane(Waves.MakeMesh(24)));
  const auto messages = UpdateAndObserve(volume);
  EXPECT_EQ(messages->Warnings, 1) << messages->Text;
  EXPECT_GT(volume->GetNumberOfMeasuredSamples(), 200);
  EXPECT_LT(volume->GetLargestError(), 1e-8);
  volume->SetEyePosition(0.0, 250.0, 0.0);
  volume->Update();
  EXPECT_EQ(messages->Warnings, 1) << messages->Text;
}

//------------------------------------------------------------------------------
TEST(RefractionErrorVolume, EqualIndicesHaveNoError)
{
  const auto volume = MakeVolume(MakeMembrane(Waves.MakeMesh(16)));
  volume->SetExactMembrane(vtkSmartPointer<WavesFunction>::New());
  volume->SetInteriorIndexOfRefraction(1.0);
  volume->Update();
  EXPECT_GT(volume->GetNumberOfMeasuredSamples(), 200);
  EXPECT_LT(volume->GetLargestError(), 1e-11);
}

//------------------------------------------------------------------------------
TEST(RefractionErrorVolume, StatesSayWhyASampleIsNotMeasured)
{
  const HeightField strong{ HeightField::Shape::Waves, 200.0, 5.0, 0.03 * Pi, 1.0, 1.333 };
  const auto volume = MakeVolume(MakeMembrane(strong.MakeMesh(48)));
  volume->SetModelBounds(-80.0, 80.0, -400.0, 40.0, -80.0, 80.0);
  volume->SetSampleDimensions(10, 9, 10);
  const auto messages = Observe(volume); // CURVED compared with itself
  volume->Update();
  vtkImageData* output = volume->GetOutput();
  vtkDataArray* states = output->GetPointData()->GetArray("SampleState");
  ASSERT_NE(states, nullptr);
  const auto errors = GetErrors(volume);
  EXPECT_EQ(
    output->GetPointData()->GetScalars(), output->GetPointData()->GetArray("RefractionError"));
  int counts[5] = { 0, 0, 0, 0, 0 };
  int wrong = 0;
  for (vtkIdType i = 0; i < states->GetNumberOfTuples(); ++i)
  {
    const int state = static_cast<int>(states->GetTuple1(i));
    ++counts[state];
    EXPECT_EQ(std::isfinite(errors[static_cast<std::size_t>(i)]),
      state == vtkRefractionErrorVolume::MEASURED);
    const glm::dvec3 p = PointOf(output, i);
    const auto exact = strong.FindSightPoints({ 20.0, 300.0, 10.0 }, { p[0], p[1], p[2] }, 100);
    const int expected = p[1] > strong.GetHeight(p[0], p[2]) || exact.empty()
      ? vtkRefractionErrorVolume::NO_IMAGE
      : (exact.size() > 1 ? vtkRefractionErrorVolume::SEVERAL_IMAGES
                          : vtkRefractionErrorVolume::MEASURED);
    // A point in front may also have an image, seen through a crest (occlusion by the membrane is
    // not modelled).
    wrong += p[1] < -5.0 && state != expected;
  }
  EXPECT_GT(counts[vtkRefractionErrorVolume::MEASURED], 100);
  EXPECT_GT(counts[vtkRefractionErrorVolume::NO_IMAGE], 50);
  EXPECT_GT(counts[vtkRefractionErrorVolume::SEVERAL_IMAGES], 100);
  EXPECT_EQ(counts[vtkRefractionErrorVolume::MEASURED],
    static_cast<int>(volume->GetNumberOfMeasuredSamples()));
  EXPECT_LE(wrong, 3); // pairs of images that merge on a caustic
}

//------------------------------------------------------------------------------
TEST(RefractionErrorVolume, FieldDataHasTheStatistics)
{
  const auto volume = MakeThesisVolume(GetThesisRows()[13]);
  volume->SetSampleDimensions(10, 11, 12);
  volume->Update();
  vtkImageData* output = volume->GetOutput();
  int dimensions[3];
  output->GetDimensions(dimensions);
  EXPECT_EQ(dimensions[0], 10);
  EXPECT_EQ(dimensions[2], 12);
  EXPECT_EQ(output->GetBounds()[1], 380.0);
  EXPECT_EQ(output->GetBounds()[2], -800.0);
  vtkFieldData* field = output->GetFieldData();
  EXPECT_EQ(field->GetArray("MeanError")->GetTuple1(0), volume->GetMeanError());
  EXPECT_EQ(field->GetArray("StandardDeviation")->GetTuple1(0), volume->GetStandardDeviation());
  EXPECT_EQ(field->GetArray("LargestError")->GetTuple1(0), volume->GetLargestError());
  EXPECT_EQ(field->GetArray("NumberOfMeasuredSamples")->GetTuple1(0),
    static_cast<double>(volume->GetNumberOfMeasuredSamples()));
  std::ostringstream text;
  volume->Print(text);
  EXPECT_TRUE(HasText(text.str(), "FLAT_FACETS"));
  EXPECT_TRUE(HasText(text.str(), "SampleDimensions: (10, 11, 12)"));
}

TEST(RefractionErrorVolume, AnySingleSliceOrPointWillDo)
{
  const auto volume = MakeVolume(MakeFlatMembrane());
  volume->SetSampleDimensions(1, 1, 1);
  volume->SetModelBounds(5.0, 5.0, -50.0, -50.0, 3.0, 9.0);
  volume->SetMembraneModelToFlatFacets();
  volume->Update();
  EXPECT_EQ(volume->GetNumberOfMeasuredSamples(), 1);
  EXPECT_EQ(volume->GetStandardDeviation(), 0.0);
  const glm::dvec3 p = PointOf(volume->GetOutput(), 0);
  EXPECT_EQ(p[1], -50.0);
  EXPECT_EQ(p[2], 3.0);
}

//------------------------------------------------------------------------------
TEST(RefractionErrorVolume, APartOfTheVolumeHasThatPartsValues)
{
  const auto volume = MakeVolume(MakeMembrane(Waves.MakeMesh(16)));
  volume->SetMembraneModelToFlatFacets();
  volume->Update();
  const auto whole = GetErrors(volume);
  const auto another = MakeVolume(MakeMembrane(Waves.MakeMesh(16)));
  another->SetMembraneModelToFlatFacets();
  int extent[6] = { 3, 7, 2, 5, 4, 11 };
  another->UpdateExtent(extent);
  const auto part = GetErrors(another);
  ASSERT_EQ(part.size(), 5u * 4u * 8u);
  std::size_t i = 0;
  for (int z = extent[4]; z <= extent[5]; ++z)
  {
    for (int y = extent[2]; y <= extent[3]; ++y)
    {
      for (int x = extent[0]; x <= extent[1]; ++x, ++i)
      {
        const auto at = static_cast<std::size_t>(x + 12 * (y + 12 * z));
        EXPECT_TRUE(part[i] == whole[at] || (std::isnan(part[i]) && std::isnan(whole[at])));
      }
    }
  }
}

//------------------------------------------------------------------------------
TEST(RefractionErrorVolume, DoesNotDependOnTheNumberOfThreads)
{
  ExpectSameOnThreads(
    []
    {
      const auto volume = MakeVolume(MakeMembrane(Waves.MakeMesh(24)));
      volume->SetSampleDimensions(30, 30, 30);
      volume->SetExactMembrane(vtkSmartPointer<WavesFunction>::New());
      volume->Update();
      std::vector<double> values = GetErrors(volume);
      values.push_back(volume->GetMeanError());
      return values;
    });
}

TEST(RefractionErrorVolume, KeepsWhatDidNotChange)
{
  const auto membrane = MakeMembrane(Waves.MakeMesh(16));
  const auto volume = MakeVolume(membrane);
  vtkNew<WavesFunction> function;
  volume->SetExactMembrane(function);
  volume->Update();
  volume->SetSampleDimensions(5, 5, 5);
  volume->Update();
  membrane->Modified();
  volume->Update();
  EXPECT_EQ(volume->GetNumberOfPatchBuilds(), 1);
  EXPECT_EQ(volume->GetNumberOfEyeUpdates(), 1);
  volume->SetEyePosition(0.0, 200.0, 0.0);
  volume->Update();
  EXPECT_EQ(volume->GetNumberOfPatchBuilds(), 1);
  EXPECT_EQ(volume->GetNumberOfEyeUpdates(), 2);
  const vtkMTimeType before = volume->GetMTime();
  function->Modified();
  EXPECT_GT(volume->GetMTime(), before);
}

//------------------------------------------------------------------------------
TEST(RefractionErrorVolume, ReportsProgressAndCanBeAborted)
{
  const auto volume = MakeVolume(MakeFlatMembrane());
  volume->SetMembraneModelToFlatFacets();
  volume->SetSampleDimensions(60, 60, 60);
  vtkNew<ProgressWatch> aborting;
  aborting->Aborts = true;
  const auto observer = volume->AddObserver(vtkCommand::ProgressEvent, aborting);
  volume->Update();
  EXPECT_LT(aborting->Calls, 5);
  EXPECT_EQ(volume->GetOutput()->GetNumberOfPoints(), 0);
  EXPECT_EQ(volume->GetNumberOfMeasuredSamples(), 0);
  volume->RemoveObserver(observer);
  vtkNew<ProgressWatch> watch;
  volume->AddObserver(vtkCommand::ProgressEvent, watch);
  volume->SetAbortExecute(0);
  volume->Modified();
  volume->Update();
  EXPECT_GT(volume->GetNumberOfMeasuredSamples(), 1000);
  EXPECT_GE(watch->Calls, 20);
  EXPECT_FALSE(watch->Falls);
  EXPECT_EQ(watch->Last, 1.0);
}

//------------------------------------------------------------------------------
class RefractionErrorVolumeBadInput : public ::testing::Test
{
protected:
  /** Expects one error, an empty output, no statistics, and recovery. */
  void ExpectErrorAndRecovery(const std::function<void(vtkRefractionErrorVolume*)>& spoil,
    const std::function<void(vtkRefractionErrorVolume*)>& mend)
  {
    const auto volume = MakeVolume(MakeFlatMembrane());
    volume->SetMembraneModelToFlatFacets();
    volume->Update();
    const vtkTypeInt64 measured = volume->GetNumberOfMeasuredSamples();
    EXPECT_GT(measured, 0);
    const auto messages = Observe(volume);
    spoil(volume);
    volume->Update();
    EXPECT_GE(messages->Errors, 1);
    EXPECT_FALSE(messages->Text.empty());
    EXPECT_EQ(volume->GetOutput()->GetNumberOfPoints(), 0);
    mend(volume);
    volume->Update();
    EXPECT_EQ(volume->GetNumberOfMeasuredSamples(), measured);
  }
};

TEST_F(RefractionErrorVolumeBadInput, Boxes)
{
  const auto mend = [](vtkRefractionErrorVolume* v)
  {
    v->SetModelBounds(-80.0, 80.0, -150.0, -10.0, -80.0, 80.0);
    v->SetSampleDimensions(12, 12, 12);
  };
  this->ExpectErrorAndRecovery(
    [](vtkRefractionErrorVolume* v) { v->SetModelBounds(1.0, -1.0, 0.0, 1.0, 0.0, 1.0); }, mend);
  this->ExpectErrorAndRecovery(
    [](vtkRefractionErrorVolume* v) { v->SetModelBounds(0.0, NaN, 0.0, 1.0, 0.0, 1.0); }, mend);
  this->ExpectErrorAndRecovery(
    [](vtkRefractionErrorVolume* v) { v->SetSampleDimensions(12, 0, 12); }, mend);
  this->ExpectErrorAndRecovery(
    [](vtkRefractionErrorVolume* v) { v->SetSampleDimensions(-3, 12, 12); }, mend);
}

TEST_F(RefractionErrorVolumeBadInput, ColorLimits)
{
  const auto mend = [](vtkRefractionErrorVolume* v) { v->SetColorLimits(1.0, 10.0, 100.0); };
  this->ExpectErrorAndRecovery(
    [](vtkRefractionErrorVolume* v) { v->SetColorLimits(10.0, 1.0, 100.0); }, mend);
  this->ExpectErrorAndRecovery(
    [](vtkRefractionErrorVolume* v) { v->SetColorLimits(0.0, 1.0, 100.0); }, mend);
  this->ExpectErrorAndRecovery(
    [](vtkRefractionErrorVolume* v) { v->SetColorLimits(1.0, NaN, 100.0); }, mend);
}

TEST_F(RefractionErrorVolumeBadInput, EyesAndIndices)
{
  const auto mend = [](vtkRefractionErrorVolume* v)
  {
    v->SetEyePosition(20.0, 300.0, 10.0);
    v->SetExteriorIndexOfRefraction(1.0);
  };
  this->ExpectErrorAndRecovery(
    [](vtkRefractionErrorVolume* v) { v->SetEyePosition(12.5, 0.0, 0.0); }, mend);
  this->ExpectErrorAndRecovery(
    [](vtkRefractionErrorVolume* v) { v->SetEyePosition(0.0, NaN, 0.0); }, mend);
  this->ExpectErrorAndRecovery(
    [](vtkRefractionErrorVolume* v) { v->SetExteriorIndexOfRefraction(-1.0); }, mend);
}

TEST_F(RefractionErrorVolumeBadInput, Membranes)
{
  const auto mend = [](vtkRefractionErrorVolume* v)
  {
    v->SetInputData(0, MakeFlatMembrane());
    v->SetInputConnection(1, nullptr);
  };
  this->ExpectErrorAndRecovery([](vtkRefractionErrorVolume* v)
    { v->SetInputData(0, vtkSmartPointer<vtkPolyData>::New()); },
    mend);
  this->ExpectErrorAndRecovery([](vtkRefractionErrorVolume* v)
    { v->SetReferenceData(vtkSmartPointer<vtkPolyData>::New()); },
    mend);
}

TEST(RefractionErrorVolume, NoMembraneAtAll)
{
  vtkNew<vtkRefractionErrorVolume> volume;
  const auto messages = UpdateAndObserve(volume);
  EXPECT_GE(messages->Errors, 1);
  EXPECT_EQ(volume->GetOutput()->GetNumberOfPoints(), 0);
  volume->SetInputData(0, vtkSmartPointer<vtkImageData>::New());
  volume->Update();
  EXPECT_GE(messages->Errors, 2);
  EXPECT_EQ(volume->GetOutput()->GetNumberOfPoints(), 0);
}

// A function that is unrelated to the membrane, or whose values are invalid.
TEST(RefractionErrorVolume, FunctionsThatAreNoSurface)
{
  const auto volume = MakeVolume(MakeFlatMembrane());
  vtkNew<vtkPlane> nowhere;
  nowhere->SetNormal(0.0, 0.0, 0.0);
  volume->SetExactMembrane(nowhere);
  volume->Update();
  EXPECT_EQ(volume->GetNumberOfMeasuredSamples(), 0);
  vtkDataArray* states = volume->GetOutput()->GetPointData()->GetArray("SampleState");
  for (vtkIdType i = 0; i < states->GetNumberOfTuples(); ++i)
  {
    EXPECT_TRUE(states->GetTuple1(i) == vtkRefractionErrorVolume::NO_EXACT_POINT ||
      states->GetTuple1(i) == vtkRefractionErrorVolume::NO_IMAGE);
  }
  volume->SetExactMembrane(MakeSphere(1e-3));
  volume->Update();
  EXPECT_EQ(volume->GetOutput()->GetNumberOfPoints(), 12 * 12 * 12);
}

}
