// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Input that cannot be used: an error that says why, and an empty output.
#include "IntegralScene.h"
#include "MembraneScene.h"

using namespace meniscus::test;

namespace
{

const double NaN = std::numeric_limits<double>::quiet_NaN();

Grid MakeMesh()
{
  return MakeBlock(2, LinearField(0.2, 0.3, 0.5));
}

Filter MakeGood()
{
  Filter rays = MakeFilter(MakeMesh(), 16, 16, { "Integral" });
  return rays;
}

}

//------------------------------------------------------------------------------
TEST(RayIntegralBadInput, Mesh)
{
  Filter rays = MakeGood();
  vtkNew<vtkUnstructuredGrid> empty;
  rays->SetInputData(empty);
  ExpectError(rays, "no cells");
  Grid flat = MakeGrid({ 0, 0, 0, 1, 0, 0, 0, 1, 0 }, { 0, 1, 2, 2 }, ConstantField(1.0));
  rays->SetInputData(flat);
  ExpectError(rays, "no cells that can be used");
  // The filter goes on with a good mesh.
  rays->SetInputData(MakeMesh());
  EXPECT_EQ(ValuesOf(rays, "Integral").size(), 256u);
}

//------------------------------------------------------------------------------
TEST(RayIntegralBadInput, Arrays)
{
  Filter rays = MakeGood();
  rays->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "missing");
  ExpectError(rays, "no scalar array named 'missing'");
  Grid grid = MakeMesh();
  grid->GetPointData()->SetScalars(nullptr);
  grid->GetPointData()->Initialize();
  rays = MakeGood();
  rays->SetInputData(grid);
  ExpectError(rays, "no active scalars and no arrays of points or cells");
  grid->GetPointData()->AddArray(MakeArray("short", grid->GetNumberOfPoints() - 1, 1.0));
  rays->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "short");
  ExpectError(rays, "values for");
  grid->GetCellData()->AddArray(MakeArray("few", 3, 1.0));
  rays->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "few");
  ExpectError(rays, "has 3 values for 48 cells");
  grid->GetPointData()->AddArray(MakeArray("pair", grid->GetNumberOfPoints(), glm::dvec2(1.0)));
  rays->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "pair");
  rays->SetArrayComponent(2);
  ExpectError(rays, "none of number 2");
}

//------------------------------------------------------------------------------
// The message names the arrays that can be chosen.
TEST(RayIntegralBadInput, NoActiveScalars)
{
  Grid grid = MakeMesh();
  grid->GetPointData()->SetActiveScalars(nullptr);
  grid->GetPointData()->AddArray(MakeArray("heat", grid->GetNumberOfPoints(), 1.0));
  grid->GetCellData()->AddArray(MakeArray("flux", grid->GetNumberOfCells(), glm::dvec3(1.0)));
  grid->GetPointData()->SetActiveAttribute(-1, vtkDataSetAttributes::SCALARS);
  grid->GetCellData()->SetActiveAttribute(-1, vtkDataSetAttributes::SCALARS);
  Filter rays = MakeGood();
  rays->SetInputData(grid);
  const std::string there =
    std::string("there are point arrays '") + ScalarName + "', 'heat' and cell arrays 'flux'";
  ExpectError(rays, "The input has no active scalars; " + there);
  rays->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "flux");
  ExpectError(rays, "no scalar array named 'flux' in its point data; " + there);
}

