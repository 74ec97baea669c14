// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Cells that their arrays do not describe: each is skipped, counted and reported, whatever its
// type, and the other cells are measured.
#include "IntegralScene.h"

#include <vtkStructuredGrid.h>
#include <vtkVersionMacros.h>

using namespace meniscus::test;

namespace
{

struct CellType
{
  const char* Name;
  int Type;
  /** A number of points that a cell of the type can have. */
  vtkIdType Points;
};

/** All cell types with a volume but the polyhedron. */
constexpr CellType CellTypes[] = {
  { "Tetra", VTK_TETRA, 4 },
  { "Voxel", VTK_VOXEL, 8 },
  { "Hexahedron", VTK_HEXAHEDRON, 8 },
  { "Wedge", VTK_WEDGE, 6 },
  { "Pyramid", VTK_PYRAMID, 5 },
  { "PentagonalPrism", VTK_PENTAGONAL_PRISM, 10 },
  { "HexagonalPrism", VTK_HEXAGONAL_PRISM, 12 },
  { "ConvexPointSet", VTK_CONVEX_POINT_SET, 4 },
  { "QuadraticTetra", VTK_QUADRATIC_TETRA, 10 },
  { "QuadraticHexahedron", VTK_QUADRATIC_HEXAHEDRON, 20 },
  { "QuadraticWedge", VTK_QUADRATIC_WEDGE, 15 },
  { "QuadraticPyramid", VTK_QUADRATIC_PYRAMID, 13 },
  { "TriQuadraticHexahedron", VTK_TRIQUADRATIC_HEXAHEDRON, 27 },
  { "TriQuadraticPyramid", VTK_TRIQUADRATIC_PYRAMID, 19 },
  { "QuadraticLinearWedge", VTK_QUADRATIC_LINEAR_WEDGE, 12 },
  { "BiQuadraticQuadraticWedge", VTK_BIQUADRATIC_QUADRATIC_WEDGE, 18 },
  { "BiQuadraticQuadraticHexahedron", VTK_BIQUADRATIC_QUADRATIC_HEXAHEDRON, 24 },
  { "LagrangeTetrahedron", VTK_LAGRANGE_TETRAHEDRON, 20 },
  { "LagrangeHexahedron", VTK_LAGRANGE_HEXAHEDRON, 27 },
  { "LagrangeWedge", VTK_LAGRANGE_WEDGE, 18 },
  { "BezierTetrahedron", VTK_BEZIER_TETRAHEDRON, 10 },
  { "BezierHexahedron", VTK_BEZIER_HEXAHEDRON, 64 },
  { "BezierWedge", VTK_BEZIER_WEDGE, 40 },
};

/** The cube [0, 1]^3 as one hexahedron, and 100 points that no cell uses. */
Grid MakeCube()
{
  Grid grid = Grid::New();
  vtkNew<vtkPoints> points;
  vtkNew<vtkDoubleArray> scalars;
  scalars->SetName(ScalarName);
  for (int i = 0; i < 108; ++i)
  {
    const double at[3] = { (i & 1) ^ (i >> 1 & 1) ? 1.0 : 0.0, static_cast<double>(i >> 1 & 1),
      static_cast<double>(i >> 2 & 1) };
    const double unused[3] = { 0.1 * (i % 7), 0.1 * (i % 5), 0.1 * (i % 3) };
    points->InsertNextPoint(i < 8 ? at : unused);
    scalars->InsertNextValue(1.0);
  }
  grid->SetPoints(points);
  grid->GetPointData()->SetScalars(scalars);
  const vtkIdType ids[8] = { 0, 1, 2, 3, 4, 5, 6, 7 };
  grid->InsertNextCell(VTK_HEXAHEDRON, 8, ids);
  return grid;
}

std::vector<vtkIdType> FirstPoints(vtkIdType count)
{
  std::vector<vtkIdType> ids;
  for (vtkIdType i = 0; i < count; ++i)
  {
    ids.push_back(i);
  }
  return ids;
}

/** Expects the cube alone, with one warning that has a text in it. */
void ExpectCube(
  vtkDataObject* input, const std::string& text, vtkTypeInt64 rejected, bool isAdaptive = false)
{
  const Filter rays = MakeFilter(input, 8, 8, { "PathLength" });
  rays->SetFrameModeToParallel();
  rays->SetFrameOrigin(0.0, 0.0, 2.0);
  rays->SetCellDivision(isAdaptive);
  rays->SetDivisionTolerance(0.01);
  const auto observer = ObserveErrors(rays);
  rays->Update();
  const std::vector<double> lengths = ValuesOf(rays, "PathLength");
  ASSERT_EQ(lengths.size(), 64u) << text << ": " << observer->GetText();
  for (const double length : lengths)
  {
    ASSERT_NEAR(length, 1.0, 1.0e-6) << text;
  }
  EXPECT_TRUE(observer->Errors.empty()) << observer->GetText();
  ASSERT_EQ(observer->Warnings.size(), 1u) << text << ": " << observer->GetText();
  EXPECT_TRUE(HasText(observer->Warnings[0], text));
  EXPECT_EQ(rays->GetStatistic("NumberOfRejectedCells"), rejected) << observer->GetText();
}

}

