// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "StackDemo.h"

#include "DemoProgress.h"
#include "WellScene.h"

#include "vtkActor.h"
#include "vtkAppendPolyData.h"
#include "vtkCamera.h"
#include "vtkCellData.h"
#include "vtkCubeSource.h"
#include "vtkCylinderSource.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkImageShrink3D.h"
#include "vtkLight.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkPNGWriter.h"
#include "vtkParametricFunctionSource.h"
#include "vtkParametricTorus.h"
#include "vtkPlaneSource.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkPolyDataNormals.h"
#include "vtkProperty.h"
#include "vtkRefractedGeometryFilter.h"
#include "vtkRefractedLightFilter.h"
#include "vtkRefractingInterface.h"
#include "vtkRefractingInterfaceCollection.h"
#include "vtkRefractionPass.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkSphere.h"
#include "vtkSphereSource.h"
#include "vtkTexture.h"
#include "vtkTransform.h"
#include "vtkTransformPolyDataFilter.h"
#include "vtkTriangleFilter.h"
#include "vtkUnsignedCharArray.h"
#include "vtkVectorText.h"
#include "vtkWindowToImageFilter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>

namespace
{

constexpr int StackPictureSize = 768;
constexpr int Samples = 4; // pixels of the window per pixel of the picture, along a side
constexpr double Glass = 1.52;

using Color = std::array<double, 3>;
using ColorRule = std::function<Color(const double center[3])>;

//------------------------------------------------------------------------------
/** Gives each cell the colour of its place. */
void ColorCells(vtkPolyData* data, const ColorRule& rule)
{
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetName("Color");
  colors->SetNumberOfComponents(3);
  colors->SetNumberOfTuples(data->GetNumberOfCells());
  vtkNew<vtkIdList> ids;
  for (vtkIdType i = 0; i < data->GetNumberOfCells(); ++i)
  {
    data->GetCellPoints(i, ids);
    double center[3] = { 0.0, 0.0, 0.0 };
    for (vtkIdType k = 0; k < ids->GetNumberOfIds(); ++k)
    {
      double p[3];
      data->GetPoint(ids->GetId(k), p);
      vtkMath::Add(center, p, center);
    }
    vtkMath::MultiplyScalar(center, 1.0 / static_cast<double>(ids->GetNumberOfIds()));
    const Color color = rule(center);
    for (int c = 0; c < 3; ++c)
    {
      const double value = color[static_cast<std::size_t>(c)];
      colors->SetComponent(i, c, 255.0 * std::min(std::max(value, 0.0), 1.0));
    }
  }
  data->GetCellData()->SetScalars(colors);
}

ColorRule MakeColor(const Color& color)
{
  return [color](const double*) { return color; };
}

vtkSmartPointer<vtkPolyData> Place(
  vtkPolyDataAlgorithm* source, const std::function<void(vtkTransform*)>& move)
{
  vtkNew<vtkTransform> transform;
  move(transform);
  vtkNew<vtkTransformPolyDataFilter> placed;
  placed->SetInputConnection(source->GetOutputPort());
  placed->SetTransform(transform);
  placed->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  vtkNew<vtkTriangleFilter> triangles;
  triangles->SetInputConnection(placed->GetOutputPort());
  triangles->Update();
  return triangles->GetOutput();
}

vtkSmartPointer<vtkPolyData> MakeSheet(double half, double height, int cells)
{
  vtkNew<vtkPlaneSource> plane;
  plane->SetOrigin(-half, -half, height);
  plane->SetPoint1(half, -half, height);
  plane->SetPoint2(-half, half, height);
  plane->SetResolution(cells, cells);
  plane->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  plane->Update();
  return plane->GetOutput();
}

vtkSmartPointer<vtkActor> MakeActor(vtkPolyData* data, bool lit)
{
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(data);
  mapper->SetScalarModeToUseCellFieldData();
  mapper->SelectColorArray("Color");
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->SetLighting(lit);
  return actor;
}

//------------------------------------------------------------------------------
const double Sun[3] = { -0.28, 0.22, 0.93 };

/** Sky in a direction: bright at the horizon, with thin clouds and a soft sun. */
Color GetSky(const double direction[3])
{
  double d[3] = { direction[0], direction[1], direction[2] };
  vtkMath::Normalize(d);
  double sun[3] = { Sun[0], Sun[1], Sun[2] };
  vtkMath::Normalize(sun);
  const double up = std::max(d[2], 0.0);
  const double fade = std::pow(1.0 - up, 3.0);
  const double u = d[0] / (up + 0.25);
  const double v = d[1] / (up + 0.25);
  const double waves = std::sin(2.1 * u + 1.3 * std::sin(1.7 * v)) +
    std::sin(3.3 * v - 0.9 * u + 2.0 * std::sin(0.8 * u)) + 0.6 * std::sin(5.9 * u + 4.1 * v);
  const double cloud = 0.5 * std::min(std::max(0.35 * waves, 0.0), 1.0);
  const double glow = std::pow(std::max(vtkMath::Dot(d, sun), 0.0), 220.0);
  const Color zenith{ 0.22, 0.44, 0.76 };
  const Color horizon{ 0.86, 0.91, 0.95 };
  Color sky;
  for (std::size_t c = 0; c < 3; ++c)
  {
    const double clear = zenith[c] + (horizon[c] - zenith[c]) * fade;
    sky[c] = std::min(clear + (0.97 - clear) * cloud + glow, 1.0);
  }
  return sky;
}

/** The sky as a cube map; vtkRefractionPass::SetReflectionTexture() has the order of its faces. */
vtkSmartPointer<vtkTexture> MakeSky()
{
  constexpr int n = 256;
  auto texture = vtkSmartPointer<vtkTexture>::New();
  texture->CubeMapOn();
  texture->InterpolateOn();
  for (int face = 0; face < 6; ++face)
  {
    vtkNew<vtkImageData> image;
    image->SetDimensions(n, n, 1);
    image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
    for (int j = 0; j < n; ++j)
    {
      for (int i = 0; i < n; ++i)
      {
        const double u = (2.0 * i + 1.0) / n - 1.0;
        const double v = (2.0 * j + 1.0) / n - 1.0;
        const double directions[6][3] = { { 1.0, -v, -u }, { -1.0, -v, u }, { u, 1.0, v },
          { u, -1.0, -v }, { u, -v, 1.0 }, { -u, -v, -1.0 } };
        const Color sky = GetSky(directions[face]);
        for (int c = 0; c < 3; ++c)
        {
          image->SetScalarComponentFromDouble(i, j, 0, c, 255.0 * sky[static_cast<std::size_t>(c)]);
        }
      }
    }
    texture->SetInputDataObject(face, image);
  }
  return texture;
}

//------------------------------------------------------------------------------
/** A window with the refraction pass and the sky. */
class StackWindow
{
public:
  StackWindow(const double eye[3], const double target[3], double angle)
  {
    this->Window->SetOffScreenRendering(1);
    this->Window->SetMultiSamples(0);
    this->Window->SetSize(Samples * StackPictureSize, Samples * StackPictureSize);
    this->Window->AddRenderer(this->Renderer);
    this->Renderer->SetBackground(0.86, 0.91, 0.95);
    this->Renderer->SetBackground2(0.45, 0.62, 0.84);
    this->Renderer->GradientBackgroundOn();
    this->Pass->SetReflectionTexture(MakeSky());
    this->Renderer->SetPass(this->Pass);
    vtkCamera* camera = this->Renderer->GetActiveCamera();
    camera->SetPosition(eye);
    camera->SetFocalPoint(target);
    camera->SetViewUp(0.0, 0.0, 1.0);
    camera->SetViewAngle(angle);
    camera->SetClippingRange(0.5, 40.0);
    vtkNew<vtkLight> sun;
    sun->SetPositional(false);
    sun->SetPosition(Sun[0], Sun[1], Sun[2]);
    sun->SetFocalPoint(0.0, 0.0, 0.0);
    sun->SetIntensity(0.9);
    this->Renderer->AddLight(sun);
    vtkNew<vtkLight> fill;
    fill->SetLightTypeToHeadlight();
    fill->SetIntensity(0.45);
    this->Renderer->AddLight(fill);
  }

