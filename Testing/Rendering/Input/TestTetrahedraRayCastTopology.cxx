// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Repeated cells, and cells that share no points: the image of the same cells as a mesh.
#include "RayCastScene.h"

#include <vtkProjectedTetrahedraMapper.h>

using namespace meniscus::test;

namespace
{

constexpr int Size = 80;
constexpr double Range[2] = { -1.0, 1.0 };
constexpr double Bounds[6] = { -1, 1, -1, 1, -1, 1 };
constexpr int Backends[3] = { vtkTetrahedraRayCastMapper::OPENGL,
  vtkTetrahedraRayCastMapper::COMPUTE, vtkTetrahedraRayCastMapper::NATIVE };

vtkSmartPointer<vtkVolumeProperty> Smooth()
{
  return MakeProperty(FunctionKind::Smooth, Range, 3.4);
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
Drawn Draw(vtkDataObject* input, int backend, vtkVolumeProperty* property = nullptr,
  int blendMode = vtkVolumeMapper::COMPOSITE_BLEND)
{
  RayCastScene scene(nullptr, property ? property : Smooth().Get(), Size, Size);
  const auto observer = ObserveErrors(scene.GetRayCaster());
  scene.GetRayCaster()->SetBackend(backend);
  scene.GetRayCaster()->SetBlendMode(blendMode);
  scene.GetRayCaster()->SetInputDataObject(input);
  LookAt(scene.GetRenderer(), Bounds, 25.0, 15.0);
  Drawn drawn;
  drawn.Image = scene.RenderFloat();
  drawn.Rejected = scene.GetRayCaster()->GetNumberOfRejectedCells();
  drawn.Steps = scene.GetRayCaster()->GetNumberOfTraversalSteps();
  EXPECT_EQ(scene.GetRayCaster()->GetNumberOfLostRays(), 0);
  EXPECT_TRUE(observer->Errors.empty()) << observer->GetText();
  return drawn;
}

/**
 * The cells of a grid in random order, each one to three times. Cell data is copied, and a
 * repetition has another value than the first occurrence.
 */
Grid Doubled(vtkUnstructuredGrid* grid, unsigned int seed, vtkTypeInt64& copies)
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
Grid Hexahedra(int n)
{
  const Grid grid = Grid::New();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkDoubleArray> scalars;
  scalars->SetName(ScalarName);
  const auto at = [n](int i, int j, int k) { return vtkIdType{ (k * (n + 1) + j) * (n + 1) + i }; };
  for (const auto& [k, j, i] : Product(n + 1, n + 1, n + 1))
  {
    const double x[3] = { 2.0 * i / n - 1.0, 2.0 * j / n - 1.0, 2.0 * k / n - 1.0 };
    points->InsertNextPoint(x);
    scalars->InsertNextValue(0.5 * x[0] - 0.3 * x[1] + 0.2 * x[2]);
  }
  grid->SetPoints(points);
  grid->GetPointData()->SetScalars(scalars);
  for (const auto& [k, j, i] : Product(n, n, n))
  {
    const vtkIdType ids[8] = { at(i, j, k), at(i + 1, j, k), at(i + 1, j + 1, k), at(i, j + 1, k),
      at(i, j, k + 1), at(i + 1, j, k + 1), at(i + 1, j + 1, k + 1), at(i, j + 1, k + 1) };
    grid->InsertNextCell(VTK_HEXAHEDRON, 8, ids);
  }
  return grid;
}

/** Each tetrahedron with its own points, shrunk about their mean; the field is that of the mesh. */
Grid Apart(vtkUnstructuredGrid* grid, double factor, const Field& field)
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
  return MakeGrid(points, cells, field);
}

} // anonymous namespace

