// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "WellDemo.h"

#include "DemoProgress.h"
#include "WellScene.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkColorTransferFunction.h"
#include "vtkDataArray.h"
#include "vtkDataSetSurfaceFilter.h"
#include "vtkImageAppend.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPNGWriter.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkRefractedGeometryFilter.h"
#include "vtkRefractionErrorVolume.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkThreshold.h"
#include "vtkUnsignedCharArray.h"
#include "vtkWindowToImageFilter.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace
{

constexpr int PictureSize = 512;
constexpr int AnimationSize = 320;
constexpr int AnimationFrames = 24;
constexpr int WaterCells = 96;
constexpr unsigned char Background[3] = { 24, 30, 40 };

const DemoView View = { { 0.25, -1.5, 3.6 }, { 0.0, 0.02, -0.45 }, { 0.0, 0.0, 1.0 }, 34.0 };

/** A window that shows the filter's output for the well. */
class WellWindow
{
public:
  explicit WellWindow(vtkPolyData* well)
  {
    this->Filter->SetInputData(0, well);
    this->Filter->SetInteriorIndexOfRefraction(DemoWater::Index);
    this->Filter->SetEyePosition(View.Eye[0], View.Eye[1], View.Eye[2]);
    this->Filter->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
    this->Mapper->SetInputConnection(this->Filter->GetOutputPort());
    this->Mapper->SetScalarModeToUseCellData();
    this->Actor->SetMapper(this->Mapper);
    this->Actor->GetProperty()->LightingOff();
    this->Renderer->AddActor(this->Actor);
    this->Renderer->SetBackground(
      Background[0] / 255.0, Background[1] / 255.0, Background[2] / 255.0);
    this->Window->SetOffScreenRendering(1);
    this->Window->SetMultiSamples(0);
    this->Window->AddRenderer(this->Renderer);
    vtkCamera* camera = this->Renderer->GetActiveCamera();
    camera->SetPosition(View.Eye);
    camera->SetFocalPoint(View.Target);
    camera->SetViewUp(View.Up);
    camera->SetViewAngle(View.Angle);
    camera->SetClippingRange(1.0, 20.0);
  }

  vtkRefractedGeometryFilter* GetFilter() { return this->Filter; }
  void SetWater(const DemoWater& water)
  {
    this->Filter->SetMembraneData(water.MakeMesh(WaterCells));
  }

  vtkSmartPointer<vtkImageData> Draw(int size)
  {
    this->Window->SetSize(size, size);
    this->Window->Render();
    vtkNew<vtkWindowToImageFilter> image;
    image->SetInput(this->Window);
    image->ReadFrontBufferOff();
    image->ShouldRerenderOff();
    image->Update();
    return image->GetOutput();
  }

private:
  vtkNew<vtkRefractedGeometryFilter> Filter;
  vtkNew<vtkPolyDataMapper> Mapper;
  vtkNew<vtkActor> Actor;
  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkRenderWindow> Window;
};

bool WritePicture(vtkImageData* image, const std::string& file)
{
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputData(image);
  writer->SetFileName(file.c_str());
  writer->Write();
  if (writer->GetErrorCode() != 0)
  {
    std::fprintf(stderr, "error: %s cannot be written\n", file.c_str());
    return false;
  }
  return true;
}

vtkSmartPointer<vtkImageData> MakeImage(vtkUnsignedCharArray* pixels, int size)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(size, size, 1);
  image->GetPointData()->SetScalars(pixels);
  return image;
}

/** White where two images are equal, darker the more they differ. */
vtkSmartPointer<vtkImageData> MakeDifference(vtkImageData* a, vtkImageData* b, int& differing)
{
  vtkNew<vtkUnsignedCharArray> pixels;
  pixels->SetNumberOfComponents(3);
  pixels->SetNumberOfTuples(a->GetNumberOfPoints());
  vtkDataArray* first = a->GetPointData()->GetScalars();
  vtkDataArray* second = b->GetPointData()->GetScalars();
  differing = 0;
  for (vtkIdType i = 0; i < a->GetNumberOfPoints(); ++i)
  {
    double largest = 0.0;
    for (int c = 0; c < 3; ++c)
    {
      const double difference = std::fabs(first->GetComponent(i, c) - second->GetComponent(i, c));
      largest = std::max(largest, difference);
      pixels->SetComponent(i, c, 255.0 - difference);
    }
    differing += largest > 2.0; // beyond rounding
  }
  return MakeImage(pixels, PictureSize);
}

bool CompareWithRays(WellWindow& window, vtkPolyData* well, const std::string& folder)
{
  const DemoWater water(0.0);
  window.SetWater(water);
  UpdateWithProgress(window.GetFilter(), "Virtual geometry of the well");
  const auto drawn = window.Draw(PictureSize);
  ShowProgress("Tracing rays", 0.0);
  const auto traced =
    MakeImage(TraceDemoWell(well, water, View, PictureSize, Background), PictureSize);
  ShowProgress("Tracing rays", 1.0);
  std::fprintf(stderr, "\n");
  int differing = 0;
  const auto difference = MakeDifference(drawn, traced, differing);
  vtkNew<vtkImageAppend> sideBySide;
  sideBySide->SetAppendAxis(0);
  sideBySide->AddInputData(drawn);
  sideBySide->AddInputData(traced);
  sideBySide->AddInputData(difference);
  sideBySide->Update();
  std::printf("wrote %s/well-comparison.png (3 x %d x %d): virtual geometry with all images, %lld "
              "cells of %lld; rays through the exact waves; their difference, %.2f %% of the "
              "pixels, most on edges of colours\n",
    folder.c_str(), PictureSize, PictureSize,
    static_cast<long long>(window.GetFilter()->GetOutput()->GetNumberOfCells()),
    static_cast<long long>(well->GetNumberOfCells()),
    100.0 * differing / (static_cast<double>(PictureSize) * PictureSize));
  return WritePicture(drawn, folder + "/well-virtual.png") &&
    WritePicture(traced, folder + "/well-traced.png") &&
    WritePicture(difference, folder + "/well-difference.png") &&
    WritePicture(sideBySide->GetOutput(), folder + "/well-comparison.png");
}

