// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "WellScene.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCommand.h>
#include <vtkDoubleArray.h>
#include <vtkMath.h>
#include <vtkOpenGLError.h> // OpenGL itself, with whichever loader VTK uses
#include <vtkOpenGLRenderWindow.h>
#include <vtkOpenGLState.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRefractedGeometryFilter.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace meniscus::benchmark
{

namespace
{

const double Pi = std::acos(-1.0);
// Tangent of half the view angle: the well fills the image.
constexpr double HalfTangent = 0.26;
const glm::dvec3 Target(0.0, -30.0, 0.0);
constexpr double SquareSide = 200.0;
constexpr double SphereRadius = 141.5; // the corners of the square almost reach the equator
constexpr double FarSide = 50.0;       // the well's far wall is below the membrane's border

void AddSide(vtkPoints* points, vtkCellArray* quads, const glm::dvec3& origin, const glm::dvec3& u,
  const glm::dvec3& v, int n)
{
  const vtkIdType first = points->GetNumberOfPoints();
  for (int j = 0; j <= n; ++j)
  {
    for (int i = 0; i <= n; ++i)
    {
      const glm::dvec3 p = origin + u * (double(i) / n) + v * (double(j) / n);
      points->InsertNextPoint(p.x, p.y, p.z);
    }
  }
  for (int j = 0; j < n; ++j)
  {
    for (int i = 0; i < n; ++i)
    {
      const vtkIdType a = first + j * (n + 1) + i;
      const vtkIdType ids[4] = { a, a + 1, a + n + 2, a + n + 1 };
      quads->InsertNextCell(4, ids);
    }
  }
}

vtkSmartPointer<vtkPolyData> MakeWell(int n)
{
  constexpr double w = WellScene::HalfWidth;
  constexpr double low = -WellScene::Depth;
  constexpr double height = WellScene::Top - low;
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> quads;
  const glm::dvec3 up(0.0, height, 0.0);
  AddSide(points, quads, { -w, low, -w }, { 2 * w, 0, 0 }, { 0, 0, 2 * w }, n);
  AddSide(points, quads, { -w, low, -w }, { 2 * w, 0, 0 }, up, n);
  AddSide(points, quads, { -w, low, w }, { 2 * w, 0, 0 }, up, n);
  AddSide(points, quads, { -w, low, -w }, { 0, 0, 2 * w }, up, n);
  AddSide(points, quads, { w, low, -w }, { 0, 0, 2 * w }, up, n);
  auto well = vtkSmartPointer<vtkPolyData>::New();
  well->SetPoints(points);
  well->SetPolys(quads);
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetName("Color");
  colors->SetNumberOfComponents(3);
  colors->SetNumberOfTuples(well->GetNumberOfCells());
  well->GetCellData()->SetScalars(colors);
  return well;
}

void Translate(vtkPolyData* data, const glm::dvec3& by)
{
  vtkPoints* points = data->GetPoints();
  for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i)
  {
    glm::dvec3 p;
    points->GetPoint(i, &p.x);
    p += by;
    points->SetPoint(i, &p.x);
  }
  points->Modified();
  data->Modified();
}

} // anonymous namespace

//------------------------------------------------------------------------------
WellScene::WellScene(int cells, int quads, WellSurface surface)
  : Surface(surface)
  , Field{ reference::HeightField::Shape::Waves, SquareSide, 1.5, 0.03 * Pi, 1.0, 1.333 }
  , Present(this->Field)
  , Cells(cells)
  , Well(MakeWell(quads))
  , Membrane(test::MakeMembrane(this->MakeMesh()))
{
  this->Filter->SetInputData(0, this->Well);
  this->Filter->SetMembraneData(this->Membrane);
  this->Filter->SetExteriorIndexOfRefraction(this->Field.Exterior);
  this->Filter->SetInteriorIndexOfRefraction(this->Field.Interior);
  this->Present.Amplitude = surface == WellSurface::Plane ? 0.0 : this->Field.Amplitude;
  this->ChangeColors(0);
  this->MoveEye(0.0);
}

//------------------------------------------------------------------------------
WellScene::~WellScene() = default;

