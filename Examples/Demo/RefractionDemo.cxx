// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "RefractionDemo.h"

#include "DemoPictures.h"
#include "DemoProgress.h"

#include "vtkActor.h"
#include "vtkAppendPolyData.h"
#include "vtkCamera.h"
#include "vtkCellData.h"
#include "vtkConeSource.h"
#include "vtkCylinderSource.h"
#include "vtkNew.h"
#include "vtkPlaneSource.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkRefractedGeometryFilter.h"
#include "vtkSmartPointer.h"
#include "vtkSphereSource.h"
#include "vtkTransform.h"
#include "vtkTransformPolyDataFilter.h"
#include "vtkTriangleFilter.h"
#include "vtkUnsignedCharArray.h"

#include <cmath>
#include <cstdio>

namespace
{

// The pool extends from -1 to 1 in x and y, and from the water at z = 0 down to its bottom.
constexpr double PoolDepth = 0.9;
constexpr int WallResolution = 48;
constexpr int TilesPerWall = 12;

/** Colours the quads of a plane source as tiles. */
void ColorTiles(vtkPolyData* wall, const double light[3], const double dark[3])
{
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetName("Color");
  colors->SetNumberOfComponents(3);
  colors->SetNumberOfTuples(wall->GetNumberOfCells());
  for (vtkIdType quad = 0; quad < wall->GetNumberOfCells(); ++quad)
  {
    const int column = static_cast<int>(quad % WallResolution) * TilesPerWall / WallResolution;
    const int row = static_cast<int>(quad / WallResolution) * TilesPerWall / WallResolution;
    const double* color = (column + row) % 2 == 0 ? light : dark;
    for (int i = 0; i < 3; ++i)
    {
      colors->SetComponent(quad, i, 255.0 * color[i]);
    }
  }
  wall->GetCellData()->SetScalars(colors);
}

void AddWall(vtkAppendPolyData* pool, const double origin[3], const double point1[3],
  const double point2[3], bool isBottom)
{
  vtkNew<vtkPlaneSource> plane;
  plane->SetOrigin(origin[0], origin[1], origin[2]);
  plane->SetPoint1(point1[0], point1[1], point1[2]);
  plane->SetPoint2(point2[0], point2[1], point2[2]);
  plane->SetResolution(WallResolution, WallResolution);
  plane->Update();
  const double light[3] = { 0.95, 0.95, 0.90 };
  const double bottomDark[3] = { 0.20, 0.45, 0.65 };
  const double wallDark[3] = { 0.45, 0.70, 0.75 };
  ColorTiles(plane->GetOutput(), light, isBottom ? bottomDark : wallDark);
  pool->AddInputData(plane->GetOutput());
}

void AddObject(vtkAppendPolyData* pool, vtkPolyDataAlgorithm* source, const double position[3],
  double rotation, const double color[3])
{
  vtkNew<vtkTransform> transform;
  transform->Translate(position);
  transform->RotateX(rotation);
  vtkNew<vtkTransformPolyDataFilter> placed;
  placed->SetInputConnection(source->GetOutputPort());
  placed->SetTransform(transform);
  vtkNew<vtkTriangleFilter> triangles;
  triangles->SetInputConnection(placed->GetOutputPort());
  triangles->Update();
  vtkPolyData* object = triangles->GetOutput();
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetName("Color");
  colors->SetNumberOfComponents(3);
  colors->SetNumberOfTuples(object->GetNumberOfCells());
  for (int i = 0; i < 3; ++i)
  {
    colors->FillComponent(i, 255.0 * color[i]);
  }
  object->GetCellData()->SetScalars(colors);
  pool->AddInputData(object);
}

/** Bottom, three walls and three objects, coloured by cell. */
vtkSmartPointer<vtkPolyData> MakePool()
{
  vtkNew<vtkAppendPolyData> pool;
  const double d = -PoolDepth;
  const double low[4][3] = { { -1, -1, d }, { 1, -1, d }, { 1, 1, d }, { -1, 1, d } };
  AddWall(pool, low[0], low[1], low[3], true);
  for (int i = 1; i < 4; ++i) // the side facing the eye stays open
  {
    const double* from = low[i];
    const double top[3] = { from[0], from[1], -0.02 };
    AddWall(pool, from, low[(i + 1) % 4], top, false);
  }
  vtkNew<vtkSphereSource> ball;
  ball->SetRadius(0.22);
  ball->SetThetaResolution(48);
  ball->SetPhiResolution(32);
  const double ballAt[3] = { -0.45, 0.25, -0.6 };
  const double red[3] = { 0.85, 0.25, 0.20 };
  AddObject(pool, ball, ballAt, 0.0, red);
  vtkNew<vtkCylinderSource> post;
  post->SetRadius(0.12);
  post->SetHeight(0.7);
  post->SetResolution(48);
  const double postAt[3] = { 0.45, 0.45, d + 0.35 };
  const double yellow[3] = { 0.95, 0.75, 0.20 };
  AddObject(pool, post, postAt, 90.0, yellow);
  vtkNew<vtkConeSource> cone;
  cone->SetRadius(0.2);
  cone->SetHeight(0.5);
  cone->SetResolution(48);
  cone->SetDirection(0.0, 0.0, 1.0);
  const double coneAt[3] = { 0.3, -0.45, d + 0.25 };
  const double green[3] = { 0.25, 0.65, 0.35 };
  AddObject(pool, cone, coneAt, 0.0, green);
  pool->Update();
  vtkSmartPointer<vtkPolyData> result = pool->GetOutput();
  result->GetPointData()->SetNormals(nullptr); // flat shading: virtual surfaces have other normals
  return result;
}

/** The water: a little larger than the pool, with two wave trains. */
vtkSmartPointer<vtkPolyData> MakeWater()
{
  vtkNew<vtkPlaneSource> plane;
  plane->SetOrigin(-1.9, -1.9, 0.0);
  plane->SetPoint1(1.9, -1.9, 0.0);
  plane->SetPoint2(-1.9, 1.9, 0.0);
  plane->SetResolution(128, 128);
  vtkNew<vtkTriangleFilter> triangles;
  triangles->SetInputConnection(plane->GetOutputPort());
  triangles->Update();
  vtkSmartPointer<vtkPolyData> water = triangles->GetOutput();
  vtkPoints* points = water->GetPoints();
  vtkDataArray* normals = water->GetPointData()->GetNormals();
  for (vtkIdType p = 0; p < points->GetNumberOfPoints(); ++p)
  {
    double x[3];
    points->GetPoint(p, x);
    const double first = 7.0 * x[0] + 2.0 * x[1];
    const double second = 5.0 * x[1] - 3.0 * x[0];
    x[2] = 0.020 * std::sin(first) + 0.025 * std::sin(second);
    const double slopeX = 0.020 * 7.0 * std::cos(first) - 0.025 * 3.0 * std::cos(second);
    const double slopeY = 0.020 * 2.0 * std::cos(first) + 0.025 * 5.0 * std::cos(second);
    const double length = std::sqrt(1.0 + slopeX * slopeX + slopeY * slopeY);
    points->SetPoint(p, x);
    normals->SetTuple3(p, -slopeX / length, -slopeY / length, 1.0 / length);
  }
  return water;
}

vtkSmartPointer<vtkActor> MakeActor(vtkPolyData* data)
{
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(data);
  mapper->SetScalarModeToUseCellData();
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->SetInterpolationToFlat();
  actor->GetProperty()->SetAmbient(0.35);
  actor->GetProperty()->SetDiffuse(0.7);
  return actor;
}

void PrintCounters(vtkRefractedGeometryFilter* filter)
{
  std::printf("  %lld points and %lld cells of virtual geometry; membrane builds %lld, eye updates "
              "%lld, solved vertices %lld, without image %lld, failed %lld, cells left out %lld\n",
    static_cast<long long>(filter->GetOutput()->GetNumberOfPoints()),
    static_cast<long long>(filter->GetOutput()->GetNumberOfCells()),
    filter->GetNumberOfPatchBuilds(), filter->GetNumberOfEyeUpdates(),
    filter->GetNumberOfSolvedVertices(),
    static_cast<long long>(filter->GetStatistic("NumberOfVerticesWithoutImage")),
    filter->GetNumberOfFailedSolves(),
    static_cast<long long>(filter->GetStatistic("NumberOfSkippedCells")));
}

}

