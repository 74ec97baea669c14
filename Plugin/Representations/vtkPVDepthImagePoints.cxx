// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPVDepthImagePoints.h"

#include "vtkCamera.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"

vtkStandardNewMacro(vtkPVDepthImagePoints);

//------------------------------------------------------------------------------
vtkPVDepthImagePoints::vtkPVDepthImagePoints()
{
  this->SetCamera(vtkNew<vtkCamera>());
}

//------------------------------------------------------------------------------
vtkPVDepthImagePoints::~vtkPVDepthImagePoints() = default;

//------------------------------------------------------------------------------
void vtkPVDepthImagePoints::SetEyePosition(double x, double y, double z)
{
  this->GetCamera()->SetPosition(x, y, z);
}

//------------------------------------------------------------------------------
void vtkPVDepthImagePoints::SetViewFocalPoint(double x, double y, double z)
{
  this->GetCamera()->SetFocalPoint(x, y, z);
}

//------------------------------------------------------------------------------
void vtkPVDepthImagePoints::SetViewUp(double x, double y, double z)
{
  this->GetCamera()->SetViewUp(x, y, z);
}

//------------------------------------------------------------------------------
void vtkPVDepthImagePoints::SetViewAngle(double degrees)
{
  this->GetCamera()->SetViewAngle(degrees);
}

//------------------------------------------------------------------------------
void vtkPVDepthImagePoints::SetViewClippingRange(double near, double far)
{
  this->GetCamera()->SetClippingRange(near, far);
}

//------------------------------------------------------------------------------
void vtkPVDepthImagePoints::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}
