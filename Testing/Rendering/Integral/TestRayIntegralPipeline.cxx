// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Work only where an input changes, threads, progress, abort, and the place of the output.
#include "IntegralScene.h"
#include "MembraneScene.h"

#include <vtkMatrix3x3.h>

using namespace meniscus::test;

namespace
{

const char* const Names[] = { "Integral", "PathLength", "OpticalDepth", "FirstDepth", "LastDepth",
  "Minimum", "MinimumDepth", "Maximum", "MaximumDepth", "RGBA", "EnergyBins" };

vtkSmartPointer<vtkVolumeProperty> MakeRamp()
{
  auto property = vtkSmartPointer<vtkVolumeProperty>::New();
  property->SetScalarOpacity(MakeOpacity({ { -1.0, 0.0 }, { 1.0, 0.6 } }));
  property->SetColor(MakeColors({ { -1.0, 0.1, 0.3, 0.9 }, { 1.0, 0.9, 0.6, 0.2 } }));
  return property;
}

Filter MakeWithEverything(vtkUnstructuredGrid* grid)
{
  Filter rays = MakeFilter(grid, 130, 110);
  rays->SetDirection(0.3, -0.4, -1.0);
  Enable(rays,
    { "Integral", "PathLength", "OpticalDepth", "FirstDepth", "LastDepth", "Minimum",
      "MinimumDepth", "Maximum", "MaximumDepth", "RGBA", "EnergyBins" });
  rays->SetNumberOfEnergyBins(2);
  rays->SetVolumeProperty(MakeRamp());
  return rays;
}

Grid MakeMesh()
{
  Grid grid = MakeBlock(10, WavyField(2.0), Torus(0.6, 0.3));
  Jitter(grid, 0.02, 3);
  return grid;
}

}

//------------------------------------------------------------------------------
TEST(RayIntegralPipeline, OnlyWhatIsAskedFor)
{
  Filter rays = MakeFilter(MakeMesh(), 20, 10, { "PathLength" });
  rays->Update();
  vtkPointData* points = rays->GetOutput()->GetPointData();
  EXPECT_EQ(points->GetNumberOfArrays(), 1);
  ASSERT_NE(points->GetArray("PathLength"), nullptr);
  EXPECT_EQ(points->GetScalars(), points->GetArray("PathLength"));
  EXPECT_EQ(points->GetArray("PathLength")->GetDataType(), VTK_FLOAT);
  rays = MakeWithEverything(MakeMesh());
  rays->Update();
  points = rays->GetOutput()->GetPointData();
  EXPECT_EQ(points->GetNumberOfArrays(), 11);
  for (const char* name : Names)
  {
    ASSERT_NE(points->GetArray(name), nullptr) << name;
    EXPECT_EQ(points->GetArray(name)->GetNumberOfTuples(), 130 * 110) << name;
  }
}

//------------------------------------------------------------------------------
TEST(RayIntegralPipeline, AnotherFrameKeepsTheMesh)
{
  Grid grid = MakeMesh();
  Filter rays = MakeWithEverything(grid);
  rays->Update();
  const auto expect = [&rays](int meshes, int scalars, int actives, int functions, int casts)
  {
    EXPECT_EQ(rays->GetStatistic("NumberOfMeshBuilds"), meshes);
    EXPECT_EQ(rays->GetStatistic("NumberOfScalarUpdates"), scalars);
    EXPECT_EQ(rays->GetStatistic("NumberOfActiveSetBuilds"), actives);
    EXPECT_EQ(rays->GetStatistic("NumberOfTransferFunctionBuilds"), functions);
    EXPECT_EQ(rays->GetStatistic("NumberOfCasts"), casts);
  };
  expect(1, 1, 1, 1, 2);
  rays->Update();
  expect(1, 1, 1, 1, 2);
  rays->SetDirection(1.0, 0.2, 0.1);
  rays->Update();
  expect(1, 1, 1, 1, 4);
  vtkNew<vtkCamera> camera;
  camera->SetPosition(0.0, 0.0, 4.0);
  rays->SetCamera(camera);
  rays->SetImageSize(30, 40);
  rays->Update();
  expect(1, 1, 1, 1, 6);
  camera->Azimuth(20.0);
  rays->Update();
  expect(1, 1, 1, 1, 8);
  rays->GetArraySelection()->DisableArray("RGBA");
  rays->Update();
  expect(1, 1, 1, 1, 9);
  rays->GetVolumeProperty()->GetScalarOpacity()->AddPoint(0.0, 0.9);
  rays->Update();
  expect(1, 1, 1, 2, 10);
  vtkDataArray* scalars = grid->GetPointData()->GetScalars();
  scalars->SetTuple1(0, scalars->GetTuple1(0) + 0.25);
  scalars->Modified();
  grid->Modified();
  rays->Update();
  expect(1, 2, 2, 2, 11);
  const glm::dvec3 p = PointOf(grid, 0);
  grid->GetPoints()->SetPoint(0, p[0] + 0.01, p[1], p[2]);
  grid->GetPoints()->Modified();
  grid->Modified();
  rays->Update();
  expect(1, 2, 2, 2, 12);
  EXPECT_EQ(rays->GetStatistic("NumberOfPointUpdates"), 1);
}

