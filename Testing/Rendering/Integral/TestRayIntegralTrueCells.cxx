// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Adaptive division of cells: integrals through cells of all types compared with an integrator that
// evaluates the shape functions of the cell itself, in double precision.
#include "CellIntegrator.h"
#include "TrueCellMeshes.h"

using namespace meniscus::test;

namespace
{

const double NaN = std::numeric_limits<double>::quiet_NaN();

/** Adaptive division for measurements, with as many pieces as that takes. */
Filter MakeAdaptive(vtkDataObject* input, int size)
{
  Filter rays = MakeFilter(input, size, size, { "Integral", "PathLength" });
  rays->SetCellDivisionToAdaptive();
  rays->SetDivisionTolerance(5e-5);
  rays->SetMaximumNumberOfPieces(1 << 25);
  SetRectangle(rays, { 0.3, -0.5, -1.0 }, 1.2);
  return rays;
}

/** Adaptive division with a tolerance that takes few pieces, for tests of other things. */
Filter MakeCoarse(vtkDataObject* input, int size)
{
  Filter rays = MakeAdaptive(input, size);
  rays->SetDivisionTolerance(2e-2);
  return rays;
}

/** Truth of each pixel. */
std::vector<glm::dvec2> TruthOf(vtkTetrahedraRayIntegral* rays, vtkUnstructuredGrid* grid)
{
  std::vector<glm::dvec2> truth;
  CellIntegrator integrator(grid, 0);
  int size[2];
  rays->GetImageSize(size);
  for (const auto& [row, column] : Product(size[1], size[0]))
  {
    truth.push_back(integrator.Integrate(RayOf(rays, column, row)));
  }
  return truth;
}

/**
 * Largest difference of the integrals from the truth, divided by the largest truth. Rays with a
 * short way through the cell are skipped: where a ray touches a curved side, the length of its way
 * changes by the root of the displacement.
 */
double ErrorOf(vtkTetrahedraRayIntegral* rays, const std::vector<glm::dvec2>& truth)
{
  const std::vector<double> found = ValuesOf(rays, "Integral");
  glm::dvec2 most(0.0);
  for (const glm::dvec2& one : truth)
  {
    most = glm::max(most, one);
  }
  double worst = 0.0;
  int compared = 0;
  for (std::size_t i = 0; i < truth.size(); ++i)
  {
    if (truth[i].y > 0.5 * most.y)
    {
      worst = std::max(worst, std::abs(found[i] - truth[i].x));
      ++compared;
    }
  }
  EXPECT_GT(compared, 5);
  return worst / most.x;
}

double SmoothField(const glm::dvec3& p)
{
  return 2.0 + 0.5 * p.x + 0.8 * p.z + 0.6 * std::sin(p.x + 0.5 * p.y - 0.7 * p.z);
}

vtkSmartPointer<vtkImageData> MakeImage(int n)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(n + 1, n + 1, n + 1);
  image->SetOrigin(-1.0, -1.0, -1.0);
  image->SetSpacing(2.0 / n, 2.0 / n, 2.0 / n);
  image->GetPointData()->SetScalars(MakeArray(
    "s", image->GetNumberOfPoints(), [&](vtkIdType i) { return SmoothField(PointOf(image, i)); }));
  return image;
}

void SetScalars(vtkDataSet* grid, const std::function<double(const glm::dvec3&)>& field)
{
  grid->GetPointData()->SetScalars(MakeArray(
    "s", grid->GetNumberOfPoints(), [&](vtkIdType i) { return field(PointOf(grid, i)); }));
}

}

class TrueCellTypes : public ::testing::TestWithParam<std::size_t>
{
};