//------------------------------------------------------------------------------
bool RunRefractionDemo(const std::string& folder)
{
  const auto pool = MakePool();
  const auto water = MakeWater();
  std::printf("Refraction: pool of %lld cells under a membrane of %lld facets\n",
    static_cast<long long>(pool->GetNumberOfCells()),
    static_cast<long long>(water->GetNumberOfCells()));

  DemoPictures pictures(folder);
  vtkRenderer* renderer = pictures.GetRenderer();
  vtkCamera* camera = renderer->GetActiveCamera();
  const double eye[3] = { 0.4, -2.7, 2.5 };
  camera->SetPosition(eye);
  camera->SetFocalPoint(0.0, 0.0, -0.4);
  camera->SetViewUp(0.0, 0.0, 1.0);
  camera->SetViewAngle(42.0);

  vtkNew<vtkRefractedGeometryFilter> refraction;
  refraction->SetInputData(0, pool);
  refraction->SetMembraneData(water);
  refraction->SetCamera(camera);
  UpdateWithProgress(refraction, "Virtual geometry");
  PrintCounters(refraction);
  const auto truePool = MakeActor(pool);
  const auto virtualPool = MakeActor(refraction->GetOutput());

  renderer->AddActor(truePool);
  bool written = pictures.Write("refraction-true", "the pool without water");
  renderer->RemoveActor(truePool);
  renderer->AddActor(virtualPool);
  written =
    pictures.Write("refraction-virtual", "its virtual geometry, as seen through the waves") &&
    written;

  // From the side: the virtual geometry is flatter and curved; the true one is drawn as lines. The
  // filter keeps its eye: the image shows the geometry for that eye.
  refraction->SetCamera(nullptr);
  refraction->SetEyePosition(eye[0], eye[1], eye[2]);
  truePool->GetProperty()->SetRepresentationToWireframe();
  truePool->GetProperty()->SetOpacity(0.15);
  renderer->AddActor(truePool);
  const auto surface = MakeActor(water);
  surface->GetProperty()->SetColor(0.3, 0.5, 0.9);
  surface->GetProperty()->SetOpacity(0.35);
  renderer->AddActor(surface);
  camera->SetPosition(0.9, -4.6, 0.35);
  camera->SetFocalPoint(0.0, 0.0, -0.4);
  written =
    pictures.Write("refraction-side", "virtual geometry from the side, true one in lines") &&
    written;
  PrintCounters(refraction);
  return written;
}
