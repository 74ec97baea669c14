// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Hidden cells up to the convex hull: their volume, their shape, and pictures that do not show
// them.
#include "RayCastScene.h"

#include <vtkImaginaryCellFilter.h>
#include <vtkTetra.h>

using namespace meniscus::test;

namespace
{

using Corners = std::array<vtkIdType, 3>;

std::array<double, 3> PointOf(vtkUnstructuredGrid* grid, vtkIdType id)
{
  std::array<double, 3> x;
  grid->GetPoint(id, x.data());
  return x;
}

double VolumeOf(vtkUnstructuredGrid* grid, vtkIdType cell)
{
  vtkNew<vtkIdList> ids;
  grid->GetCellPoints(cell, ids);
  std::array<std::array<double, 3>, 4> p;
  std::transform(
    ids->begin(), ids->end(), p.begin(), [grid](vtkIdType id) { return PointOf(grid, id); });
  return std::abs(vtkTetra::ComputeVolume(p[0].data(), p[1].data(), p[2].data(), p[3].data()));
}

/** Six times the volume between a face and a point. */
double SideOf(vtkUnstructuredGrid* grid, const Corners& face, vtkIdType point)
{
  auto a = PointOf(grid, face[0]);
  auto b = PointOf(grid, face[1]);
  auto c = PointOf(grid, face[2]);
  auto d = PointOf(grid, point);
  return 6.0 * vtkTetra::ComputeVolume(a.data(), b.data(), c.data(), d.data());
}

/**
 * Largest sixfold volume by which a point of the mesh is beyond a face that has one cell only: 0
 * for a convex mesh without gaps. Points are compared by their first index of equal coordinates.
 */
double FindDent(vtkUnstructuredGrid* grid)
{
  std::map<std::array<double, 3>, vtkIdType> first;
  std::map<Corners, std::pair<int, vtkIdType>> faces; // number of cells, corner opposite
  vtkNew<vtkIdList> ids;
  for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c)
  {
    grid->GetCellPoints(c, ids);
    std::array<vtkIdType, 4> cell;
    std::transform(ids->begin(), ids->end(), cell.begin(),
      [&](vtkIdType id) { return first.emplace(PointOf(grid, id), id).first->second; });
    for (std::size_t i = 0; i < 4; ++i)
    {
      Corners face{ cell[(i + 1) % 4], cell[(i + 2) % 4], cell[(i + 3) % 4] };
      std::sort(face.begin(), face.end());
      auto& entry = faces[face];
      entry = { entry.first + 1, cell[i] };
    }
  }
  double dent = 0.0;
  for (const auto& face : faces)
  {
    const double inner = SideOf(grid, face.first, face.second.second);
    for (const auto& point : first)
    {
      const double side = face.second.first == 1 ? SideOf(grid, face.first, point.second) : 0.0;
      dent = std::max(dent, inner > 0.0 ? -side : side);
    }
  }
  return dent;
}

/** Picture of a mesh in the view of another one, and the number of cells that are drawn. */
std::pair<FloatImage, vtkTypeInt64> Draw(vtkUnstructuredGrid* grid, vtkUnstructuredGrid* viewed)
{
  RayCastScene scene(
    grid, MakeProperty(FunctionKind::Smooth, viewed, DiagonalOf(viewed->GetBounds())), 96, 96);
  scene.GetRayCaster()->SetBackend(BackendUnderTest());
  LookAt(scene.GetRenderer(), viewed->GetBounds(), 25.0, 15.0);
  const FloatImage image = scene.RenderFloat();
  return { image, scene.GetRayCaster()->GetNumberOfActiveCells() };
}

/** Expects that not a bit of the picture changes by the imaginary cells. */
void ExpectSamePicture(vtkUnstructuredGrid* filled, vtkUnstructuredGrid* mesh)
{
  const auto after = Draw(filled, mesh);
  const auto before = Draw(mesh, mesh);
  EXPECT_EQ(after.second, before.second);
  EXPECT_TRUE(after.first.Rgba == before.first.Rgba);
  EXPECT_GT(*std::max_element(before.first.Rgba.begin(), before.first.Rgba.end()), 0.1f);
}

struct HullCase
{
  const char* Name;
  Region Part;
  double HullVolume;
  double Jitter;
  bool Seam;   ///< each cell has points of its own
  bool Turned; ///< every second cell has the other order of corners
};

class ImaginaryCells : public ::testing::TestWithParam<HullCase>
{
};