TEST_P(TrueCellTypes, IntegralsFollowTheShapeFunctions)
{
  const CellCase& shape = CellCases[GetParam()];
  const Grid grid = MakeCell(shape, shape.Displacement, 3);
  const Filter rays = MakeAdaptive(grid, 10);
  rays->Update();
  EXPECT_EQ(rays->GetStatistic("NumberOfCellDivisions"), 1);
  EXPECT_EQ(rays->GetStatistic("NumberOfFoldedCells"), 0);
  EXPECT_EQ(rays->GetStatistic("NumberOfUnresolvedEdges"), 0);
  const std::vector<glm::dvec2> truth = TruthOf(rays, grid);
  const double adaptive = ErrorOf(rays, truth);
  // The error that is stated for this tolerance.
  EXPECT_LE(adaptive, 1.0e-4);
  std::printf("%-34s %8lld tetrahedra, error %.2g", shape.Name,
    static_cast<long long>(rays->GetStatistic("NumberOfTetrahedra")), adaptive);
  // Cells of higher order are divided whatever the setting (CellTypes.HigherOrders...).
  if (shape.Type < VTK_LAGRANGE_CURVE)
  {
    rays->SetCellDivisionToFixed();
    rays->Update();
    std::printf("; fixed %.2g", ErrorOf(rays, truth));
    EXPECT_GT(ErrorOf(rays, truth), 5.0 * adaptive);
  }
  std::printf("\n");
}

INSTANTIATE_TEST_SUITE_P(
  AllTypes, TrueCellTypes, ::testing::Range(std::size_t{ 0 }, std::size(CellCases)));

TEST(TrueCells, TheErrorConvergesWithTheTolerances)
{
  for (const std::size_t i : { 0, 3, 9 })
  {
    const CellCase& shape = CellCases[i];
    SCOPED_TRACE(shape.Name);
    const Grid grid = MakeCell(shape, 0.06, 5);
    const Filter rays = MakeAdaptive(grid, 12);
    rays->SetDivisionTolerance(0.1);
    rays->Update();
    const std::vector<glm::dvec2> truth = TruthOf(rays, grid);
    double first = 0.0;
    double error = 0.0;
    for (const double tolerance : { 1.6e-2, 4e-3, 1e-3, 2.5e-4 })
    {
      rays->SetDivisionTolerance(tolerance);
      rays->Update();
      error = ErrorOf(rays, truth);
      first = first == 0.0 ? error : first;
      std::printf("%-34s tolerance %.2g: %8lld tetrahedra, error %.2g\n", shape.Name, tolerance,
        static_cast<long long>(rays->GetStatistic("NumberOfTetrahedra")), error);
      // The displaced ends of a ray's way, which meets sides at an angle, and the value.
      EXPECT_LE(error, 4.0 * tolerance);
      EXPECT_EQ(rays->GetStatistic("NumberOfUnresolvedEdges"), 0);
    }
    // First order in the tolerance, which is 64 times smaller in the end; that is second order in
    // the size of the pieces. Differences are between a quarter of the tolerance and all of it.
    EXPECT_LE(error, 4.0 / 64.0 * first);
  }
}

TEST(TrueCells, SmoothFieldsTakeFewPieces)
{
  constexpr int n = 32;
  const auto image = MakeImage(n);
  const Filter rays = MakeAdaptive(image, 40);
  rays->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "s");
  rays->Update();
  const double pieces = rays->GetStatistic("NumberOfTetrahedra") / (6.0 * n * n * n);
  const auto truth = [&image](const WorldRay& ray) { return IntegrateImage(image, n, ray); };
  const double adaptive = WorstError(rays, "Integral", truth);
  rays->SetCellDivisionToFixed();
  rays->Update();
  const double fixed = WorstError(rays, "Integral", truth);
  std::printf("image of %d^3: %.2f times the tetrahedra, error %.2g, fixed %.2g\n", n, pieces,
    adaptive, fixed);
  EXPECT_GT(pieces, 1.0);
  EXPECT_LE(pieces, 4.0);
  EXPECT_LE(adaptive, 1.0e-4);
  EXPECT_LT(adaptive, fixed);
}

