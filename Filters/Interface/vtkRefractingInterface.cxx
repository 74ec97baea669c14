// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkRefractingInterface.h"

#include "vtkImplicitFunction.h"
#include "vtkObjectFactory.h"

#include <algorithm>

vtkStandardNewMacro(vtkRefractingInterface);

//------------------------------------------------------------------------------
vtkRefractingInterface::vtkRefractingInterface() = default;

//------------------------------------------------------------------------------
vtkRefractingInterface::~vtkRefractingInterface() = default;

//------------------------------------------------------------------------------
void vtkRefractingInterface::SetExactSurface(vtkImplicitFunction* function)
{
  if (this->ExactSurface != function)
  {
    this->ExactSurface = function;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
vtkImplicitFunction* vtkRefractingInterface::GetExactSurface()
{
  return this->ExactSurface;
}

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
