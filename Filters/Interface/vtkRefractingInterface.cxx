// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkRefractingInterface.h"

#include "Filters/Common/Accessors.h"

#include "vtkImplicitFunction.h"
#include "vtkObjectFactory.h"

#include <algorithm>

vtkStandardNewMacro(vtkRefractingInterface);
meniscusObjectMacro(vtkRefractingInterface, ExactSurface, vtkImplicitFunction, ExactSurface);

//------------------------------------------------------------------------------
vtkRefractingInterface::vtkRefractingInterface() = default;

//------------------------------------------------------------------------------
vtkRefractingInterface::~vtkRefractingInterface() = default;

//------------------------------------------------------------------------------
vtkMTimeType vtkRefractingInterface::GetMTime()
{
  const vtkMTimeType own = this->Superclass::GetMTime();
  return this->ExactSurface ? std::max(own, this->ExactSurface->GetMTime()) : own;
}

//------------------------------------------------------------------------------
void vtkRefractingInterface::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "ExteriorIndexOfRefraction: " << this->ExteriorIndexOfRefraction << "\n";
  os << indent << "InteriorIndexOfRefraction: " << this->InteriorIndexOfRefraction << "\n";
  os << indent << "TurnTowardsEye: " << (this->TurnTowardsEye ? "on" : "off") << "\n";
  os << indent << "ExactSurface: " << this->ExactSurface.Get() << "\n";
}