TEST(TetrahedraRayCastTopology, DoubledMeshMatchesTheReferenceOfTheMesh)
{
  const Grid grid = MakeBlock(5, WavyField(3.0));
  vtkTypeInt64 copies = 0;
  const Grid given = Doubled(grid, 17, copies);
  for (const int backend : Backends)
  {
    RayCastScene single(grid, Smooth(), Size, Size);
    LookAt(single.GetRenderer(), Bounds, 40.0, 20.0);
    single.GetWindow()->Render();
    const SceneTruth truth = MakeTruth(single);
    RayCastScene scene(given, Smooth(), Size, Size);
    scene.GetRayCaster()->SetBackend(backend);
    LookAt(scene.GetRenderer(), Bounds, 40.0, 20.0);
    ExpectMatch(
      CompareToReference(scene.RenderFloat(), truth.Image, *truth.Integrator, truth.RayOf),
      "doubled");
    EXPECT_EQ(scene.GetRayCaster()->GetNumberOfRejectedCells(), copies);
  }
}

TEST(TetrahedraRayCastTopology, HexahedraGivenRepeatedly)
{
  const Grid grid = Hexahedra(4);
  for (const int backend : Backends)
  {
    const FloatImage once = Draw(grid, backend).Image;
    vtkTypeInt64 copies = 0;
    const Drawn drawn = Draw(Doubled(grid, 3, copies), backend);
    ExpectSamePicture(drawn.Image, once, "hexahedra");
    EXPECT_EQ(drawn.Rejected, 6 * copies);
  }
}

TEST(TetrahedraRayCastTopology, FirstOfRepeatedCellsGivesTheValue)
{
  const Grid grid = MakeBlock(4, ConstantField(0.0));
  grid->GetPointData()->Initialize();
  grid->GetCellData()->SetScalars(MakeArray("PerCell", grid->GetNumberOfCells(),
    [&](vtkIdType c) { return std::sin(1.7 * static_cast<double>(c)); }));
  for (const int backend : Backends)
  {
    vtkTypeInt64 copies = 0;
    ExpectSamePicture(
      Draw(Doubled(grid, 8, copies), backend).Image, Draw(grid, backend).Image, "cell data");
  }
}

TEST(TetrahedraRayCastTopology, CellsOfSeveralBlocksCountOnce)
{
  // The second block repeats the first one, partly in another order, with copied points.
  const Grid grid = MakeBlock(4, WavyField(3.0));
  vtkTypeInt64 copies = 0;
  const Grid again = Doubled(grid, 2, copies);
  const auto blocks = MakeBlocks({ grid, again });
  for (const int backend : Backends)
  {
    const Drawn drawn = Draw(blocks, backend);
    ExpectSamePicture(drawn.Image, Draw(grid, backend).Image, "blocks");
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
    const Grid grid = MakeGrid(points,
      std::vector<vtkIdType>(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(4 * count)),
      ConstantField(0.5));
    // Each with its own points: no face is shared.
    const Grid separate = Apart(grid, 1.0, ConstantField(0.5));
    for (const int backend : Backends)
    {
      ExpectSamePicture(Draw(grid, backend).Image, Draw(separate, backend).Image,
        std::to_string(count) + " cells at a face");
    }
  }
}

TEST(TetrahedraRayCastTopology, CellsWithPointsOfTheirOwnLookLikeTheMesh)
{
  const Field field = WavyField(2.0);
  const Grid grid = MakeBlock(7, field);
  const Grid separate = Apart(grid, 1.0, field);
  for (const int backend : Backends)
  {
    for (const int mode : { vtkVolumeMapper::COMPOSITE_BLEND,
           vtkVolumeMapper::MAXIMUM_INTENSITY_BLEND, vtkVolumeMapper::AVERAGE_INTENSITY_BLEND })
    {
      const Drawn mesh = Draw(grid, backend, nullptr, mode);
      const Drawn cells = Draw(separate, backend, nullptr, mode);
      ExpectSamePicture(cells.Image, mesh.Image, "mode " + std::to_string(mode));
      // The same cells are crossed, except for cells that rays touch in an edge only.
      EXPECT_NEAR(static_cast<double>(cells.Steps) / static_cast<double>(mesh.Steps), 1.0, 0.01);
    }
  }
}

