// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Composite data sets and structured grids: the image of the same cells in one unstructured grid.
#include "RayCastScene.h"

#include <vtkPartitionedDataSet.h>
#include <vtkPartitionedDataSetCollection.h>
#include <vtkStructuredGrid.h>

using namespace meniscus::test;

namespace
{

constexpr int Size = 100;
constexpr double Range[2] = { -2.0, 2.0 };
constexpr double Bounds[6] = { -1, 1, -1, 1, -1, 1 };

// A field that any tetrahedra represent equally; only the walk's rounding differs.
Field MakeLinear()
{
  return LinearField(0.7, -0.4, 0.5);
}

vtkSmartPointer<vtkVolumeProperty> Smooth()
{
  return MakeProperty(FunctionKind::Smooth, Range, 3.5);
}

/** A scene of any data object. */
class AnyScene : public RayCastScene
{
public:
  explicit AnyScene(vtkDataObject* input)
    : RayCastScene(nullptr, Smooth(), Size, Size)
    , Observer(vtkSmartPointer<ErrorObserver>::Take(ErrorObserver::New()))
  {
    this->Observer->Observe(this->GetRayCaster());
    this->GetRayCaster()->SetInputDataObject(input);
    LookAt(this->GetRenderer(), Bounds, 25.0, 15.0);
  }

  FloatImage MakePicture()
  {
    const FloatImage image = this->RenderFloat();
    EXPECT_EQ(this->GetRayCaster()->GetNumberOfLostRays(), 0);
    return image;
  }

  vtkSmartPointer<ErrorObserver> Observer;
};

FloatImage PictureOf(vtkDataObject* input, int scalarMode = VTK_SCALAR_MODE_DEFAULT)
{
  AnyScene scene(input);
  scene.GetRayCaster()->SetScalarMode(scalarMode);
  const FloatImage image = scene.MakePicture();
  EXPECT_TRUE(scene.Observer->Errors.empty()) << scene.Observer->GetText();
  return image;
}

/** Some cells of a grid, with their own points and all data. */
Grid Extract(vtkUnstructuredGrid* grid, const std::function<bool(vtkIdType)>& keep)
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
std::vector<Grid> Interlocking(vtkUnstructuredGrid* grid)
{
  std::vector<Grid> parts;
  for (int k = 0; k < 3; ++k)
  {
    parts.push_back(
      Extract(grid, [k](vtkIdType c) { return (c / 6 + c / 30 + c / 150) % 3 == k; }));
  }
  return parts;
}

/** Cells of a structured kind over [-1, 1]^3 with n cubes along each axis. */
void AddScalars(vtkDataSet* grid, const Field& field)
{
  grid->GetPointData()->SetScalars(MakeArray(ScalarName, grid->GetNumberOfPoints(),
    [&](vtkIdType i)
    {
      const glm::dvec3 x = PointOf(grid, i);
      return field(x[0], x[1], x[2]);
    }));
}

vtkSmartPointer<vtkImageData> MakeImage(int n, const Field& field)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(n + 1, n + 1, n + 1);
  image->SetOrigin(-1.0, -1.0, -1.0);
  image->SetSpacing(2.0 / n, 2.0 / n, 2.0 / n);
  AddScalars(image, field);
  return image;
}

vtkSmartPointer<vtkStructuredGrid> MakeStructured(int n, const Field& field)
{
  auto grid = vtkSmartPointer<vtkStructuredGrid>::New();
  grid->SetDimensions(n + 1, n + 1, n + 1);
  vtkNew<vtkPoints> points;
  const auto image = MakeImage(n, field);
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    points->InsertNextPoint(image->GetPoint(i));
  }
  grid->SetPoints(points);
  AddScalars(grid, field);
  return grid;
}

vtkSmartPointer<vtkRectilinearGrid> MakeRectilinear(int n, const Field& field)
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
  AddScalars(grid, field);
  return grid;
}

} // anonymous namespace

