// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Bounds are those of the cells that are drawn: of the mapper, for cameras, and of fitted rays.
#include "IntegralScene.h"

#include <vtkStructuredGrid.h>
#include <vtkUniformGrid.h>

using namespace meniscus::test;

namespace
{

/** A corner of the drawn cells in the middle of Germany, in metres of UTM. */
const glm::dvec3 Place(561000.0, 5700000.0, 100.0);
const double NaN = std::numeric_limits<double>::quiet_NaN();

/** The cube of side 10 at Place, in tetrahedra. */
Grid MakeCube()
{
  const Grid grid = MakeCubeOfFive(ConstantField(1.0));
  MapPoints(grid, [](const glm::dvec3& at) { return Place + 10.0 * at; });
  return grid;
}

/** Adds a point with a scalar; returns its number. */
vtkIdType AddPoint(vtkUnstructuredGrid* grid, double x, double y, double z)
{
  vtkDoubleArray::SafeDownCast(grid->GetPointData()->GetScalars())->InsertNextValue(1.0);
  return grid->GetPoints()->InsertNextPoint(x, y, z);
}

/** Adds a cell between the origin and the points (1, 0, 0), (0, 1, 0), (0, 0, 1). */
void AddFarCell(vtkUnstructuredGrid* grid, int type, vtkIdType size)
{
  vtkIdType ids[4];
  for (vtkIdType i = 0; i < 4; ++i)
  {
    ids[i] = AddPoint(grid, i == 1 ? 1.0 : 0.0, i == 2 ? 1.0 : 0.0, i == 3 ? 1.0 : 0.0);
  }
  grid->InsertNextCell(type, size, ids);
}

void AddFlags(vtkDataSet* grid, unsigned char flag)
{
  const auto flags = MakeArray<vtkUnsignedCharArray>(
    vtkDataSetAttributes::GhostArrayName(), grid->GetNumberOfCells(), 0.0);
  flags->SetValue(grid->GetNumberOfCells() - 1, flag);
  grid->GetCellData()->AddArray(flags);
}

struct BoundsCase
{
  const char* Name;
  vtkSmartPointer<vtkDataObject> Input;
};

Grid MakeHalf(int axisSide)
{
  const Grid half = MakeCube();
  MapPoints(half,
    [axisSide](const glm::dvec3& at)
    { return glm::dvec3(Place.x + 0.5 * (at.x - Place.x) + 5.0 * axisSide, at.y, at.z); });
  return half;
}

/** Inputs of which the cube alone is drawn. */
std::vector<BoundsCase> MakeCases()
{
  std::vector<BoundsCase> cases;
  const auto add = [&cases](const char* name, auto&& change)
  {
    const Grid grid = MakeCube();
    change(grid.Get());
    cases.push_back({ name, grid });
  };
  add("unused point", [](vtkUnstructuredGrid* grid) { AddPoint(grid, 0.0, 0.0, 0.0); });
  add("unused point that is not finite",
    [](vtkUnstructuredGrid* grid) { AddPoint(grid, 0.0, NaN, 0.0); });
  add("point that does not exist",
    [](vtkUnstructuredGrid* grid)
    {
      AddFarCell(grid, VTK_TETRA, 4);
      vtkDataArray* ids = grid->GetCells()->GetConnectivityArray();
      ids->SetTuple1(ids->GetNumberOfTuples() - 1, grid->GetNumberOfPoints());
    });
  add("triangle", [](vtkUnstructuredGrid* grid) { AddFarCell(grid, VTK_TRIANGLE, 3); });
  add("vertex", [](vtkUnstructuredGrid* grid) { AddFarCell(grid, VTK_VERTEX, 1); });
  for (const auto& [name, flag] : std::initializer_list<std::pair<const char*, unsigned char>>{
         { "hidden cell", vtkDataSetAttributes::HIDDENCELL },
         { "ghost cell", vtkDataSetAttributes::DUPLICATECELL },
         { "refined cell", vtkDataSetAttributes::REFINEDCELL } })
  {
    add(name,
      [bits = flag](vtkUnstructuredGrid* grid)
      {
        AddFarCell(grid, VTK_TETRA, 4);
        AddFlags(grid, bits);
      });
  }
  add("tetrahedron with a repeated point",
    [](vtkUnstructuredGrid* grid)
    {
      AddFarCell(grid, VTK_TETRA, 4);
      vtkDataArray* ids = grid->GetCells()->GetConnectivityArray();
      ids->SetTuple1(ids->GetNumberOfTuples() - 1, grid->GetNumberOfPoints() - 2);
    });
  add("pyramid of three points",
    [](vtkUnstructuredGrid* grid)
    {
      AddFarCell(grid, VTK_TRIANGLE, 3);
      const vtkIdType last = grid->GetNumberOfPoints() - 1;
      const vtkIdType ids[5] = { last, last - 1, last - 2, last - 2, last };
      grid->InsertNextCell(VTK_PYRAMID, 5, ids);
    });
  add("too few points", [](vtkUnstructuredGrid* grid) { AddFarCell(grid, VTK_HEXAHEDRON, 4); });
  add("point that is not finite",
    [](vtkUnstructuredGrid* grid)
    {
      AddFarCell(grid, VTK_TETRA, 4);
      grid->GetPoints()->SetPoint(grid->GetNumberOfPoints() - 1, 0.0, NaN, 0.0);
    });
  vtkNew<vtkSphereSource> sphere;
  sphere->Update();
  const Grid other = MakeCube();
  AddPoint(other, 0.0, 0.0, 0.0);
  cases.push_back(
    { "blocks", MakeBlocks({ MakeHalf(0), sphere->GetOutput(), MakeHalf(1), Grid::New() }) });
  const Grid nameless = MakeSingleTetrahedron(ConstantField(1.0));
  nameless->GetPointData()->Initialize();
  cases.push_back({ "block without the array", MakeBlocks({ nameless, other }) });
  auto image = vtkSmartPointer<vtkUniformGrid>::New();
  image->SetDimensions(4, 3, 2);
  image->SetOrigin(Place[0], Place[1], Place[2]);
  image->SetSpacing(5.0, 5.0, 10.0);
  image->GetPointData()->SetScalars(MakeArray(ScalarName, 24, 1.0));
  image->BlankCell(2);
  image->BlankCell(5);
  cases.push_back({ "blanked cells of an image", image });
  for (const int first : { 0, 2 })
  {
    auto points = vtkSmartPointer<vtkStructuredGrid>::New();
    points->SetDimensions(4, 2, 2);
    vtkNew<vtkPoints> places;
    vtkNew<vtkDoubleArray> constant;
    constant->SetName(ScalarName);
    for (int i = 0; i < 16; ++i)
    {
      const int column = i % 4 - (first == 0 ? 1 : 0);
      places->InsertNextPoint(
        Place[0] + 5.0 * column, Place[1] + 10.0 * (i / 4 % 2), Place[2] + 10.0 * (i / 8));
      constant->InsertNextValue(1.0);
    }
    points->SetPoints(places);
    points->GetPointData()->SetScalars(constant);
    for (vtkIdType i = first == 0 ? 0 : 3; i < 16; i += 4)
    {
      points->BlankPoint(i);
    }
    cases.push_back({ "blanked points", points });
  }
  return cases;
}

void ExpectCube(const double* bounds, const char* name)
{
  for (int i = 0; i < 6; ++i)
  {
    EXPECT_DOUBLE_EQ(bounds[i], Place[i / 2] + 10.0 * (i % 2)) << name << ", bound " << i;
  }
}

}