//------------------------------------------------------------------------------
// Lengths need no scalars: all cells count if none are active, but a named array must exist.
TEST(RayIntegralBadInput, LengthsWithoutArrays)
{
  Grid grid = MakeMesh();
  grid->GetPointData()->Initialize();
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, vtkSmartPointer<vtkPolyData>::New());
  blocks->SetBlock(1, grid);
  for (vtkDataObject* input :
    { static_cast<vtkDataObject*>(grid), static_cast<vtkDataObject*>(blocks.Get()) })
  {
    Filter rays = MakeFilter(input, 8, 8, { "PathLength", "FirstDepth", "LastDepth" });
    const auto observer = ObserveErrors(rays);
    rays->Update();
    EXPECT_TRUE(observer->GetText().empty()) << observer->GetText();
    const std::vector<double> lengths = ValuesOf(rays, "PathLength");
    const std::vector<double> first = ValuesOf(rays, "FirstDepth");
    const std::vector<double> last = ValuesOf(rays, "LastDepth");
    ASSERT_EQ(lengths.size(), 64u);
    for (std::size_t i = 0; i < lengths.size(); ++i)
    {
      EXPECT_NEAR(lengths[i], 2.0, 1.0e-6);
      EXPECT_NEAR(last[i] - first[i], 2.0, 1.0e-6);
    }
    rays->GetArraySelection()->EnableArray("Integral");
    ExpectError(rays, "no active scalars");
    rays->GetArraySelection()->DisableArray("Integral");
    rays->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "missing");
    ExpectError(rays, "no scalar array named 'missing'");
  }
}

//------------------------------------------------------------------------------
TEST(RayIntegralBadInput, Rectangle)
{
  Filter rays = MakeGood();
  rays->SetFrameModeToParallel();
  rays->SetFrameAxis2(2.0, 0.0, 0.0);
  ExpectError(rays, "no area");
  rays->SetFrameAxis2(0.0, 0.0, 0.0);
  ExpectError(rays, "no area");
  rays->SetFrameAxis2(0.0, NaN, 0.0);
  ExpectError(rays, "not finite");
  rays->SetFrameAxis2(0.0, 1.0, 0.0);
  rays->SetFrameOrigin(0.0, 0.0, NaN);
  ExpectError(rays, "not finite");
  rays->SetFrameOrigin(0.0, 0.0, 0.0);
  rays->SetFrameAxis2(0.1, 1.0, 0.0);
  ExpectError(rays, "not perpendicular");
  rays->SetFrameAxis1(1.0e200, 0.0, 0.0);
  rays->SetFrameAxis2(0.0, 1.0e200, 0.0);
  ExpectError(rays, "area");
  rays->SetFrameModeToFitted();
  rays->SetViewUp(0.0, 0.0, 3.0);
  ExpectError(rays, "parallel, zero or not finite");
  rays->SetViewUp(0.0, 1.0, 0.0);
  rays->SetDirection(0.0, 0.0, 0.0);
  ExpectError(rays, "parallel, zero or not finite");
  rays->SetDirection(NaN, 0.0, 1.0);
  ExpectError(rays, "parallel, zero or not finite");
}

//------------------------------------------------------------------------------
TEST(RayIntegralBadInput, Camera)
{
  Filter rays = MakeGood();
  rays->SetFrameModeToCamera();
  ExpectError(rays, "no camera");
  vtkNew<vtkCamera> camera;
  camera->SetPosition(0.0, NaN, 4.0);
  rays->SetCamera(camera);
  ExpectError(rays, "singular or not finite");
}

//------------------------------------------------------------------------------
// The size is checked before anything is allocated: the image has 4 EB.
TEST(RayIntegralBadInput, Size)
{
  Filter rays = MakeGood();
  rays->SetImageSize(0, 16);
  ExpectError(rays, "at least 1 by 1");
  rays->SetImageSize(16, -3);
  ExpectError(rays, "at least 1 by 1");
  rays->SetImageSize(1 << 30, 1 << 30);
  ExpectError(rays, "memory");
}

//------------------------------------------------------------------------------
TEST(RayIntegralBadInput, Choice)
{
  Filter rays = MakeGood();
  rays->GetArraySelection()->DisableArray("Integral");
  ExpectError(rays, "No array is switched on");
  rays->GetArraySelection()->EnableArray("RGBA");
  ExpectError(rays, "need a volume property");
  rays->GetArraySelection()->DisableArray("RGBA");
  rays->GetArraySelection()->EnableArray("EnergyBins");
  ExpectError(rays, "no energy bins");
  rays->SetBinEmission(0, NaN);
  ExpectError(rays, "not finite");
  rays->SetBinEmission(-1, 1.0);
  EXPECT_EQ(rays->GetNumberOfEnergyBins(), 1);
  EXPECT_EQ(rays->GetBinEmission(7), 0.0);
}