TEST(TetrahedraRayCastComposite, InterlockingLeavesGiveThePictureOfOneGrid)
{
  const Grid whole = MakeBlock(5, WavyField(3.0));
  Jitter(whole, 0.05, 4);
  const FloatImage expected = PictureOf(whole);
  const std::vector<Grid> parts = Interlocking(whole);
  ExpectSamePicture(PictureOf(MakeBlocks(parts)), expected, "multiple blocks");

  vtkNew<vtkMultiBlockDataSet> nested;
  nested->SetBlock(0, MakeBlocks({ parts[0], parts[2] }));
  nested->SetBlock(3, parts[1]); // blocks 1 and 2 are empty
  ExpectSamePicture(PictureOf(nested), expected, "nested blocks");

  vtkNew<vtkPartitionedDataSet> partitions;
  vtkNew<vtkPartitionedDataSet> single;
  partitions->SetPartition(0, parts[0]);
  partitions->SetPartition(1, parts[1]);
  single->SetPartition(0, parts[2]);
  vtkNew<vtkPartitionedDataSetCollection> collection;
  collection->SetPartitionedDataSet(0, partitions);
  collection->SetPartitionedDataSet(1, single);
  ExpectSamePicture(PictureOf(collection), expected, "collection of partitions");
}

TEST(TetrahedraRayCastComposite, EveryWayOfConnecting)
{
  const Grid whole = MakeBlock(4, MakeLinear());
  const FloatImage expected = PictureOf(whole);
  const auto blocks = MakeBlocks(Interlocking(whole));
  vtkNew<vtkTrivialProducer> producer;
  producer->SetOutput(blocks);
  AnyScene scene(whole);
  scene.GetRayCaster()->SetInputConnection(producer->GetOutputPort());
  ExpectSamePicture(scene.MakePicture(), expected, "connection");
  scene.GetRayCaster()->SetInputData(blocks);
  ExpectSamePicture(scene.MakePicture(), expected, "SetInputData of blocks");
  scene.GetRayCaster()->SetInputData(MakeImage(4, MakeLinear()));
  ExpectSamePicture(scene.MakePicture(), expected, "SetInputData of an image");
  scene.GetRayCaster()->SetInputData(whole);
  ExpectSamePicture(scene.MakePicture(), expected, "SetInputData of a grid");
  EXPECT_TRUE(scene.Observer->Errors.empty()) << scene.Observer->GetText();
}

TEST(TetrahedraRayCastComposite, BoundsAreThoseOfAllLeaves)
{
  const Grid whole = MakeBlock(4, MakeLinear());
  AnyScene scene(MakeBlocks(Interlocking(whole)));
  double bounds[6];
  scene.GetRayCaster()->GetBounds(bounds);
  for (int i = 0; i < 6; ++i)
  {
    EXPECT_EQ(bounds[i], Bounds[i]);
    EXPECT_EQ(scene.GetVolume()->GetBounds()[i], Bounds[i]);
  }
}

TEST(TetrahedraRayCastComposite, LeavesWithoutTheArrayAreLeftOutWithOneWarning)
{
  const Grid whole = MakeBlock(4, MakeLinear());
  const std::vector<Grid> parts = Interlocking(whole);
  const FloatImage expected = PictureOf(MakeBlocks({ parts[0], parts[2] }));
  parts[1]->GetPointData()->Initialize();
  AnyScene scene(MakeBlocks(parts));
  ExpectSamePicture(scene.MakePicture(), expected, "one of three left out");
  ExpectSamePicture(scene.MakePicture(), expected, "once more");
  ASSERT_EQ(scene.Observer->Warnings.size(), 1u);
  EXPECT_TRUE(HasText(scene.Observer->Warnings[0], "1 of 3"));
  EXPECT_TRUE(scene.Observer->Errors.empty());

  parts[0]->GetPointData()->Initialize();
  parts[2]->GetPointData()->Initialize();
  for (const float value : scene.RenderFloat().Rgba)
  {
    ASSERT_EQ(value, 0.0f);
  }
  EXPECT_EQ(scene.Observer->Errors.size(), 1u);
}

TEST(TetrahedraRayCastComposite, SurfacesAndEmptyLeavesAreNoMistake)
{
  const Grid whole = MakeBlock(4, MakeLinear());
  AnyScene scene(MakeBlocks({ vtkSmartPointer<vtkPolyData>::New(), whole, Grid::New() }));
  ExpectSamePicture(scene.MakePicture(), PictureOf(whole), "beside a surface");
  EXPECT_TRUE(scene.Observer->Errors.empty());
  EXPECT_TRUE(scene.Observer->Warnings.empty());

  AnyScene empty(vtkSmartPointer<vtkMultiBlockDataSet>::New());
  for (const float value : empty.RenderFloat().Rgba)
  {
    ASSERT_EQ(value, 0.0f);
  }
  EXPECT_TRUE(empty.Observer->Errors.empty());
}