TEST(DrawnBounds, OfTheMapper)
{
  for (const BoundsCase& bounds : MakeCases())
  {
    vtkNew<vtkTetrahedraRayCastMapper> mapper;
    mapper->SetInputDataObject(bounds.Input);
    ExpectCube(mapper->GetBounds(), bounds.Name);
  }
}

/** Cells of four and more points without a volume; a mesh of nothing else has their bounds. */
TEST(DrawnBounds, FlatCellsDoNotCount)
{
  const auto expect = [](const char* name, auto&& change)
  {
    const Grid grid = MakeCube();
    change(grid.Get());
    vtkNew<vtkTetrahedraRayCastMapper> mapper;
    mapper->SetInputData(grid);
    ExpectCube(mapper->GetBounds(), name);
  };
  expect("flat tetrahedron",
    [](vtkUnstructuredGrid* grid)
    {
      AddFarCell(grid, VTK_TETRA, 4);
      grid->GetPoints()->SetPoint(grid->GetNumberOfPoints() - 1, 3.0, 1.0, 0.0);
    });
  expect("flat tetrahedra and a far point",
    [](vtkUnstructuredGrid* grid)
    {
      for (const double shift : { 0.0, 0.1 })
      {
        AddFarCell(grid, VTK_TETRA, 4);
        // In a plane that rounding does not keep.
        const vtkIdType last = grid->GetNumberOfPoints() - 1;
        const glm::dvec3 a = PointOf(grid, last - 3);
        const glm::dvec3 u = PointOf(grid, last - 2) - a;
        const glm::dvec3 v = PointOf(grid, last - 1) - a;
        const glm::dvec3 at = a + 0.3 * u + (0.6 + shift) * v;
        grid->GetPoints()->SetPoint(last, at.x, at.y, at.z);
      }
      AddPoint(grid, 0.0, 0.0, -1.0);
    });
  expect("flat pyramid",
    [](vtkUnstructuredGrid* grid)
    {
      AddFarCell(grid, VTK_TRIANGLE, 3);
      const vtkIdType last = grid->GetNumberOfPoints() - 1;
      grid->GetPoints()->SetPoint(last, 1.0, 1.0, 0.0);
      const vtkIdType ids[5] = { last - 3, last - 2, last, last - 1,
        AddPoint(grid, 0.3, 0.6, 0.0) };
      grid->InsertNextCell(VTK_PYRAMID, 5, ids);
    });
  const Grid flat = MakeSingleTetrahedron(ConstantField(1.0));
  for (vtkIdType i = 0; i < 4; ++i)
  {
    flat->GetPoints()->SetPoint(i, i % 2, i / 2, 3.0);
  }
  vtkNew<vtkTetrahedraRayCastMapper> mapper;
  mapper->SetInputData(flat);
  for (int i = 0; i < 6; ++i)
  {
    EXPECT_DOUBLE_EQ(mapper->GetBounds()[i], i < 4 ? i % 2 : 3.0) << i;
  }
}

