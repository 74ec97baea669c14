// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "PoolScene.h"

#include "ExactStack.h"

#include <vtkAppendPolyData.h>
#include <vtkConeSource.h>
#include <vtkGenericCell.h>
#include <vtkRefractedGeometryFilter.h>
#include <vtkRefractionPass.h>
#include <vtkStaticCellLocator.h>
#include <vtkTexture.h>
#include <vtkTransformPolyDataFilter.h>
#include <vtkTriangleFilter.h>

#include <glm/exponential.hpp>

namespace meniscus::test
{
namespace
{

constexpr double HalfWidth = 60.0;
constexpr double Depth = 80.0;
constexpr double Index = 1.333;
constexpr double HalfTangent = 0.3;
constexpr glm::dvec3 Eye{ 60.0, 260.0, -130.0 };
constexpr glm::dvec3 Target{ 0.0, -20.0, 0.0 };
constexpr glm::dvec3 Background{ 235.0 / 255.0, 239.0 / 255.0, 243.0 / 255.0 };
constexpr double Far = 1000.0;
// A lamp in the water, between the objects.
constexpr glm::dvec3 LampPlace{ 0.0, -30.0, 15.0 };
constexpr double LampAmbient = 0.1;
constexpr double LampDiffuse = 0.9;
constexpr glm::dvec3 LampFalloff{ 0.6, 0.004, 0.0001 };
constexpr int TextureSize = 256;
constexpr int SkySize = 128;

reference::HeightField MakeWaves(double time)
{
  reference::HeightField field;
  field.Shape = reference::HeightField::Shape::Waves;
  field.Side = 2.0 * HalfWidth;
  field.Amplitude = 2.0 * std::cos(time);
  field.K = 0.12;
  field.Exterior = 1.0;
  field.Interior = Index;
  return field;
}

unsigned char ToByte(double value)
{
  return static_cast<unsigned char>(std::lround(255.0 * std::clamp(value, 0.0, 1.0)));
}

/** Tiles with soft joints. */
vtkSmartPointer<vtkImageData> MakeTiles()
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(TextureSize, TextureSize, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  const auto joint = [](int i)
  {
    const double t = 8.0 * (i + 0.5) / TextureSize; // eight tiles
    return std::pow(std::sin(vtkMath::Pi() * t), 2.0);
  };
  for (const auto& [j, i] : Product(TextureSize, TextureSize))
  {
    const double tile = std::sqrt(std::min(joint(i), joint(j)));
    const bool dark = (i * 8 / TextureSize + j * 8 / TextureSize) % 2 != 0;
    const glm::dvec3 color = dark ? glm::dvec3(0.25, 0.55, 0.75) : glm::dvec3(0.85, 0.9, 0.8);
    auto* pixel = static_cast<unsigned char*>(image->GetScalarPointer(i, j, 0));
    for (int c = 0; c < 3; ++c)
    {
      pixel[c] = ToByte(0.5 + tile * (color[c] - 0.5));
    }
  }
  return image;
}

// Bilinear interpolation, as in OpenGL's samplers.
glm::dvec3 GetSample(vtkImageData* image, double u, double v)
{
  const auto fetch = [image](int i, int j)
  {
    const int x = std::clamp(i, 0, TextureSize - 1);
    const int y = std::clamp(j, 0, TextureSize - 1);
    const auto* p = static_cast<const unsigned char*>(image->GetScalarPointer(x, y, 0));
    return glm::dvec3(p[0], p[1], p[2]) / 255.0;
  };
  const double x = u * TextureSize - 0.5;
  const double y = v * TextureSize - 0.5;
  const int i = static_cast<int>(std::floor(x));
  const int j = static_cast<int>(std::floor(y));
  const double s = x - i;
  const double t = y - j;
  return (1.0 - t) * ((1.0 - s) * fetch(i, j) + s * fetch(i + 1, j)) +
    t * ((1.0 - s) * fetch(i, j + 1) + s * fetch(i + 1, j + 1));
}

/**
 * Direction of a texel of a cube map: face, column and row in the order of OpenGL's table of faces.
 */
glm::dvec3 CubeDirection(int face, int column, int row)
{
  const double s = 2.0 * (column + 0.5) / SkySize - 1.0;
  const double t = 2.0 * (row + 0.5) / SkySize - 1.0;
  const glm::dvec3 directions[6] = { { 1.0, -t, -s }, { -1.0, -t, s }, { s, 1.0, t },
    { s, -1.0, -t }, { s, -t, 1.0 }, { -s, -t, -1.0 } };
  return glm::normalize(directions[face]);
}

vtkSmartPointer<vtkTexture> MakeSky()
{
  auto sky = vtkSmartPointer<vtkTexture>::New();
  sky->CubeMapOn();
  sky->InterpolateOn();
  for (int face = 0; face < 6; ++face)
  {
    vtkNew<vtkImageData> image;
    image->SetDimensions(SkySize, SkySize, 1);
    image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
    for (const auto& [j, i] : Product(SkySize, SkySize))
    {
      const glm::dvec3 color = SkyColor(CubeDirection(face, i, j));
      auto* pixel = static_cast<unsigned char*>(image->GetScalarPointer(i, j, 0));
      for (int c = 0; c < 3; ++c)
      {
        pixel[c] = ToByte(color[c]);
      }
    }
    sky->SetInputDataObject(face, image);
  }
  return sky;
}

vtkSmartPointer<vtkPolyData> MakeWalls()
{
  vtkNew<vtkAppendPolyData> walls;
  walls->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  const double w = HalfWidth;
  const double low[4][3] = { { -w, -Depth, -w }, { w, -Depth, -w }, { w, -Depth, w },
    { -w, -Depth, w } };
  for (int side = 0; side < 5; ++side)
  {
    const double* origin = low[side % 4];
    const double* along = low[(side + 1) % 4];
    const double* floor = low[3];
    const double top[3] = { origin[0], -4.0, origin[2] };
    const double* up = side == 4 ? floor : top;
    vtkNew<vtkPlaneSource> plane;
    plane->SetOrigin(origin[0], origin[1], origin[2]);
    plane->SetPoint1(along[0], along[1], along[2]);
    plane->SetPoint2(up[0], up[1], up[2]);
    plane->SetResolution(16, 16);
    plane->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
    plane->Update();
    vtkNew<vtkPolyData> copy;
    copy->ShallowCopy(plane->GetOutput());
    copy->GetPointData()->RemoveArray("Normals");
    // Coordinates stay away from the border of the image, so that its wrap mode has no effect.
    vtkDataArray* coordinates = copy->GetPointData()->GetTCoords();
    copy->GetPointData()->SetTCoords(
      MakeArray<vtkFloatArray>("TextureCoordinates", coordinates->GetNumberOfTuples(),
        [&](vtkIdType i)
        {
          return glm::dvec2(0.02 + 0.96 * coordinates->GetComponent(i, 0),
            0.02 + 0.96 * coordinates->GetComponent(i, 1));
        }));
    walls->AddInputData(copy);
  }
  vtkNew<vtkTriangleFilter> triangles;
  triangles->SetInputConnection(walls->GetOutputPort());
  triangles->Update();
  return triangles->GetOutput();
}

vtkSmartPointer<vtkPolyData> MakePlace(
  vtkPolyDataAlgorithm* source, const glm::dvec3& at, double turn)
{
  vtkNew<vtkTransform> transform;
  transform->Translate(at.x, at.y, at.z);
  transform->RotateWXYZ(turn, 1.0, 0.5, 0.2);
  vtkNew<vtkTransformPolyDataFilter> placed;
  placed->SetInputConnection(source->GetOutputPort());
  placed->SetTransform(transform);
  placed->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  vtkNew<vtkTriangleFilter> triangles;
  triangles->SetInputConnection(placed->GetOutputPort());
  triangles->Update();
  vtkSmartPointer<vtkPolyData> data = triangles->GetOutput();
  data->GetPointData()->Initialize();
  return data;
}

/** Nearest hit of several surfaces behind a point. */
class PoolHit
{
public:
  explicit PoolHit(const std::vector<vtkSmartPointer<vtkPolyData>>& parts)
  {
    for (vtkPolyData* part : parts)
    {
      this->Locators.emplace_back(vtkSmartPointer<vtkStaticCellLocator>::New());
      this->Locators.back()->SetDataSet(part);
      this->Locators.back()->BuildLocator();
      part->GetCell(0); // builds the tables that threads share
    }
  }

