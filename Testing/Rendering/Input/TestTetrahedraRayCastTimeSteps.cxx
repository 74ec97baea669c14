// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Time steps: new arrays with equal cells cost an update of the scalars, moving points cost one of
// the positions. Counters prove the work, images of new mappers the result.
#include "RayCastScene.h"

#include <vtkXMLUnstructuredGridReader.h>
#include <vtkXMLUnstructuredGridWriter.h>

using namespace meniscus::test;

namespace
{

constexpr int Size = 72;
constexpr double Range[2] = { -1.5, 1.5 };
constexpr int Steps = 20;

using Position = std::array<double, 3>;
using Motion = std::function<Position(const Position&, double)>;

/** Work of a mapper so far. */
struct Work
{
  vtkTypeInt64 Builds;
  vtkTypeInt64 Points;
  vtkTypeInt64 Scalars;
  vtkTypeInt64 Bounds;
  vtkTypeInt64 Bytes;

  explicit Work(vtkTetrahedraRayCastMapper* mapper)
    : Builds(mapper->GetNumberOfMeshBuilds())
    , Points(mapper->GetStatistic("NumberOfPointUpdates"))
    , Scalars(mapper->GetNumberOfScalarUpdates())
    , Bounds(mapper->GetStatistic("NumberOfBoundsBuilds"))
    , Bytes(mapper->GetUploadedBytes())
  {
  }
};

class TetrahedraRayCastTimeSteps : public ::testing::Test
{
protected:
  TetrahedraRayCastTimeSteps()
    : Property(MakeProperty(FunctionKind::Smooth, Range, 3.5))
  {
  }

  std::unique_ptr<RayCastScene> MakeScene(vtkDataObject* data)
  {
    auto scene = std::make_unique<RayCastScene>(nullptr, this->Property, Size, Size);
    scene->GetRayCaster()->SetInputDataObject(data);
    const double bounds[6] = { -1.0, 1.0, -1.0, 1.0, -1.0, 1.0 };
    LookAt(scene->GetRenderer(), bounds, 30.0, 20.0);
    return scene;
  }

  /** Draws data with a mapper that drew other data before. */
  FloatImage Draw(RayCastScene& scene, vtkDataObject* data)
  {
    scene.GetRayCaster()->SetInputDataObject(data);
    const FloatImage image = scene.RenderFloat();
    EXPECT_EQ(scene.GetRayCaster()->GetNumberOfLostRays(), 0);
    return image;
  }

  FloatImage DrawAnew(vtkDataObject* data) { return this->MakeScene(data)->RenderFloat(); }

  /**
   * Draws data, of which the mapper last drew other points, and expects that these were moved, and
   * the image of a new mapper but for rounding, since that one has its own order of vertices.
   */
  void ExpectMoved(RayCastScene& scene, vtkDataObject* data)
  {
    ExpectSamePicture(this->DrawWith(scene, data, false), this->DrawAnew(data), "moved points");
  }

  /** As above, but expects a new mesh and the same image to the bit. */
  void ExpectBuilt(RayCastScene& scene, vtkDataObject* data)
  {
    EXPECT_EQ(this->DrawWith(scene, data, true).Rgba, this->DrawAnew(data).Rgba);
  }

  /** Draws data and expects either a new mesh or moved points. */
  FloatImage DrawWith(RayCastScene& scene, vtkDataObject* data, bool isBuilt)
  {
    const Work before(scene.GetRayCaster());
    const FloatImage picture = this->Draw(scene, data);
    const Work after(scene.GetRayCaster());
    EXPECT_EQ(after.Builds - before.Builds, isBuilt ? 1 : 0);
    EXPECT_EQ(after.Points - before.Points, isBuilt ? 0 : 1);
    return picture;
  }