/** Points and cells that are not drawn, far away or with fill values, change no error. */
TEST(TrueCells, OnlyWhatIsDrawnIsTheMeasure)
{
  const CellCase& shape = CellCases[4];
  const auto divide = [](vtkUnstructuredGrid* grid)
  {
    const Filter rays = MakeCoarse(grid, 8);
    rays->Update();
    return std::make_pair(
      rays->GetStatistic("NumberOfTetrahedra"), rays->GetStatistic("DivisionError"));
  };
  const auto expected = divide(MakeCell(shape, 0.05, 3));
  EXPECT_GT(expected.first, 100.0);
  for (const bool isFar : { true, false })
  {
    for (const bool hasCell : { false, true })
    {
      SCOPED_TRACE(::testing::Message() << "far " << isFar << ", cell " << hasCell);
      const Grid grid = MakeCell(shape, 0.05, 3);
      vtkIdType ids[4];
      for (int i = 0; i < 4; ++i)
      {
        const double at = isFar ? 1e6 : 0.1;
        ids[i] = grid->GetPoints()->InsertNextPoint(
          at + (i == 1 ? 0.1 : 0.0), at + (i == 2 ? 0.1 : 0.0), at + (i == 3 ? 0.1 : 0.0));
        vtkDoubleArray::SafeDownCast(grid->GetPointData()->GetScalars())
          ->InsertNextValue(isFar ? 2.0 : 1e9);
      }
      if (hasCell)
      {
        grid->InsertNextCell(VTK_TETRA, 4, ids);
        grid->AllocateCellGhostArray()->SetValue(1, vtkDataSetAttributes::HIDDENCELL);
      }
      EXPECT_EQ(divide(grid), expected);
    }
  }
}

/**
 * Cells that need no division have their error. Along a diagonal of a side of 1.2 by 1.2, 2 x z is
 * off its chord by a quarter of 2 1.2^2.
 */
TEST(TrueCells, CellsThatAreNotDividedHaveTheirError)
{
  for (const CellCase& shape : { CellCases[0], CellCases[1] })
  {
    SCOPED_TRACE(shape.Name);
    const Grid cell = MakeCell(shape, 0.0, 2);
    SetScalars(cell, [](const glm::dvec3& at) { return at.x + 0.5 * at.y + 2.0 * at.x * at.z; });
    double range[2];
    cell->GetPointData()->GetScalars()->GetRange(range);
    const Filter rays = MakeAdaptive(cell, 4);
    rays->SetDivisionTolerance(0.5);
    rays->Update();
    EXPECT_NEAR(rays->GetStatistic("DivisionError"), 0.72 / (range[1] - range[0]), 1e-12);
    EXPECT_EQ(rays->GetStatistic("NumberOfCellDivisions"), 0.0);
  }
}

TEST(TrueCells, NeighboursOfAllTypesDoNotCrack)
{
  for (const bool quadratic : { false, true })
  {
    for (const unsigned int seed : { 1U, 2U })
    {
      const Grid grid = MakeMixedBlock(3, quadratic, seed);
      const Filter rays = MakeAdaptive(grid, 96);
      // So coarse that triangles of either side would lie far apart if they were not the same.
      rays->SetDivisionTolerance(0.05);
      rays->Update();
      EXPECT_GT(rays->GetStatistic("NumberOfTetrahedra"), 500);
      EXPECT_EQ(rays->GetStatistic("NumberOfLostRays"), 0);
      EXPECT_EQ(rays->GetStatistic("NumberOfFoldedCells"), 0);
      // The sides are plane, so each ray's way is that in the cube: a crack would shorten it.
      ConvexSolid cube;
      for (int axis = 0; axis < 3; ++axis)
      {
        glm::dvec3 normal(0.0);
        normal[axis] = 1.0;
        cube.Planes.push_back({ normal, 1.0 });
        cube.Planes.push_back({ -normal, 1.0 });
      }
      EXPECT_LE(WorstError(rays, "PathLength",
                  [&cube](const WorldRay& ray) { return cube.Clip(ray).GetLength(); }),
        1.0e-6);
    }
  }
}

