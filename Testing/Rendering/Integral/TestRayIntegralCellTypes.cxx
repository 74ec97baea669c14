// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Cell types: Lagrange and Bezier cells of order 1 are linear cells, those of higher order are
// divided by default, and cells that cannot be drawn or are folded are named.
#include "IntegralScene.h"
#include "TrueCellMeshes.h"

using namespace meniscus::test;

namespace
{

/** The grid with other numbers of types. */
Grid WithTypes(vtkUnstructuredGrid* grid, const std::map<int, int>& types)
{
  Grid copy = Grid::New();
  copy->SetPoints(grid->GetPoints());
  copy->GetPointData()->ShallowCopy(grid->GetPointData());
  vtkNew<vtkIdList> ids;
  for (vtkIdType cell = 0; cell < grid->GetNumberOfCells(); ++cell)
  {
    grid->GetCellPoints(cell, ids);
    const auto found = types.find(grid->GetCellType(cell));
    copy->InsertNextCell(found == types.end() ? grid->GetCellType(cell) : found->second, ids);
  }
  return copy;
}

Filter MakeIntegral(vtkDataObject* input, int size)
{
  Filter rays = MakeFilter(input, size, size, { "Integral" });
  SetRectangle(rays, { 0.3, -0.5, -1.0 }, 1.2);
  return rays;
}

/** A hexahedron of second order, whose middle points of edges are permuted. */
Grid MakePermuted(const std::vector<vtkIdType>& order)
{
  Grid grid = MakeCell({ "", VTK_QUADRATIC_HEXAHEDRON, 20 }, 0.0, 1);
  grid->GetCells()->ReplaceCellAtId(0, 20, order.data());
  grid->Modified();
  return grid;
}

std::string TextOf(const ErrorObserver* observer)
{
  std::string text;
  for (const std::string& warning : observer->Warnings)
  {
    text += warning + "\n";
  }
  return text;
}

}

TEST(CellTypes, OrderOneIsLinear)
{
  const std::map<int, int> lagrange{ { VTK_TETRA, VTK_LAGRANGE_TETRAHEDRON },
    { VTK_HEXAHEDRON, VTK_LAGRANGE_HEXAHEDRON }, { VTK_WEDGE, VTK_LAGRANGE_WEDGE },
    { VTK_PYRAMID, VTK_LAGRANGE_PYRAMID } };
  const std::map<int, int> bezier{ { VTK_TETRA, VTK_BEZIER_TETRAHEDRON },
    { VTK_HEXAHEDRON, VTK_BEZIER_HEXAHEDRON }, { VTK_WEDGE, VTK_BEZIER_WEDGE },
    { VTK_PYRAMID, VTK_BEZIER_PYRAMID } };
  const Grid mixed = MakeMixedBlock(2, false, 5);
  const Grid tetrahedra =
    MakeSolids([](double x, double y, double) { return 1.0 + x * y; }).at(1).Mesh;
  for (const Grid& grid : { mixed, tetrahedra })
  {
    for (const auto& types : { lagrange, bezier })
    {
      for (const bool adaptive : { false, true })
      {
        const Filter linear = MakeIntegral(grid, 24);
        const Filter same = MakeIntegral(WithTypes(grid, types), 24);
        const auto observer = ObserveErrors(same);
        for (const Filter& rays : { linear, same })
        {
          rays->SetCellDivision(adaptive ? rays->ADAPTIVE_DIVISION : rays->FIXED_DIVISION);
          rays->SetMaximumNumberOfPieces(1 << 25);
          rays->Update();
        }
        EXPECT_EQ(ValuesOf(same, "Integral"), ValuesOf(linear, "Integral"));
        EXPECT_GT(ValuesOf(same, "Integral").size(), 0u);
        EXPECT_EQ(
          same->GetStatistic("NumberOfTetrahedra"), linear->GetStatistic("NumberOfTetrahedra"));
        EXPECT_TRUE(observer->Warnings.empty()) << TextOf(observer);
      }
    }
  }
}

TEST(CellTypes, HigherOrdersAreDrawnByDefault)
{
  for (const CellCase& shape : CellCases)
  {
    if (shape.Type < VTK_LAGRANGE_CURVE)
    {
      continue; // they have a fixed division
    }
    SCOPED_TRACE(shape.Name);
    const Grid grid = MakeCell(shape, 0.01, 3);
    std::vector<double> adaptive;
    for (const bool isFixed : { false, true })
    {
      const Filter rays = MakeIntegral(grid, 8);
      EXPECT_EQ(rays->GetCellDivision(), rays->FIXED_DIVISION);
      if (!isFixed)
      {
        rays->SetCellDivisionToAdaptive();
      }
      rays->SetDivisionTolerance(0.01);
      rays->SetMaximumNumberOfPieces(500); // Bezier cells are slow in VTK
      rays->Update();
      EXPECT_EQ(rays->GetStatistic("NumberOfCellDivisions"), 1);
      EXPECT_GT(rays->GetStatistic("NumberOfTetrahedra"), 6);
      // TrueCellTypes compares the values of the adaptive division with the truth.
      const std::vector<double> found = ValuesOf(rays, "Integral");
      adaptive = isFixed ? adaptive : found;
      EXPECT_EQ(found, adaptive);
      EXPECT_GT(*std::max_element(found.begin(), found.end()), 0.0);
    }
  }
}

