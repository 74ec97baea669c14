// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkRefractedGeometryFilter.h"

#include "vtkObjectFactory.h"

vtkStandardNewMacro(vtkRefractedGeometryFilter);

//------------------------------------------------------------------------------
vtkRefractedGeometryFilter::vtkRefractedGeometryFilter()
{
  this->SetNumberOfInputPorts(2);
}

//------------------------------------------------------------------------------
vtkRefractedGeometryFilter::~vtkRefractedGeometryFilter() = default;

//------------------------------------------------------------------------------
void vtkRefractedGeometryFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}