TEST(TrueCells, ScalarsAndPointsKeepTheDivision)
{
  const Grid grid = MakeMixedBlock(2, true, 9);
  SetScalars(grid, SmoothField);
  const Filter rays = MakeAdaptive(grid, 16);
  rays->SetDivisionTolerance(5e-3);
  rays->Update();
  const double pieces = rays->GetStatistic("NumberOfTetrahedra");
  EXPECT_EQ(rays->GetStatistic("NumberOfUnresolvedEdges"), 0);
  rays->SetImageSize(24, 24);
  rays->Update();
  EXPECT_EQ(rays->GetStatistic("NumberOfMeshBuilds"), 1);
  // New arrays of scalars, as a reader makes them.
  for (int step = 1; step <= 5; ++step)
  {
    SetScalars(grid, [step](const glm::dvec3& at) { return 1.0 + (1.0 + step) * SmoothField(at); });
    rays->Update();
    EXPECT_EQ(rays->GetStatistic("NumberOfScalarUpdates"), 1 + step);
  }
  EXPECT_EQ(rays->GetStatistic("NumberOfCellDivisions"), 1);
  EXPECT_EQ(rays->GetStatistic("NumberOfMeshBuilds"), 1);
  // The same scalars from the start lead to the same pieces.
  const Filter fresh = MakeAdaptive(grid, 24);
  fresh->SetDivisionTolerance(5e-3);
  fresh->Update();
  EXPECT_EQ(fresh->GetStatistic("NumberOfTetrahedra"), pieces);
  EXPECT_EQ(ValuesOf(rays, "Integral"), ValuesOf(fresh, "Integral"));
  // Stretched points keep the division: the positions of all points are interpolated.
  MapPoints(grid, [](const glm::dvec3& at) { return 0.9 * at; });
  rays->Update();
  fresh->Update();
  EXPECT_EQ(rays->GetStatistic("NumberOfCellDivisions"), 1);
  EXPECT_EQ(rays->GetStatistic("NumberOfMeshBuilds"), 1);
  EXPECT_EQ(rays->GetStatistic("NumberOfPointUpdates"), 1);
  const Filter moved = MakeAdaptive(grid, 24);
  moved->SetDivisionTolerance(5e-3);
  moved->Update();
  const std::vector<double> kept = ValuesOf(rays, "Integral");
  const std::vector<double> again = ValuesOf(moved, "Integral");
  const double most = *std::max_element(again.begin(), again.end());
  for (std::size_t i = 0; i < kept.size(); ++i)
  {
    EXPECT_NEAR(kept[i], again[i], 5e-3 * most);
  }
  // Scalars of another shape exceed the tolerance.
  SetScalars(
    grid, [](const glm::dvec3& at) { return std::sin(9.0 * at.x) * std::cos(7.0 * at.z); });
  rays->Update();
  EXPECT_EQ(rays->GetStatistic("NumberOfUnresolvedEdges"), 0);
  EXPECT_EQ(rays->GetStatistic("NumberOfCellDivisions"), 2);
  EXPECT_EQ(rays->GetStatistic("NumberOfMeshBuilds"), 2);
  // So does another tolerance.
  rays->SetDivisionTolerance(1e-2);
  rays->Update();
  EXPECT_EQ(rays->GetStatistic("NumberOfCellDivisions"), 3);
}

TEST(TrueCells, CellsOfTheInputAreKnown)
{
  const Grid grid = MakeMixedBlock(2, false, 4);
  const auto numbers = MakeArray(
    "number", grid->GetNumberOfCells(), [&](vtkIdType c) { return 1.0 + static_cast<double>(c); });
  grid->GetCellData()->AddArray(numbers);
  const Filter rays = MakeCoarse(grid, 24);
  rays->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "number");
  Enable(rays, { "Minimum", "MinimumDepth", "Maximum", "MaximumDepth" });
  rays->Update();
  EXPECT_GT(rays->GetStatistic("NumberOfTetrahedra"), 6 * 8);
  const double mostNumber = static_cast<double>(grid->GetNumberOfCells());
  for (const char* name : { "Minimum", "Maximum" })
  {
    for (const double value : ValuesOf(rays, name))
    {
      // Values are normalised in single precision, with the range of the numbers as unit.
      EXPECT_TRUE(std::isnan(value) || std::abs(value - std::round(value)) < 1e-5) << value;
      EXPECT_TRUE(std::isnan(value) || (value > 0.5 && value < mostNumber + 0.5)) << value;
    }
  }
}

