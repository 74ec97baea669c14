// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Adaptive division of cells in frames and picks: opacities and picked values compared with closed
// forms of a trilinear field, and the counters of a mapper whose cells are divided.
#include "RayCastScene.h"

#include <vtkTetrahedraVolumePicker.h>

using namespace meniscus::test;

namespace
{

constexpr int Size = 48;
/** Half the height of the view. */
constexpr double Half = 1.2;
/** Cells along an axis, in [-1, 1]^3. */
constexpr int Cells = 3;
constexpr double CellSize = 2.0 / Cells;
/** Attenuation at a scalar of 1; it is linear in the scalar. */
constexpr double Attenuation = 1.5;
constexpr double Tolerance = 1e-3;

int IndexOf(const glm::ivec3& point)
{
  return (point.z * (Cells + 1) + point.y) * (Cells + 1) + point.x;
}

/** Voxels with values in [0, 1] at random: trilinear, and far from linear. */
Grid MakeVoxels(unsigned int seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> value(0.0, 1.0);
  Grid grid = Grid::New();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkDoubleArray> scalars;
  scalars->SetName("s");
  for (const auto& [z, y, x] : Product(Cells + 1, Cells + 1, Cells + 1))
  {
    points->InsertNextPoint(CellSize * x - 1.0, CellSize * y - 1.0, CellSize * z - 1.0);
    scalars->InsertNextValue(value(random));
  }
  grid->SetPoints(points);
  grid->GetPointData()->SetScalars(scalars);
  for (int i = 0; i < Cells * Cells * Cells; ++i)
  {
    const glm::ivec3 cell(i % Cells, i / Cells % Cells, i / Cells / Cells);
    vtkIdType ids[8];
    for (int corner = 0; corner < 8; ++corner)
    {
      ids[corner] = IndexOf(cell + glm::ivec3(corner & 1, corner >> 1 & 1, corner >> 2 & 1));
    }
    grid->InsertNextCell(VTK_VOXEL, 8, ids);
  }
  return grid;
}

glm::ivec3 CellAt(const glm::dvec3& position)
{
  return glm::clamp(
    glm::ivec3(glm::floor((position + 1.0) / CellSize)), glm::ivec3(0), glm::ivec3(Cells - 1));
}

/** The trilinear field, evaluated in its own way. */
double ValueAt(vtkUnstructuredGrid* grid, const glm::dvec3& position)
{
  const glm::ivec3 cell = CellAt(position);
  const glm::dvec3 t = (position + 1.0) / CellSize - glm::dvec3(cell);
  double sum = 0.0;
  for (int corner = 0; corner < 8; ++corner)
  {
    const glm::ivec3 upper(corner & 1, corner >> 1 & 1, corner >> 2 & 1);
    const glm::dvec3 u(upper);
    const glm::dvec3 weight = u * t + (1.0 - u) * (1.0 - t);
    sum += weight.x * weight.y * weight.z *
      grid->GetPointData()->GetScalars()->GetTuple1(IndexOf(cell + upper));
  }
  return sum;
}

/** Along z the field is linear in each cell, so its integral is that of the trapezoidal rule. */
double OpticalDepthAt(vtkUnstructuredGrid* grid, double x, double y)
{
  double sum = 0.0;
  for (int i = 0; i < Cells; ++i)
  {
    const double low = CellSize * i - 1.0;
    sum +=
      0.5 * CellSize * (ValueAt(grid, { x, y, low }) + ValueAt(grid, { x, y, low + CellSize }));
  }
  return Attenuation * sum;
}

vtkSmartPointer<vtkVolumeProperty> MakeLinearProperty()
{
  auto property = MakeConstantProperty(1.0, 1.0, 1.0, 1.0, 1.0 / Attenuation);
  property->SetScalarOpacity(MakeOpacity({ { 0.0, 0.0 }, { 1.0, 1.0 } }));
  return property;
}

/** The voxels, seen along -z without perspective. */
struct VoxelScene
{
  VoxelScene()
    : Mesh(MakeVoxels(7))
    , Scene(Mesh, MakeLinearProperty(), Size, Size)
    , Mapper(Scene.GetRayCaster())
  {
    vtkCamera* camera = this->Scene.GetRenderer()->GetActiveCamera();
    camera->ParallelProjectionOn();
    camera->SetPosition(0.0, 0.0, 5.0);
    camera->SetFocalPoint(0.0, 0.0, 0.0);
    camera->SetParallelScale(Half);
    camera->SetClippingRange(0.1, 100.0);
    this->Mapper->SetDivisionTolerance(Tolerance);
    this->Mapper->SetMaximumNumberOfPieces(1 << 25);
  }