bool Animate(WellWindow& window, const std::string& folder)
{
  for (int i = 0; i < AnimationFrames; ++i)
  {
    ShowProgress("Moving water", static_cast<double>(i) / AnimationFrames);
    window.SetWater(DemoWater(0.06 * i));
    char name[64];
    std::snprintf(name, sizeof name, "/well-animation-%02d.png", i);
    if (!WritePicture(window.Draw(AnimationSize), folder + name))
    {
      return false;
    }
  }
  ShowProgress("Moving water", 1.0);
  std::fprintf(stderr, "\n");
  std::printf("wrote %s/well-animation-00.png to -%02d.png (%d x %d): moving water\n",
    folder.c_str(), AnimationFrames - 1, AnimationSize, AnimationSize);
  return true;
}

/** Errors of a coarse mesh of the water, as blocks cut open in the middle. */
bool DrawErrorVolume(const std::string& folder)
{
  constexpr int samples = 40;
  constexpr int coarse = 12;
  vtkNew<vtkRefractionErrorVolume> volume;
  volume->SetInputData(0, DemoWater(0.0).MakeMesh(coarse));
  volume->SetReferenceData(DemoWater(0.0).MakeMesh(4 * WaterCells));
  volume->SetMembraneModelToFlatFacets();
  volume->SetEyePosition(View.Eye[0], View.Eye[1], View.Eye[2]);
  volume->SetInteriorIndexOfRefraction(DemoWater::Index);
  volume->SetModelBounds(-1.0, 1.0, -1.0, 1.0, -2.0, -0.1);
  volume->SetSampleDimensions(samples, samples, samples);
  UpdateWithProgress(volume, "Error volume of a coarse membrane");
  vtkNew<vtkThreshold> measured;
  measured->SetInputConnection(volume->GetOutputPort());
  measured->SetInputArrayToProcess(
    0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "RefractionError");
  measured->SetLowerThreshold(0.0); // others are NaN
  measured->SetUpperThreshold(VTK_DOUBLE_MAX);
  vtkNew<vtkDataSetSurfaceFilter> surface;
  surface->SetInputConnection(measured->GetOutputPort());
  vtkNew<vtkColorTransferFunction> colors;
  const double largest = 3.0 * volume->GetMeanError();
  colors->AddRGBPoint(0.0, 0.15, 0.35, 0.65);
  colors->AddRGBPoint(0.3 * largest, 0.95, 0.95, 0.85);
  colors->AddRGBPoint(largest, 0.75, 0.10, 0.10);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(surface->GetOutputPort());
  mapper->SelectColorArray("RefractionError");
  mapper->SetScalarModeToUsePointFieldData();
  mapper->SetLookupTable(colors);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  vtkNew<vtkPolyDataMapper> waterMapper;
  waterMapper->SetInputData(DemoWater(0.0).MakeMesh(coarse));
  vtkNew<vtkActor> water;
  water->SetMapper(waterMapper);
  water->GetProperty()->SetRepresentationToWireframe();
  water->GetProperty()->SetColor(0.1, 0.2, 0.4);
  vtkNew<vtkRenderer> renderer;
  renderer->SetBackground(1.0, 1.0, 1.0);
  renderer->AddActor(actor);
  renderer->AddActor(water);
  vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering(1);
  window->SetMultiSamples(4);
  window->SetSize(PictureSize, PictureSize);
  window->AddRenderer(renderer);
  vtkCamera* camera = renderer->GetActiveCamera();
  camera->SetPosition(3.5, -5.5, 2.6);
  camera->SetFocalPoint(0.0, 0.0, -0.8);
  camera->SetViewUp(0.0, 0.0, 1.0);
  renderer->ResetCameraClippingRange();
  window->Render();
  vtkNew<vtkWindowToImageFilter> image;
  image->SetInput(window);
  image->ReadFrontBufferOff();
  image->Update();
  std::printf("wrote %s/well-errors.png (%d x %d): errors of %d flat facets below the water; mean "
              "%.2g, largest %.2g of a well 2 wide\n",
    folder.c_str(), PictureSize, PictureSize, 2 * coarse * coarse, volume->GetMeanError(),
    volume->GetLargestError());
  return WritePicture(image->GetOutput(), folder + "/well-errors.png");
}

}

//------------------------------------------------------------------------------
bool RunWellDemo(const std::string& folder)
{
  const auto well = MakeDemoWell();
  std::printf("Well: %lld cells under a membrane of %d facets\n",
    static_cast<long long>(well->GetNumberOfCells()), 2 * WaterCells * WaterCells);
  WellWindow window(well);
  const bool compared = CompareWithRays(window, well, folder);
  const bool animated = Animate(window, folder);
  return DrawErrorVolume(folder) && compared && animated;
}