TEST(TrueCells, BadSettingsAreErrors)
{
  const Grid grid = MakeCell(CellCases[0], 0.05, 2);
  const Filter rays = MakeCoarse(grid, 8);
  for (const double bad : { 0.0, -1.0, NaN })
  {
    rays->SetDivisionTolerance(bad);
    // An error lasts as long as its cause.
    ExpectError(rays, "tolerance of the division of cells must be positive");
    rays->Modified();
    ExpectError(rays, "tolerance of the division of cells must be positive");
  }
  rays->SetDivisionTolerance(2e-2);
  rays->Update();
  EXPECT_GT(rays->GetOutput()->GetNumberOfPoints(), 0);
}

TEST(TrueCells, DifferencesOfRoundingAreNotDivided)
{
  // Sums of weights times a constant differ from it in the last digits, as do constants in arrays.
  for (const auto& [constant, step] :
    Product(List(0.0, 0.1, 1.0 / 3.0, 293.15, -1e300), List(0.0, 1e-16)))
  {
    SCOPED_TRACE(constant);
    const Grid grid = MakeCell(CellCases[0], 0.0, 2);
    vtkDataArray* scalars = grid->GetPointData()->GetScalars();
    for (vtkIdType i = 0; i < 8; ++i)
    {
      scalars->SetTuple1(i, constant * (1.0 + step * static_cast<double>(i)));
    }
    const Filter rays = MakeAdaptive(grid, 4);
    rays->Update();
    EXPECT_LE(rays->GetStatistic("NumberOfTetrahedra"), 6);
    EXPECT_GT(rays->GetStatistic("NumberOfTetrahedra"), 4);
  }
  // The same for places far from the origin: a cube, whose edges are straight.
  Grid cube = MakeCell(CellCases[0], 0.0, 2);
  for (vtkIdType i = 0; i < 8; ++i)
  {
    const glm::dvec3 at = PointOf(cube, i);
    cube->GetPoints()->SetPoint(i, at[0] + 1e6, at[1] - 2e6, at[2] + 3e6);
    cube->GetPointData()->GetScalars()->SetTuple1(i, 1.0);
  }
  const Filter rays = MakeAdaptive(cube, 4);
  rays->SetDivisionTolerance(1e-12);
  rays->Update();
  EXPECT_LE(rays->GetStatistic("NumberOfTetrahedra"), 6);
  EXPECT_GT(rays->GetStatistic("NumberOfTetrahedra"), 4);
}

TEST(TrueCells, TheBudgetEndsADivisionWithItsError)
{
  const Grid grid = MakeCell(CellCases[0], 0.05, 2);
  SetScalars(
    grid, [](const glm::dvec3& at) { return std::sin(9.0 * at.x) * std::cos(7.0 * at.z); });
  const Filter rays = MakeAdaptive(grid, 16);
  constexpr double finest = 5e-4;
  rays->SetDivisionTolerance(finest);
  rays->Update();
  EXPECT_LE(rays->GetStatistic("DivisionError"), finest);
  const std::vector<double> truth = ValuesOf(rays, "Integral");
  double range[2];
  grid->GetPointData()->GetScalars()->GetRange(range);
  double last = 1.0;
  for (const vtkTypeInt64 budget : { 100, 1000, 5000 })
  {
    const auto observer = ObserveErrors(rays);
    rays->SetMaximumNumberOfPieces(budget);
    rays->Update();
    EXPECT_LE(rays->GetStatistic("NumberOfTetrahedra"), budget);
    EXPECT_GE(rays->GetStatistic("NumberOfTetrahedra"), 0.6 * static_cast<double>(budget));
    ASSERT_EQ(observer->Warnings.size(), 1u);
    EXPECT_TRUE(HasText(observer->Warnings[0],
      "budget of " + std::to_string(budget) + " tetrahedra at an error of "));
    rays->RemoveObserver(observer);
    // The scalar is off by 1.5 times the error at most where it is quadratic, along a way of 1.4.
    const double error = rays->GetStatistic("DivisionError");
    EXPECT_GT(error, rays->GetDivisionTolerance());
    EXPECT_LT(error, last);
    last = error;
    const std::vector<double> found = ValuesOf(rays, "Integral");
    double worst = 0.0;
    for (std::size_t i = 0; i < found.size(); ++i)
    {
      worst = std::max(worst, std::abs(found[i] - truth[i]));
    }
    const double bound = 1.5 * 1.4 * (error + finest) * (range[1] - range[0]);
    std::printf("budget %lld: error %.2g, integrals %.2g of %.2g\n", static_cast<long long>(budget),
      error, worst, bound);
    EXPECT_LE(worst, bound);
    EXPECT_GE(worst, 0.02 * bound);
  }
}