  /** Largest difference between the opacity of a frame and its closed form. */
  double WorstOpacity()
  {
    const FloatImage image = this->Scene.RenderFloat();
    double worst = 0.0;
    for (const auto& [row, column] : Product(Size, Size))
    {
      const double x = PlaceOf(column);
      const double y = PlaceOf(row);
      if (std::max(std::abs(x), std::abs(y)) < 1.0)
      {
        const double found = image.GetPixel(column, row)[3];
        const double truth = -std::expm1(-OpticalDepthAt(this->Mesh, x, y));
        worst = std::max(worst, std::abs(found - truth));
      }
    }
    return worst;
  }

  static double PlaceOf(int pixel) { return Half * (2.0 * (pixel + 0.5) / Size - 1.0); }

  Grid Mesh;
  RayCastScene Scene;
  vtkTetrahedraRayCastMapper* Mapper;
};

// A tetrahedron holds a quadratic function within 1.5 times the tolerance, so the optical depth of
// a way of 2 is off by no more than twice that, and the opacity by less. A trilinear function is
// cubic inside, which the factor of 2 covers.
constexpr double OpacityBound = 2.0 * 1.5 * Tolerance * Attenuation * 2.0;

}

TEST(TetrahedraRayCastTrueCells, FramesShowTheTrilinearField)
{
  VoxelScene scene;
  const double fixed = scene.WorstOpacity();
  EXPECT_EQ(scene.Mapper->GetStatistic("NumberOfCellDivisions"), 0);
  scene.Mapper->SetCellDivisionToAdaptive();
  const double adaptive = scene.WorstOpacity();
  EXPECT_EQ(scene.Mapper->GetStatistic("NumberOfCellDivisions"), 1);
  EXPECT_EQ(scene.Mapper->GetNumberOfLostRays(), 0);
  EXPECT_EQ(scene.Mapper->GetStatistic("NumberOfUnresolvedEdges"), 0);
  EXPECT_LE(adaptive, OpacityBound);
  EXPECT_GT(fixed, 4.0 * OpacityBound);
}

TEST(TetrahedraRayCastTrueCells, FramesAndScalarsCostNoDivision)
{
  VoxelScene scene;
  scene.Mapper->SetCellDivisionToAdaptive();
  scene.Scene.GetWindow()->Render();
  for (int step = 0; step < 3; ++step)
  {
    scene.Scene.GetRenderer()->GetActiveCamera()->Azimuth(10.0);
    scene.Scene.GetWindow()->Render();
  }
  EXPECT_EQ(scene.Mapper->GetNumberOfMeshBuilds(), 1);
  EXPECT_EQ(scene.Mapper->GetNumberOfScalarUpdates(), 1);
  scene.Scene.GetRenderer()->GetActiveCamera()->Azimuth(-30.0);
  vtkDataArray* scalars = scene.Mesh->GetPointData()->GetScalars();
  for (vtkIdType i = 0; i < scalars->GetNumberOfTuples(); ++i)
  {
    scalars->SetTuple1(i, 0.5 + 0.5 * scalars->GetTuple1(i));
  }
  scalars->Modified();
  EXPECT_LE(scene.WorstOpacity(), OpacityBound);
  EXPECT_EQ(scene.Mapper->GetNumberOfMeshBuilds(), 1);
  EXPECT_EQ(scene.Mapper->GetNumberOfScalarUpdates(), 2);
  EXPECT_EQ(scene.Mapper->GetStatistic("NumberOfCellDivisions"), 1);
  // Without the division it is another mesh.
  scene.Mapper->SetCellDivisionToFixed();
  EXPECT_GT(scene.WorstOpacity(), OpacityBound);
  EXPECT_EQ(scene.Mapper->GetNumberOfMeshBuilds(), 2);
}

TEST(TetrahedraRayCastTrueCells, PicksYieldTheFieldAndTheCellOfTheInput)
{
  VoxelScene scene;
  scene.Mapper->SetCellDivisionToAdaptive();
  vtkNew<vtkTetrahedraVolumePicker> picker;
  picker->SetPlaceToOpacityReached();
  picker->SetOpacityThreshold(0.2);
  int picked = 0;
  for (int pixel = 6; pixel < Size - 6; pixel += 5)
  {
    ASSERT_EQ(picker->Pick(pixel, Size - 1 - pixel, 0.0, scene.Scene.GetRenderer()), 1);
    glm::dvec3 position;
    picker->GetPickPosition(&position.x);
    EXPECT_NEAR(picker->GetValue(), ValueAt(scene.Mesh, position), 2.0 * 1.5 * Tolerance);
    const glm::ivec3 cell = CellAt(position);
    const double share = (position.z + 1.0) / CellSize;
    if (std::abs(share - std::round(share)) > 1e-4)
    {
      EXPECT_EQ(picker->GetCellId(), (cell.z * Cells + cell.y) * Cells + cell.x);
      ++picked;
    }
  }
  EXPECT_GE(picked, 4);
}