  void Find(const glm::dvec3& start, const glm::dvec3& direction, vtkGenericCell* cell,
    PoolSight& sight) const
  {
    sight.Distance = Far;
    for (std::size_t i = 0; i < this->Locators.size(); ++i)
    {
      glm::dvec3 from = start;
      glm::dvec3 to = start + Far * direction;
      double t = 0.0;
      double x[3];
      double pcoords[3];
      int part = 0;
      vtkIdType id = -1;
      if (this->Locators[i]->IntersectWithLine(
            &from.x, &to.x, 1e-9, t, x, pcoords, part, id, cell) &&
        t * Far < sight.Distance)
      {
        sight.Part = static_cast<int>(i);
        sight.Cell = id;
        sight.Weights = { 1.0 - pcoords[0] - pcoords[1], pcoords[0], pcoords[1] };
        sight.Distance = t * Far;
      }
    }
  }

private:
  std::vector<vtkSmartPointer<vtkStaticCellLocator>> Locators;
};

} // anonymous namespace

//------------------------------------------------------------------------------
glm::dvec3 SkyColor(const glm::dvec3& d)
{
  return 0.5 +
    0.3 * glm::dvec3(std::sin(3.0 * d.x), std::sin(2.0 * d.y + 1.0), std::cos(3.0 * d.z));
}

//------------------------------------------------------------------------------
PoolScene::PoolScene(int cells, double time)
  : Field(MakeWaves(time))
  , Cells(cells)
  , Camera(Eye, Target, HalfTangent, Pixels)
  , Water(MakeMembrane(this->Field.MakeMesh(cells)))
  , Sky(MakeSky())
  , Window(Pixels, Pixels)
{
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(this->Water);
  this->WaterActor = vtkSmartPointer<vtkActor>::New();
  this->WaterActor->SetMapper(mapper);
  this->AddPart(MakeWalls(), MakeTiles(), glm::dvec3(1.0));
  vtkNew<vtkSphereSource> ball;
  ball->SetRadius(16.0);
  ball->SetThetaResolution(48);
  ball->SetPhiResolution(32);
  this->AddPart(MakePlace(ball, { -22.0, -50.0, 10.0 }, 0.0), nullptr, { 0.85, 0.2, 0.15 });
  vtkNew<vtkCubeSource> box;
  box->SetXLength(24.0);
  box->SetYLength(24.0);
  box->SetZLength(24.0);
  this->AddPart(MakePlace(box, { 25.0, -55.0, 20.0 }, 40.0), nullptr, { 0.9, 0.7, 0.1 });
  vtkNew<vtkConeSource> cone;
  cone->SetRadius(14.0);
  cone->SetHeight(34.0);
  cone->SetResolution(48);
  this->AddPart(MakePlace(cone, { 5.0, -40.0, -28.0 }, 70.0), nullptr, { 0.2, 0.7, 0.3 });

  vtkRenderer* renderer = this->Window.GetRenderer();
  renderer->SetBackground(Background.x, Background.y, Background.z);
  vtkCamera* camera = renderer->GetActiveCamera();
  camera->SetPosition(Eye.x, Eye.y, Eye.z);
  camera->SetFocalPoint(Target.x, Target.y, Target.z);
  camera->SetViewUp(0.0, 0.0, 1.0);
  camera->SetViewAngle(2.0 * vtkMath::DegreesFromRadians(std::atan(HalfTangent)));
  camera->SetClippingRange(50.0, 800.0);
  renderer->SetPass(this->Pass);
  this->SetOptics({});
}

//------------------------------------------------------------------------------
PoolScene::~PoolScene() = default;

//------------------------------------------------------------------------------
void PoolScene::AddPart(vtkPolyData* data, vtkImageData* image, const glm::dvec3& color)
{
  Part part;
  part.Data = data;
  part.Image = image;
  part.Color = color;
  part.Filter = vtkSmartPointer<vtkRefractedGeometryFilter>::New();
  part.Filter->SetInputData(0, data);
  part.Filter->SetMembraneData(this->Water);
  part.Filter->SetCamera(this->Window.GetRenderer()->GetActiveCamera());
  part.Filter->SetInteriorIndexOfRefraction(Index);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(part.Filter->GetOutputPort());
  mapper->ScalarVisibilityOff();
  part.Actor = vtkSmartPointer<vtkActor>::New();
  part.Actor->SetMapper(mapper);
  part.Actor->GetProperty()->SetColor(color.r, color.g, color.b);
  part.Actor->GetProperty()->LightingOff();
  if (image)
  {
    vtkNew<vtkTexture> texture;
    texture->SetInputData(image);
    texture->InterpolateOn();
    part.Actor->SetTexture(texture);
    vtkDataArray* coordinates = data->GetPointData()->GetTCoords();
    vtkNew<vtkIdList> ids;
    for (vtkIdType i = 0; i < data->GetNumberOfCells(); ++i)
    {
      data->GetCellPoints(i, ids);
      std::array<glm::dvec2, 3> corners;
      for (std::size_t k = 0; k < 3; ++k)
      {
        double uv[2];
        coordinates->GetTuple(ids->GetId(static_cast<vtkIdType>(k)), uv);
        corners[k] = { uv[0], uv[1] };
      }
      part.Coordinates.push_back(corners);
    }
  }
  this->Pass->AddRefraction(this->WaterActor, part.Actor, part.Filter);
  this->Parts.push_back(part);
}

//------------------------------------------------------------------------------
void PoolScene::SetOptics(const PoolOptics& optics)
{
  this->Optics = optics;
  this->Pass->SetReflectanceModel(
    optics.Fresnel ? vtkRefractionPass::FRESNEL : vtkRefractionPass::NONE);
  this->Pass->SetReflectionTexture(optics.Sky ? this->Sky.Get() : nullptr);
  this->Pass->SetAttenuationCoefficients(
    optics.Attenuation.r, optics.Attenuation.g, optics.Attenuation.b);
  this->Pass->SetMediumColor(optics.Scattered.r, optics.Scattered.g, optics.Scattered.b);
  this->SetLamp(optics.Lamp);
}

//------------------------------------------------------------------------------
void PoolScene::SetLamp(bool isOn)
{
  this->Pass->SetLighting(isOn ? vtkRefractionPass::TRUE_SPACE : vtkRefractionPass::VIRTUAL_SPACE);
  for (const Part& part : this->Parts)
  {
    vtkProperty* property = part.Actor->GetProperty();
    property->SetLighting(isOn);
    property->SetAmbient(LampAmbient);
    property->SetDiffuse(LampDiffuse);
    part.Filter->SetTrueGeometry(isOn);
  }
  vtkRenderer* renderer = this->Window.GetRenderer();
  renderer->RemoveAllLights();
  if (isOn)
  {
    vtkNew<vtkLight> lamp;
    lamp->SetLightTypeToSceneLight();
    lamp->PositionalOn();
    lamp->SetConeAngle(90.0);
    lamp->SetPosition(LampPlace.x, LampPlace.y, LampPlace.z);
    lamp->SetAttenuationValues(LampFalloff.x, LampFalloff.y, LampFalloff.z);
    renderer->AddLight(lamp);
  }
}

//------------------------------------------------------------------------------
void PoolScene::MoveWater(double time)
{
  this->Field = MakeWaves(time);
  const auto mesh = MakeMembrane(this->Field.MakeMesh(this->Cells));
  this->Water->SetPoints(mesh->GetPoints());
  this->Water->GetPointData()->SetNormals(mesh->GetPointData()->GetNormals());
}

//------------------------------------------------------------------------------
test::ByteImage PoolScene::Draw()
{
  this->Window.GetWindow()->Render();
  return test::ReadBytes(this->Window.GetWindow());
}

//------------------------------------------------------------------------------
void PoolScene::SetAccuracy(bool allImages, double tolerance)
{
  for (const Part& part : this->Parts)
  {
    part.Filter->SetImages(
      allImages ? vtkRefractedGeometryFilter::ALL_IMAGES : vtkRefractedGeometryFilter::FIRST_IMAGE);
    part.Filter->SetAngularTolerance(tolerance);
  }
}

//------------------------------------------------------------------------------
void PoolScene::ShowObjects(bool show)
{
  for (std::size_t i = 1; i < this->Parts.size(); ++i)
  {
    this->Parts[i].Actor->SetVisibility(show);
  }
}

//------------------------------------------------------------------------------
/** Light of the lamp that a facet reflects to a sight ray, without the water's colour. */
double PoolScene::LampAt(const PoolSight& sight) const
{
  const Part& part = this->Parts[static_cast<std::size_t>(sight.Part)];
  glm::dvec3 corners[3];
  for (int k = 0; k < 3; ++k)
  {
    part.Data->GetPoint(
      part.Data->GetPolys()->GetConnectivityArray()->GetComponent(3 * sight.Cell + k, 0),
      &corners[k].x);
  }
  const glm::dvec3 normal =
    glm::normalize(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
  const glm::dvec3 toLamp = LampPlace - (sight.Start + sight.Distance * sight.Behind);
  const double distance = glm::length(toLamp);
  const double facing = glm::dot(normal, toLamp) / distance;
  // The lit side is the one that is seen.
  const double lit = glm::dot(normal, sight.Behind) < 0.0 ? facing : -facing;
  return std::max(lit, 0.0) / glm::dot(LampFalloff, glm::dvec3(1.0, distance, distance * distance));
}

//------------------------------------------------------------------------------
glm::dvec3 PoolScene::Shade(const PoolSight& sight) const
{
  glm::dvec3 color = Background;
  if (sight.Part >= 0)
  {
    const Part& part = this->Parts[static_cast<std::size_t>(sight.Part)];
    color = part.Color;
    if (part.Image)
    {
      const auto& corners = part.Coordinates[static_cast<std::size_t>(sight.Cell)];
      const glm::dvec2 uv = sight.Weights[0] * corners[0] + sight.Weights[1] * corners[1] +
        sight.Weights[2] * corners[2];
      color = GetSample(part.Image, uv.x, uv.y);
    }
    if (this->Optics.Lamp)
    {
      const double way = glm::distance(LampPlace, sight.Start + sight.Distance * sight.Behind);
      color *=
        LampAmbient + LampDiffuse * this->LampAt(sight) * glm::exp(-way * this->Optics.Attenuation);
    }
    const glm::dvec3 seen = glm::exp(-sight.Distance * this->Optics.Attenuation);
    color = glm::min(seen * color + (1.0 - seen) * this->Optics.Scattered, glm::dvec3(1.0));
  }
  const double cosine = -glm::dot(sight.Ray, sight.Normal);
  const double reflected =
    this->Optics.Fresnel ? reference::MakeReflectance(cosine, 1.0, Index) : 0.0;
  const glm::dvec3 mirrored =
    this->Optics.Sky ? SkyColor(sight.Ray + 2.0 * cosine * sight.Normal) : Background;
  return (1.0 - reflected) * color + reflected * mirrored;
}

//------------------------------------------------------------------------------
PoolPicture PoolScene::Trace() const
{
  std::vector<vtkSmartPointer<vtkPolyData>> data;
  for (const Part& part : this->Parts)
  {
    data.push_back(part.Data);
  }
  const PoolHit pool(data);
  PoolPicture picture;
  picture.Colors.assign(static_cast<std::size_t>(Pixels) * Pixels, Background);
  std::vector<char> isWater(picture.Colors.size(), 0); // bits are shared by threads

  vtkSMPTools::For(0, Pixels,
    [&](vtkIdType begin, vtkIdType end)
    {
      vtkNew<vtkGenericCell> cell;
      for (vtkIdType i = begin * Pixels; i < end * Pixels; ++i)
      {
        const glm::dvec3 ray =
          this->Camera.GetRay(static_cast<int>(i % Pixels), static_cast<int>(i / Pixels));
        const glm::dvec3 start = this->Field.Intersect(Eye, ray, Eye.y / -ray.y);
        const double reach = std::max(std::fabs(start.x), std::fabs(start.z));
        if (!(ray.y < 0.0 && reach <= HalfWidth))
        {
          continue;
        }
        PoolSight sight;
        sight.Ray = ray;
        sight.Normal = this->Field.GetNormal(start.x, start.z);
        const glm::dvec3 behind = this->Field.Refract(Eye, start, 1.0).value_or(start) - start;
        sight.Start = start;
        sight.Behind = glm::normalize(behind);
        pool.Find(start, sight.Behind, cell, sight);
        isWater[static_cast<std::size_t>(i)] = 1;
        picture.Colors[static_cast<std::size_t>(i)] = this->Shade(sight);
      }
    });
  picture.IsWater.assign(isWater.begin(), isWater.end());
  return picture;
}

} // namespace meniscus::test
