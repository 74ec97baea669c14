// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Composite data sets and structured grids: the image of the same cells in one unstructured grid.
#include "RayCastScene.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDoubleArray.h>
#include <vtkImageData.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkPartitionedDataSet.h>
#include <vtkPartitionedDataSetCollection.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkRectilinearGrid.h>
#include <vtkRenderWindow.h>
#include <vtkStructuredGrid.h>
#include <vtkTrivialProducer.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkVolume.h>
#include <vtkVolumeProperty.h>

#include <cmath>
#include <vector>

using namespace meniscus::test;

namespace
{

constexpr int Size = 100;
constexpr double Range[2] = { -2.0, 2.0 };
constexpr double Bounds[6] = { -1, 1, -1, 1, -1, 1 };

// A field that any tetrahedra represent equally; only the walk's rounding differs.
Field linear()
{
  return linearField(0.7, -0.4, 0.5);
}

vtkSmartPointer<vtkVolumeProperty> smooth()
{
  return makeProperty(FunctionKind::Smooth, Range, 3.5);
}

/** A scene of any data object. */
class AnyScene : public RayCastScene
{
public:
  explicit AnyScene(vtkDataObject* input)
    : RayCastScene(nullptr, smooth(), Size, Size)
    , Observer(vtkSmartPointer<ErrorObserver>::Take(ErrorObserver::New()))
  {
    this->Observer->observe(this->rayCaster());
    this->rayCaster()->SetInputDataObject(input);
    lookAt(this->renderer(), Bounds, 25.0, 15.0);
  }

  FloatImage picture()
  {
    const FloatImage image = this->renderFloat();
    EXPECT_EQ(this->rayCaster()->GetNumberOfLostRays(), 0);
    return image;
  }

  vtkSmartPointer<ErrorObserver> Observer;
};

FloatImage pictureOf(vtkDataObject* input, int scalarMode = VTK_SCALAR_MODE_DEFAULT)
{
  AnyScene scene(input);
  scene.rayCaster()->SetScalarMode(scalarMode);
  const FloatImage image = scene.picture();
  EXPECT_TRUE(scene.Observer->Errors.empty()) << scene.Observer->text();
  return image;
}

/** Some cells of a grid, with their own points and all data. */
Grid extract(vtkUnstructuredGrid* grid, const std::function<bool(vtkIdType)>& keep)
{
  const Grid part = Grid::New();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  part->SetPoints(points);
  part->GetPointData()->CopyAllocate(grid->GetPointData());
  part->GetCellData()->CopyAllocate(grid->GetCellData());
  std::vector<vtkIdType> numbers(grid->GetNumberOfPoints(), -1);
  vtkNew<vtkIdList> ids;
  for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c)
  {
    if (!keep(c))
    {
      continue;
    }
    grid->GetCellPoints(c, ids);
    for (vtkIdType i = 0; i < ids->GetNumberOfIds(); ++i)
    {
      vtkIdType& number = numbers[ids->GetId(i)];
      if (number < 0)
      {
        number = points->InsertNextPoint(grid->GetPoint(ids->GetId(i)));
        part->GetPointData()->CopyData(grid->GetPointData(), ids->GetId(i), number);
      }
      ids->SetId(i, number);
    }
    const vtkIdType cell = part->InsertNextCell(grid->GetCellType(c), ids);
    part->GetCellData()->CopyData(grid->GetCellData(), c, cell);
  }
  return part;
}

/** Three grids whose cells interlock without gaps. */
std::vector<Grid> interlocking(vtkUnstructuredGrid* grid)
{
  std::vector<Grid> parts;
  for (int k = 0; k < 3; ++k)
  {
    parts.push_back(
      extract(grid, [k](vtkIdType c) { return (c / 6 + c / 30 + c / 150) % 3 == k; }));
  }
  return parts;
}

vtkSmartPointer<vtkMultiBlockDataSet> makeBlocks(const std::vector<Grid>& parts)
{
  auto blocks = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  for (std::size_t i = 0; i < parts.size(); ++i)
  {
    blocks->SetBlock(static_cast<unsigned int>(i), parts[i]);
  }
  return blocks;
}