  vtkSmartPointer<vtkVolumeProperty> Property;
};

Grid Copy(vtkUnstructuredGrid* grid)
{
  Grid copy = Grid::New();
  copy->DeepCopy(grid);
  return copy;
}

/** A copy in new arrays with points that have moved. */
Grid Moved(vtkUnstructuredGrid* grid, const Motion& motion, double time)
{
  Grid copy = Copy(grid);
  for (vtkIdType p = 0; p < copy->GetNumberOfPoints(); ++p)
  {
    Position x;
    copy->GetPoint(p, x.data());
    copy->GetPoints()->SetPoint(p, motion(x, time).data());
  }
  return copy;
}

/** A copy in new arrays with a wave as its scalars. */
Grid WithWave(vtkUnstructuredGrid* grid, double time)
{
  Grid copy = Copy(grid);
  vtkDataArray* scalars = copy->GetPointData()->GetScalars();
  for (vtkIdType p = 0; p < copy->GetNumberOfPoints(); ++p)
  {
    const glm::dvec3 x = PointOf(copy, p);
    scalars->SetComponent(p, 0, std::sin(3.0 * x[0] + time) * std::cos(2.0 * x[1] - x[2]));
  }
  return copy;
}

/** Moves inner points only, by up to 0.03; points of sides of the cube [-1, 1]^3 stay in them. */
Position Wobble(const Position& x, double time)
{
  Position moved;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double phase = 5.0 * x[(axis + 1) % 3] + time + axis;
    moved[axis] = x[axis] + 0.03 * (1.0 - x[axis] * x[axis]) * std::sin(phase);
  }
  return moved;
}

/** Bends the cube and turns it. */
Position Bend(const Position& x, double time)
{
  const double angle = 0.4 * time * x[2] + time;
  return { 0.7 * (std::cos(angle) * x[0] - std::sin(angle) * x[1]),
    0.7 * (std::sin(angle) * x[0] + std::cos(angle) * x[1]), 0.7 * x[2] + 0.1 * x[0] * x[0] };
}

Position Mirror(const Position& x, double)
{
  return { x[0], x[1], -x[2] };
}

std::string NameOfStep(int step)
{
  // Tests of several backends may run at the same time.
  return std::string(MENISCUS_TEMPORARY_DIR "/time-step-") + std::to_string(BackendUnderTest()) +
    "-" + std::to_string(step) + ".vtu";
}

void WriteSteps(vtkUnstructuredGrid* grid)
{
  for (int step = 0; step < Steps; ++step)
  {
    vtkNew<vtkXMLUnstructuredGridWriter> writer;
    writer->SetInputData(WithWave(grid, 0.2 * step));
    writer->SetFileName(NameOfStep(step).c_str());
    ASSERT_EQ(writer->Write(), 1);
  }
}

/** Two cubes with a common side; each has points of its own. */
std::vector<Grid> TwoCubes()
{
  Grid left = MakeBlock(3, WavyField(3.0));
  TransformPoints(left, { -1.0, 0.0, 0.0 }, 0.45);
  Grid right = MakeBlock(3, WavyField(3.0));
  TransformPoints(right, { 1.0, 0.0, 0.0 }, 0.45);
  return { left, right };
}

} // anonymous namespace

TEST_F(TetrahedraRayCastTimeSteps, FilesOfAReaderCostScalars)
{
  ASSERT_NO_FATAL_FAILURE(WriteSteps(MakeBlock(6, WavyField(3.0))));
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  RayCastScene scene(nullptr, this->Property, Size, Size);
  vtkTetrahedraRayCastMapper* mapper = scene.GetRayCaster();
  mapper->SetInputConnection(reader->GetOutputPort());
  const double bounds[6] = { -1.0, 1.0, -1.0, 1.0, -1.0, 1.0 };
  LookAt(scene.GetRenderer(), bounds, 30.0, 20.0);
  const vtkDataArray* lastIds = nullptr;
  vtkSmartPointer<vtkCellArray> kept;
  for (int step = 0; step < Steps; ++step)
  {
    SCOPED_TRACE(step);
    reader->SetFileName(NameOfStep(step).c_str());
    const FloatImage picture = scene.RenderFloat();
    // The reader makes new arrays. Those of the last step are kept so that none has its place.
    vtkCellArray* cells = reader->GetOutput()->GetCells();
    EXPECT_NE(cells->GetConnectivityArray(), lastIds);
    lastIds = cells->GetConnectivityArray();
    kept = cells;
    EXPECT_EQ(mapper->GetNumberOfMeshBuilds(), 1);
    EXPECT_EQ(mapper->GetStatistic("NumberOfPointUpdates"), 0);
    EXPECT_EQ(mapper->GetNumberOfScalarUpdates(), step + 1);
    EXPECT_EQ(mapper->GetStatistic("NumberOfBoundsBuilds"), 1);
    if (step % 5 == 4)
    {
      EXPECT_EQ(picture.Rgba, this->DrawAnew(Copy(reader->GetOutput())).Rgba);
    }
  }
  for (int step = 0; step < Steps; ++step)
  {
    std::remove(NameOfStep(step).c_str());
  }
}