/** Surfaces alone are one: the warning has the types of their cells. */
TEST(TetrahedraRayCastComposite, SurfacesAlone)
{
  vtkNew<vtkPolyData> surface;
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> polygons;
  vtkNew<vtkDoubleArray> scalars;
  for (const glm::dvec3& x : { glm::dvec3(0.0), glm::dvec3(1.0, 0.0, 0.0), glm::dvec3(1.0) })
  {
    points->InsertNextPoint(x.x, x.y, x.z);
    scalars->InsertNextValue(x.y);
  }
  const vtkIdType ids[3] = { 0, 1, 2 };
  polygons->InsertNextCell(3, ids);
  surface->SetPoints(points);
  surface->SetPolys(polygons);
  surface->GetPointData()->SetScalars(scalars);
  AnyScene scene(MakeBlocks({ surface, nullptr }));
  scene.RenderFloat();
  ASSERT_EQ(scene.Observer->Warnings.size(), 1u);
  EXPECT_TRUE(HasText(scene.Observer->Warnings[0], "1 vtkTriangle (without a volume)"));
  EXPECT_TRUE(scene.Observer->Errors.empty());
}

TEST(TetrahedraRayCastComposite, ChangesOfALeaf)
{
  const Grid whole = MakeBlock(4, WavyField(3.0));
  const std::vector<Grid> parts = Interlocking(whole);
  AnyScene scene(MakeBlocks(parts));
  scene.GetWindow()->Render();
  scene.GetWindow()->Render();
  vtkTetrahedraRayCastMapper* mapper = scene.GetRayCaster();
  EXPECT_EQ(mapper->GetNumberOfMeshBuilds(), 1);
  EXPECT_EQ(mapper->GetNumberOfScalarUpdates(), 1);
  vtkDataArray* scalars = parts[1]->GetPointData()->GetScalars();
  for (vtkIdType i = 0; i < scalars->GetNumberOfTuples(); ++i)
  {
    scalars->SetComponent(i, 0, -0.5 * scalars->GetComponent(i, 0));
  }
  scalars->Modified();
  ExpectSamePicture(scene.MakePicture(), PictureOf(MakeBlocks(parts)), "scalars of a leaf");
  EXPECT_EQ(mapper->GetNumberOfMeshBuilds(), 1);
  EXPECT_EQ(mapper->GetNumberOfScalarUpdates(), 2);
  Jitter(parts[2], 0.02, 9);
  parts[2]->GetPoints()->Modified();
  ExpectSamePicture(scene.MakePicture(), PictureOf(MakeBlocks(parts)), "points of a leaf");
  EXPECT_EQ(mapper->GetNumberOfMeshBuilds(), 2);
}

TEST(TetrahedraRayCastComposite, CellDataOfLeaves)
{
  const Grid whole = MakeBlock(4, MakeLinear());
  whole->GetCellData()->SetScalars(
    MakeArray("cells", whole->GetNumberOfCells(), [&](vtkIdType c) { return std::sin(0.01 * c); }));
  ExpectSamePicture(PictureOf(MakeBlocks(Interlocking(whole)), VTK_SCALAR_MODE_USE_CELL_DATA),
    PictureOf(whole, VTK_SCALAR_MODE_USE_CELL_DATA), "cell data");
}

TEST(TetrahedraRayCastComposite, StructuredGrids)
{
  const FloatImage expected = PictureOf(MakeBlock(4, MakeLinear()));
  ExpectSamePicture(PictureOf(MakeImage(4, MakeLinear())), expected, "image");
  ExpectSamePicture(PictureOf(MakeStructured(4, MakeLinear())), expected, "structured");
  ExpectSamePicture(PictureOf(MakeRectilinear(4, MakeLinear())), expected, "rectilinear");
}

