// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Invalid input: an error or a counted skip, and the image of the scene without the volume (or
// without the cells that were left out). Never a crash.
#include "HardMeshes.h"
#include "RayCastScene.h"
#include "SceneParts.h"

#include <vtkLongLongArray.h>

using namespace meniscus::test;

namespace
{

constexpr int Size = 100;
constexpr double Bounds[6] = { -1.0, 1.0, -1.0, 1.0, -1.0, 1.0 };
constexpr double Range[2] = { -1.5, 1.5 };

vtkSmartPointer<vtkVolumeProperty> Smooth()
{
  return MakeProperty(FunctionKind::Smooth, Range, 3.5);
}

// Two frames of a scene with an opaque cube, and the errors that they caused.
struct Outcome
{
  bool PictureIsTheCube;
  vtkSmartPointer<ErrorObserver> Errors;
};

Outcome Render(RayCastScene& scene)
{
  vtkNew<vtkCubeSource> cube;
  scene.GetRenderer()->AddActor(MakeActor(cube->GetOutputPort()));
  scene.GetRenderer()->SetBackground(0.2, 0.3, 0.4);
  LookAt(scene.GetRenderer(), Bounds, 30.0, 20.0);

  scene.GetVolume()->SetVisibility(false);
  const ByteImage without = scene.RenderBytes();
  scene.GetVolume()->SetVisibility(true);
  Outcome outcome;
  outcome.Errors = vtkSmartPointer<ErrorObserver>::Take(ErrorObserver::New());
  outcome.Errors->Observe(scene.GetRayCaster());
  outcome.Errors->Observe(scene.GetRayCaster()->GetExecutive());
  const ByteImage first = scene.RenderBytes();
  const ByteImage second = scene.RenderBytes();
  outcome.PictureIsTheCube = first.Rgb == without.Rgb && second.Rgb == without.Rgb;
  return outcome;
}

void ExpectError(RayCastScene& scene, const std::vector<std::string>& words)
{
  const Outcome outcome = Render(scene);
  EXPECT_TRUE(outcome.PictureIsTheCube);
  EXPECT_FALSE(outcome.Errors->Errors.empty());
  for (const std::string& word : words)
  {
    EXPECT_TRUE(HasText(outcome.Errors->GetText(), word)) << "no \"" << word << "\" in: ";
  }
}

// Expects the rejected cells to be counted and the rest of the image to be right.
void ExpectRest(const Grid& grid, vtkTypeInt64 rejected, const std::string& what)
{
  RayCastScene scene(grid, Smooth(), Size, Size);
  LookAt(scene.GetRenderer(), Bounds, 30.0, 20.0);
  ExpectMatchesReference(scene, what);
  EXPECT_EQ(scene.GetRayCaster()->GetNumberOfRejectedCells(), rejected) << what;
}

vtkIdType MiddlePoint(const Grid& grid)
{
  double middle[3] = { 0.0, 0.0, 0.0 };
  return grid->FindPoint(middle);
}

vtkIdType CellsAt(const Grid& grid, vtkIdType point)
{
  vtkNew<vtkIdList> cells;
  grid->BuildLinks();
  grid->GetPointCells(point, cells);
  return cells->GetNumberOfIds();
}

} // anonymous namespace

TEST(TetrahedraRayCastBadInput, NoInput)
{
  RayCastScene scene(nullptr, Smooth(), Size, Size);
  const Outcome outcome = Render(scene);
  EXPECT_TRUE(outcome.PictureIsTheCube);
  EXPECT_FALSE(outcome.Errors->Errors.empty());
}

