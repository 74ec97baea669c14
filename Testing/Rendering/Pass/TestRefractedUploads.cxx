// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Uploads of virtual geometry by VTK's mapper: new colours leave the points on the device.
#include "SceneParts.h"
#include "VTKTestBasics.h"

#include <vtkOpenGLPolyDataMapper.h>
#include <vtkOpenGLVertexBufferObject.h>
#include <vtkOpenGLVertexBufferObjectGroup.h>
#include <vtkRefractedGeometryFilter.h>

namespace
{

void SetColors(vtkPolyData* object, double first)
{
  object->GetPointData()->SetScalars(meniscus::test::MakeArray("Color", object->GetNumberOfPoints(),
    [&](vtkIdType i) { return first + 0.001 * static_cast<double>(i); }));
}

}

TEST(RefractedUploads, NewColorsLeaveThePointsOnTheDevice)
{
  vtkNew<vtkSphereSource> sphere;
  sphere->SetCenter(0.0, 0.0, -0.7);
  sphere->Update();
  vtkPolyData* object = sphere->GetOutput();
  SetColors(object, 0.0);
  const auto water = meniscus::test::MakePlane(5.0, 0.0, 1);
  vtkNew<vtkRefractedGeometryFilter> refraction;
  refraction->SetInputData(0, object);
  refraction->SetInputConnection(1, water->GetOutputPort());
  refraction->SetEyePosition(0.0, -2.0, 3.0);
  vtkNew<vtkOpenGLPolyDataMapper> mapper;
  mapper->SetInputConnection(refraction->GetOutputPort());
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  vtkNew<vtkRenderer> renderer;
  renderer->AddActor(actor);
  vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering(1);
  window->SetSize(64, 64);
  window->AddRenderer(renderer);
  window->Render();
  const auto uploadedAt = [&mapper]() -> vtkMTimeType
  {
    vtkOpenGLVertexBufferObject* points = mapper->GetVBOs()->GetVBO("vertexMC");
    return points ? points->GetUploadTime().GetMTime() : 0;
  };
  const vtkMTimeType first = uploadedAt();
  ASSERT_GT(first, 0u);
  SetColors(object, 0.5);
  object->Modified();
  window->Render();
  EXPECT_EQ(uploadedAt(), first);
  // Another eye moves the points.
  refraction->SetEyePosition(0.1, -2.0, 3.0);
  window->Render();
  EXPECT_GT(uploadedAt(), first);
}
