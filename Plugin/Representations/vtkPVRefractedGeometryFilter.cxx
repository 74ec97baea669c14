// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPVRefractedGeometryFilter.h"

#include "MembraneGathering.h"

#include "vtkCamera.h"
#include "vtkDemandDrivenPipeline.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"

vtkStandardNewMacro(vtkPVRefractedGeometryFilter);
meniscusInterfaceTableMacro(vtkPVRefractedGeometryFilter);

//------------------------------------------------------------------------------
vtkPVRefractedGeometryFilter::vtkPVRefractedGeometryFilter()
{
  this->View->SetPosition(this->GetEyePosition());
  this->Superclass::SetViewCulling(false);
  this->SetInterfaces(this->Table.GetInterfaces());
}

//------------------------------------------------------------------------------
vtkPVRefractedGeometryFilter::~vtkPVRefractedGeometryFilter() = default;

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
void vtkPVRefractedGeometryFilter::SetViewFocalPoint(double x, double y, double z)
{
  this->View->SetFocalPoint(x, y, z);
}

//------------------------------------------------------------------------------
void vtkPVRefractedGeometryFilter::SetViewUp(double x, double y, double z)
{
  this->View->SetViewUp(x, y, z);
}

//------------------------------------------------------------------------------
void vtkPVRefractedGeometryFilter::SetViewAngle(double degrees)
{
  this->View->SetViewAngle(degrees);
}

//------------------------------------------------------------------------------
void vtkPVRefractedGeometryFilter::SetViewParallelProjection(bool parallel)
{
  this->View->SetParallelProjection(parallel);
  this->UseViewIfNeeded();
}

//------------------------------------------------------------------------------
void vtkPVRefractedGeometryFilter::SetViewParallelScale(double scale)
{
  this->View->SetParallelScale(scale);
}

meniscusBlockPortsMacro(vtkPVRefractedGeometryFilter, RequestUpdateExtent);

//------------------------------------------------------------------------------
int vtkPVRefractedGeometryFilter::RequestData(
  vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  std::string fault;
  const auto membranes = this->Table.GatherSurfaces(inputs[1], false, fault);
  if (!membranes)
  {
    vtkErrorMacro(<< fault << "; the output is empty.");
    return 0;
  }
  return meniscus::RunBlocks("vtkPolyData", inputs, outputs, membranes,
    [this, request](vtkInformationVector** ports, vtkInformationVector* output)
    { return this->Superclass::RequestData(request, ports, output); });
}

//------------------------------------------------------------------------------
void vtkPVRefractedGeometryFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "View:\n";
  this->View->PrintSelf(os, indent.GetNextIndent());
}