//------------------------------------------------------------------------------
reference::MembraneMesh WellScene::MakeMesh() const
{
  switch (this->Surface)
  {
    case WellSurface::Waves:
      return this->Field.MakeMesh(this->Cells);
    case WellSurface::Plane:
      return reference::MakeSquare(SquareSide, this->Cells, 0.0);
    case WellSurface::HemisphereUp:
    case WellSurface::HemisphereDown:
      break;
  }
  reference::MembraneMesh mesh = reference::MakeSquare(SquareSide, this->Cells, SphereRadius);
  if (this->Surface == WellSurface::HemisphereDown)
  {
    for (std::size_t i = 0; i < mesh.Points.size(); i += 3)
    {
      mesh.Points[i + 1] = SphereRadius - mesh.Points[i + 1];
      mesh.Normals[i] = -mesh.Normals[i];
      mesh.Normals[i + 2] = -mesh.Normals[i + 2];
    }
  }
  return mesh;
}

//------------------------------------------------------------------------------
reference::HeightField WellScene::FieldAt(double time) const
{
  reference::HeightField field = this->Field;
  field.Amplitude *= 1.0 + 0.3 * std::sin(time);
  return field;
}

//------------------------------------------------------------------------------
void WellScene::MoveMembrane(double time)
{
  if (this->Surface != WellSurface::Waves)
  {
    Translate(this->Membrane, { 0.0, 0.01 * std::sin(time), 0.0 });
    return;
  }
  this->Present = this->FieldAt(time);
  vtkPoints* points = this->Membrane->GetPoints();
  vtkDataArray* normals = this->Membrane->GetPointData()->GetNormals();
  for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i)
  {
    double p[3];
    points->GetPoint(i, p);
    p[1] = this->Present.GetHeight(p[0], p[2]);
    points->SetPoint(i, p);
    const glm::dvec3 normal = this->Present.GetNormal(p[0], p[2]);
    normals->SetTuple(i, &normal.x);
  }
  points->Modified();
  normals->Modified();
  this->Membrane->Modified();
}

//------------------------------------------------------------------------------
void WellScene::MoveEye(double time)
{
  this->Eye = glm::dvec3(20.0 * std::cos(time), 300.0, 20.0 * std::sin(time));
  this->Filter->SetEyePosition(this->Eye.x, this->Eye.y, this->Eye.z);
}

//------------------------------------------------------------------------------
void WellScene::ChangeColors(int number)
{
  vtkDataArray* colors = this->Well->GetCellData()->GetScalars();
  for (vtkIdType i = 0; i < colors->GetNumberOfTuples(); ++i)
  {
    const auto tint = static_cast<double>((number + 5 * i) % 200);
    colors->SetTuple3(i, 55.0 + tint, i % 2 ? 200.0 : 60.0, 220.0 - tint);
  }
  colors->Modified();
  this->Well->Modified();
}

//------------------------------------------------------------------------------
void WellScene::MoveWell(double time)
{
  Translate(this->Well, { 0.0, 0.01 * std::sin(time), 0.0 });
}

//------------------------------------------------------------------------------
void WellScene::MoveWellAside()
{
  Translate(this->Well, { FarSide, 0.0, 0.0 });
}

//------------------------------------------------------------------------------
test::PixelCamera WellScene::GetCamera() const
{
  return { this->Eye, Target, HalfTangent };
}

//------------------------------------------------------------------------------
void WellScene::SetUpWindow()
{
  if (this->HasMatrix)
  {
    this->Mapper->SetInputData(this->Well);
    this->Actor->SetScale(1.0, this->GetScale(), 1.0);
  }
  else if (this->Instead)
  {
    this->Mapper->SetInputData(this->Instead);
  }
  else
  {
    this->Mapper->SetInputConnection(this->Filter->GetOutputPort());
  }
  this->Mapper->SetScalarModeToUseCellData();
  this->Actor->SetMapper(this->Mapper);
  this->Actor->GetProperty()->LightingOff();
  this->Renderer->AddActor(this->Actor);
  this->Renderer->AddObserver(vtkCommand::StartEvent, this, &WellScene::PrepareState);
  this->Window->SetOffScreenRendering(1);
  this->Window->SetMultiSamples(0);
  this->Window->SetSize(512, 512);
  this->Window->AddRenderer(this->Renderer);
  vtkCamera* camera = this->Renderer->GetActiveCamera();
  camera->SetViewAngle(2.0 * vtkMath::DegreesFromRadians(std::atan(HalfTangent)));
  camera->SetFocalPoint(Target.x, Target.y, Target.z);
  camera->SetViewUp(0.0, 0.0, 1.0);
  camera->SetClippingRange(100.0, 1000.0);
  this->HasWindow = true;
}

