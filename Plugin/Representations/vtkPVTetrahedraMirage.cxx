// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPVTetrahedraMirage.h"

#include "vtkCamera.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"

vtkStandardNewMacro(vtkPVTetrahedraMirage);

//------------------------------------------------------------------------------
vtkPVTetrahedraMirage::vtkPVTetrahedraMirage()
{
  this->SetCamera(vtkNew<vtkCamera>());
}

//------------------------------------------------------------------------------
vtkPVTetrahedraMirage::~vtkPVTetrahedraMirage() = default;

//------------------------------------------------------------------------------
void vtkPVTetrahedraMirage::SetEyePosition(double x, double y, double z)
{
  this->GetCamera()->SetPosition(x, y, z);
}

//------------------------------------------------------------------------------
void vtkPVTetrahedraMirage::SetViewFocalPoint(double x, double y, double z)
{
  this->GetCamera()->SetFocalPoint(x, y, z);
}

//------------------------------------------------------------------------------
void vtkPVTetrahedraMirage::SetCameraViewUp(double x, double y, double z)
{
  this->GetCamera()->SetViewUp(x, y, z);
}

//------------------------------------------------------------------------------
void vtkPVTetrahedraMirage::SetViewAngle(double degrees)
{
  this->GetCamera()->SetViewAngle(degrees);
}

//------------------------------------------------------------------------------
void vtkPVTetrahedraMirage::SetViewParallelProjection(int isParallel)
{
  this->GetCamera()->SetParallelProjection(isParallel);
}

//------------------------------------------------------------------------------
void vtkPVTetrahedraMirage::SetViewParallelScale(double scale)
{
  this->GetCamera()->SetParallelScale(scale);
}

//------------------------------------------------------------------------------
void vtkPVTetrahedraMirage::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}