// A rank without cells is no error: nothing is drawn.
TEST(TetrahedraRayCastBadInput, NothingToDraw)
{
  const Grid triangle = MakeGrid({ 0, 0, 0, 1, 0, 0, 0, 1, 0 }, {}, ConstantField(1.0));
  const vtkIdType ids[3] = { 0, 1, 2 };
  triangle->InsertNextCell(VTK_TRIANGLE, 3, ids);
  const Grid flat = MakeBlock(4, WavyField(2.0));
  MapPoints(flat, [](glm::dvec3 x) { return glm::dvec3(x.x, x.y, 0.0); });
  for (const Grid& grid : { Grid::New(), MakeGrid({ 0, 0, 0, 1, 0, 0 }, {}, ConstantField(1.0)),
         triangle, flat, MakeBlock(2, ConstantField(std::numeric_limits<double>::quiet_NaN())) })
  {
    RayCastScene scene(grid, Smooth(), Size, Size);
    EXPECT_TRUE(Render(scene).PictureIsTheCube) << grid->GetNumberOfCells();
    EXPECT_TRUE(
      grid->GetNumberOfCells() > 1 || scene.GetRayCaster()->GetNumberOfActiveCells() == 0);
  }
}

TEST(TetrahedraRayCastBadInput, ScalarsThatAreMissing)
{
  for (const bool some : { false, true })
  {
    const Grid grid = MakeBlock(2, WavyField(1.0));
    grid->GetPointData()->GetScalars()->SetNumberOfTuples(3);
    grid->GetPointData()->SetScalars(some ? grid->GetPointData()->GetScalars() : nullptr);
    RayCastScene scene(grid, Smooth(), Size, Size);
    ExpectError(scene, {});
  }
}

TEST(TetrahedraRayCastBadInput, WrongArrayName)
{
  RayCastScene scene(MakeBlock(2, WavyField(1.0)), Smooth(), Size, Size);
  scene.GetRayCaster()->SetScalarModeToUsePointFieldData();
  scene.GetRayCaster()->SelectScalarArray("NoSuchArray");
  ExpectError(scene, { "NoSuchArray" });
}

TEST(TetrahedraRayCastBadInput, ScalarsThatAreNotFinite)
{
  for (const double bad : { std::numeric_limits<double>::quiet_NaN(),
         std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity() })
  {
    const Grid grid = MakeBlock(4, WavyField(2.0));
    vtkDoubleArray::SafeDownCast(grid->GetPointData()->GetScalars())
      ->SetValue(MiddlePoint(grid), bad);
    // Transparent, not left out of the mesh.
    ExpectRest(grid, 0, "scalar " + std::to_string(bad));
  }
}

TEST(TetrahedraRayCastBadInput, WholeNumbersThatAreRounded)
{
  // 2^60 and more, where doubles are 256 apart.
  for (const int width : { 1, 40000, 400000 })
  {
    const Grid grid = MakeBlock(4, WavyField(2.0));
    vtkNew<vtkLongLongArray> scalars;
    scalars->SetName(ScalarName);
    for (vtkIdType i = 0; i < grid->GetNumberOfPoints(); ++i)
    {
      scalars->InsertNextValue((1LL << 60) + width * (i % 2));
    }
    grid->GetPointData()->SetScalars(scalars);
    RayCastScene scene(grid, Smooth(), Size, Size);
    const auto told = Render(scene).Errors;
    EXPECT_TRUE(told->Errors.empty());
    if (width > 256 * 256)
    {
      EXPECT_TRUE(told->Warnings.empty()) << told->Warnings.front();
      continue;
    }
    ASSERT_EQ(told->Warnings.size(), 1u);
    for (const char* words :
      { "whole numbers from 1152921504606846976 to 11529215046068", "256 apart" })
    {
      EXPECT_TRUE(HasText(told->Warnings.front(), words));
    }
  }
}

TEST(TetrahedraRayCastBadInput, PointsThatAreNotFinite)
{
  for (const double bad :
    { std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity() })
  {
    const Grid grid = MakeBlock(4, WavyField(2.0));
    const vtkIdType middle = MiddlePoint(grid);
    const double x[3] = { 0.0, bad, 0.0 };
    const vtkIdType cells = CellsAt(grid, middle);
    grid->GetPoints()->SetPoint(middle, x);
    ExpectRest(grid, cells, "coordinate " + std::to_string(bad));
  }
}