//------------------------------------------------------------------------------
void WellScene::PrepareState()
{
  auto* window = vtkOpenGLRenderWindow::SafeDownCast(this->Window);
  window->GetState()->SetEnumState(GL_BLEND, this->Blends);
}

//------------------------------------------------------------------------------
void WellScene::UseMatrix()
{
  this->HasMatrix = true;
}

//------------------------------------------------------------------------------
double WellScene::GetScale() const
{
  return this->Field.Exterior / this->Field.Interior;
}

//------------------------------------------------------------------------------
void WellScene::Draw()
{
  if (!this->HasWindow)
  {
    this->SetUpWindow();
  }
  this->Renderer->GetActiveCamera()->SetPosition(this->Eye.x, this->Eye.y, this->Eye.z);
  this->Window->Render();
  this->Window->WaitForCompletion();
}

//------------------------------------------------------------------------------
void WellScene::Update()
{
  this->Filter->Update();
}

//------------------------------------------------------------------------------
test::PlacePixel WellScene::Meet(const glm::dvec3& start, const glm::dvec3& direction)
{
  double t = std::numeric_limits<double>::max();
  for (const int axis : { 0, 2 })
  {
    const double wall = direction[axis] > 0.0 ? HalfWidth : -HalfWidth;
    const double at = (wall - start[axis]) / direction[axis];
    // A ray that starts next to the well may meet a wall from outside.
    const double other = (-wall - start[axis]) / direction[axis];
    for (const double candidate : { other, at })
    {
      const glm::dvec3 hit = start + candidate * direction;
      const double across = axis == 0 ? hit.z : hit.x;
      if (candidate > 0.0 && candidate < t && std::fabs(across) <= HalfWidth && hit.y <= Top &&
        hit.y >= -Depth)
      {
        t = candidate;
      }
    }
  }
  const double bottom = (-Depth - start.y) / direction.y;
  const glm::dvec3 hit = start + bottom * direction;
  test::PlacePixel pixel;
  if (bottom > 0.0 && bottom < t && std::max(std::fabs(hit.x), std::fabs(hit.z)) <= HalfWidth)
  {
    t = bottom;
  }
  pixel.Covered = t < std::numeric_limits<double>::max();
  pixel.Place = start + (pixel.Covered ? t : bottom) * direction;
  return pixel;
}

//------------------------------------------------------------------------------
test::PlacePicture WellScene::Trace() const
{
  return test::TracePlaces(this->Present, this->GetCamera(), &WellScene::Meet);
}

//------------------------------------------------------------------------------
test::PlacePicture WellScene::DrawPlaces()
{
  test::AddPlaces(this->Well);
  this->Well->Modified();
  vtkSmartPointer<vtkPolyData> drawn;
  if (this->HasMatrix)
  {
    drawn = vtkSmartPointer<vtkPolyData>::New();
    drawn->DeepCopy(this->Well);
    for (vtkIdType i = 0; i < drawn->GetNumberOfPoints(); ++i)
    {
      double p[3];
      drawn->GetPoint(i, p);
      drawn->GetPoints()->SetPoint(i, p[0], p[1] * this->GetScale(), p[2]);
    }
  }
  else
  {
    this->Filter->Update();
    drawn = this->Filter->GetOutput();
  }
  const auto picture = test::DrawPlaces(drawn, this->GetCamera());
  this->Well->GetPointData()->RemoveArray("Place");
  return picture;
}

} // namespace meniscus::benchmark