//------------------------------------------------------------------------------
TEST(RayIntegralPipeline, ThreadsDoNotMatter)
{
  const Grid grid = MakeMesh();
  ExpectSameOnThreads(
    [&grid]
    {
      const Filter rays = MakeWithEverything(grid);
      rays->Update();
      return ValuesOf(rays->GetOutput()->GetPointData());
    });
}

//------------------------------------------------------------------------------
TEST(RayIntegralPipeline, ProgressAndAbort)
{
  struct Watch
  {
    int Reports = 0;
    double Last = 0.0;
    bool Falls = false;
    double AbortAt = 2.0;
  } watch;
  vtkNew<vtkCallbackCommand> command;
  command->SetClientData(&watch);
  command->SetCallback(
    [](vtkObject* caller, unsigned long, void* data, void* progress)
    {
      auto* seen = static_cast<Watch*>(data);
      const double now = *static_cast<double*>(progress);
      ++seen->Reports;
      seen->Falls = seen->Falls || now < seen->Last;
      seen->Last = now;
      if (now >= seen->AbortAt)
      {
        vtkTetrahedraRayIntegral::SafeDownCast(caller)->AbortExecuteOn();
      }
    });
  Filter rays = MakeFilter(MakeMesh(), 900, 900, { "Integral" });
  rays->AddObserver(vtkCommand::ProgressEvent, command);
  // While the mesh is built, and while rays are cast.
  for (const double abortAt : { 0.1, 0.6 })
  {
    watch = Watch();
    watch.AbortAt = abortAt;
    rays->AbortExecuteOff(); // since VTK 9.3 the flag stays
    rays->Modified();
    rays->Update();
    EXPECT_EQ(rays->GetOutput()->GetNumberOfPoints(), 0) << abortAt;
  }
  watch = Watch();
  rays->AbortExecuteOff();
  rays->Modified();
  rays->Update();
  EXPECT_EQ(rays->GetOutput()->GetNumberOfPoints(), 900 * 900);
  EXPECT_GT(watch.Reports, 5);
  EXPECT_FALSE(watch.Falls);
  EXPECT_EQ(watch.Last, 1.0);
}

//------------------------------------------------------------------------------
// A point of the output is the point of the rectangle through which its ray goes.
TEST(RayIntegralPipeline, OutputLiesInTheRectangle)
{
  Filter rays = MakeFilter(MakeMesh(), 30, 20);
  SetRectangle(rays, { 0.3, 0.4, -0.7 }, 1.5);
  rays->GetArraySelection()->EnableArray("Integral");
  rays->Update();
  vtkImageData* image = rays->GetOutput();
  for (const auto& pixel : { std::pair<int, int>{ 0, 0 }, { 29, 0 }, { 3, 19 } })
  {
    double p[3];
    image->TransformIndexToPhysicalPoint(pixel.first, pixel.second, 0, p);
    const WorldRay ray = RayOf(rays, pixel.first, pixel.second);
    EXPECT_LT(glm::length(glm::dvec3(p[0], p[1], p[2]) - ray.Origin), 1.0e-12);
  }
}

//------------------------------------------------------------------------------
// Around the box: the image holds the whole mesh, pixels are square, the middle is in the middle.
TEST(RayIntegralPipeline, FittedRectangle)
{
  Grid grid = MakeBlock(3, ConstantField(1.0));
  Filter rays = MakeFilter(grid, 100, 50);
  rays->SetDirection(0.0, 0.0, -2.0);
  rays->SetViewUp(0.0, 3.0, 1.0);
  Enable(rays, { "PathLength", "FirstDepth" });
  const std::vector<double> lengths = ValuesOf(rays, "PathLength");
  const std::vector<double> depths = ValuesOf(rays, "FirstDepth");
  const double* spacing = rays->GetOutput()->GetSpacing();
  EXPECT_DOUBLE_EQ(spacing[0], 0.04);
  EXPECT_DOUBLE_EQ(spacing[1], 0.04);
  for (std::size_t i = 0; i < lengths.size(); ++i)
  {
    const bool met = i % 100 >= 25 && i % 100 < 75;
    EXPECT_NEAR(lengths[i], met ? 2.0 : 0.0, 1.0e-6) << i;
    EXPECT_EQ(std::isnan(depths[i]), !met) << i;
    EXPECT_TRUE(!met || std::abs(depths[i]) < 1.0e-6) << i;
  }
}