class BrokenCells : public ::testing::TestWithParam<CellType>
{
};

TEST_P(BrokenCells, TooFewPoints)
{
  const CellType& type = GetParam();
  for (const auto& [size, isAdaptive] : Product(
         std::vector<vtkIdType>{ vtkIdType{ 0 }, vtkIdType{ 1 }, vtkIdType{ 3 }, type.Points - 1 },
         List(false, true)))
  {
    const Grid grid = MakeCube();
    const std::vector<vtkIdType> ids = FirstPoints(size);
    grid->InsertNextCell(type.Type, size, ids.data());
    ExpectCube(grid, "1 with a number of points that their type does not have", 1, isAdaptive);
  }
}

TEST_P(BrokenCells, PointsOutOfRange)
{
  const CellType& type = GetParam();
  for (const auto& [bad, isAdaptive] :
    Product(std::vector<vtkIdType>{ vtkIdType{ -1 }, vtkIdType{ 108 }, vtkIdType{ 1 } << 40 },
      List(false, true)))
  {
    const Grid grid = MakeCube();
    std::vector<vtkIdType> ids = FirstPoints(type.Points);
    ids[2] = bad;
    grid->InsertNextCell(type.Type, type.Points, ids.data());
    ExpectCube(grid, "1 with a point index out of range", 1, isAdaptive);
  }
}

INSTANTIATE_TEST_SUITE_P(AllTypes, BrokenCells, ::testing::ValuesIn(CellTypes),
  [](const ::testing::TestParamInfo<CellType>& of) { return std::string(of.param.Name); });

TEST(BrokenCellArrays, PointsOfTheNextDataSetAreOutOfRange)
{
  const Grid first = MakeCube();
  const vtkIdType ids[8] = { 0, 1, 2, 3, 4, 5, 6, 108 + 7 };
  first->InsertNextCell(VTK_HEXAHEDRON, 8, ids);
  const Grid second = MakeCube();
  MapPoints(second, [](const glm::dvec3& at) { return at + glm::dvec3(5.0, 0.0, 0.0); });
  ExpectCube(MakeBlocks({ first, second }), "1 with a point index out of range", 1);
}

TEST(BrokenCellArrays, OffsetsOutsideOfTheirArray)
{
  for (const auto& [type, end] : Product(List(VTK_TETRA, VTK_HEXAHEDRON),
         std::vector<vtkIdType>{ vtkIdType{ 1000 }, vtkIdType{ -4 }, vtkIdType{ 3 } }))
  {
    const Grid grid = MakeCube();
    vtkNew<vtkIdTypeArray> offsets;
    vtkNew<vtkIdTypeArray> ids;
    for (const vtkIdType offset : { vtkIdType{ 0 }, vtkIdType{ 8 }, end })
    {
      offsets->InsertNextValue(offset);
    }
    for (vtkIdType i = 0; i < 12; ++i)
    {
      ids->InsertNextValue(i);
    }
    vtkNew<vtkCellArray> cells;
    cells->SetData(offsets, ids);
    int types[2] = { VTK_HEXAHEDRON, type };
    grid->SetCells(types, cells);
    ExpectCube(grid, "1 with points or faces outside of their array", 1);
  }
}

TEST(BrokenCellArrays, TetrahedraWithUnequalNumbersOfPoints)
{
  // Together they have four points per cell.
  const Grid grid = MakeCube();
  vtkNew<vtkCellArray> cells;
  const vtkIdType ids[2][8] = { { 0, 1, 2 }, { 0, 1, 2, 5, 6 } };
  cells->InsertNextCell(3, ids[0]);
  cells->InsertNextCell(5, ids[1]);
  grid->SetCells(VTK_TETRA, cells);
  const Filter rays = MakeFilter(grid, 4, 4, { "PathLength" });
  rays->Update();
  EXPECT_EQ(rays->GetStatistic("NumberOfRejectedCells"), 1);
  EXPECT_EQ(rays->GetStatistic("NumberOfTetrahedra"), 1);
}

