// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTetrahedraRayCastRepresentation.h"

#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkTetrahedraRayCastMapper.h"

vtkStandardNewMacro(vtkTetrahedraRayCastRepresentation);

//------------------------------------------------------------------------------
vtkTetrahedraRayCastRepresentation::vtkTetrahedraRayCastRepresentation()
{
  vtkNew<vtkTetrahedraRayCastMapper> mapper;
  this->AddVolumeMapper("Tetrahedra ray cast", mapper);
}

//------------------------------------------------------------------------------
vtkTetrahedraRayCastRepresentation::~vtkTetrahedraRayCastRepresentation() = default;

//------------------------------------------------------------------------------
void vtkTetrahedraRayCastRepresentation::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}