//------------------------------------------------------------------------------
// The rule of the mapper: cells with a scalar that is not finite are transparent.
TEST(RayIntegralPipeline, ValuesThatAreNotFinite)
{
  Grid grid = MakeBlock(1, ConstantField(2.0));
  grid->GetPointData()->GetScalars()->SetTuple1(1, std::numeric_limits<double>::quiet_NaN());
  Filter rays = MakeFilter(grid, 40, 40);
  rays->SetDirection(0.3, 0.2, -1.0);
  Enable(rays, { "PathLength", "Integral" });
  const std::vector<double> lengths = ValuesOf(rays, "PathLength");
  const std::vector<double> integrals = ValuesOf(rays, "Integral");
  EXPECT_GT(rays->GetStatistic("NumberOfTransparentCells"), 0);
  EXPECT_LT(rays->GetStatistic("NumberOfTransparentCells"), grid->GetNumberOfCells());
  double most = 0.0;
  for (std::size_t i = 0; i < lengths.size(); ++i)
  {
    EXPECT_NEAR(integrals[i], 2.0 * lengths[i], 4.0e-6);
    most = std::max(most, lengths[i]);
  }
  EXPECT_GT(most, 0.5);
  for (vtkIdType i = 0; i < grid->GetNumberOfPoints(); ++i)
  {
    grid->GetPointData()->GetScalars()->SetTuple1(i, HUGE_VAL);
  }
  grid->GetPointData()->GetScalars()->Modified();
  grid->Modified();
  for (const double length : ValuesOf(rays, "PathLength"))
  {
    ASSERT_EQ(length, 0.0);
  }
  EXPECT_EQ(rays->GetStatistic("NumberOfTransparentCells"), grid->GetNumberOfCells());
}

//------------------------------------------------------------------------------
// A value of an attenuation array that is not finite lets its cell pass without effect.
TEST(RayIntegralPipeline, AttenuationThatIsNotFinite)
{
  Grid grid = MakeBlock(1, ConstantField(2.0));
  for (const char* name : { "all", "some" })
  {
    const auto mu = MakeArray(name, grid->GetNumberOfCells(), 0.5);
    if (name[0] == 's')
    {
      mu->SetTuple1(0, std::numeric_limits<double>::quiet_NaN());
      mu->SetTuple1(1, 1.0e300);
    }
    grid->GetCellData()->AddArray(mu);
  }
  Filter rays = MakeFilter(grid, 40, 40);
  rays->SetDirection(0.3, 0.2, -1.0);
  rays->GetArraySelection()->EnableArray("EnergyBins");
  rays->SetAttenuationArrayName("all");
  const std::vector<double> all = ValuesOf(rays, "EnergyBins");
  rays->SetAttenuationArrayName("some");
  const std::vector<double> some = ValuesOf(rays, "EnergyBins");
  int lighter = 0;
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    ASSERT_GE(some[i], all[i]);
    ASSERT_LE(some[i], 1.0);
    lighter += some[i] > all[i] + 0.01;
  }
  EXPECT_GT(lighter, 40);
  EXPECT_EQ(rays->GetStatistic("NumberOfMeshBuilds"), 1);
  EXPECT_EQ(rays->GetStatistic("NumberOfBinUpdates"), 2);
}

//------------------------------------------------------------------------------
TEST(RayIntegralPipeline, Components)
{
  Grid grid = MakeBlock(2, ConstantField(1.0));
  vtkNew<vtkDoubleArray> vectors;
  vectors->SetName("velocity");
  vectors->SetNumberOfComponents(2);
  vectors->SetNumberOfTuples(grid->GetNumberOfPoints());
  vectors->FillComponent(0, 3.0);
  vectors->FillComponent(1, -4.0);
  grid->GetPointData()->AddArray(vectors);
  Filter rays = MakeFilter(grid, 8, 8);
  rays->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "velocity");
  Enable(rays, { "Maximum", "MaximumDepth" });
  for (const auto& expected : { std::pair<int, double>{ 0, 3.0 }, { 1, -4.0 }, { -1, 5.0 } })
  {
    rays->SetArrayComponent(expected.first);
    for (const double value : ValuesOf(rays, "Maximum"))
    {
      ASSERT_NEAR(value, expected.second, 5.0e-6);
    }
  }
}