TEST(TetrahedraRayCastTopology, ShrunkCellsMatchTheReference)
{
  const Field field = WavyField(2.0);
  for (const double factor : { 0.999, 0.6 })
  {
    const Grid separate = Apart(MakeBlock(6, field), factor, field);
    for (const int backend : Backends)
    {
      RayCastScene scene(separate, Smooth(), Size, Size);
      scene.GetRayCaster()->SetBackend(backend);
      LookAt(scene.GetRenderer(), Bounds, 40.0, 20.0);
      ExpectMatchesReference(
        scene, "shrunk to " + std::to_string(factor), SilhouetteAllowance{ 0.02, 1 });
    }
  }
}

TEST(TetrahedraRayCastTopology, ListsOfEntriesAreMadeWhereRaysOrBoundaryChange)
{
  const Field field = WavyField(2.0);
  RayCastScene scene(Apart(MakeBlock(6, field), 0.9, field), Smooth(), Size, Size);
  vtkTetrahedraRayCastMapper* mapper = scene.GetRayCaster();
  mapper->SetBackend(vtkTetrahedraRayCastMapper::OPENGL);
  LookAt(scene.GetRenderer(), Bounds, 40.0, 20.0);
  scene.GetWindow()->Render();
  EXPECT_EQ(mapper->GetStatistic("NumberOfEntryListBuilds"), 1);
  scene.GetWindow()->Render();
  scene.GetVolume()->SetProperty(Smooth());
  scene.GetWindow()->Render();
  EXPECT_EQ(mapper->GetStatistic("NumberOfEntryListBuilds"), 1) << "the same rays and cells";
  LookAt(scene.GetRenderer(), Bounds, 41.0, 20.0);
  scene.GetWindow()->Render();
  EXPECT_EQ(mapper->GetStatistic("NumberOfEntryListBuilds"), 2);
  // A connected mesh has few entries: the graphics device lists them.
  RayCastScene connected(MakeBlock(6, field), Smooth(), Size, Size);
  connected.GetRayCaster()->SetBackend(vtkTetrahedraRayCastMapper::OPENGL);
  LookAt(connected.GetRenderer(), Bounds, 40.0, 20.0);
  connected.GetWindow()->Render();
  EXPECT_EQ(connected.GetRayCaster()->GetStatistic("NumberOfEntryListBuilds"), 0);
}

namespace
{

/** Corner of the triangle of the visibility cycle. */
std::array<double, 2> CycleCorner(int i)
{
  const double angle = 2.0 * vtkMath::Pi() * i / 3.0;
  return { 0.6 * std::cos(angle), 0.6 * std::sin(angle) };
}

/**
 * Three bars over the sides of a triangle, seen from above: at each corner, one lies over the next.
 * No order of the cells shows them from back to front. Bar i has the scalar i - 1.
 */
Grid MakeVisibilityCycle()
{
  std::vector<double> points;
  std::vector<vtkIdType> cells;
  for (int i = 0; i < 3; ++i)
  {
    const std::array<double, 2> from = CycleCorner(i);
    const std::array<double, 2> to = CycleCorner(i + 1);
    const double along[2] = { to[0] - from[0], to[1] - from[1] };
    // Low at its beginning and high at its end, and longer than the side.
    const double places[4][3] = { { -0.3, 0.15, -0.4 }, { -0.3, -0.15, -0.4 }, { 1.3, 0.1, 0.35 },
      { 1.3, -0.1, 0.45 } };
    for (const auto& place : places)
    {
      cells.push_back(static_cast<vtkIdType>(points.size() / 3));
      points.insert(points.end(),
        { from[0] + place[0] * along[0] - place[1] * along[1],
          from[1] + place[0] * along[1] + place[1] * along[0], place[2] });
    }
  }
  Grid grid = MakeGrid(points, cells, ConstantField(0.0));
  for (vtkIdType i = 0; i < 12; ++i)
  {
    grid->GetPointData()->GetScalars()->SetComponent(i, 0, static_cast<double>(i / 4) - 1.0);
  }
  return grid;
}

/** Red, green and blue bars. */
vtkSmartPointer<vtkVolumeProperty> MakeCycleProperty()
{
  vtkNew<vtkColorTransferFunction> color;
  vtkNew<vtkPiecewiseFunction> opacity;
  for (int i = 0; i < 3; ++i)
  {
    color->AddRGBPoint(i - 1.0, i == 0, i == 1, i == 2);
    opacity->AddPoint(i - 1.0, 1.0);
  }
  auto property = vtkSmartPointer<vtkVolumeProperty>::New();
  property->SetColor(color);
  property->SetScalarOpacity(opacity);
  return property;
}

/** Colour of a picture at each corner, where the bar i that ends there must be seen alone. */
std::array<std::array<double, 3>, 3> CornerColors(vtkRenderer* renderer, const FloatImage& image)
{
  std::array<std::array<double, 3>, 3> colors{};
  for (int i = 0; i < 3; ++i)
  {
    const std::array<double, 2> corner = CycleCorner(i + 1);
    renderer->SetWorldPoint(corner[0], corner[1], 0.0, 1.0);
    renderer->WorldToDisplay();
    const double* place = renderer->GetDisplayPoint();
    const float* pixel = image.GetPixel(static_cast<int>(place[0]), static_cast<int>(place[1]));
    std::copy(pixel, pixel + 3, colors[static_cast<std::size_t>(i)].begin());
  }
  return colors;
}

} // anonymous namespace

