// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "WaterWindow.h"

#include "WellScene.h"

#include "vtkActor.h"
#include "vtkActor2D.h"
#include "vtkCamera.h"
#include "vtkImageData.h"
#include "vtkImageMapper.h"
#include "vtkMath.h"
#include "vtkPNGWriter.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkRefractedGeometryFilter.h"
#include "vtkRefractionPass.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkTextActor.h"
#include "vtkTextProperty.h"
#include "vtkUnsignedCharArray.h"
#include "vtkWindowToImageFilter.h"

#include <cmath>
#include <cstdio>

namespace
{

constexpr int WaterCells = 64;
constexpr unsigned char Background[3] = { 110, 130, 150 };
constexpr double EyeDistance = 1.6;
constexpr double EyeHeight = 3.6;
constexpr double Target[3] = { 0.0, 0.0, -0.45 };
constexpr double ViewAngle = 36.0;

void SetUpCells(vtkActor* actor, vtkPolyDataMapper* mapper)
{
  mapper->SetScalarModeToUseCellData();
  actor->SetMapper(mapper);
  actor->GetProperty()->LightingOff(); // the cells' colours include the light of a lamp
}

}

//------------------------------------------------------------------------------
WaterWindow::WaterWindow(int size)
  : Size(size)
  , Well(MakeDemoWell())
{
  this->Filter->SetInputData(0, this->Well);
  this->Filter->SetCamera(this->Renderer->GetActiveCamera());
  // Half a pixel.
  this->Filter->SetAngularTolerance(0.5 * ViewAngle / size);

  vtkNew<vtkPolyDataMapper> waterMapper;
  waterMapper->SetInputData(DemoWater(0.0).MakeMesh(WaterCells));
  this->Water->SetMapper(waterMapper);
  vtkNew<vtkPolyDataMapper> virtualMapper;
  virtualMapper->SetInputConnection(this->Filter->GetOutputPort());
  SetUpCells(this->Virtual, virtualMapper);
  this->Pass->AddRefraction(this->Water, this->Virtual, this->Filter);

  vtkNew<vtkPolyDataMapper> solidMapper;
  solidMapper->SetInputData(this->Well);
  SetUpCells(this->Solid, solidMapper);
  this->Solid->VisibilityOff();
  this->Renderer->AddActor(this->Solid);

  this->Text->SetPosition(10, 10);
  this->Text->GetTextProperty()->SetFontSize(14);
  this->Renderer->AddActor(this->Text);
  this->Renderer->SetBackground(
    Background[0] / 255.0, Background[1] / 255.0, Background[2] / 255.0);
  this->TracedPicture->SetColorWindow(255.0);
  this->TracedPicture->SetColorLevel(127.5);
  this->Traced->SetMapper(this->TracedPicture);
  this->TracedRenderer->AddActor(this->Traced);
  this->TracedRenderer->InteractiveOff();
  this->Window->AddRenderer(this->Renderer);
  this->Window->SetMultiSamples(0);
  this->Window->SetSize(size, size);
  this->Window->SetWindowName("Meniscus: water");

  vtkCamera* camera = this->Renderer->GetActiveCamera();
  camera->SetFocalPoint(Target);
  camera->SetViewUp(0.0, 0.0, 1.0);
  camera->SetViewAngle(ViewAngle);
  camera->SetClippingRange(1.0, 20.0);
  this->SetEyeAngle(0.0);
}

//------------------------------------------------------------------------------
WaterWindow::~WaterWindow() = default;

//------------------------------------------------------------------------------
void WaterWindow::SetEyeAngle(double angle)
{
  const double a = vtkMath::RadiansFromDegrees(angle);
  this->Renderer->GetActiveCamera()->SetPosition(
    EyeDistance * std::sin(a), -EyeDistance * std::cos(a), EyeHeight);
}

//------------------------------------------------------------------------------
void WaterWindow::Show(const WaterSettings& settings)
{
  const DemoWater water(settings.Time, settings.WaveHeight, settings.Index);
  const auto mesh = water.MakeMesh(WaterCells);
  this->Filter->SetMembraneData(mesh);
  this->Filter->SetInteriorIndexOfRefraction(settings.Index);
  this->Filter->SetMembraneModel(
    settings.Curved ? vtkRefractedGeometryFilter::CURVED : vtkRefractedGeometryFilter::FLAT_FACETS);
  this->Filter->SetImages(settings.Curved ? vtkRefractedGeometryFilter::ALL_IMAGES
                                          : vtkRefractedGeometryFilter::FIRST_IMAGE);
  vtkPolyDataMapper::SafeDownCast(this->Water->GetMapper())->SetInputData(mesh);

  // Rays are traced without the effects of the pass.
  const double k = settings.ShowsRays ? 0.0 : settings.Attenuation;
  this->Pass->SetAttenuationCoefficients(k, 0.4 * k, 0.2 * k);
  this->Pass->SetReflectanceModel(
    settings.ShowsRays ? vtkRefractionPass::NONE : vtkRefractionPass::FRESNEL);
  this->Renderer->SetPass(settings.Refracts ? this->Pass.Get() : nullptr);
  this->Solid->SetVisibility(!settings.Refracts);

  char text[160];
  std::snprintf(text, sizeof(text), "%s  index %.3f  waves %.2f  attenuation %.2f",
    settings.Refracts ? (settings.Curved ? "curved" : "flat facets") : "not refracted",
    settings.Index, settings.WaveHeight, k);
  this->Text->SetInput(text);
  this->ShowRays(settings);
  this->Window->Render();
}

//------------------------------------------------------------------------------
void WaterWindow::ShowRays(const WaterSettings& settings)
{
  const bool wasShown = this->Window->HasRenderer(this->TracedRenderer);
  if (settings.ShowsRays != wasShown)
  {
    this->Renderer->SetViewport(0.0, 0.0, settings.ShowsRays ? 0.5 : 1.0, 1.0);
    this->TracedRenderer->SetViewport(0.5, 0.0, 1.0, 1.0);
    this->Window->SetSize((settings.ShowsRays ? 2 : 1) * this->Size, this->Size);
    settings.ShowsRays ? this->Window->AddRenderer(this->TracedRenderer)
                       : this->Window->RemoveRenderer(this->TracedRenderer);
  }
  if (!settings.ShowsRays)
  {
    return;
  }
  vtkCamera* camera = this->Renderer->GetActiveCamera();
  DemoView view{};
  camera->GetPosition(view.Eye);
  camera->GetFocalPoint(view.Target);
  camera->GetViewUp(view.Up);
  view.Angle = camera->GetViewAngle();
  vtkNew<vtkImageData> picture;
  picture->SetDimensions(this->Size, this->Size, 1);
  picture->GetPointData()->SetScalars(TraceDemoWell(this->Well,
    DemoWater(settings.Time, settings.WaveHeight, settings.Index), view, this->Size, Background));
  this->TracedPicture->SetInputData(picture);
}

//------------------------------------------------------------------------------
bool WaterWindow::Write(const std::string& file)
{
  vtkNew<vtkWindowToImageFilter> image;
  image->SetInput(this->Window);
  image->ReadFrontBufferOff();
  image->ShouldRerenderOff();
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputConnection(image->GetOutputPort());
  writer->SetFileName(file.c_str());
  writer->Write();
  return writer->GetErrorCode() == 0;
}