TEST(TrueCells, SettingsThatChangeNothingCostNothing)
{
  const Grid grid = MakeMixedBlock(2, true, 9);
  Filter rays = MakeCoarse(grid, 8);
  rays->SetCellDivisionToFixed();
  rays->Update();
  rays->SetDivisionTolerance(1e-3);
  rays->SetMaximumNumberOfPieces(7);
  rays->Update();
  EXPECT_EQ(rays->GetStatistic("NumberOfMeshBuilds"), 1);
  rays = MakeCoarse(grid, 8);
  rays->SetMaximumNumberOfPieces(1000000);
  rays->Update();
  rays->SetMaximumNumberOfPieces(2000000);
  rays->Update();
  rays->SetMaximumNumberOfPieces(rays->GetStatistic("NumberOfTetrahedra"));
  rays->Update();
  EXPECT_EQ(rays->GetStatistic("NumberOfCellDivisions"), 1);
  EXPECT_EQ(rays->GetStatistic("NumberOfMeshBuilds"), 1);
  rays->SetMaximumNumberOfPieces(rays->GetStatistic("NumberOfTetrahedra") / 2);
  const auto observer = ObserveErrors(rays);
  rays->Update();
  EXPECT_EQ(rays->GetStatistic("NumberOfCellDivisions"), 2);
  EXPECT_EQ(observer->Warnings.size(), 1u);
}

TEST(TrueCells, OddCellsAreCounted)
{
  // Folded: one corner is pushed through the opposite one.
  Grid grid = MakeCell(CellCases[0], 0.0, 2);
  const auto movePoint = [&grid](vtkIdType i, double x, double y, double z)
  {
    grid->GetPoints()->SetPoint(i, x, y, z);
    grid->GetPoints()->Modified();
  };
  movePoint(0, 0.7, 0.7, 0.7);
  Filter rays = MakeCoarse(grid, 16);
  const auto observer = ObserveErrors(rays);
  rays->Update();
  EXPECT_EQ(rays->GetStatistic("NumberOfFoldedCells"), 1);
  ASSERT_EQ(observer->Warnings.size(), 1u);
  EXPECT_TRUE(HasText(observer->Warnings[0], "1 cells are folded inside out"));
  // A point that is not finite, and a repeated one: linear, without the parts that cannot be drawn.
  for (const bool repeated : { false, true })
  {
    grid = MakeCell(CellCases[0], 0.0, 2);
    vtkIdType ids[8] = { 0, 1, 2, 2, 4, 5, 6, 6 };
    if (repeated)
    {
      grid->GetCells()->ReplaceCellAtId(0, 8, ids);
      grid->Modified();
    }
    else
    {
      movePoint(5, NaN, 0.0, 0.0);
    }
    rays = MakeCoarse(grid, 16);
    const auto quiet = ObserveErrors(rays);
    rays->Update();
    EXPECT_LE(rays->GetStatistic("NumberOfTetrahedra"), 6);
    EXPECT_GT(rays->GetStatistic("NumberOfTetrahedra"), 0);
    EXPECT_EQ(rays->GetStatistic("NumberOfCellDivisions"), 0);
  }
  // A point out of range is not read.
  grid = MakeCell(CellCases[0], 0.05, 2);
  const vtkIdType bad[8] = { 0, 1, 2, 3, 4, 5, 6, 1000000 };
  const vtkIdType good[8] = { 0, 1, 2, 3, 4, 5, 6, 7 };
  grid->GetCells()->ReplaceCellAtId(0, 8, bad);
  grid->InsertNextCell(VTK_HEXAHEDRON, 8, good);
  rays = MakeCoarse(grid, 16);
  const auto third = ObserveErrors(rays);
  rays->Update();
  EXPECT_GT(rays->GetStatistic("NumberOfRejectedCells"), 0);
  EXPECT_GT(rays->GetStatistic("NumberOfTetrahedra"), 6);
  // A type without a volume is left out, and the others are drawn.
  grid = MakeCell(CellCases[0], 0.05, 2);
  grid->InsertNextCell(VTK_QUAD, 4, good);
  rays = MakeCoarse(grid, 16);
  const auto fourth = ObserveErrors(rays);
  rays->Update();
  ASSERT_EQ(fourth->Warnings.size(), 1u);
  EXPECT_TRUE(HasText(fourth->Warnings[0], "1 vtkQuad"));
  EXPECT_GT(rays->GetStatistic("NumberOfTetrahedra"), 6);
}

