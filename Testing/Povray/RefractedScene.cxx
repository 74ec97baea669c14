// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "RefractedScene.h"

#include <vtkRefractedGeometryFilter.h>
#include <vtkRefractionPass.h>

namespace meniscus::test
{

namespace
{

void PlaceCamera(vtkRenderer* renderer, const ComparisonScene& scene)
{
  const SceneCamera& view = scene.Camera;
  renderer->SetBackground(scene.Background.r, scene.Background.g, scene.Background.b);
  vtkCamera* camera = renderer->GetActiveCamera();
  camera->SetPosition(view.Eye.x, view.Eye.y, view.Eye.z);
  camera->SetFocalPoint(view.Target.x, view.Target.y, view.Target.z);
  camera->SetViewUp(view.Up.x, view.Up.y, view.Up.z);
  camera->SetViewAngle(view.ViewAngle);
  camera->SetClippingRange(5.0, 200.0);
}

/** An actor of flat triangles in the colours of their cells. */
vtkSmartPointer<vtkActor> MakeFlatActor(vtkPolyDataMapper* mapper)
{
  mapper->SetScalarModeToUseCellFieldData();
  mapper->SelectColorArray(ColorArrayName);
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->LightingOff();
  return actor;
}

} // anonymous namespace

//------------------------------------------------------------------------------
ByteImage DrawRefractedScene(const ComparisonScene& scene, int pixels, double tolerance)
{
  VolumeScene window(pixels, pixels);
  vtkRenderer* renderer = window.GetRenderer();
  PlaceCamera(renderer, scene);
  vtkNew<vtkPolyDataMapper> surfaceMapper;
  surfaceMapper->SetInputData(scene.Surface.Membrane);
  vtkNew<vtkActor> surface;
  surface->SetMapper(surfaceMapper);
  vtkNew<vtkRefractionPass> pass;
  pass->SetReflectanceModel(vtkRefractionPass::NONE);
  for (vtkPolyData* object : scene.Objects)
  {
    vtkNew<vtkPolyDataMapper> mapper;
    const auto actor = MakeFlatActor(mapper);
    if (!scene.Surface.Membrane)
    {
      mapper->SetInputData(object);
      renderer->AddActor(actor);
      continue;
    }
    vtkNew<vtkRefractedGeometryFilter> filter;
    filter->SetInputData(0, object);
    filter->SetMembraneData(scene.Surface.Membrane);
    filter->SetCamera(renderer->GetActiveCamera());
    filter->SetViewAspectRatio(1.0);
    filter->SetExteriorIndexOfRefraction(scene.Surface.Exterior);
    filter->SetInteriorIndexOfRefraction(scene.Surface.Interior);
    filter->SetAngularTolerance(tolerance);
    mapper->SetInputConnection(filter->GetOutputPort());
    pass->AddRefraction(surface, actor, filter);
  }
  renderer->SetPass(pass);
  window.GetWindow()->Render();
  return ReadBytes(window.GetWindow());
}

} // namespace meniscus::test