/** Cells of a structured kind over [-1, 1]^3 with n cubes along each axis. */
void addScalars(vtkDataSet* grid, const Field& field)
{
  vtkNew<vtkDoubleArray> scalars;
  scalars->SetName(ScalarName);
  for (vtkIdType i = 0; i < grid->GetNumberOfPoints(); ++i)
  {
    double x[3];
    grid->GetPoint(i, x);
    scalars->InsertNextValue(field(x[0], x[1], x[2]));
  }
  grid->GetPointData()->SetScalars(scalars);
}

vtkSmartPointer<vtkImageData> makeImage(int n, const Field& field)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(n + 1, n + 1, n + 1);
  image->SetOrigin(-1.0, -1.0, -1.0);
  image->SetSpacing(2.0 / n, 2.0 / n, 2.0 / n);
  addScalars(image, field);
  return image;
}

vtkSmartPointer<vtkStructuredGrid> makeStructured(int n, const Field& field)
{
  auto grid = vtkSmartPointer<vtkStructuredGrid>::New();
  grid->SetDimensions(n + 1, n + 1, n + 1);
  vtkNew<vtkPoints> points;
  const auto image = makeImage(n, field);
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    points->InsertNextPoint(image->GetPoint(i));
  }
  grid->SetPoints(points);
  addScalars(grid, field);
  return grid;
}

vtkSmartPointer<vtkRectilinearGrid> makeRectilinear(int n, const Field& field)
{
  auto grid = vtkSmartPointer<vtkRectilinearGrid>::New();
  grid->SetDimensions(n + 1, n + 1, n + 1);
  vtkNew<vtkDoubleArray> places;
  for (int i = 0; i <= n; ++i)
  {
    const double t = static_cast<double>(i) / n;
    places->InsertNextValue(2.0 * t * t - 1.0); // not evenly spaced
  }
  grid->SetXCoordinates(places);
  grid->SetYCoordinates(places);
  grid->SetZCoordinates(places);
  addScalars(grid, field);
  return grid;
}

} // anonymous namespace

TEST(TetrahedraRayCastComposite, InterlockingLeavesGiveThePictureOfOneGrid)
{
  const Grid whole = makeBlock(5, wavyField(3.0));
  jitter(whole, 0.05, 4);
  const FloatImage expected = pictureOf(whole);
  const std::vector<Grid> parts = interlocking(whole);
  expectSamePicture(pictureOf(makeBlocks(parts)), expected, "multiple blocks");

  vtkNew<vtkMultiBlockDataSet> nested;
  nested->SetBlock(0, makeBlocks({ parts[0], parts[2] }));
  nested->SetBlock(3, parts[1]); // blocks 1 and 2 are empty
  expectSamePicture(pictureOf(nested), expected, "nested blocks");

  vtkNew<vtkPartitionedDataSet> partitions;
  vtkNew<vtkPartitionedDataSet> single;
  partitions->SetPartition(0, parts[0]);
  partitions->SetPartition(1, parts[1]);
  single->SetPartition(0, parts[2]);
  vtkNew<vtkPartitionedDataSetCollection> collection;
  collection->SetPartitionedDataSet(0, partitions);
  collection->SetPartitionedDataSet(1, single);
  expectSamePicture(pictureOf(collection), expected, "collection of partitions");
}

TEST(TetrahedraRayCastComposite, EveryWayOfConnecting)
{
  const Grid whole = makeBlock(4, linear());
  const FloatImage expected = pictureOf(whole);
  const auto blocks = makeBlocks(interlocking(whole));
  vtkNew<vtkTrivialProducer> producer;
  producer->SetOutput(blocks);
  AnyScene scene(whole);
  scene.rayCaster()->SetInputConnection(producer->GetOutputPort());
  expectSamePicture(scene.picture(), expected, "connection");
  scene.rayCaster()->SetInputData(blocks);
  expectSamePicture(scene.picture(), expected, "SetInputData of blocks");
  scene.rayCaster()->SetInputData(makeImage(4, linear()));
  expectSamePicture(scene.picture(), expected, "SetInputData of an image");
  scene.rayCaster()->SetInputData(whole);
  expectSamePicture(scene.picture(), expected, "SetInputData of a grid");
  EXPECT_TRUE(scene.Observer->Errors.empty()) << scene.Observer->text();
}