TEST(TrueCells, LinearNeighboursDoNotMisplaceNewPoints)
{
  // Points at a quarter of three edges: the inverse of the shape is singular at a corner. A linear
  // tetrahedron shares a face with that corner.
  const auto make = [](const std::vector<vtkIdType>& linear, bool isFirst)
  {
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    const glm::dvec3 places[11] = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 },
      { 0.25, 0, 0 }, { 0.5, 0.5, 0 }, { 0, 0.25, 0 }, { 0, 0, 0.25 }, { 0.5, 0, 0.5 },
      { 0, 0.5, 0.5 }, { -0.3, 0.2, 0.2 } };
    const double values[11] = { 0, 1, 1, 1, 0.5, 1, 0.5, 0.5, 1, 1, 0.7 };
    vtkNew<vtkDoubleArray> scalars;
    scalars->SetName("s");
    for (int i = 0; i < 11; ++i)
    {
      points->InsertNextPoint(&places[i].x);
      scalars->InsertNextValue(values[i]);
    }
    Grid grid = Grid::New();
    grid->SetPoints(points);
    const vtkIdType curved[10] = { 0, 1, 2, 3, 4, 5, 6, 7, 8, 9 };
    for (const bool turn : { true, false })
    {
      if (turn == isFirst)
      {
        grid->InsertNextCell(VTK_TETRA, 4, linear.data());
      }
      else
      {
        grid->InsertNextCell(VTK_QUADRATIC_TETRA, 10, curved);
      }
    }
    grid->GetPointData()->SetScalars(scalars);
    return grid;
  };
  std::vector<double> first;
  for (const std::vector<vtkIdType>& linear : { std::vector<vtkIdType>{ 10, 0, 2, 3 },
         std::vector<vtkIdType>{ 3, 10, 2, 0 }, std::vector<vtkIdType>{ 2, 3, 0, 10 } })
  {
    for (const bool isFirst : { true, false })
    {
      const Filter rays = MakeAdaptive(make(linear, isFirst), 20);
      rays->SetDivisionTolerance(1e-3);
      rays->Update();
      std::vector<double> found = ValuesOf(rays, "Integral");
      ASSERT_FALSE(found.empty());
      found.push_back(rays->GetStatistic("NumberOfTetrahedra"));
      first = first.empty() ? found : first;
      ASSERT_EQ(found.size(), first.size());
      for (std::size_t i = 0; i < found.size(); ++i)
      {
        EXPECT_NEAR(found[i], first[i], 1e-5) << i;
      }
    }
  }
}

