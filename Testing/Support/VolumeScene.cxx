// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "VolumeScene.h"

#include <vtkFramebufferPass.h>
#include <vtkPixelBufferObject.h>
#include <vtkRenderStepsPass.h>
#include <vtkTextureObject.h>
#include <vtkUnstructuredGridVolumeMapper.h>

namespace meniscus::test
{

//------------------------------------------------------------------------------
bool HasDisplay()
{
  const char* display = std::getenv("DISPLAY");
  return display && *display;
}

//------------------------------------------------------------------------------
DisplayHold::DisplayHold()
{
  this->Window->SetOffScreenRendering(1);
  this->Window->SetSize(8, 8);
  this->Window->Render();
}

//------------------------------------------------------------------------------
DisplayHold::~DisplayHold() = default;

//------------------------------------------------------------------------------
VolumeScene::VolumeScene(int width, int height, int multiSamples)
{
  this->Window->SetOffScreenRendering(1);
  this->Window->SetMultiSamples(multiSamples);
  this->Window->SetSize(width, height);
  this->Window->AddRenderer(this->Renderer);
  this->Renderer->SetBackground(0.0, 0.0, 0.0);
  this->Renderer->SetBackgroundAlpha(0.0);
  this->Renderer->AddVolume(this->Volume);
  vtkNew<vtkRenderStepsPass> steps;
  this->FloatPass->SetDelegatePass(steps);
  this->FloatPass->SetColorFormat(vtkTextureObject::Float32);
  this->FloatPass->SetDepthFormat(vtkTextureObject::Float32);
}

//------------------------------------------------------------------------------
VolumeScene::~VolumeScene()
{
  this->FloatPass->ReleaseGraphicsResources(this->Window);
}

//------------------------------------------------------------------------------
void VolumeScene::SetMapper(vtkUnstructuredGridVolumeMapper* mapper)
{
  this->Volume->SetMapper(mapper);
}

//------------------------------------------------------------------------------
vtkUnstructuredGridVolumeMapper* VolumeScene::GetMapper() const
{
  return vtkUnstructuredGridVolumeMapper::SafeDownCast(this->Volume->GetMapper());
}

//------------------------------------------------------------------------------
void VolumeScene::SetProperty(vtkVolumeProperty* property)
{
  this->Volume->SetProperty(property);
}

//------------------------------------------------------------------------------
FloatImage VolumeScene::RenderFloat()
{
  this->Renderer->SetPass(this->FloatPass);
  this->Window->Render();
  vtkTextureObject* texture = this->FloatPass->GetColorTexture();
  FloatImage image;
  image.Width = static_cast<int>(texture->GetWidth());
  image.Height = static_cast<int>(texture->GetHeight());
  image.Rgba.resize(4 * static_cast<std::size_t>(image.Width) * image.Height);
  auto pixels = vtkSmartPointer<vtkPixelBufferObject>::Take(texture->Download());
  unsigned int dimensions[2] = { texture->GetWidth(), texture->GetHeight() };
  vtkIdType increments[2] = { 0, 0 };
  pixels->Download2D(VTK_FLOAT, image.Rgba.data(), dimensions, 4, increments);
  this->Renderer->SetPass(nullptr);
  return image;
}

//------------------------------------------------------------------------------
ByteImage VolumeScene::RenderBytes()
{
  this->Renderer->SetPass(nullptr);
  this->Window->Render();
  return ReadBytes(this->Window);
}

//------------------------------------------------------------------------------
ByteImage ReadBytes(vtkRenderWindow* window)
{
  const int* size = window->GetSize();
  ByteImage image;
  image.Width = size[0];
  image.Height = size[1];
  vtkNew<vtkUnsignedCharArray> pixels;
  window->GetPixelData(0, 0, image.Width - 1, image.Height - 1, 0, pixels);
  const unsigned char* data = pixels->GetPointer(0);
  image.Rgb.assign(data, data + pixels->GetNumberOfValues());
  return image;
}

//------------------------------------------------------------------------------
std::string DeviceName(vtkRenderWindow* window)
{
  std::istringstream report(window->ReportCapabilities());
  std::string name;
  for (std::string line; std::getline(report, line);)
  {
    for (const char* key : { "OpenGL renderer string:", "OpenGL version string:" })
    {
      const std::size_t at = line.find(key);
      if (at != std::string::npos)
      {
        const std::size_t begin = line.find_first_not_of(' ', at + std::strlen(key));
        name += (name.empty() ? "" : ", ") + line.substr(std::min(begin, line.size()));
      }
    }
  }
  return name;
}

//------------------------------------------------------------------------------
double DiagonalOf(const double bounds[6])
{
  return std::hypot(
    std::hypot(bounds[1] - bounds[0], bounds[3] - bounds[2]), bounds[5] - bounds[4]);
}

namespace
{

constexpr double ViewAngle = 30.0;

void PlaceCamera(vtkRenderer* renderer, const double bounds[6], const double toCamera[3],
  const double viewUp[3], double zoom, bool parallel)
{
  const double radius = 0.5 * DiagonalOf(bounds);
  const double distance = radius / std::sin(vtkMath::RadiansFromDegrees(0.5 * ViewAngle));
  vtkCamera* camera = renderer->GetActiveCamera();
  double center[3];
  double position[3];
  for (int axis = 0; axis < 3; ++axis)
  {
    center[axis] = 0.5 * (bounds[2 * axis] + bounds[2 * axis + 1]);
    position[axis] = center[axis] + distance * toCamera[axis];
  }
  camera->SetFocalPoint(center);
  camera->SetPosition(position);
  camera->SetViewUp(viewUp);
  camera->SetParallelProjection(parallel);
  camera->SetParallelScale(radius / zoom);
  camera->SetViewAngle(ViewAngle / zoom);
  camera->SetClippingRange(distance - 1.1 * radius, distance + 1.1 * radius);
}

} // anonymous namespace

//------------------------------------------------------------------------------
void LookAt(vtkRenderer* renderer, const double bounds[6], double azimuth, double elevation,
  double zoom, bool parallel)
{
  const double a = vtkMath::RadiansFromDegrees(azimuth);
  const double e = vtkMath::RadiansFromDegrees(elevation);
  const double toCamera[3] = { std::cos(e) * std::sin(a), std::sin(e), std::cos(e) * std::cos(a) };
  const double viewUp[3] = { 0.0, 1.0, 0.0 };
  PlaceCamera(renderer, bounds, toCamera, viewUp, zoom, parallel);
}

//------------------------------------------------------------------------------
void LookAlongAxis(vtkRenderer* renderer, const double bounds[6], int axis, double zoom)
{
  double toCamera[3] = { 0.0, 0.0, 0.0 };
  double viewUp[3] = { 0.0, 0.0, 0.0 };
  toCamera[axis] = 1.0;
  viewUp[(axis + 1) % 3] = 1.0;
  PlaceCamera(renderer, bounds, toCamera, viewUp, zoom, true);
}

//------------------------------------------------------------------------------
std::array<double, 2> ViewAngles(int i)
{
  // Steps of the golden angle in azimuth, and elevations within 60 degrees.
  const double azimuth = 17.3 + 137.50776405 * i;
  return { azimuth, 60.0 * std::sin(0.7 + 2.4 * i) };
}

} // namespace meniscus::test