TEST(TetrahedraRayCastComposite, BoundsAreThoseOfAllLeaves)
{
  const Grid whole = makeBlock(4, linear());
  AnyScene scene(makeBlocks(interlocking(whole)));
  double bounds[6];
  scene.rayCaster()->GetBounds(bounds);
  for (int i = 0; i < 6; ++i)
  {
    EXPECT_EQ(bounds[i], Bounds[i]);
    EXPECT_EQ(scene.volume()->GetBounds()[i], Bounds[i]);
  }
}

TEST(TetrahedraRayCastComposite, LeavesWithoutTheArrayAreLeftOutWithOneWarning)
{
  const Grid whole = makeBlock(4, linear());
  const std::vector<Grid> parts = interlocking(whole);
  const FloatImage expected = pictureOf(makeBlocks({ parts[0], parts[2] }));
  parts[1]->GetPointData()->Initialize();
  AnyScene scene(makeBlocks(parts));
  expectSamePicture(scene.picture(), expected, "one of three left out");
  expectSamePicture(scene.picture(), expected, "once more");
  ASSERT_EQ(scene.Observer->Warnings.size(), 1u);
  EXPECT_NE(scene.Observer->Warnings[0].find("1 of 3"), std::string::npos);
  EXPECT_TRUE(scene.Observer->Errors.empty());

  parts[0]->GetPointData()->Initialize();
  parts[2]->GetPointData()->Initialize();
  for (const float value : scene.renderFloat().Rgba)
  {
    ASSERT_EQ(value, 0.0f);
  }
  EXPECT_EQ(scene.Observer->Errors.size(), 1u);
}

TEST(TetrahedraRayCastComposite, SurfacesAndEmptyLeavesAreNoMistake)
{
  const Grid whole = makeBlock(4, linear());
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, vtkSmartPointer<vtkPolyData>::New());
  blocks->SetBlock(1, whole);
  blocks->SetBlock(2, Grid::New());
  AnyScene scene(blocks);
  expectSamePicture(scene.picture(), pictureOf(whole), "beside a surface");
  EXPECT_TRUE(scene.Observer->Errors.empty());
  EXPECT_TRUE(scene.Observer->Warnings.empty());

  AnyScene empty(vtkSmartPointer<vtkMultiBlockDataSet>::New());
  for (const float value : empty.renderFloat().Rgba)
  {
    ASSERT_EQ(value, 0.0f);
  }
  EXPECT_TRUE(empty.Observer->Errors.empty());
}

TEST(TetrahedraRayCastComposite, ChangesOfALeaf)
{
  const Grid whole = makeBlock(4, wavyField(3.0));
  const std::vector<Grid> parts = interlocking(whole);
  AnyScene scene(makeBlocks(parts));
  scene.window()->Render();
  scene.window()->Render();
  vtkTetrahedraRayCastMapper* mapper = scene.rayCaster();
  EXPECT_EQ(mapper->GetNumberOfMeshBuilds(), 1);
  EXPECT_EQ(mapper->GetNumberOfScalarUpdates(), 1);
  vtkDataArray* scalars = parts[1]->GetPointData()->GetScalars();
  for (vtkIdType i = 0; i < scalars->GetNumberOfTuples(); ++i)
  {
    scalars->SetComponent(i, 0, -0.5 * scalars->GetComponent(i, 0));
  }
  scalars->Modified();
  expectSamePicture(scene.picture(), pictureOf(makeBlocks(parts)), "scalars of a leaf");
  EXPECT_EQ(mapper->GetNumberOfMeshBuilds(), 1);
  EXPECT_EQ(mapper->GetNumberOfScalarUpdates(), 2);
  jitter(parts[2], 0.02, 9);
  parts[2]->GetPoints()->Modified();
  expectSamePicture(scene.picture(), pictureOf(makeBlocks(parts)), "points of a leaf");
  EXPECT_EQ(mapper->GetNumberOfMeshBuilds(), 2);
}