/** The mesh of a case: part of a block of 4^3 cubes of six tetrahedra in [-1, 1]^3. */
Grid MakeMesh(const HullCase& hull)
{
  const Grid block = MakeBlock(4, LinearField(0.3, 0.2, -0.4), hull.Part);
  Jitter(block, hull.Jitter, 5);
  std::vector<double> points;
  std::vector<vtkIdType> cells;
  vtkNew<vtkIdList> ids;
  for (vtkIdType p = 0; !hull.Seam && p < block->GetNumberOfPoints(); ++p)
  {
    const auto x = PointOf(block, p);
    points.insert(points.end(), x.begin(), x.end());
  }
  for (vtkIdType c = 0; c < block->GetNumberOfCells(); ++c)
  {
    block->GetCellPoints(c, ids);
    std::array<vtkIdType, 4> cell;
    std::copy(ids->begin(), ids->end(), cell.begin());
    if (hull.Turned && c % 2 == 1)
    {
      std::swap(cell[0], cell[1]);
    }
    for (vtkIdType& id : cell)
    {
      if (hull.Seam)
      {
        const auto x = PointOf(block, id);
        id = static_cast<vtkIdType>(points.size() / 3);
        points.insert(points.end(), x.begin(), x.end());
      }
    }
    cells.insert(cells.end(), cell.begin(), cell.end());
  }
  return meniscus::test::MakeGrid(points, cells, LinearField(0.3, 0.2, -0.4));
}

std::string ErrorsOf(vtkImaginaryCellFilter* filter)
{
  const auto observer = ObserveErrors(filter);
  observer->Observe(filter->GetExecutive());
  filter->Update();
  return observer->GetText();
}

} // anonymous namespace

TEST_P(ImaginaryCells, FillTheHullUnseen)
{
  const HullCase& hull = GetParam();
  const Grid mesh = MakeMesh(hull);
  vtkNew<vtkImaginaryCellFilter> filter;
  if (!filter->HasTetGen())
  {
    GTEST_SKIP() << "built without MENISCUS_WITH_TETGEN";
  }
  filter->SetInputData(mesh);
  ASSERT_EQ(ErrorsOf(filter), "");
  vtkUnstructuredGrid* filled = filter->GetOutput();
  const vtkIdType own = mesh->GetNumberOfCells();
  ASSERT_EQ(filled->GetNumberOfCells(), own + filter->GetNumberOfImaginaryCells());
  EXPECT_EQ(
    filled->GetNumberOfPoints(), mesh->GetNumberOfPoints() + filter->GetNumberOfAddedPoints());
  vtkDataArray* flags = filled->GetCellData()->GetArray("vtkGhostType");
  ASSERT_TRUE(flags);
  double all = 0.0;
  for (vtkIdType c = 0; c < filled->GetNumberOfCells(); ++c)
  {
    EXPECT_EQ(flags->GetComponent(c, 0), c < own ? 0.0 : double(vtkDataSetAttributes::HIDDENCELL));
    all += VolumeOf(filled, c);
  }
  if (hull.HullVolume > 0.0)
  {
    EXPECT_NEAR(all, hull.HullVolume, 1e-12);
  }
  // Rounding of TetGen's added points: its own tolerance of coplanar points.
  EXPECT_LE(FindDent(filled), 1e-8);
  ExpectSamePicture(filled, mesh);
}

INSTANTIATE_TEST_SUITE_P(, ImaginaryCells,
  // The hull of the L lacks the prism beyond the diagonal of its notch.
  ::testing::Values(HullCase{ "L", LShape(), 7.0, 0.0, false, false },
    HullCase{ "Cavity", Shell(0.5, 2.0), 8.0, 0.0, false, false },
    HullCase{ "TwoBlocks", TwoBlocks(1.0), 8.0, 0.0, false, false },
    HullCase{ "Torus", Torus(0.8, 0.4), 0.0, 0.05, false, false },
    HullCase{ "Convex", nullptr, 8.0, 0.0, false, false },
    HullCase{ "PointsOfEachCell", LShape(), 7.0, 0.0, true, false },
    HullCase{ "TurnedCells", Shell(0.5, 2.0), 8.0, 0.0, false, true }),
  [](const ::testing::TestParamInfo<HullCase>& hull) { return std::string(hull.param.Name); });

namespace
{

struct DataCase
{
  const char* Name;
  vtkIdType Cells;     ///< imaginary ones; 0 where TetGen gives up
  vtkIdType Tolerance; ///< between builds of TetGen
};

class ImaginaryCellsOfData : public ::testing::TestWithParam<DataCase>
{
};

} // anonymous namespace

TEST_P(ImaginaryCellsOfData, AreNotSeen)
{
  const Grid mesh = ReadDataMesh(GetParam().Name);
  vtkNew<vtkImaginaryCellFilter> filter;
  if (!mesh || !filter->HasTetGen())
  {
    GTEST_SKIP() << "no data folder, or built without MENISCUS_WITH_TETGEN";
  }
  filter->SetInputData(mesh);
  const std::string errors = ErrorsOf(filter);
  if (GetParam().Cells == 0)
  {
    EXPECT_TRUE(HasText(errors, "The surface crosses itself"));
    EXPECT_EQ(filter->GetOutput()->GetNumberOfCells(), 0);
    return;
  }
  ASSERT_EQ(errors, "");
  EXPECT_NEAR(static_cast<double>(filter->GetNumberOfImaginaryCells()),
    static_cast<double>(GetParam().Cells), static_cast<double>(GetParam().Tolerance));
  ExpectSamePicture(filter->GetOutput(), mesh);
}

