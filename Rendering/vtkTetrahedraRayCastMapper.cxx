// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTetrahedraRayCastMapper.h"

#include "vtkObjectFactory.h"

class vtkTetrahedraRayCastMapper::vtkInternals
{
};

vtkStandardNewMacro(vtkTetrahedraRayCastMapper);

//------------------------------------------------------------------------------
vtkTetrahedraRayCastMapper::vtkTetrahedraRayCastMapper()
  : Internals(new vtkInternals)
{
}

//------------------------------------------------------------------------------
vtkTetrahedraRayCastMapper::~vtkTetrahedraRayCastMapper() = default;

//------------------------------------------------------------------------------
void vtkTetrahedraRayCastMapper::Render(vtkRenderer*, vtkVolume*) {}

//------------------------------------------------------------------------------
void vtkTetrahedraRayCastMapper::ReleaseGraphicsResources(vtkWindow*) {}

//------------------------------------------------------------------------------
void vtkTetrahedraRayCastMapper::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}
