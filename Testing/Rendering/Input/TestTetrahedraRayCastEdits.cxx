// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Edits of the input in place: they are detected whichever object receives Modified(), and nothing
// is rebuilt for an object that was modified without a change of values. The counters and images of
// new objects prove both.
#include "RayCastScene.h"

using namespace meniscus::test;

namespace
{

constexpr int Size = 72;

using NamedObjects = std::vector<std::pair<std::string, vtkObject*>>;

// Builds of the mesh, updates of the positions and of the scalars, uploaded bytes.
struct Work
{
  vtkTypeInt64 Mesh;
  vtkTypeInt64 Points;
  vtkTypeInt64 Scalars;
  vtkTypeInt64 Bytes;

  explicit Work(vtkTetrahedraRayCastMapper* mapper)
    : Mesh(mapper->GetNumberOfMeshBuilds())
    , Points(mapper->GetStatistic("NumberOfPointUpdates"))
    , Scalars(mapper->GetNumberOfScalarUpdates())
    , Bytes(mapper->GetUploadedBytes())
  {
  }
};

class TetrahedraRayCastEdits : public ::testing::Test
{
protected:
  TetrahedraRayCastEdits()
    : Mesh(MakeBlock(4, WavyField(3.0)))
  {
    const double range[2] = { -1.5, 1.5 };
    this->Property = MakeProperty(FunctionKind::Smooth, range, 3.5);
  }

  std::unique_ptr<RayCastScene> MakeScene(vtkDataSet* data)
  {
    auto scene = std::make_unique<RayCastScene>(nullptr, this->Property, Size, Size);
    scene->GetRayCaster()->SetInputData(data);
    // Bounds of all data sets here: an edit that changes bounds must not move the camera.
    const double bounds[6] = { -1.0, 1.0, -1.0, 1.0, -1.0, 1.0 };
    LookAt(scene->GetRenderer(), bounds, 30.0, 20.0);
    scene->GetWindow()->Render();
    return scene;
  }

  enum class Part
  {
    Cells,
    Points,
    Scalars
  };

  // Makes an edit of a part that is different each time, calls Modified() of one object after
  // another, and expects the work and the image of new objects.
  void ExpectSeen(
    vtkDataSet* data, const NamedObjects& told, const std::function<void(int)>& edit, Part part)
  {
    const auto scene = this->MakeScene(data);
    FloatImage last = scene->RenderFloat();
    for (std::size_t i = 0; i < told.size(); ++i)
    {
      SCOPED_TRACE(told[i].first);
      const Work before(scene->GetRayCaster());
      edit(static_cast<int>(i));
      told[i].second->Modified();
      const FloatImage picture = scene->RenderFloat();
      const Work after(scene->GetRayCaster());
      EXPECT_EQ(after.Mesh - before.Mesh, part == Part::Cells);
      EXPECT_EQ(after.Points - before.Points, part == Part::Points);
      // Other cells have their scalars in another order.
      EXPECT_EQ(after.Scalars - before.Scalars, part != Part::Points);
      EXPECT_GT(after.Bytes, before.Bytes);
      EXPECT_NE(picture.Rgba, last.Rgba);
      const auto copy = vtkSmartPointer<vtkDataSet>::Take(data->NewInstance());
      copy->DeepCopy(data);
      EXPECT_EQ(this->MakeScene(copy)->RenderFloat().Rgba, picture.Rgba);
      last = picture;
    }
  }

  Grid Mesh;
  vtkSmartPointer<vtkVolumeProperty> Property;
};

vtkDoubleArray* AddCellScalars(vtkUnstructuredGrid* grid)
{
  grid->GetCellData()->SetScalars(MakeArray(ScalarName, grid->GetNumberOfCells(),
    [&](vtkIdType c) { return std::sin(0.1 * static_cast<double>(c)); }));
  return vtkDoubleArray::SafeDownCast(grid->GetCellData()->GetScalars());
}

} // anonymous namespace

TEST_F(TetrahedraRayCastEdits, ScalarsOfPoints)
{
  vtkDataArray* scalars = this->Mesh->GetPointData()->GetScalars();
  this->ExpectSeen(
    this->Mesh,
    { { "array", scalars }, { "point data", this->Mesh->GetPointData() }, { "grid", this->Mesh } },
    [scalars](int i)
    {
      // One value: of an inner vertex, which every ray through its cells shows.
      scalars->SetComponent(62, 0, 0.3 + 0.3 * i);
    },
    Part::Scalars);
}