TEST(TrueCells, BlocksMayDifferInComponents)
{
  // Lengths of tuples of one, two and three components, with values up to 2 in each block.
  vtkNew<vtkMultiBlockDataSet> blocks;
  for (int block = 0; block < 3; ++block)
  {
    const Grid grid = MakeCell(CellCases[0], 0.02, 2);
    vtkNew<vtkDoubleArray> vectors;
    vectors->SetName("v");
    vectors->SetNumberOfComponents(block + 1);
    vectors->SetNumberOfTuples(8);
    vectors->FillComponent(0, 0.0);
    for (vtkIdType i = 0; i < 8; ++i)
    {
      const glm::dvec3 at = PointOf(grid, i);
      grid->GetPoints()->SetPoint(i, at[0] + 3.0 * block, at[1], at[2]);
      std::vector<double> tuple(static_cast<std::size_t>(block) + 1, 0.0);
      tuple.back() = 1.0 + static_cast<double>(i % 2);
      vectors->SetTuple(i, tuple.data());
    }
    grid->GetPointData()->AddArray(vectors);
    blocks->SetBlock(static_cast<unsigned int>(block), grid);
  }
  const Filter rays = MakeCoarse(blocks, 40);
  SetRectangle(rays, { 0.0, 0.0, -1.0 }, 7.0);
  rays->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "v");
  rays->SetArrayComponent(-1);
  Enable(rays, { "Maximum", "MaximumDepth", "Minimum", "MinimumDepth" });
  rays->Update();
  int seen = 0;
  for (const double value : ValuesOf(rays, "Maximum"))
  {
    EXPECT_TRUE(std::isnan(value) || (value > 1.0 && value < 2.0 + 1e-6)) << value;
    seen += std::isnan(value) ? 0 : 1;
  }
  EXPECT_GT(seen, 30);
  for (const double value : ValuesOf(rays, "Minimum"))
  {
    EXPECT_TRUE(std::isnan(value) || value > 1.0 - 1e-6) << value;
  }
}

TEST(TrueCells, LengthsOfInterpolatedVectorsAreDrawn)
{
  // A vector that turns along z, in layers: its length is less in a layer than between its ends.
  const Grid grid = Grid::New();
  vtkNew<vtkPoints> points;
  vtkNew<vtkDoubleArray> vectors;
  vectors->SetName("v");
  vectors->SetNumberOfComponents(3);
  constexpr vtkIdType layers = 16;
  for (vtkIdType i = 0; i < 4 * (layers + 1); ++i)
  {
    const double t = static_cast<double>(i / 4) / layers;
    points->InsertNextPoint(i % 4 == 1 || i % 4 == 2 ? 0.5 : -0.5, i % 4 < 2 ? -0.5 : 0.5, 1.2 * t);
    vectors->InsertNextTuple3(1.0 - t, 2.0 * t, 0.0);
  }
  grid->SetPoints(points);
  for (vtkIdType i = 0; i < layers; ++i)
  {
    const vtkIdType ids[] = { 4 * i, 4 * i + 1, 4 * i + 2, 4 * i + 3, 4 * i + 4, 4 * i + 5,
      4 * i + 6, 4 * i + 7 };
    grid->InsertNextCell(VTK_HEXAHEDRON, 8, ids);
  }
  grid->GetPointData()->AddArray(vectors);
  const Filter rays = MakeAdaptive(grid, 12);
  rays->SetDivisionTolerance(1e-4);
  SetRectangle(rays, { 0.0, 0.0, -1.0 }, 0.3);
  rays->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "v");
  rays->SetArrayComponent(-1);
  rays->Update();
  // Integral over [0, 1] of sqrt((1 - t)^2 + 4 t^2), times the height of the cell.
  double truth = 0.0;
  constexpr int steps = 20000;
  for (int i = 0; i < steps; ++i)
  {
    const double t = (i + 0.5) / steps;
    truth += 1.2 / steps * std::hypot(1.0 - t, 2.0 * t);
  }
  for (const double value : ValuesOf(rays, "Integral"))
  {
    EXPECT_NEAR(value, truth, 1e-4 * truth);
  }
}
