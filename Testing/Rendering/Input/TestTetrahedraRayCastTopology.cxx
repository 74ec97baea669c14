// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Repeated cells, and cells that share no points: the image of the same cells as a mesh.
#include "RayCastScene.h"

#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkRenderWindow.h>
#include <vtkUnstructuredGrid.h>
#include <vtkVolume.h>
#include <vtkVolumeMapper.h>
#include <vtkVolumeProperty.h>

#include <algorithm>
#include <cmath>
#include <random>

using namespace meniscus::test;

namespace
{

constexpr int Size = 120;
constexpr double Range[2] = { -1.0, 1.0 };
constexpr double Bounds[6] = { -1, 1, -1, 1, -1, 1 };
constexpr int Backends[3] = { vtkTetrahedraRayCastMapper::OPENGL,
  vtkTetrahedraRayCastMapper::COMPUTE, vtkTetrahedraRayCastMapper::NATIVE };

vtkSmartPointer<vtkVolumeProperty> smooth()
{
  return makeProperty(FunctionKind::Smooth, Range, 3.4);
}

struct Drawn
{
  FloatImage Image;
  vtkTypeInt64 Rejected = 0;
  vtkTypeInt64 Steps = 0;
};

/**
 * Image of any input by one backend; no ray may be lost, and no message but a warning may be
 * issued.
 */
Drawn draw(vtkDataObject* input, int backend, vtkVolumeProperty* property = nullptr,
  int blendMode = vtkVolumeMapper::COMPOSITE_BLEND)
{
  RayCastScene scene(nullptr, property ? property : smooth().Get(), Size, Size);
  const auto observer = vtkSmartPointer<ErrorObserver>::Take(ErrorObserver::New());
  observer->observe(scene.rayCaster());
  scene.rayCaster()->SetBackend(backend);
  scene.rayCaster()->SetBlendMode(blendMode);
  scene.rayCaster()->SetInputDataObject(input);
  lookAt(scene.renderer(), Bounds, 25.0, 15.0);
  Drawn drawn;
  drawn.Image = scene.renderFloat();
  drawn.Rejected = scene.rayCaster()->GetNumberOfRejectedCells();
  drawn.Steps = scene.rayCaster()->GetNumberOfTraversalSteps();
  EXPECT_EQ(scene.rayCaster()->GetNumberOfLostRays(), 0);
  EXPECT_TRUE(observer->Errors.empty()) << observer->text();
  return drawn;
}

/**
 * The cells of a grid in random order, each one to three times. Cell data is copied, and a
 * repetition has another value than the first occurrence.
 */
Grid doubled(vtkUnstructuredGrid* grid, unsigned int seed, vtkTypeInt64& copies)
{
  std::mt19937 random(seed);
  std::vector<vtkIdType> order;
  for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c)
  {
    order.insert(order.end(), 1 + random() % 3, c);
  }
  std::shuffle(order.begin(), order.end(), random);
  copies = static_cast<vtkTypeInt64>(order.size()) - grid->GetNumberOfCells();
  const Grid result = Grid::New();
  result->SetPoints(grid->GetPoints());
  result->GetPointData()->ShallowCopy(grid->GetPointData());
  vtkDataArray* values = grid->GetCellData()->GetScalars();
  vtkNew<vtkDoubleArray> copied;
  copied->SetName(values ? values->GetName() : "none");
  std::vector<char> met(static_cast<std::size_t>(grid->GetNumberOfCells()), 0);
  vtkNew<vtkIdList> ids;
  for (const vtkIdType cell : order)
  {
    grid->GetCellPoints(cell, ids);
    result->InsertNextCell(grid->GetCellType(cell), ids);
    if (values)
    {
      const double value = values->GetComponent(cell, 0);
      copied->InsertNextValue(met[cell] ? -value : value);
      met[cell] = 1;
    }
  }
  if (values)
  {
    result->GetCellData()->SetScalars(copied);
  }
  return result;
}

/** n^3 hexahedra that fill the bounds. */
Grid hexahedra(int n)
{
  const Grid grid = Grid::New();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkDoubleArray> scalars;
  scalars->SetName(ScalarName);
  const auto at = [n](int i, int j, int k) { return vtkIdType{ (k * (n + 1) + j) * (n + 1) + i }; };
  for (int k = 0; k <= n; ++k)
  {
    for (int j = 0; j <= n; ++j)
    {
      for (int i = 0; i <= n; ++i)
      {
        const double x[3] = { 2.0 * i / n - 1.0, 2.0 * j / n - 1.0, 2.0 * k / n - 1.0 };
        points->InsertNextPoint(x);
        scalars->InsertNextValue(0.5 * x[0] - 0.3 * x[1] + 0.2 * x[2]);
      }
    }
  }
  grid->SetPoints(points);
  grid->GetPointData()->SetScalars(scalars);
  for (int k = 0; k < n; ++k)
  {
    for (int j = 0; j < n; ++j)
    {
      for (int i = 0; i < n; ++i)
      {
        const vtkIdType ids[8] = { at(i, j, k), at(i + 1, j, k), at(i + 1, j + 1, k),
          at(i, j + 1, k), at(i, j, k + 1), at(i + 1, j, k + 1), at(i + 1, j + 1, k + 1),
          at(i, j + 1, k + 1) };
        grid->InsertNextCell(VTK_HEXAHEDRON, 8, ids);
      }
    }
  }
  return grid;
}