TEST_F(TetrahedraRayCastEdits, ScalarsOfCells)
{
  this->Mesh->GetPointData()->Initialize();
  vtkDoubleArray* scalars = AddCellScalars(this->Mesh);
  this->ExpectSeen(
    this->Mesh,
    { { "array", scalars }, { "cell data", this->Mesh->GetCellData() }, { "grid", this->Mesh } },
    [scalars](int i) { scalars->SetValue(scalars->GetNumberOfTuples() / 2, 0.3 + 0.3 * i); },
    Part::Scalars);
}

TEST_F(TetrahedraRayCastEdits, Points)
{
  vtkPoints* points = this->Mesh->GetPoints();
  this->ExpectSeen(
    this->Mesh,
    { { "points", points }, { "array", points->GetData() }, { "grid", this->Mesh },
      { "point data", this->Mesh->GetPointData() } },
    [points](int i)
    {
      const glm::dvec3 x = PointOf(points, 62);
      points->SetPoint(62, x[0], x[1] + 0.02 * (i + 1), x[2]);
    },
    Part::Points);
}

TEST_F(TetrahedraRayCastEdits, Connectivity)
{
  vtkCellArray* cells = this->Mesh->GetCells();
  this->ExpectSeen(
    this->Mesh,
    { { "cells", cells }, { "array", cells->GetConnectivityArray() }, { "grid", this->Mesh },
      { "cell data", this->Mesh->GetCellData() } },
    [cells](int i)
    {
      // A cell with a repeated point is left out.
      vtkDataArray* ids = cells->GetConnectivityArray();
      ids->SetComponent(4 * (100 + i) + 1, 0, ids->GetComponent(4 * (100 + i), 0));
    },
    Part::Cells);
}

TEST_F(TetrahedraRayCastEdits, HiddenCells)
{
  this->Mesh->AllocateCellGhostArray();
  vtkUnsignedCharArray* ghosts = this->Mesh->GetCellGhostArray();
  this->ExpectSeen(
    this->Mesh,
    { { "array", ghosts }, { "cell data", this->Mesh->GetCellData() }, { "grid", this->Mesh } },
    [ghosts](int i) { ghosts->SetValue(100 + i, vtkDataSetAttributes::HIDDENCELL); }, Part::Cells);
}

TEST_F(TetrahedraRayCastEdits, CoordinatesOfARectilinearGrid)
{
  vtkNew<vtkRectilinearGrid> grid;
  grid->SetDimensions(4, 4, 4);
  vtkNew<vtkDoubleArray> axes[3];
  for (vtkDoubleArray* axis : { axes[0].Get(), axes[1].Get(), axes[2].Get() })
  {
    for (const double value : { -0.8, -0.3, 0.2, 0.7 })
    {
      axis->InsertNextValue(value);
    }
  }
  grid->SetXCoordinates(axes[0]);
  grid->SetYCoordinates(axes[1]);
  grid->SetZCoordinates(axes[2]);
  grid->GetPointData()->SetScalars(MakeArray(nullptr, grid->GetNumberOfPoints(),
    [&](vtkIdType p) { return std::sin(static_cast<double>(p)); }));
  this->ExpectSeen(
    grid, { { "array", axes[1] }, { "grid", grid } },
    [&axes](int i) { axes[1]->SetValue(3, 0.8 + 0.1 * i); }, Part::Points);
}

TEST_F(TetrahedraRayCastEdits, Membrane)
{
  const auto source = MakePlane(2.0, 0.2, 4);
  source->Update();
  vtkPolyData* membrane = source->GetOutput();
  membrane->GetPointData()->Initialize(); // normals are computed from the shape
  const auto draw = [this](vtkPolyData* surface)
  {
    auto scene = this->MakeScene(this->Mesh);
    scene->GetRayCaster()->SetMembraneData(surface);
    LookAt(scene->GetRenderer(), this->Mesh->GetBounds(), 30.0, 60.0);
    return scene;
  };
  const auto scene = draw(membrane);
  FloatImage last = scene->RenderFloat();
  vtkCellArray* polys = membrane->GetPolys();
  const NamedObjects told{ { "points", membrane->GetPoints() },
    { "coordinates", membrane->GetPoints()->GetData() }, { "point data", membrane->GetPointData() },
    { "cells", polys }, { "connectivity", polys->GetConnectivityArray() },
    { "membrane", membrane } };
  double builds = scene->GetRayCaster()->GetStatistic("NumberOfMembraneBuilds");
  for (std::size_t i = 0; i < told.size(); ++i)
  {
    SCOPED_TRACE(told[i].first);
    membrane->GetPoints()->SetPoint(12, 0.0, 0.0, 0.25 + 0.05 * static_cast<double>(i));
    told[i].second->Modified();
    const FloatImage picture = scene->RenderFloat();
    EXPECT_EQ(scene->GetRayCaster()->GetStatistic("NumberOfMembraneBuilds"), ++builds);
    EXPECT_NE(picture.Rgba, last.Rgba);
    vtkNew<vtkPolyData> copy;
    copy->DeepCopy(membrane);
    EXPECT_EQ(draw(copy)->RenderFloat().Rgba, picture.Rgba);
    last = picture;
    told[i].second->Modified();
    scene->GetWindow()->Render();
    EXPECT_EQ(scene->GetRayCaster()->GetStatistic("NumberOfMembraneBuilds"), builds);
  }
}