#if VTK_VERSION_NUMBER < VTK_VERSION_CHECK(9, 4, 0)
// Later versions keep the faces of polyhedra in cell arrays, whose offsets are checked above.
TEST(BrokenCellArrays, FacesOfPolyhedra)
{
  const std::vector<vtkIdType> tetrahedron = { 4, 3, 0, 1, 2, 3, 0, 1, 4, 3, 1, 2, 4, 3, 2, 0, 4 };
  struct Change
  {
    std::size_t Place;
    vtkIdType Value;
    const char* Text;
  };
  const Change changes[] = {
    { 0, 0, "1 polyhedra without usable faces" },
    { 0, -3, "1 polyhedra without usable faces" },
    { 0, 40, "1 with points or faces outside of their array" },
    { 1, 2, "1 polyhedra without usable faces" },
    { 1, -1, "1 polyhedra without usable faces" },
    { 13, 30, "1 with points or faces outside of their array" },
    { 13, vtkIdType{ 1 } << 60, "1 with points or faces outside of their array" },
    { 14, 108, "1 with a point index out of range" },
    { 14, -1, "1 with a point index out of range" },
  };
  const vtkIdType ids[4] = { 0, 1, 2, 4 };
  for (const Change& change : changes)
  {
    const Grid grid = MakeCube();
    grid->InsertNextCell(VTK_POLYHEDRON, 4, ids, 4, tetrahedron.data() + 1);
    grid->GetFaces()->SetValue(static_cast<vtkIdType>(change.Place), change.Value);
    ExpectCube(grid, change.Text, 1);
  }
  for (const vtkIdType place : { vtkIdType{ 17 }, vtkIdType{ 1000 }, vtkIdType{ -1 } })
  {
    const Grid grid = MakeCube();
    grid->InsertNextCell(VTK_POLYHEDRON, 4, ids, 4, tetrahedron.data() + 1);
    grid->GetFaceLocations()->SetValue(1, place);
    ExpectCube(grid, place < 0 ? "without usable faces" : "outside of their array", 1);
  }
}
#endif

TEST(BrokenCellArrays, ArraysThatContradictEachOther)
{
  const auto expectError = [](vtkDataObject* input, const std::string& text)
  {
    const Filter rays = MakeFilter(input, 4, 4, { "PathLength" });
    const auto observer = ObserveErrors(rays);
    rays->Update();
    EXPECT_TRUE(HasText(observer->GetText(), text)) << text;
  };
  const vtkIdType tetrahedron[4] = { 0, 1, 2, 5 };
  {
    const Grid grid = MakeCube();
    vtkNew<vtkCellArray> cells;
    cells->InsertNextCell(4, tetrahedron);
    cells->InsertNextCell(4, tetrahedron);
    vtkNew<vtkUnsignedCharArray> types;
    types->InsertNextValue(VTK_TETRA);
    grid->SetCells(types, cells);
    expectError(grid, "1 cell types for 2 cells");
  }
  {
    const Grid grid = MakeCube();
    grid->InsertNextCell(VTK_TETRA, 4, tetrahedron);
    vtkNew<vtkUnsignedCharArray> ghosts;
    ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
    ghosts->InsertNextValue(0);
    grid->GetCellData()->AddArray(ghosts);
    expectError(grid, "1 ghost flags for 2 cells");
  }
  {
    const Grid grid = MakeCube();
    grid->InsertNextCell(VTK_TETRA, 4, tetrahedron);
    vtkNew<vtkDoubleArray> degrees;
    degrees->SetNumberOfComponents(3);
    degrees->InsertNextTuple3(1.0, 1.0, 1.0);
    grid->GetCellData()->SetHigherOrderDegrees(degrees);
    expectError(grid, "1 degrees along three axes for 2 cells");
  }
  {
    const Grid grid = MakeCube();
    vtkNew<vtkDoubleArray> weights;
    weights->InsertNextValue(1.0);
    grid->GetPointData()->SetRationalWeights(weights);
    expectError(grid, "1 rational weights for 108 points");
  }
  {
    vtkNew<vtkStructuredGrid> grid;
    grid->SetDimensions(3, 3, 3);
    grid->SetPoints(MakeCube()->GetPoints());
    grid->GetPoints()->SetNumberOfPoints(20);
    expectError(grid, "20 points for 27 places");
  }
  {
    vtkNew<vtkRectilinearGrid> grid;
    grid->SetDimensions(3, 3, 3);
    const auto two = MakeArray(nullptr, 2, 0.0);
    grid->SetXCoordinates(two);
    grid->SetYCoordinates(two);
    grid->SetZCoordinates(two);
    expectError(grid, "2 coordinates along an axis for 3 points");
  }
}