/** Each tetrahedron with its own points, shrunk about their mean; the field is that of the mesh. */
Grid apart(vtkUnstructuredGrid* grid, double factor, const Field& field)
{
  std::vector<double> points;
  std::vector<vtkIdType> cells;
  vtkNew<vtkIdList> ids;
  for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c)
  {
    grid->GetCellPoints(c, ids);
    double x[4][3];
    double mean[3] = { 0.0, 0.0, 0.0 };
    for (int i = 0; i < 4; ++i)
    {
      grid->GetPoint(ids->GetId(i), x[i]);
      for (int k = 0; k < 3; ++k)
      {
        mean[k] += 0.25 * x[i][k];
      }
    }
    for (auto& point : x)
    {
      for (int k = 0; k < 3; ++k)
      {
        points.push_back(factor == 1.0 ? point[k] : mean[k] + factor * (point[k] - mean[k]));
      }
      cells.push_back(static_cast<vtkIdType>(cells.size()));
    }
  }
  return makeGrid(points, cells, field);
}

} // anonymous namespace

TEST(TetrahedraRayCastTopology, CellsGivenRepeatedlyCountOnce)
{
  for (const Grid& grid : { makeCubeOfSix(radialField()), makeBlock(4, wavyField(3.0)) })
  {
    for (const int backend : Backends)
    {
      const FloatImage once = draw(grid, backend).Image;
      for (unsigned int seed = 0; seed < 2; ++seed)
      {
        vtkTypeInt64 copies = 0;
        const Drawn drawn = draw(doubled(grid, seed, copies), backend);
        expectSamePicture(drawn.Image, once, "seed " + std::to_string(seed));
        EXPECT_EQ(drawn.Rejected, copies);
      }
    }
  }
}

TEST(TetrahedraRayCastTopology, DoubledMeshMatchesTheReferenceOfTheMesh)
{
  const Grid grid = makeBlock(5, wavyField(3.0));
  vtkTypeInt64 copies = 0;
  const Grid given = doubled(grid, 17, copies);
  for (const int backend : Backends)
  {
    RayCastScene single(grid, smooth(), Size, Size);
    lookAt(single.renderer(), Bounds, 40.0, 20.0);
    single.window()->Render();
    const SceneTruth truth = makeTruth(single);
    RayCastScene scene(given, smooth(), Size, Size);
    scene.rayCaster()->SetBackend(backend);
    lookAt(scene.renderer(), Bounds, 40.0, 20.0);
    expectMatch(
      compareToReference(scene.renderFloat(), truth.Image, *truth.Integrator, truth.RayOf),
      "doubled");
  }
}

TEST(TetrahedraRayCastTopology, HexahedraGivenRepeatedly)
{
  const Grid grid = hexahedra(4);
  for (const int backend : Backends)
  {
    const FloatImage once = draw(grid, backend).Image;
    vtkTypeInt64 copies = 0;
    const Drawn drawn = draw(doubled(grid, 3, copies), backend);
    expectSamePicture(drawn.Image, once, "hexahedra");
    EXPECT_EQ(drawn.Rejected, 6 * copies);
  }
}

TEST(TetrahedraRayCastTopology, FirstOfRepeatedCellsGivesTheValue)
{
  const Grid grid = makeBlock(4, constantField(0.0));
  vtkNew<vtkDoubleArray> values;
  values->SetName("PerCell");
  for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c)
  {
    values->InsertNextValue(std::sin(1.7 * static_cast<double>(c)));
  }
  grid->GetPointData()->Initialize();
  grid->GetCellData()->SetScalars(values);
  for (const int backend : Backends)
  {
    vtkTypeInt64 copies = 0;
    expectSamePicture(
      draw(doubled(grid, 8, copies), backend).Image, draw(grid, backend).Image, "cell data");
  }
}