TEST_F(TetrahedraRayCastEdits, ModifiedWithoutAnotherValueCostsNothing)
{
  AddCellScalars(this->Mesh);
  const auto scene = this->MakeScene(this->Mesh);
  const NamedObjects objects{ { "scalars", this->Mesh->GetPointData()->GetScalars() },
    { "point data", this->Mesh->GetPointData() }, { "cell data", this->Mesh->GetCellData() },
    { "points", this->Mesh->GetPoints() }, { "coordinates", this->Mesh->GetPoints()->GetData() },
    { "cells", this->Mesh->GetCells() },
    { "connectivity", this->Mesh->GetCells()->GetConnectivityArray() },
    { "offsets", this->Mesh->GetCells()->GetOffsetsArray() },
    { "cell scalars", this->Mesh->GetCellData()->GetScalars() }, { "grid", this->Mesh } };
  for (const auto& object : objects)
  {
    const Work before(scene->GetRayCaster());
    object.second->Modified();
    scene->GetWindow()->Render();
    const Work after(scene->GetRayCaster());
    EXPECT_EQ(after.Mesh, before.Mesh) << object.first;
    EXPECT_EQ(after.Points, before.Points) << object.first;
    EXPECT_EQ(after.Scalars, before.Scalars) << object.first;
    EXPECT_EQ(after.Bytes, before.Bytes) << object.first;
  }
}

TEST_F(TetrahedraRayCastEdits, EqualObjectsAreTheSameMesh)
{
  const auto scene = this->MakeScene(this->Mesh);
  vtkNew<vtkUnstructuredGrid> copy;
  copy->DeepCopy(this->Mesh);
  scene->GetRayCaster()->SetInputData(copy);
  scene->GetWindow()->Render();
  EXPECT_EQ(scene->GetRayCaster()->GetNumberOfMeshBuilds(), 1);
  EXPECT_EQ(scene->GetRayCaster()->GetNumberOfScalarUpdates(), 1);
  // From now on the copy is watched.
  copy->GetPointData()->GetScalars()->SetComponent(62, 0, 0.4);
  copy->Modified();
  scene->GetWindow()->Render();
  EXPECT_EQ(scene->GetRayCaster()->GetNumberOfScalarUpdates(), 2);
}

TEST_F(TetrahedraRayCastEdits, UploadedBytesAreThoseOfTheTables)
{
  // 32 bytes per cell, 16 per vertex, at least 16 per boundary face, and the transfer function.
  const auto scene = this->MakeScene(this->Mesh);
  vtkTetrahedraRayCastMapper* mapper = scene->GetRayCaster();
  const vtkTypeInt64 cells = 32 * this->Mesh->GetNumberOfCells();
  const vtkTypeInt64 vertices = 16 * this->Mesh->GetNumberOfPoints();
  const vtkTypeInt64 faces = 6 * 4 * 4 * 2;
  const vtkTypeInt64 all = mapper->GetUploadedBytes();
  EXPECT_GE(all, cells + vertices + 16 * faces);
  EXPECT_LE(all, cells + vertices + 80 * faces + 48 * 1000);
  // Another view uploads nothing, other scalars upload those of the vertices, another function its
  // points.
  LookAt(scene->GetRenderer(), this->Mesh->GetBounds(), 70.0, -20.0);
  scene->GetWindow()->Render();
  EXPECT_EQ(mapper->GetUploadedBytes(), all);
  this->Mesh->GetPointData()->GetScalars()->SetComponent(62, 0, 0.4);
  this->Mesh->GetPointData()->GetScalars()->Modified();
  scene->GetWindow()->Render();
  EXPECT_EQ(mapper->GetUploadedBytes() - all, vertices);
  this->Property->SetScalarOpacityUnitDistance(0.7);
  scene->GetWindow()->Render();
  EXPECT_GT(mapper->GetUploadedBytes() - all, vertices);
  EXPECT_LE(mapper->GetUploadedBytes() - all, vertices + 48 * 1000);
}