  vtkRenderer* GetRenderer() { return this->Renderer; }
  vtkRefractionPass* GetPass() { return this->Pass; }

  /** Sets the filter's eye; its tolerance is half a pixel of the picture. */
  void Follow(vtkRefractedGeometryFilter* filter)
  {
    vtkCamera* camera = this->Renderer->GetActiveCamera();
    filter->SetCamera(camera);
    filter->SetAngularTolerance(0.5 * camera->GetViewAngle() / StackPictureSize);
  }

  bool Write(const std::string& folder, const std::string& name, const std::string& caption)
  {
    this->Window->Render();
    vtkNew<vtkWindowToImageFilter> image;
    image->SetInput(this->Window);
    image->ReadFrontBufferOff();
    image->ShouldRerenderOff();
    vtkNew<vtkImageShrink3D> smaller;
    smaller->SetInputConnection(image->GetOutputPort());
    smaller->SetShrinkFactors(Samples, Samples, 1);
    smaller->MeanOn();
    vtkNew<vtkPNGWriter> writer;
    writer->SetInputConnection(smaller->GetOutputPort());
    const std::string file = folder + "/" + name + ".png";
    writer->SetFileName(file.c_str());
    writer->Write();
    if (writer->GetErrorCode() != 0)
    {
      std::fprintf(stderr, "error: %s cannot be written\n", file.c_str());
      return false;
    }
    std::printf("wrote %s (%d x %d): %s\n", file.c_str(), StackPictureSize, StackPictureSize,
      caption.c_str());
    return true;
  }

private:
  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkRenderWindow> Window;
  vtkNew<vtkRefractionPass> Pass;
};

//------------------------------------------------------------------------------
// The pool is 3 wide. Its water is 0.6 deep, on a pane of glass; air and the floor are below.
constexpr double PoolHalf = 1.5;
constexpr double PaneTop = -0.597;
constexpr double PaneBottom = -0.703;
constexpr double Floor = -1.9;
constexpr double RimTop = 0.2;

/** Checkered floor and four walls with a dark band. */
void AddFloorAndWalls(vtkAppendPolyData* room)
{
  constexpr int cells = 240; // also pixels of the light on the floor
  constexpr double tile = 2.0 * PoolHalf / 10.0;
  const auto floor = MakeSheet(PoolHalf, Floor, cells);
  ColorCells(floor,
    [](const double p[3])
    {
      const auto isOdd = static_cast<int>(std::floor((p[0] + PoolHalf) / tile)) +
        static_cast<int>(std::floor((p[1] + PoolHalf) / tile));
      return isOdd % 2 ? Color{ 0.16, 0.42, 0.58 } : Color{ 0.93, 0.91, 0.84 };
    });
  room->AddInputData(floor);
  for (int side = 0; side < 4; ++side)
  {
    vtkNew<vtkPlaneSource> wall;
    wall->SetOrigin(-PoolHalf, PoolHalf, Floor);
    wall->SetPoint1(PoolHalf, PoolHalf, Floor);
    wall->SetPoint2(-PoolHalf, PoolHalf, RimTop);
    wall->SetResolution(108, 63); // rows of 1 / 30, of which the pane has three
    const auto placed = Place(wall, [side](vtkTransform* move) { move->RotateZ(90.0 * side); });
    ColorCells(placed,
      [](const double p[3])
      {
        const bool isBand = p[2] > -0.7 && p[2] < -0.6;
        return isBand ? Color{ 0.30, 0.32, 0.34 } : Color{ 0.62, 0.80, 0.80 };
      });
    room->AddInputData(placed);
  }
}

/** Floor, walls and objects on the floor. */
vtkSmartPointer<vtkPolyData> MakeRoom()
{
  vtkNew<vtkAppendPolyData> room;
  AddFloorAndWalls(room);
  const auto add = [&room](vtkPolyDataAlgorithm* source, const Color& color,
                     const std::function<void(vtkTransform*)>& move)
  {
    const auto object = Place(source, move);
    ColorCells(object, MakeColor(color));
    room->AddInputData(object);
  };
  vtkNew<vtkSphereSource> ball;
  ball->SetRadius(0.38);
  ball->SetThetaResolution(96);
  ball->SetPhiResolution(64);
  add(ball, { 0.86, 0.22, 0.16 },
    [](vtkTransform* move) { move->Translate(-0.55, 0.35, Floor + 0.38); });
  vtkNew<vtkParametricTorus> ring;
  ring->SetRingRadius(0.36);
  ring->SetCrossSectionRadius(0.13);
  vtkNew<vtkParametricFunctionSource> torus;
  torus->SetParametricFunction(ring);
  torus->SetUResolution(96);
  torus->SetVResolution(48);
  add(torus, { 0.96, 0.72, 0.14 },
    [](vtkTransform* move)
    {
      move->Translate(0.55, -0.30, Floor + 0.13);
      move->RotateX(4.0);
    });
  vtkNew<vtkCylinderSource> post;
  post->SetRadius(0.16);
  post->SetHeight(0.8);
  post->SetResolution(96);
  add(post, { 0.20, 0.55, 0.30 },
    [](vtkTransform* move)
    {
      move->Translate(0.65, 0.75, Floor + 0.4);
      move->RotateX(90.0);
    });
  room->Update();
  vtkSmartPointer<vtkPolyData> result = room->GetOutput();
  result->GetPointData()->Initialize();
  return result;
}

/** The rim around the pool. */
vtkSmartPointer<vtkPolyData> MakeRim()
{
  vtkNew<vtkAppendPolyData> rim;
  constexpr double width = 1.6;
  for (int side = 0; side < 4; ++side)
  {
    vtkNew<vtkCubeSource> stone;
    stone->SetBounds(-PoolHalf - width, PoolHalf, PoolHalf, PoolHalf + width, -0.1, RimTop);
    rim->AddInputData(Place(stone, [side](vtkTransform* move) { move->RotateZ(90.0 * side); }));
  }
  rim->Update();
  vtkSmartPointer<vtkPolyData> result = rim->GetOutput();
  ColorCells(result, MakeColor({ 0.56, 0.52, 0.47 }));
  return result;
}

/** Multiplies the cells' colours by the light that arrives through the interfaces. */
void ShineOn(vtkPolyData* data, vtkDataArray* irradiance)
{
  vtkDataArray* colors = data->GetCellData()->GetArray("Color");
  for (vtkIdType i = 0; i < data->GetNumberOfCells(); ++i)
  {
    const double light = 0.62 + 0.55 * std::min(irradiance->GetTuple1(i), 2.0);
    for (int c = 0; c < 3; ++c)
    {
      colors->SetComponent(i, c, std::min(light * colors->GetComponent(i, c), 255.0));
    }
  }
}

bool DrawPane(const std::string& folder)
{
  const DemoWater water(0.35, 0.3);
  const auto waves = water.MakeMesh(96);
  const auto top = MakeSheet(2.4, PaneTop, 24);
  const auto bottom = MakeSheet(2.4, PaneBottom, 24);
  vtkNew<vtkRefractingInterfaceCollection> list;
  list->AddInterface(1.0, DemoWater::Index);
  list->AddInterface(DemoWater::Index, Glass);
  list->AddInterface(Glass, 1.0);

  vtkNew<vtkRefractedLightFilter> light;
  vtkNew<vtkRefractedGeometryFilter> seen;
  light->SetInterfaces(list);
  seen->SetInterfaces(list);
  for (vtkPolyData* surface : { waves.Get(), top.Get(), bottom.Get() })
  {
    light->AddMembraneData(surface);
    seen->AddMembraneData(surface);
  }
  light->SetInputData(0, MakeRoom());
  light->SetLightPosition(Sun[0], Sun[1], Sun[2]);
  light->OneSidedOff();
  UpdateWithProgress(light, "Sunlight through waves and a pane");
  vtkNew<vtkPolyData> room;
  room->ShallowCopy(light->GetOutput());
  ShineOn(room, room->GetCellData()->GetArray("RefractionIrradiance"));

  const double eye[3] = { 0.2, -3.3, 5.4 };
  const double target[3] = { 0.02, -0.02, -0.35 };
  StackWindow window(eye, target, 29.0);
  seen->SetInputData(0, room);
  seen->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  window.Follow(seen);
  UpdateWithProgress(seen, "Virtual geometry behind waves and a pane");
  const auto virtualRoom = MakeActor(seen->GetOutput(), false);
  window.GetPass()->AddRefraction(MakeActor(waves, false), virtualRoom, seen);
  window.GetPass()->SetAttenuationCoefficients(0.12, 0.04, 0.03);
  const auto rim = MakeActor(MakeRim(), true);
  rim->GetProperty()->SetAmbient(0.4);
  rim->GetProperty()->SetDiffuse(0.7);
  window.GetRenderer()->AddActor(rim);
  return window.Write(
    folder, "stack-pane", "objects below waves and a pane of glass: three interfaces");
}

//------------------------------------------------------------------------------
const char* const PageText[] = { "A ray that meets a lens is refracted",
  "twice. Every point of this page is moved", "to where the eye sees it through both",
  "surfaces, so the letters are polygons that", "any renderer draws: no ray is traced for",
  "a pixel. n sin a = m sin b holds at both", "sides of the glass, to the last digits of",
  "double precision. Snell 1621, Descartes", "1637, Fermat 1662, Fresnel 1823, Ofek",
  "and Rappoport 1998: light, mirrors and", "the geometry behind curved surfaces." };

vtkSmartPointer<vtkPolyData> MakePage()
{
  vtkNew<vtkAppendPolyData> page;
  const auto paper = MakeSheet(2.2, 0.0, 44);
  ColorCells(paper, MakeColor({ 0.97, 0.95, 0.89 }));
  page->AddInputData(paper);
  double y = 1.5;
  for (const char* line : PageText)
  {
    vtkNew<vtkVectorText> text;
    text->SetText(line);
    const auto placed = Place(text,
      [y](vtkTransform* move)
      {
        move->Translate(-1.9, y, 0.004);
        move->Scale(0.132, 0.155, 1.0);
      });
    ColorCells(placed, MakeColor({ 0.10, 0.12, 0.18 }));
    page->AddInputData(placed);
    y -= 0.315;
  }
  page->Update();
  vtkSmartPointer<vtkPolyData> result = page->GetOutput();
  result->GetPointData()->Initialize();
  return result;
}

// The magnifying glass: two caps of spheres of one radius around the point Middle.
constexpr double Middle[3] = { 0.2, 0.15, 0.75 };
constexpr double Aperture = 0.92;
constexpr double CapRadius = 2.6;

/** A cap above (+1) or below (-1) and its sphere. */
vtkSmartPointer<vtkPolyData> MakeCap(double side, vtkSphere* exact)
{
  const double angle = std::asin(Aperture / CapRadius);
  const double edge = 0.03; // half the thickness of the edge
  const double height = Middle[2] + side * (edge - CapRadius * std::cos(angle));
  vtkNew<vtkSphereSource> cap;
  cap->SetRadius(CapRadius);
  cap->SetCenter(Middle[0], Middle[1], height);
  const double degrees = vtkMath::DegreesFromRadians(angle);
  cap->SetStartPhi(side > 0.0 ? 0.0 : 180.0 - degrees);
  cap->SetEndPhi(side > 0.0 ? degrees : 180.0);
  cap->SetThetaResolution(72);
  cap->SetPhiResolution(24);
  cap->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  cap->Update();
  exact->SetRadius(CapRadius);
  exact->SetCenter(Middle[0], Middle[1], height);
  return cap->GetOutput();
}

/** Ring and handle. */
vtkSmartPointer<vtkActor> MakeHolder()
{
  vtkNew<vtkParametricTorus> torus;
  torus->SetRingRadius(Aperture + 0.045);
  torus->SetCrossSectionRadius(0.06);
  vtkNew<vtkParametricFunctionSource> ring;
  ring->SetParametricFunction(torus);
  ring->SetUResolution(160);
  ring->SetVResolution(40);
  vtkNew<vtkCylinderSource> grip;
  grip->SetRadius(0.085);
  grip->SetHeight(1.5);
  grip->SetResolution(64);
  vtkNew<vtkAppendPolyData> holder;
  holder->AddInputData(Place(ring, [](vtkTransform* move) { move->Translate(Middle); }));
  holder->AddInputData(Place(grip,
    [](vtkTransform* move)
    {
      move->Translate(Middle);
      move->RotateZ(-130.0);
      move->Translate(0.0, Aperture + 0.09 + 0.75, 0.0);
    }));
  vtkNew<vtkPolyDataNormals> normals;
  normals->SetInputConnection(holder->GetOutputPort());
  normals->SetFeatureAngle(50.0);
  normals->Update();
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(normals->GetOutput());
  mapper->ScalarVisibilityOff();
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(0.55, 0.40, 0.18);
  actor->GetProperty()->SetAmbient(0.25);
  actor->GetProperty()->SetSpecular(0.6);
  actor->GetProperty()->SetSpecularPower(30.0);
  return actor;
}

bool DrawLens(const std::string& folder)
{
  const auto page = MakePage();
  vtkNew<vtkRefractedGeometryFilter> seen;
  vtkNew<vtkRefractingInterfaceCollection> list;
  vtkNew<vtkSphere> spheres[2];
  vtkSmartPointer<vtkPolyData> caps[2];
  for (int i = 0; i < 2; ++i)
  {
    caps[i] = MakeCap(i == 0 ? 1.0 : -1.0, spheres[i]);
    // Both caps have normals that point outwards, to the air.
    list->AddInterface(1.0, Glass)->SetExactSurface(spheres[i]);
    seen->AddMembraneData(caps[i]);
  }
  seen->SetInterfaces(list);
  seen->SetInputData(0, page);
  seen->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  const double eye[3] = { 0.15, -2.0, 6.0 };
  const double target[3] = { 0.02, -0.02, 0.1 };
  StackWindow window(eye, target, 38.0);
  window.Follow(seen);
  UpdateWithProgress(seen, "Virtual geometry of a page behind a lens");
  window.GetPass()->AddRefraction(
    MakeActor(caps[0], false), MakeActor(seen->GetOutput(), false), seen);
  const auto table = MakeSheet(8.0, -0.05, 1);
  ColorCells(table, MakeColor({ 0.42, 0.29, 0.19 }));
  window.GetRenderer()->AddActor(MakeActor(table, false));
  window.GetRenderer()->AddActor(MakeActor(page, false));
  window.GetRenderer()->AddActor(MakeHolder());
  return window.Write(folder, "stack-lens", "a page under a magnifying glass: two interfaces");
}

}

//------------------------------------------------------------------------------
bool RunStackDemo(const std::string& folder)
{
  const bool pane = DrawPane(folder);
  return DrawLens(folder) && pane;
}