TEST_F(TetrahedraRayCastTimeSteps, ScalarsOfNewBlocksCostScalars)
{
  const std::vector<Grid> cubes = TwoCubes();
  const auto scene = this->MakeScene(MakeBlocks(cubes));
  for (int step = 0; step < 4; ++step)
  {
    SCOPED_TRACE(step);
    const auto blocks = MakeBlocks({ WithWave(cubes[0], step), WithWave(cubes[1], step) });
    const FloatImage picture = this->Draw(*scene, blocks);
    EXPECT_EQ(scene->GetRayCaster()->GetNumberOfMeshBuilds(), 1);
    EXPECT_EQ(scene->GetRayCaster()->GetNumberOfScalarUpdates(), step + 1);
    EXPECT_EQ(picture.Rgba, this->DrawAnew(blocks).Rgba);
  }
}

TEST_F(TetrahedraRayCastTimeSteps, MovedPointsKeepTheCells)
{
  // The 8 points along each axis each stay in an eighth of their own, so that the order of the
  // vertices along their curve and with it all rounding is that of a new mapper.
  const Grid grid = MakeBlock(7, WavyField(3.0));
  const auto scene = this->MakeScene(grid);
  scene->RenderFloat();
  vtkTetrahedraRayCastMapper* mapper = scene->GetRayCaster();
  const vtkTypeInt64 cells = 32 * grid->GetNumberOfCells();
  for (int step = 1; step < Steps; ++step)
  {
    SCOPED_TRACE(step);
    const Grid moved = Moved(grid, Wobble, 0.3 * step);
    const Work before(mapper);
    const FloatImage picture = this->Draw(*scene, moved);
    const Work after(mapper);
    EXPECT_EQ(after.Builds, 1);
    EXPECT_EQ(after.Points, step);
    EXPECT_EQ(after.Scalars, 1);
    EXPECT_EQ(after.Bounds, before.Bounds + 1);
    EXPECT_GT(after.Bytes, before.Bytes);
    EXPECT_LT(after.Bytes - before.Bytes, cells);
    EXPECT_EQ(mapper->GetNumberOfActiveSetBuilds(), 1);
    EXPECT_EQ(picture.Rgba, this->DrawAnew(moved).Rgba);
  }
}

TEST_F(TetrahedraRayCastTimeSteps, MovedPointsWithOtherScalars)
{
  const Grid grid = MakeBlock(7, WavyField(3.0));
  const auto scene = this->MakeScene(grid);
  scene->RenderFloat();
  for (int step = 1; step < 4; ++step)
  {
    SCOPED_TRACE(step);
    const Grid both = WithWave(Moved(grid, Wobble, step), step);
    const FloatImage picture = this->Draw(*scene, both);
    const Work work(scene->GetRayCaster());
    EXPECT_EQ(work.Builds, 1);
    EXPECT_EQ(work.Points, step);
    EXPECT_EQ(work.Scalars, 1 + step);
    EXPECT_EQ(picture.Rgba, this->DrawAnew(both).Rgba);
  }
}

