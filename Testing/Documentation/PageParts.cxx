// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Parts of programs as the pages show them, within the code that they assume. Writes an image of
// each.
#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkColorTransferFunction.h>
#include <vtkDataSetTriangleFilter.h>
#include <vtkElevationFilter.h>
#include <vtkPNGWriter.h>
#include <vtkPiecewiseFunction.h>
#include <vtkPlaneSource.h>
#include <vtkPolyDataMapper.h>
#include <vtkRTAnalyticSource.h>
#include <vtkRefractedGeometryFilter.h>
#include <vtkRefractionPass.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSphereSource.h>
#include <vtkTetrahedraRayCastMapper.h>
#include <vtkVolume.h>
#include <vtkVolumeProperty.h>
#include <vtkWindowToImageFilter.h>

namespace
{

vtkNew<vtkPlaneSource> MakeWater(double half, double height)
{
  vtkNew<vtkPlaneSource> water;
  water->SetOrigin(-half, -half, height);
  water->SetPoint1(half, -half, height);
  water->SetPoint2(-half, half, height);
  water->SetResolution(8, 8);
  return water;
}

void Write(vtkRenderer* renderer, const char* file)
{
  vtkNew<vtkRenderWindow> window;
  window->SetSize(200, 200);
  window->AddRenderer(renderer);
  vtkNew<vtkWindowToImageFilter> picture;
  picture->SetInput(window);
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputConnection(picture->GetOutputPort());
  writer->SetFileName(file);
  writer->Write();
  renderer->SetPass(nullptr);
}

// Documentation/refraction.md
void DrawPass()
{
  vtkNew<vtkSphereSource> ball;
  ball->SetCenter(0.0, 0.0, -1.0);
  ball->SetPhiResolution(30);
  ball->SetThetaResolution(30);
  vtkNew<vtkElevationFilter> object;
  object->SetInputConnection(ball->GetOutputPort());
  const auto water = MakeWater(2.0, 0.0);
  vtkNew<vtkRefractedGeometryFilter> filter;
  vtkNew<vtkRenderer> renderer;
  renderer->GetActiveCamera()->SetPosition(0.3, -2.0, 3.0);
  renderer->GetActiveCamera()->SetFocalPoint(0.0, 0.0, -0.7);
  vtkNew<vtkPolyDataMapper> waterMapper;
  waterMapper->SetInputConnection(water->GetOutputPort());
  vtkNew<vtkActor> waterActor;
  waterActor->SetMapper(waterMapper);
  vtkNew<vtkPolyDataMapper> virtualMapper;
  virtualMapper->SetScalarRange(0.0, 1.0);
  vtkNew<vtkActor> virtualActor;
  virtualActor->SetMapper(virtualMapper);
  vtkNew<vtkRefractionPass> pass;
#include "refraction.inc"
  Write(renderer, "part-refraction.png");
}

// Documentation/volume.md
void DrawVolume()
{
  vtkNew<vtkRTAnalyticSource> field;
  vtkNew<vtkDataSetTriangleFilter> tetrahedra;
  tetrahedra->SetInputConnection(field->GetOutputPort());
  const auto water = MakeWater(30.0, 14.0);
  vtkNew<vtkTetrahedraRayCastMapper> mapper;
  mapper->SetInputConnection(tetrahedra->GetOutputPort());
#include "volume.inc"
  vtkNew<vtkVolume> volume;
  volume->SetMapper(mapper);
  volume->GetProperty()->GetRGBTransferFunction()->AddRGBSegment(37, 0, 0.3, 1, 277, 1, 0.4, 0);
  volume->GetProperty()->GetScalarOpacity()->RemoveAllPoints();
  volume->GetProperty()->GetScalarOpacity()->AddSegment(120, 0, 277, 0.3);
  vtkNew<vtkRenderer> renderer;
  renderer->AddVolume(volume);
  renderer->GetActiveCamera()->SetPosition(10.0, -30.0, 60.0);
  renderer->GetActiveCamera()->SetFocalPoint(0.0, 0.0, 0.0);
  renderer->ResetCameraClippingRange();
  Write(renderer, "part-volume.png");
}

}

int main()
{
  DrawPass();
  DrawVolume();
  return 0;
}