TEST(TetrahedraRayCastTopology, VisibilityCycle)
{
  const Grid grid = MakeVisibilityCycle();
  const auto property = MakeCycleProperty();
  for (const int backend : Backends)
  {
    RayCastScene scene(grid, property, Size, Size);
    scene.GetRayCaster()->SetBackend(backend);
    LookAlongAxis(scene.GetRenderer(), Bounds, 2, 1.0);
    property->SetScalarOpacityUnitDistance(0.05);
    ExpectMatchesReference(scene, "cycle, translucent");
    property->SetScalarOpacityUnitDistance(1.0e-4); // opaque
    const auto colors = CornerColors(scene.GetRenderer(), scene.RenderFloat());
    for (std::size_t i = 0; i < 9; ++i)
    {
      EXPECT_NEAR(colors[i / 3][i % 3], i / 3 == i % 3 ? 1.0 : 0.0, 1.0e-4)
        << "corner " << i / 3 << ", channel " << i % 3 << ", backend " << backend;
    }
  }
}

/**
 * The same mesh by projected tetrahedra, which must be sorted. The bar that is drawn last covers
 * both of its neighbours, so that at least one of three corners is wrong in any order.
 */
TEST(TetrahedraRayCastTopology, VisibilityCycleMisleadsProjectedTetrahedra)
{
  VolumeScene scene(Size, Size);
  vtkNew<vtkProjectedTetrahedraMapper> mapper;
  mapper->SetInputData(MakeVisibilityCycle());
  scene.SetMapper(mapper);
  const auto property = MakeCycleProperty();
  property->SetScalarOpacityUnitDistance(1.0e-4);
  scene.SetProperty(property);
  LookAlongAxis(scene.GetRenderer(), Bounds, 2, 1.0);
  scene.RenderBytes(); // its first frame in a window is empty
  const ByteImage bytes = scene.RenderBytes();
  FloatImage image{ Size, Size, std::vector<float>(std::size_t{ 4 } * Size * Size, 1.0f) };
  for (std::size_t i = 0; i < bytes.Rgb.size(); ++i)
  {
    image.Rgba[i / 3 * 4 + i % 3] = static_cast<float>(bytes.Rgb[i]) / 255.0f;
  }
  const auto colors = CornerColors(scene.GetRenderer(), image);
  int wrong = 0;
  for (std::size_t i = 0; i < 3; ++i)
  {
    // One bar is seen, which is opaque.
    EXPECT_NEAR(colors[i][0] + colors[i][1] + colors[i][2], 1.0, 0.05) << "corner " << i;
    EXPECT_GT(*std::max_element(colors[i].begin(), colors[i].end()), 0.95) << "corner " << i;
    wrong += colors[i][i] < 0.5;
  }
  RecordProperty("WrongCorners", wrong);
  EXPECT_GE(wrong, 1);
}