TEST(DrawnBounds, OfFittedRays)
{
  for (const BoundsCase& bounds : MakeCases())
  {
    const Filter rays = MakeFilter(bounds.Input, 8, 8, { "PathLength" });
    const auto quiet = ObserveErrors(rays);
    rays->Update();
    EXPECT_TRUE(quiet->Errors.empty()) << bounds.Name << ": " << quiet->GetText();
    const std::vector<double> lengths = ValuesOf(rays, "PathLength");
    ASSERT_EQ(lengths.size(), 64u) << bounds.Name;
    for (const double length : lengths)
    {
      EXPECT_NEAR(length, 10.0, 1.0e-4) << bounds.Name;
    }
  }
}

TEST(DrawnBounds, FollowTheInput)
{
  const Grid grid = MakeCube();
  AddFarCell(grid, VTK_TETRA, 4);
  vtkNew<vtkTetrahedraRayCastMapper> mapper;
  mapper->SetInputData(grid);
  EXPECT_DOUBLE_EQ(mapper->GetBounds()[0], 0.0);
  // The cell is hidden, shown and moved.
  AddFlags(grid, vtkDataSetAttributes::HIDDENCELL);
  grid->Modified();
  ExpectCube(mapper->GetBounds(), "hidden");
  grid->GetCellData()->RemoveArray(vtkDataSetAttributes::GhostArrayName());
  EXPECT_DOUBLE_EQ(mapper->GetBounds()[0], 0.0);
  for (vtkIdType i = 8; i < 12; ++i)
  {
    grid->GetPoints()->SetPoint(
      i, Place[0] + (i == 9 ? 1.0 : 0.0), Place[1] + (i == 10 ? 1.0 : 0.0), Place[2] + (i == 11));
  }
  grid->GetPoints()->Modified();
  ExpectCube(mapper->GetBounds(), "moved");
}