TEST_F(TetrahedraRayCastTimeSteps, LargeMotionsAndMirrors)
{
  const Grid grid = MakeBlock(6, WavyField(3.0), Torus(0.6, 0.35));
  const auto scene = this->MakeScene(grid);
  scene->RenderFloat();
  for (const double time : { 0.5, 1.0, 3.0 })
  {
    SCOPED_TRACE(time);
    this->ExpectMoved(*scene, Moved(grid, Bend, time));
  }
  this->ExpectMoved(*scene, Moved(Moved(grid, Bend, 1.0), Mirror, 0.0));
  this->ExpectMoved(*scene, grid);
}

TEST_F(TetrahedraRayCastTimeSteps, LightFollowsMovedPoints)
{
  this->Property->ShadeOn();
  const Grid grid = MakeBlock(7, WavyField(3.0));
  for (const int place :
    { vtkTetrahedraRayCastMapper::VERTEX_GRADIENTS, vtkTetrahedraRayCastMapper::CELL_GRADIENTS })
  {
    SCOPED_TRACE(place);
    const auto draw = [this, place](RayCastScene& scene, vtkDataObject* data)
    {
      scene.GetRayCaster()->SetGradients(place);
      return this->Draw(scene, data);
    };
    const auto scene = this->MakeScene(grid);
    draw(*scene, grid);
    const Grid moved = Moved(grid, Wobble, 1.0);
    const FloatImage picture = draw(*scene, moved);
    EXPECT_EQ(scene->GetRayCaster()->GetStatistic("NumberOfPointUpdates"), 1);
    // Sums over the cells of a vertex depend on the order of the cells.
    ExpectSamePicture(picture, draw(*this->MakeScene(moved), moved), "lit");
  }
}

TEST_F(TetrahedraRayCastTimeSteps, BlocksMoveTogether)
{
  const std::vector<Grid> cubes = TwoCubes();
  const auto scene = this->MakeScene(MakeBlocks(cubes));
  scene->RenderFloat();
  for (const double time : { 0.5, 1.0 })
  {
    this->ExpectMoved(
      *scene, MakeBlocks({ Moved(cubes[0], Bend, time), Moved(cubes[1], Bend, time) }));
  }
  // One cube moves onto the other one: its cells are duplicates.
  this->ExpectBuilt(*scene, MakeBlocks({ cubes[0], Copy(cubes[0]) }));
  EXPECT_EQ(scene->GetRayCaster()->GetNumberOfRejectedCells(), cubes[0]->GetNumberOfCells());
  this->ExpectBuilt(*scene, MakeBlocks(cubes));
}

TEST_F(TetrahedraRayCastTimeSteps, OtherCellTypesMove)
{
  for (const int type : { VTK_HEXAHEDRON, VTK_CONVEX_POINT_SET })
  {
    SCOPED_TRACE(type);
    const Grid cell = Grid::New();
    vtkNew<vtkPoints> points;
    const double corners[8][3] = { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 }, { 0, 0, 1 },
      { 1, 0, 1 }, { 1, 1, 1 }, { 0, 1, 1 } };
    vtkNew<vtkDoubleArray> scalars;
    for (const auto& corner : corners)
    {
      points->InsertNextPoint(corner);
      scalars->InsertNextValue(corner[0] - corner[1] + 0.5 * corner[2]);
    }
    cell->SetPoints(points);
    cell->GetPointData()->SetScalars(scalars);
    const vtkIdType ids[8] = { 0, 1, 2, 3, 4, 5, 6, 7 };
    cell->InsertNextCell(type, 8, ids);
    const auto scene = this->MakeScene(cell);
    scene->RenderFloat();
    const Grid moved = Moved(cell, Bend, 0.3);
    // Positions decide on the hull of a set of points.
    if (type == VTK_HEXAHEDRON)
    {
      this->ExpectMoved(*scene, moved);
    }
    else
    {
      this->ExpectBuilt(*scene, moved);
    }
  }
}