TEST(CellTypes, CellsThatVTKCannotEvaluateAreNamed)
{
  const Grid grid = MakeCell(CellCases[0], 0.0, 2);
  vtkIdType ids[14];
  for (vtkIdType i = 0; i < 14; ++i)
  {
    ids[i] = grid->GetPoints()->InsertNextPoint(0.1 * i, 0.2, i % 3);
    grid->GetPointData()->GetScalars()->InsertTuple(
      ids[i], ids[0] - 1, grid->GetPointData()->GetScalars());
  }
  grid->InsertNextCell(VTK_LAGRANGE_PYRAMID, 14, ids);
  grid->InsertNextCell(VTK_TRIANGLE, 3, ids);
  for (const bool adaptive : { false, true })
  {
    const Filter rays = MakeIntegral(grid, 8);
    rays->SetCellDivision(adaptive ? rays->ADAPTIVE_DIVISION : rays->FIXED_DIVISION);
    const auto observer = ObserveErrors(rays);
    rays->Update();
    const std::string text = TextOf(observer);
    EXPECT_TRUE(HasText(text, "VTK cannot evaluate this type; write linear or quadratic cells"));
    EXPECT_TRUE(HasText(text, "1 vtkTriangle (without a volume)"));
    EXPECT_GT(rays->GetStatistic("NumberOfTetrahedra"), 4);
  }
}

TEST(CellTypes, FoldedCellsOfSecondOrderAreCounted)
{
  const std::vector<vtkIdType> vtkOrder{ 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16,
    17, 18, 19 };
  // The order of Exodus and others: edges along z come before those of the upper face.
  std::vector<vtkIdType> other = vtkOrder;
  std::rotate(other.begin() + 12, other.begin() + 16, other.end());
  for (const auto& [adaptive, right] : Product(List(false, true), List(true, false)))
  {
    const Filter rays = MakeIntegral(MakePermuted(right ? vtkOrder : other), 8);
    rays->SetCellDivision(adaptive ? rays->ADAPTIVE_DIVISION : rays->FIXED_DIVISION);
    rays->SetDivisionTolerance(0.1);
    const auto observer = ObserveErrors(rays);
    rays->Update();
    EXPECT_EQ(rays->GetStatistic("NumberOfFoldedCells"), right ? 0 : 1) << adaptive;
    const std::string text = TextOf(observer);
    EXPECT_EQ(text.find("1 cells are folded inside out") == std::string::npos, right) << text;
    EXPECT_EQ(observer->Warnings.size(), right ? 0u : 1u) << text;
  }
  // Points in the middle of the edges, and all of them displaced a little: no cell is folded.
  for (const CellCase& shape : CellCases)
  {
    for (const double displacement : { 0.0, 0.02 })
    {
      const Filter rays = MakeIntegral(MakeCell(shape, displacement, 4), 4);
      rays->SetCellDivisionToFixed();
      rays->Update();
      EXPECT_EQ(rays->GetStatistic("NumberOfFoldedCells"), 0) << shape.Name << " " << displacement;
    }
  }
}

// Points in the order of another type or program. Cells with collapsed edges, mirrored ones and
// those with faces that are not planes are no error.
TEST(CellTypes, FoldedLinearCellsAreCounted)
{
  struct Order
  {
    const char* Name;
    CellCase Shape;
    std::vector<vtkIdType> Points;
    int Folded;
  };
  const CellCase hexahedron{ "", VTK_HEXAHEDRON, 8 };
  const CellCase wedge{ "", VTK_WEDGE, 6 };
  const CellCase pyramid{ "", VTK_PYRAMID, 5 };
  const Order orders[] = { { "voxel", hexahedron, { 0, 1, 3, 2, 4, 5, 7, 6 }, 1 },
    { "exchanged", hexahedron, { 0, 1, 2, 3, 4, 5, 7, 6 }, 1 },
    { "mirrored", hexahedron, { 4, 5, 6, 7, 0, 1, 2, 3 }, 0 },
    { "collapsed", hexahedron, { 0, 1, 2, 2, 4, 5, 6, 6 }, 0 },
    { "hexahedron", hexahedron, { 0, 1, 2, 3, 4, 5, 6, 7 }, 0 },
    { "exchanged wedge", wedge, { 0, 1, 2, 3, 5, 4 }, 1 },
    { "mirrored wedge", wedge, { 0, 2, 1, 3, 5, 4 }, 0 },
    { "crossed pyramid", pyramid, { 0, 2, 1, 3, 4 }, 1 },
    { "mirrored pyramid", pyramid, { 0, 3, 2, 1, 4 }, 0 } };
  for (const Order& order : orders)
  {
    Grid grid = MakeCell(order.Shape, 0.02, 1);
    grid->GetCells()->ReplaceCellAtId(
      0, static_cast<vtkIdType>(order.Points.size()), order.Points.data());
    grid->Modified();
    const Filter rays = MakeIntegral(grid, 8);
    const auto observer = ObserveErrors(rays);
    rays->Update();
    EXPECT_EQ(rays->GetStatistic("NumberOfFoldedCells"), order.Folded) << order.Name;
    const bool isTold = TextOf(observer).find("folded inside out") != std::string::npos;
    EXPECT_EQ(isTold, order.Folded > 0) << order.Name << TextOf(observer);
  }
}