/** Cells at the sides stay there, become inner ones, get flat or get lost; more than one block. */
TEST(DrawnBounds, FollowMotions)
{
  const Grid grid = MakeBlock(16, ConstantField(1.0));
  const vtkIdType far = grid->GetNumberOfPoints();
  AddFarCell(grid, VTK_TETRA, 4);
  std::vector<glm::dvec3> places;
  for (vtkIdType i = 0; i < grid->GetNumberOfPoints(); ++i)
  {
    places.push_back((i < far ? 1.0 : 3.0) * PointOf(grid, i));
  }
  struct Motion
  {
    const char* Name;
    std::function<glm::dvec3(const glm::dvec3&, bool)> Move;
    double Right;
  };
  const auto away = [](const glm::dvec3& at) { return at + glm::dvec3(9.0, 0.0, 0.0); };
  const Motion motions[] = {
    { "none", [](const glm::dvec3& at, bool) { return at; }, 3.0 },
    { "longer", [](const glm::dvec3& at, bool) { return 1.5 * at; }, 4.5 },
    { "mirrored", [](const glm::dvec3& at, bool) { return -at; }, 1.0 },
    { "away", [&](const glm::dvec3& at, bool isFar) { return isFar ? away(at) : at; }, 12.0 },
    { "flat",
      [&](const glm::dvec3& at, bool isFar) {
        return isFar ? away({ at.x, at.y, 0.0 }) : at;
      },
      1.0 },
    { "away again", [&](const glm::dvec3& at, bool isFar) { return isFar ? away(at) : at; }, 12.0 },
    { "lost",
      [&](const glm::dvec3& at, bool isFar) { return isFar ? glm::dvec3(NaN, at.y, at.z) : at; },
      1.0 },
    { "back", [](const glm::dvec3& at, bool) { return at; }, 3.0 },
  };
  vtkNew<vtkTetrahedraRayCastMapper> mapper;
  mapper->SetInputData(grid);
  for (const Motion& motion : motions)
  {
    for (vtkIdType i = 0; i < grid->GetNumberOfPoints(); ++i)
    {
      const glm::dvec3 to = motion.Move(places[static_cast<std::size_t>(i)], i >= far);
      grid->GetPoints()->SetPoint(i, to.x, to.y, to.z);
    }
    grid->GetPoints()->Modified();
    vtkNew<vtkTetrahedraRayCastMapper> other;
    other->SetInputData(grid);
    EXPECT_EQ(mapper->GetBounds()[1], motion.Right) << motion.Name;
    for (int side = 0; side < 6; ++side)
    {
      EXPECT_EQ(mapper->GetBounds()[side], other->GetBounds()[side]) << motion.Name << side;
    }
  }
}

TEST(DrawnBounds, OfNothing)
{
  vtkNew<vtkTetrahedraRayCastMapper> mapper;
  EXPECT_FALSE(vtkMath::AreBoundsInitialized(mapper->GetBounds()));
  mapper->SetInputData(Grid::New());
  EXPECT_FALSE(vtkMath::AreBoundsInitialized(mapper->GetBounds()));
  // Pixels are no volumes.
  vtkNew<vtkImageData> flat;
  flat->SetDimensions(4, 4, 1);
  mapper->SetInputData(flat);
  EXPECT_FALSE(vtkMath::AreBoundsInitialized(mapper->GetBounds()));
  // Without scalars nothing is drawn, but the place of the cells is known.
  const Grid grid = MakeCube();
  grid->GetPointData()->Initialize();
  mapper->SetInputData(grid);
  ExpectCube(mapper->GetBounds(), "without scalars");
}
