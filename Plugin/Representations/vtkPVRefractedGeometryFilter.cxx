// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPVRefractedGeometryFilter.h"

#include "MembraneGathering.h"

#include "vtkDemandDrivenPipeline.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"

//------------------------------------------------------------------------------
vtkPVRefractedGeometryFilter::vtkPVRefractedGeometryFilter()
{
  this->View->SetPosition(this->GetEyePosition());
  this->Superclass::SetViewCulling(false);
  this->SetInterfaces(this->Table.GetInterfaces());
}

//------------------------------------------------------------------------------
void vtkPVRefractedGeometryFilter::SetEyePosition(double x, double y, double z)
{
  this->Superclass::SetEyePosition(x, y, z);
  this->View->SetPosition(x, y, z);
}

//------------------------------------------------------------------------------
void vtkPVRefractedGeometryFilter::SetViewCulling(bool culling)
{
  this->Superclass::SetViewCulling(culling);
  this->UseViewIfNeeded();
}

//------------------------------------------------------------------------------
void vtkPVRefractedGeometryFilter::UseViewIfNeeded()
{
  const bool isNeeded = this->GetViewCulling() || this->View->GetParallelProjection() != 0;
  this->SetCamera(isNeeded ? this->View.Get() : nullptr);
}

//------------------------------------------------------------------------------
void vtkPVRefractedGeometryFilter::SetExactMembrane(vtkImplicitFunction* function)
{
  this->Table.SetExactSurface(function);
}

//------------------------------------------------------------------------------
void vtkPVRefractedGeometryFilter::SetViewParallelProjection(bool parallel)
{
  this->View->SetParallelProjection(parallel);
  this->UseViewIfNeeded();
}

meniscusBlockPortsMacro(
  vtkPVRefractedGeometryFilter, RequestUpdateExtent, "vtkPolyData", static_cast<void>(0));

//------------------------------------------------------------------------------
void vtkPVRefractedGeometryFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "View:\n";
  this->View->PrintSelf(os, indent.GetNextIndent());
}