// Repeated points, four points of a face of the boundary, and a cell that is there: it covers the
// same space, and counts once.
TEST(TetrahedraRayCastBadInput, CellsThatDoNotCount)
{
  const Grid grid = MakeBlock(3, WavyField(2.0));
  vtkNew<vtkIdList> again;
  grid->GetCellPoints(17, again);
  grid->InsertNextCell(VTK_TETRA, again);
  const vtkIdType cells[3][4] = { { 0, 1, 1, 5 }, { 2, 2, 2, 2 }, { 0, 1, 4, 5 } };
  for (const auto& cell : cells)
  {
    grid->InsertNextCell(VTK_TETRA, 4, cell);
  }
  ExpectRest(grid, 3, "repeated points, a flat cell and a cell given twice");
}

TEST(TetrahedraRayCastBadInput, PointIndexOutOfRange)
{
  const Grid grid = MakeBlock(3, WavyField(2.0));
  // One value has more than 32 bits, and its lower 32 bits would be a valid point.
  for (const vtkIdType bad :
    { vtkIdType(1000000), vtkIdType(-1), grid->GetNumberOfPoints(), (vtkIdType(1) << 32) + 2 })
  {
    const vtkIdType ids[4] = { 0, 1, 5, bad };
    grid->InsertNextCell(VTK_TETRA, 4, ids);
  }
  ExpectRest(grid, 4, "index out of range");
}

/** VTK's cameras see nothing that is much smaller than 1e-20: told once, and cured by a scale. */
TEST(TetrahedraRayCastBadInput, MeshesThatAreTooSmallForCameras)
{
  for (const double size : { 1e-20, 1e-23, 1e-30, 1e-100, 1e-200 })
  {
    SCOPED_TRACE(size);
    const Grid grid = MakeBlock(3, LinearField(1.0, 0.0, 0.0));
    TransformPoints(grid, { 0.0, 0.0, 0.0 }, size);
    vtkNew<vtkTetrahedraRayCastMapper> mapper;
    const auto told = ObserveErrors(mapper);
    mapper->SetInputData(grid);
    for (int i = 0; i < 2; ++i)
    {
      EXPECT_DOUBLE_EQ(mapper->GetBounds()[1], size);
      ASSERT_EQ(told->Warnings.size(), size < 1e-20 ? 1u : 0u) << told->GetText();
    }
    EXPECT_TRUE(told->Warnings.empty() || HasText(told->Warnings[0], "VTK's cameras see nothing"));
  }
  // Seen as one of size 1.
  std::vector<FloatImage> images;
  for (const double size : { 1.0, 1e-30 })
  {
    const Grid grid = MakeBlock(3, LinearField(1.0, 0.0, 0.0));
    TransformPoints(grid, { 0.0, 0.0, 0.0 }, size);
    RayCastScene scene(grid, Smooth(), Size, Size);
    scene.GetVolume()->SetScale(1.0 / size);
    LookAt(scene.GetRenderer(), Bounds, 25.0, 15.0);
    images.push_back(scene.RenderFloat());
  }
  ExpectSamePicture(images[1], images[0], "scaled");
}

/** A fault of the medium is told once for each change, not in each frame. */
TEST(TetrahedraRayCastBadInput, AMediumWithoutMeaning)
{
  RayCastScene scene(MakeBlock(3, LinearField(1.0, 0.0, 0.0)), Smooth(), Size, Size);
  vtkTetrahedraRayCastMapper* mapper = scene.GetRayCaster();
  const auto told = ObserveErrors(mapper);
  for (const double coefficient : { -1.0, std::numeric_limits<double>::infinity() })
  {
    told->Errors.clear();
    mapper->SetMediumAttenuationCoefficients(coefficient, 0.0, 0.0);
    for (int frame = 0; frame < 3; ++frame)
    {
      scene.GetWindow()->Render();
      ASSERT_EQ(told->Errors.size(), 1u) << told->GetText();
    }
    EXPECT_TRUE(HasText(told->Errors[0], "drawn clear"));
  }
}