namespace
{

/** A room with a plume that rises from a source, on hexahedra that are finer near the walls. */
Grid MakeRoom()
{
  constexpr int n[3] = { 6, 5, 4 };
  Grid grid = Grid::New();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkDoubleArray> scalars;
  scalars->SetName("s");
  const auto placeOf = [](int i, int count) { return -std::cos(3.14159265 * i / count); };
  for (const auto& [k, j, i] : Product(n[2] + 1, n[1] + 1, n[0] + 1))
  {
    const glm::dvec3 at(placeOf(i, n[0]), 0.8 * placeOf(j, n[1]), 0.6 * placeOf(k, n[2]));
    points->InsertNextPoint(&at.x);
    const double width = 0.15 + 0.2 * (at.z + 0.6);
    const double away = std::hypot(at.x - 0.2 * at.z, at.y) / width;
    scalars->InsertNextValue(std::exp(-away * away) + 0.5 * std::max(at.z, 0.0));
  }
  grid->SetPoints(points);
  grid->GetPointData()->SetScalars(scalars);
  for (int cell = 0; cell < n[0] * n[1] * n[2]; ++cell)
  {
    const int dy = n[0] + 1;
    const int dz = dy * (n[1] + 1);
    const vtkIdType o = cell % n[0] + cell / n[0] % n[1] * dy + cell / (n[0] * n[1]) * dz;
    const vtkIdType ids[8] = { o, o + 1, o + dy + 1, o + dy, o + dz, o + dz + 1, o + dz + dy + 1,
      o + dz + dy };
    grid->InsertNextCell(VTK_HEXAHEDRON, 8, ids);
  }
  return grid;
}

double LargestDifference(const FloatImage& a, const FloatImage& b)
{
  double worst = 0.0;
  for (const auto& [row, column, channel] : Product(Size, Size, Below<std::size_t>(4)))
  {
    worst = std::max(worst,
      static_cast<double>(
        std::abs(a.GetPixel(column, row)[channel] - b.GetPixel(column, row)[channel])));
  }
  return worst;
}

}

TEST(TetrahedraRayCastTrueCells, ARoomEndsWithinItsBudgetAndReportsItsError)
{
  const Grid room = MakeRoom();
  const double range[2] = { 0.0, 1.0 };
  const auto property = MakeProperty(FunctionKind::Smooth, range, 2.0);
  RayCastScene scene(room, property, Size, Size);
  LookAt(scene.GetRenderer(), room->GetBounds(), 25.0, 15.0);
  vtkTetrahedraRayCastMapper* mapper = scene.GetRayCaster();
  const double fixed = [&]()
  {
    scene.GetWindow()->Render();
    return mapper->GetStatistic("NumberOfTetrahedra");
  }();
  EXPECT_EQ(mapper->GetStatistic("DivisionError"), 0.0);
  const FloatImage split = scene.RenderFloat();
  mapper->SetCellDivisionToAdaptive();
  mapper->SetDivisionTolerance(2e-3);
  mapper->SetMaximumNumberOfPieces(1 << 25);
  const FloatImage fine = scene.RenderFloat();
  EXPECT_LE(mapper->GetStatistic("DivisionError"), 2e-3);
  const double before = LargestDifference(split, fine);
  mapper->SetDivisionTolerance(1.0 / 256.0);
  double last = 1.0;
  for (const double budget : { 1.5, 3.0, 8.0, 0.0 })
  {
    const auto told = ObserveErrors(mapper);
    mapper->SetMaximumNumberOfPieces(static_cast<vtkTypeInt64>(budget * fixed));
    const FloatImage image = scene.RenderFloat();
    const double limit = budget > 0.0 ? budget * fixed : 100000.0;
    EXPECT_LE(mapper->GetStatistic("NumberOfTetrahedra"), limit);
    const double error = mapper->GetStatistic("DivisionError");
    EXPECT_EQ(told->Warnings.size(), error > mapper->GetDivisionTolerance() ? 1u : 0u) << budget;
    const double difference = LargestDifference(image, fine);
    std::printf("budget %.1f: %lld tetrahedra, error %.3g, picture %.3g of %.3g\n", budget,
      static_cast<long long>(mapper->GetStatistic("NumberOfTetrahedra")), error, difference,
      before);
    // The bounds of ErrorScale (2) and of a tetrahedron (1.5), and the fine division's own error.
    EXPECT_LE(difference, 3.0 * (error + 2e-3)) << budget;
    EXPECT_LT(error, last);
    EXPECT_LT(difference, before);
    last = error;
    mapper->RemoveObserver(told);
  }
  // The default budget is enough for the default tolerance here.
  EXPECT_LE(last, 1.0 / 256.0);
}