//------------------------------------------------------------------------------
TEST(RayIntegralBadInput, EnergyBins)
{
  Grid grid = MakeMesh();
  const vtkIdType points = grid->GetNumberOfPoints();
  grid->GetPointData()->AddArray(MakeArray("mu", points, glm::dvec3(0.5)));
  grid->GetPointData()->AddArray(MakeArray("light", points, glm::dvec2(0.5)));
  grid->GetCellData()->AddArray(MakeArray("cells", grid->GetNumberOfCells(), glm::dvec3(0.5)));
  grid->GetPointData()->AddArray(MakeArray("negative", points, -0.5));
  grid->GetPointData()->AddArray(MakeArray("short", points - 2, 0.5));
  Filter rays = MakeGood();
  rays->SetInputData(grid);
  rays->GetArraySelection()->DisableArray("Integral");
  rays->GetArraySelection()->EnableArray("EnergyBins");
  rays->SetAttenuationArrayName("missing");
  ExpectError(rays, "no scalar array named 'missing'");
  rays->SetAttenuationArrayName("short");
  ExpectError(rays, "values for");
  rays->SetAttenuationArrayName("negative");
  ExpectError(rays, "negative");
  rays->SetAttenuationArrayName("mu");
  rays->SetEmissionArrayName("missing");
  ExpectError(rays, "no scalar array named 'missing'");
  rays->SetEmissionArrayName("light");
  ExpectError(rays, "as many components");
  rays->SetEmissionArrayName("cells");
  ExpectError(rays, "both of points or both of cells");
  rays->SetEmissionArrayName(nullptr);
  rays->SetNumberOfEnergyBins(2);
  ExpectError(rays, "has 3 components for 2 energy bins");
  rays->SetNumberOfEnergyBins(3);
  EXPECT_EQ(ValuesOf(rays, "EnergyBins").size(), 3u * 256u);
}

//------------------------------------------------------------------------------
TEST(RayIntegralBadInput, Interfaces)
{
  Filter rays = MakeGood();
  rays->SetMembraneData(MakePlaneCase(0.0, 3.0, 2).Mesh);
  rays->SetInteriorIndexOfRefraction(-1.0);
  ExpectError(rays, "positive and finite");
  rays->SetInteriorIndexOfRefraction(1.333);
  rays->AddMembraneData(MakePlaneCase(-1.0, 3.0, 2).Mesh);
  ExpectError(rays, "one for each is needed");
  vtkNew<vtkPolyData> nothing;
  rays->SetMembraneData(nothing);
  const auto observer = ObserveErrors(rays);
  const auto executive = ObserveErrors(rays->GetExecutive());
  rays->Update();
  EXPECT_EQ(observer->Errors.size(), 1u);
  EXPECT_EQ(rays->GetOutput()->GetNumberOfPoints(), 0);
}

//------------------------------------------------------------------------------
// A fill value that is 1e30 times as far away as the function's changes are wide.
TEST(RayIntegralBadInput, ScalarsBeyondThePropertysReach)
{
  Grid grid = MakeMesh();
  grid->GetPointData()->GetScalars()->SetTuple1(0, 1.0e30);
  vtkNew<vtkVolumeProperty> property;
  property->GetScalarOpacity()->AddPoint(0.1, 0.0);
  property->GetScalarOpacity()->AddPoint(0.2, 1.0);
  Filter rays = MakeGood();
  rays->SetInputData(grid);
  rays->SetVolumeProperty(property);
  rays->GetArraySelection()->EnableArray("OpticalDepth");
  ExpectError(rays, "reach too far");
  rays->GetArraySelection()->DisableArray("Integral");
  EXPECT_EQ(ValuesOf(rays, "OpticalDepth").size(), 256u);
}