/** A volume that its matrix makes flat is not drawn. One error says so after each change of it. */
TEST(TetrahedraRayCastBadInput, AMatrixThatMakesTheVolumeFlat)
{
  RayCastScene scene(MakeBlock(3, WavyField(2.0)), Smooth(), Size, Size);
  vtkTetrahedraRayCastMapper* mapper = scene.GetRayCaster();
  for (const glm::dvec3 scale : { glm::dvec3(1.0, 1.0, 0.0), glm::dvec3(0.0),
         glm::dvec3(1.0, std::numeric_limits<double>::quiet_NaN(), 1.0) })
  {
    SCOPED_TRACE(scale.z);
    scene.GetVolume()->SetScale(scale.x, scale.y, scale.z);
    const Outcome outcome = Render(scene);
    EXPECT_TRUE(outcome.PictureIsTheCube);
    for (int frame = 0; frame < 3; ++frame)
    {
      scene.GetRenderer()->GetActiveCamera()->Azimuth(1.0);
      scene.GetWindow()->Render();
      ASSERT_EQ(outcome.Errors->Errors.size(), 1u) << outcome.Errors->GetText();
    }
    EXPECT_TRUE(HasText(outcome.Errors->Errors[0], "matrix of the volume"));
    EXPECT_EQ(mapper->GetNumberOfRays(), 0);
  }
  scene.GetRenderer()->RemoveAllViewProps();
  scene.GetRenderer()->AddVolume(scene.GetVolume());
  scene.GetRenderer()->SetBackground(0.0, 0.0, 0.0);
  scene.GetVolume()->SetScale(1.0);
  ExpectMatchesReference(scene, "with its size again");
}

/** Its membrane is in world coordinates, which such a matrix takes to none of the volume's. */
TEST(TetrahedraRayCastBadInput, AFlatVolumeBehindAMembraneHasBounds)
{
  RayCastScene scene(MakeBlock(3, WavyField(2.0)), Smooth(), Size, Size);
  const auto plane = MakePlane(1.0, 2.0, 2);
  plane->Update();
  scene.GetRayCaster()->SetMembraneData(plane->GetOutput());
  scene.GetVolume()->SetScale(1.0, 0.0, 1.0);
  const auto told = ObserveErrors(scene.GetRayCaster());
  scene.GetWindow()->Render();
  const double* bounds = scene.GetVolume()->GetBounds();
  EXPECT_EQ(told->Errors.size(), 1u) << told->GetText();
  EXPECT_DOUBLE_EQ(bounds[4], -1.0);
  EXPECT_DOUBLE_EQ(bounds[5], 2.0);
}

TEST(TetrahedraRayCastBadInput, TransferFunctionWithoutNodes)
{
  const Grid grid = MakeBlock(2, WavyField(1.0));
  vtkNew<vtkVolumeProperty> property;
  vtkNew<vtkPiecewiseFunction> opacity;
  vtkNew<vtkColorTransferFunction> color;
  property->SetScalarOpacity(opacity);
  property->SetColor(color);
  RayCastScene scene(grid, property, Size, Size);
  EXPECT_TRUE(Render(scene).PictureIsTheCube);
}

TEST(TetrahedraRayCastBadInput, RecoversFromAnError)
{
  RayCastScene scene(MakeBlock(3, WavyField(2.0)), Smooth(), Size, Size);
  scene.GetRayCaster()->SetScalarModeToUsePointFieldData();
  scene.GetRayCaster()->SelectScalarArray("NoSuchArray");
  LookAt(scene.GetRenderer(), Bounds, 30.0, 20.0);
  const auto errors = ObserveErrors(scene.GetRayCaster());
  scene.GetWindow()->Render();
  EXPECT_FALSE(errors->Errors.empty());
  scene.GetRayCaster()->SelectScalarArray(ScalarName);
  ExpectMatchesReference(scene, "after an error");
}
