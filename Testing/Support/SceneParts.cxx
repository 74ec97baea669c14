// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "SceneParts.h"

namespace meniscus::test
{

//------------------------------------------------------------------------------
vtkSmartPointer<vtkPlaneSource> MakePlane(double halfWidth, double height, int resolution)
{
  auto plane = vtkSmartPointer<vtkPlaneSource>::New();
  plane->SetOrigin(-halfWidth, -halfWidth, height);
  plane->SetPoint1(halfWidth, -halfWidth, height);
  plane->SetPoint2(-halfWidth, halfWidth, height);
  plane->SetResolution(resolution, resolution);
  return plane;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkActor> MakeActor(vtkAlgorithmOutput* port)
{
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(port);
  mapper->ScalarVisibilityOff();
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  return actor;
}

//------------------------------------------------------------------------------
void SetFlatColor(vtkActor* actor, double red, double green, double blue)
{
  actor->GetProperty()->SetColor(red, green, blue);
  actor->GetProperty()->SetAmbient(1.0);
  actor->GetProperty()->SetDiffuse(0.0);
}

} // namespace meniscus::test