INSTANTIATE_TEST_SUITE_P(, ImaginaryCellsOfData,
  ::testing::Values(DataCase{ "blunt_fin", 3538, 40 }, DataCase{ "combustor", 25309, 300 },
    DataCase{ "crushed_can", 0, 0 }),
  [](const ::testing::TestParamInfo<DataCase>& data) { return std::string(data.param.Name); });

TEST(ImaginaryCellsInput, ArraysAndFlagsAreKept)
{
  const Grid mesh = MakeBlock(2, LinearField(1.0, 0.0, 0.0), LShape());
  vtkNew<vtkDoubleArray> values;
  values->SetName("values");
  vtkNew<vtkUnsignedCharArray> flags;
  flags->SetName("vtkGhostType");
  vtkNew<vtkIdTypeArray> ids;
  ids->SetName("ids");
  for (vtkIdType c = 0; c < mesh->GetNumberOfCells(); ++c)
  {
    values->InsertNextValue(3.0 + static_cast<double>(c));
    flags->InsertNextValue(c == 2 ? vtkDataSetAttributes::DUPLICATECELL : 0);
    ids->InsertNextValue(c);
  }
  mesh->GetCellData()->AddArray(values);
  mesh->GetCellData()->AddArray(flags);
  mesh->GetCellData()->SetGlobalIds(ids);
  const vtkIdType corner = 0;
  mesh->InsertNextCell(VTK_VERTEX, 1, &corner);
  values->InsertNextValue(50.0);
  flags->InsertNextValue(0);
  ids->InsertNextValue(99);
  vtkNew<vtkImaginaryCellFilter> filter;
  if (!filter->HasTetGen())
  {
    GTEST_SKIP() << "built without MENISCUS_WITH_TETGEN";
  }
  filter->SetInputData(mesh);
  ASSERT_EQ(ErrorsOf(filter), "");
  vtkUnstructuredGrid* filled = filter->GetOutput();
  ASSERT_GT(filter->GetNumberOfImaginaryCells(), 0);
  const vtkIdType own = mesh->GetNumberOfCells();
  EXPECT_EQ(filled->GetCellType(own - 1), VTK_VERTEX);
  EXPECT_FALSE(filled->GetCellData()->GetGlobalIds());
  vtkDataArray* after = filled->GetCellData()->GetArray("values");
  ASSERT_TRUE(after);
  EXPECT_EQ(after->GetComponent(own - 1, 0), 50.0);
  EXPECT_EQ(after->GetComponent(own, 0), 3.0);
  EXPECT_EQ(filled->GetCellData()->GetArray("vtkGhostType")->GetComponent(2, 0),
    double(vtkDataSetAttributes::DUPLICATECELL));
  double before[2];
  double range[2];
  mesh->GetPointData()->GetScalars()->GetRange(before);
  filled->GetPointData()->GetScalars()->GetRange(range);
  EXPECT_EQ(before[0], range[0]);
  EXPECT_EQ(before[1], range[1]);
}

TEST(ImaginaryCellsInput, FaultsAreErrors)
{
  vtkNew<vtkImaginaryCellFilter> filter;
  const Grid mesh = MakeCubeOfFive(ConstantField(0.0));
  filter->SetInputData(mesh);
  filter->SetMesherProgram("/no/such/program");
  EXPECT_TRUE(HasText(ErrorsOf(filter), "could not be started"));
  EXPECT_EQ(filter->GetOutput()->GetNumberOfCells(), 0);
  filter->SetTimeLimit(0.0);
  EXPECT_TRUE(HasText(ErrorsOf(filter), "TimeLimit must be positive"));
  filter->SetTimeLimit(10.0);
  const Grid empty = Grid::New();
  filter->SetInputData(empty);
  EXPECT_TRUE(HasText(ErrorsOf(filter), "is empty"));
  const Grid wedge = Grid::New();
  wedge->SetPoints(mesh->GetPoints());
  const vtkIdType ids[6] = { 0, 1, 2, 3, 4, 5 };
  wedge->InsertNextCell(VTK_WEDGE, 6, ids);
  filter->SetInputData(wedge);
  EXPECT_TRUE(HasText(ErrorsOf(filter), "1 cells are no linear tetrahedra"));
  vtkNew<vtkPoints> points;
  points->DeepCopy(mesh->GetPoints());
  points->SetPoint(3, 0.0, vtkMath::Nan(), 0.0);
  mesh->SetPoints(points);
  filter->SetInputData(mesh);
  EXPECT_TRUE(HasText(ErrorsOf(filter), "not finite"));
}