TEST(TetrahedraRayCastTopology, CellsOfSeveralBlocksCountOnce)
{
  // The second block repeats the first one, partly in another order, with copied points.
  const Grid grid = makeBlock(4, wavyField(3.0));
  vtkTypeInt64 copies = 0;
  const Grid again = doubled(grid, 2, copies);
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, grid);
  blocks->SetBlock(1, again);
  for (const int backend : Backends)
  {
    const Drawn drawn = draw(blocks, backend);
    expectSamePicture(drawn.Image, draw(grid, backend).Image, "blocks");
    EXPECT_EQ(drawn.Rejected, grid->GetNumberOfCells() + copies);
  }
}

TEST(TetrahedraRayCastTopology, FaceOfThreeAndFourCellsHidesNone)
{
  // Two cells on each side of a face; those on one side overlap: a ray sees the union of the cells.
  // Along z the union extends between the planes of the lower and of the upper apexes.
  const std::vector<double> points{ 0, 0, 0, 1, 0, 0, 0, 1, 0, 0.2, 0.2, 1, 0.4, 0.3, 0.8, 0.2, 0.3,
    -1, 0.5, 0.2, -0.6 };
  const std::vector<vtkIdType> all{ 0, 1, 2, 3, 0, 1, 2, 4, 0, 1, 2, 5, 0, 1, 2, 6 };
  for (const std::size_t count : { 3, 4 })
  {
    const Grid grid = makeGrid(points,
      std::vector<vtkIdType>(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(4 * count)),
      constantField(0.5));
    // Each with its own points: no face is shared.
    const Grid separate = apart(grid, 1.0, constantField(0.5));
    for (const int backend : Backends)
    {
      expectSamePicture(draw(grid, backend).Image, draw(separate, backend).Image,
        std::to_string(count) + " cells at a face");
    }
  }
}

TEST(TetrahedraRayCastTopology, CellsWithPointsOfTheirOwnLookLikeTheMesh)
{
  const Field field = wavyField(2.0);
  const Grid grid = makeBlock(7, field);
  const Grid separate = apart(grid, 1.0, field);
  for (const int backend : Backends)
  {
    for (const int mode : { vtkVolumeMapper::COMPOSITE_BLEND,
           vtkVolumeMapper::MAXIMUM_INTENSITY_BLEND, vtkVolumeMapper::AVERAGE_INTENSITY_BLEND })
    {
      const Drawn mesh = draw(grid, backend, nullptr, mode);
      const Drawn cells = draw(separate, backend, nullptr, mode);
      expectSamePicture(cells.Image, mesh.Image, "mode " + std::to_string(mode));
      // The same cells are crossed, except for cells that rays touch in an edge only.
      EXPECT_NEAR(static_cast<double>(cells.Steps) / static_cast<double>(mesh.Steps), 1.0, 0.01);
    }
  }
}

TEST(TetrahedraRayCastTopology, ShrunkCellsMatchTheReference)
{
  const Field field = wavyField(2.0);
  for (const double factor : { 0.999, 0.6 })
  {
    const Grid separate = apart(makeBlock(6, field), factor, field);
    for (const int backend : Backends)
    {
      RayCastScene scene(separate, smooth(), Size, Size);
      scene.rayCaster()->SetBackend(backend);
      lookAt(scene.renderer(), Bounds, 40.0, 20.0);
      expectMatchesReference(
        scene, "shrunk to " + std::to_string(factor), SilhouetteAllowance{ 0.02, 1 });
    }
  }
}

TEST(TetrahedraRayCastTopology, ListsOfEntriesAreMadeWhereRaysOrBoundaryChange)
{
  const Field field = wavyField(2.0);
  RayCastScene scene(apart(makeBlock(6, field), 0.9, field), smooth(), Size, Size);
  vtkTetrahedraRayCastMapper* mapper = scene.rayCaster();
  mapper->SetBackend(vtkTetrahedraRayCastMapper::OPENGL);
  lookAt(scene.renderer(), Bounds, 40.0, 20.0);
  scene.window()->Render();
  EXPECT_EQ(mapper->GetNumberOfEntryListBuilds(), 1);
  scene.window()->Render();
  scene.volume()->SetProperty(smooth());
  scene.window()->Render();
  EXPECT_EQ(mapper->GetNumberOfEntryListBuilds(), 1) << "the same rays and cells";
  lookAt(scene.renderer(), Bounds, 41.0, 20.0);
  scene.window()->Render();
  EXPECT_EQ(mapper->GetNumberOfEntryListBuilds(), 2);
  // A connected mesh has few entries: the graphics device lists them.
  RayCastScene connected(makeBlock(6, field), smooth(), Size, Size);
  connected.rayCaster()->SetBackend(vtkTetrahedraRayCastMapper::OPENGL);
  lookAt(connected.renderer(), Bounds, 40.0, 20.0);
  connected.window()->Render();
  EXPECT_EQ(connected.rayCaster()->GetNumberOfEntryListBuilds(), 0);
}
