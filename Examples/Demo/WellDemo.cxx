// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "WellDemo.h"

#include "DemoProgress.h"
#include "WellScene.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkDataArray.h"
#include "vtkImageAppend.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPNGWriter.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkRefractedGeometryFilter.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkUnsignedCharArray.h"
#include "vtkWindowToImageFilter.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace
{

constexpr int WellPictureSize = 512;
constexpr int WaterCells = 96;
constexpr unsigned char Background[3] = { 235, 239, 243 };

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

  vtkSmartPointer<vtkImageData> Draw()
  {
    this->Window->SetSize(WellPictureSize, WellPictureSize);
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
  return MakeImage(pixels, WellPictureSize);
}

bool CompareWithRays(WellWindow& window, vtkPolyData* well, const std::string& folder)
{
  const DemoWater water(0.0);
  window.SetWater(water);
  UpdateWithProgress(window.GetFilter(), "Virtual geometry of the well");
  const auto drawn = window.Draw();
  ShowProgress("Tracing rays", 0.0);
  const auto traced =
    MakeImage(TraceDemoWell(well, water, View, WellPictureSize, Background), WellPictureSize);
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
    folder.c_str(), WellPictureSize, WellPictureSize,
    static_cast<long long>(window.GetFilter()->GetOutput()->GetNumberOfCells()),
    static_cast<long long>(well->GetNumberOfCells()),
    100.0 * differing / (static_cast<double>(WellPictureSize) * WellPictureSize));
  return WritePicture(sideBySide->GetOutput(), folder + "/well-comparison.png");
}

}

//------------------------------------------------------------------------------
bool RunWellDemo(const std::string& folder)
{
  const auto well = MakeDemoWell();
  std::printf("Well: %lld cells under a membrane of %d facets\n",
    static_cast<long long>(well->GetNumberOfCells()), 2 * WaterCells * WaterCells);
  WellWindow window(well);
  return CompareWithRays(window, well, folder);
}
