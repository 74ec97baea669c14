// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkRefractingInterfaceCollection.h"

#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkRefractingInterface.h"

#include <algorithm>

vtkStandardNewMacro(vtkRefractingInterfaceCollection);

//------------------------------------------------------------------------------
void vtkRefractingInterfaceCollection::AddItem(vtkRefractingInterface* interface)
{
  if (!interface)
  {
    vtkErrorMacro("There is no interface to add.");
    return;
  }
  this->vtkCollection::AddItem(interface);
}

//------------------------------------------------------------------------------
vtkRefractingInterface* vtkRefractingInterfaceCollection::AddInterface(
  double exterior, double interior)
{
  vtkNew<vtkRefractingInterface> interface;
  interface->SetExteriorIndexOfRefraction(exterior);
  interface->SetInteriorIndexOfRefraction(interior);
  this->AddItem(interface);
  return interface;
}

//------------------------------------------------------------------------------
vtkRefractingInterface* vtkRefractingInterfaceCollection::GetInterface(int i)
{
  return vtkRefractingInterface::SafeDownCast(this->GetItemAsObject(i));
}

//------------------------------------------------------------------------------
vtkRefractingInterface* vtkRefractingInterfaceCollection::GetFirstInterface()
{
  if (this->GetNumberOfItems() == 0)
  {
    vtkNew<vtkRefractingInterface> interface;
    this->AddItem(interface);
  }
  return this->GetInterface(0);
}

//------------------------------------------------------------------------------
vtkMTimeType vtkRefractingInterfaceCollection::GetMTime()
{
  vtkMTimeType time = this->Superclass::GetMTime();
  for (int i = 0; i < this->GetNumberOfItems(); ++i)
  {
    time = std::max(time, this->GetInterface(i)->GetMTime());
  }
  return time;
}