TEST(TetrahedraRayCastComposite, ChangedImagesMoveOrAreOtherMeshes)
{
  const auto image = MakeImage(4, MakeLinear());
  AnyScene scene(image);
  scene.GetWindow()->Render();
  scene.GetWindow()->Render();
  EXPECT_EQ(scene.GetRayCaster()->GetNumberOfMeshBuilds(), 1);
  image->GetPointData()->GetScalars()->Modified();
  scene.GetWindow()->Render();
  EXPECT_EQ(scene.GetRayCaster()->GetNumberOfMeshBuilds(), 1);
  image->SetSpacing(0.4, 0.5, 0.5);
  ExpectSamePicture(scene.MakePicture(), PictureOf(image), "other spacing");
  EXPECT_EQ(scene.GetRayCaster()->GetNumberOfMeshBuilds(), 1);
  EXPECT_EQ(scene.GetRayCaster()->GetStatistic("NumberOfPointUpdates"), 1);
  image->SetExtent(3, 7, 0, 4, 0, 4);
  scene.GetWindow()->Render();
  EXPECT_EQ(scene.GetRayCaster()->GetNumberOfMeshBuilds(), 2);
}

TEST(TetrahedraRayCastComposite, BlankedAndGhostCellsAreLeftOut)
{
  const auto grid = MakeStructured(4, MakeLinear());
  grid->BlankCell(7);
  grid->BlankCell(20);
  AnyScene scene(grid);
  scene.GetWindow()->Render();
  EXPECT_EQ(scene.GetRayCaster()->GetNumberOfActiveCells(), 6 * (64 - 2));

  // Two images that overlap by a layer of ghost cells.
  const Field field = MakeLinear();
  vtkNew<vtkMultiBlockDataSet> blocks;
  for (int side = 0; side < 2; ++side)
  {
    vtkNew<vtkImageData> half;
    half->SetDimensions(4, 5, 5);
    half->SetOrigin(side == 0 ? -1.0 : -0.5, -1.0, -1.0);
    half->SetSpacing(0.5, 0.5, 0.5);
    AddScalars(half, field);
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
  ExpectSamePicture(ghosts.MakePicture(), PictureOf(MakeImage(4, field)), "ghost layers");
  EXPECT_EQ(ghosts.GetRayCaster()->GetNumberOfActiveCells(), 6 * 64);
}

/** The levels of an AMR data set: a block, and a finer one over an eighth of it. */
TEST(TetrahedraRayCastComposite, RefinedCellsAreShownByTheFinerBlock)
{
  const Field field = MakeLinear();
  const auto coarse = MakeImage(4, field);
  vtkUnsignedCharArray* flags = coarse->AllocateCellGhostArray();
  for (vtkIdType c = 0; c < 64; ++c)
  {
    const bool isRefined = c % 4 < 2 && c / 4 % 4 < 2 && c / 16 < 2;
    flags->SetValue(c, isRefined ? vtkDataSetAttributes::REFINEDCELL : 0);
  }
  vtkNew<vtkImageData> fine;
  fine->SetDimensions(5, 5, 5);
  fine->SetOrigin(-1.0, -1.0, -1.0);
  fine->SetSpacing(0.25, 0.25, 0.25);
  AddScalars(fine, field);
  vtkNew<vtkMultiBlockDataSet> levels;
  levels->SetBlock(0, coarse);
  levels->SetBlock(1, fine);
  AnyScene scene(levels);
  ExpectSamePicture(scene.MakePicture(), PictureOf(MakeImage(4, field)), "levels");
  EXPECT_EQ(scene.GetRayCaster()->GetNumberOfActiveCells(), 6 * (64 - 8 + 64));
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
  for (const float value : scene.RenderFloat().Rgba)
  {
    ASSERT_EQ(value, 0.0f);
  }
  ASSERT_EQ(scene.Observer->Errors.size(), 1u);
  EXPECT_TRUE(HasText(scene.Observer->GetText(), std::to_string(6LL * 449 * 449 * 449)));
  EXPECT_TRUE(HasText(scene.Observer->GetText(), "536870911"));
  // Input that fits is drawn after it.
  scene.GetRayCaster()->SetInputData(MakeImage(4, MakeLinear()));
  ExpectSamePicture(scene.MakePicture(), PictureOf(MakeImage(4, MakeLinear())), "after the error");
}