TEST_F(TetrahedraRayCastTimeSteps, OtherCellsAreAnotherMesh)
{
  const Grid grid = MakeBlock(6, WavyField(3.0));
  const auto scene = this->MakeScene(grid);
  scene->RenderFloat();
  this->ExpectBuilt(*scene, MakeBlock(5, WavyField(3.0)));
  // As many points and cells, two cells exchanged their corners.
  const Grid exchanged = MakeBlock(5, WavyField(3.0));
  vtkDataArray* ids = exchanged->GetCells()->GetConnectivityArray();
  const double first = ids->GetComponent(40, 0);
  ids->SetComponent(40, 0, ids->GetComponent(400, 0));
  ids->SetComponent(400, 0, first);
  this->ExpectBuilt(*scene, exchanged);
}

TEST_F(TetrahedraRayCastTimeSteps, PositionsThatAreNotFinite)
{
  const Grid grid = MakeBlock(6, WavyField(3.0));
  const auto scene = this->MakeScene(grid);
  const auto observer = ObserveErrors(scene->GetRayCaster());
  scene->RenderFloat();
  const Grid broken = Copy(grid);
  const double nan[3] = { 0.0, std::numeric_limits<double>::quiet_NaN(), 0.0 };
  broken->GetPoints()->SetPoint(171, nan);
  this->ExpectBuilt(*scene, broken);
  EXPECT_GT(scene->GetRayCaster()->GetNumberOfRejectedCells(), 0);
  ASSERT_EQ(observer->Warnings.size(), 1u);
  EXPECT_TRUE(HasText(observer->Warnings[0], "not finite"));
  this->ExpectBuilt(*scene, grid);
  EXPECT_EQ(scene->GetRayCaster()->GetNumberOfRejectedCells(), 0);
}

TEST_F(TetrahedraRayCastTimeSteps, AnArrayOfTheWrongLengthIsAnErrorOfItsStep)
{
  const Grid grid = MakeBlock(6, WavyField(3.0));
  const auto scene = this->MakeScene(grid);
  const auto observer = ObserveErrors(scene->GetRayCaster());
  scene->RenderFloat();
  const Grid broken = Copy(grid);
  broken->GetPointData()->GetScalars()->SetNumberOfTuples(grid->GetNumberOfPoints() - 1);
  for (const float value : this->Draw(*scene, broken).Rgba)
  {
    ASSERT_EQ(value, 0.0f);
  }
  EXPECT_EQ(observer->Errors.size(), 1u);
  EXPECT_TRUE(HasText(observer->GetText(), "values for"));
  // The next step finds the mesh again.
  const Grid next = WithWave(grid, 1.0);
  EXPECT_EQ(this->Draw(*scene, next).Rgba, this->DrawAnew(next).Rgba);
  EXPECT_EQ(scene->GetRayCaster()->GetNumberOfMeshBuilds(), 1);
}

TEST_F(TetrahedraRayCastTimeSteps, ThreeChangedSignsAreSeen)
{
  // In a digest whose steps spread a word's highest bit to bit 31 only, these three changes of four
  // bytes each cancel.
  const Grid grid = MakeBlock(6, WavyField(3.0));
  const auto scalars = MakeArray<vtkFloatArray>(ScalarName, grid->GetNumberOfPoints(),
    [&](vtkIdType p) { return 0.5f + 0.001f * static_cast<float>(p); });
  grid->GetPointData()->SetScalars(scalars);
  const auto scene = this->MakeScene(grid);
  scene->RenderFloat();
  const Grid changed = Copy(grid);
  for (const vtkIdType p : { 1, 8, 9 })
  {
    changed->GetPointData()->GetScalars()->SetComponent(p, 0, -scalars->GetValue(p));
  }
  const FloatImage picture = this->Draw(*scene, changed);
  EXPECT_EQ(scene->GetRayCaster()->GetNumberOfScalarUpdates(), 2);
  EXPECT_EQ(picture.Rgba, this->DrawAnew(changed).Rgba);
}