TEST(TetrahedraRayCastComposite, CellDataOfLeaves)
{
  const Grid whole = makeBlock(4, linear());
  vtkNew<vtkDoubleArray> values;
  values->SetName("cells");
  for (vtkIdType c = 0; c < whole->GetNumberOfCells(); ++c)
  {
    values->InsertNextValue(std::sin(0.01 * c));
  }
  whole->GetCellData()->SetScalars(values);
  expectSamePicture(pictureOf(makeBlocks(interlocking(whole)), VTK_SCALAR_MODE_USE_CELL_DATA),
    pictureOf(whole, VTK_SCALAR_MODE_USE_CELL_DATA), "cell data");
}

TEST(TetrahedraRayCastComposite, StructuredGrids)
{
  const FloatImage expected = pictureOf(makeBlock(4, linear()));
  expectSamePicture(pictureOf(makeImage(4, linear())), expected, "image");
  expectSamePicture(pictureOf(makeStructured(4, linear())), expected, "structured");
  expectSamePicture(pictureOf(makeRectilinear(4, linear())), expected, "rectilinear");
}

TEST(TetrahedraRayCastComposite, ChangedImagesAreOtherMeshes)
{
  const auto image = makeImage(4, linear());
  AnyScene scene(image);
  scene.window()->Render();
  scene.window()->Render();
  EXPECT_EQ(scene.rayCaster()->GetNumberOfMeshBuilds(), 1);
  image->GetPointData()->GetScalars()->Modified();
  scene.window()->Render();
  EXPECT_EQ(scene.rayCaster()->GetNumberOfMeshBuilds(), 1);
  image->SetSpacing(0.4, 0.5, 0.5);
  scene.window()->Render();
  EXPECT_EQ(scene.rayCaster()->GetNumberOfMeshBuilds(), 2);
}

TEST(TetrahedraRayCastComposite, BlankedAndGhostCellsAreLeftOut)
{
  const auto grid = makeStructured(4, linear());
  grid->BlankCell(7);
  grid->BlankCell(20);
  AnyScene scene(grid);
  scene.window()->Render();
  EXPECT_EQ(scene.rayCaster()->GetNumberOfActiveCells(), 6 * (64 - 2));

  // Two images that overlap by a layer of ghost cells.
  const Field field = linear();
  vtkNew<vtkMultiBlockDataSet> blocks;
  for (int side = 0; side < 2; ++side)
  {
    vtkNew<vtkImageData> half;
    half->SetDimensions(4, 5, 5);
    half->SetOrigin(side == 0 ? -1.0 : -0.5, -1.0, -1.0);
    half->SetSpacing(0.5, 0.5, 0.5);
    addScalars(half, field);
    vtkUnsignedCharArray* ghosts = half->AllocateCellGhostArray();
    for (vtkIdType c = 0; c < half->GetNumberOfCells(); ++c)
    {
      if (c % 3 == (side == 0 ? 2 : 0))
      {
        ghosts->SetValue(c, vtkDataSetAttributes::DUPLICATECELL);
      }
    }
    blocks->SetBlock(static_cast<unsigned int>(side), half);
  }
  AnyScene ghosts(blocks);
  expectSamePicture(ghosts.picture(), pictureOf(makeImage(4, field)), "ghost layers");
  EXPECT_EQ(ghosts.rayCaster()->GetNumberOfActiveCells(), 6 * 64);
}

TEST(TetrahedraRayCastComposite, MeshesBeyond32BitsAreRefusedWithNumbers)
{
  // 6 * 449^3 tetrahedra; the scalars are never read.
  vtkNew<vtkImageData> image;
  image->SetDimensions(450, 450, 450);
  vtkNew<vtkUnsignedCharArray> scalars;
  scalars->SetNumberOfTuples(image->GetNumberOfPoints());
  image->GetPointData()->SetScalars(scalars);
  AnyScene scene(image);
  for (const float value : scene.renderFloat().Rgba)
  {
    ASSERT_EQ(value, 0.0f);
  }
  ASSERT_EQ(scene.Observer->Errors.size(), 1u);
  EXPECT_NE(scene.Observer->text().find(std::to_string(6LL * 449 * 449 * 449)), std::string::npos);
  EXPECT_NE(scene.Observer->text().find("536870911"), std::string::npos);
  // Input that fits is drawn after it.
  scene.rayCaster()->SetInputData(makeImage(4, linear()));
  expectSamePicture(scene.picture(), pictureOf(makeImage(4, linear())), "after the error");
}
