// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/** Properties of the classes that have a list of refracting interfaces. */
#pragma once

#include "vtkRefractingInterface.h"
#include "vtkRefractingInterfaceCollection.h"
#include "vtkSmartPointer.h"

#include <algorithm>

/**
 * Defines the methods of a class that forward to its member Interfaces and to the first interface:
 * SetInterfaces, GetInterfaces, and setters and getters of the two indices of refraction.
 */
#define meniscusInterfacePropertiesMacro(className)                                                \
  void className::SetInterfaces(vtkRefractingInterfaceCollection* interfaces)                      \
  {                                                                                                \
    if (this->Interfaces != interfaces)                                                            \
    {                                                                                              \
      this->Interfaces = interfaces ? interfaces : meniscus::MakeInterfaces().Get();               \
      this->Modified();                                                                            \
    }                                                                                              \
  }                                                                                                \
  vtkRefractingInterfaceCollection* className::GetInterfaces()                                     \
  {                                                                                                \
    return this->Interfaces;                                                                       \
  }                                                                                                \
  void className::SetExteriorIndexOfRefraction(double index)                                       \
  {                                                                                                \
    this->Interfaces->GetFirstInterface()->SetExteriorIndexOfRefraction(index);                    \
  }                                                                                                \
  double className::GetExteriorIndexOfRefraction()                                                 \
  {                                                                                                \
    return this->Interfaces->GetFirstInterface()->GetExteriorIndexOfRefraction();                  \
  }                                                                                                \
  void className::SetInteriorIndexOfRefraction(double index)                                       \
  {                                                                                                \
    this->Interfaces->GetFirstInterface()->SetInteriorIndexOfRefraction(index);                    \
  }                                                                                                \
  double className::GetInteriorIndexOfRefraction()                                                 \
  {                                                                                                \
    return this->Interfaces->GetFirstInterface()->GetInteriorIndexOfRefraction();                  \
  }

/** Defines SetExactMembrane() and GetExactMembrane(), the exact surface of the first interface. */
#define meniscusExactMembraneMacro(className)                                                      \
  void className::SetExactMembrane(vtkImplicitFunction* function)                                  \
  {                                                                                                \
    this->Interfaces->GetFirstInterface()->SetExactSurface(function);                              \
  }                                                                                                \
  vtkImplicitFunction* className::GetExactMembrane()                                               \
  {                                                                                                \
    return this->Interfaces->GetFirstInterface()->GetExactSurface();                               \
  }

/** Defines GetMTime() of a class that depends on its members and on the list of interfaces. */
#define meniscusInterfaceTimeMacro(className)                                                      \
  vtkMTimeType className::GetMTime()                                                               \
  {                                                                                                \
    return std::max(this->Superclass::GetMTime(), this->Interfaces->GetMTime());                   \
  }

/**
 * Defines the methods of a filter for the surfaces at one of its ports, which may be repeated:
 * AddMembraneConnection, AddMembraneData, RemoveAllMembranes and GetNumberOfMembranes.
 */
#define meniscusMembranePortMacro(className, port)                                                 \
  void className::AddMembraneConnection(vtkAlgorithmOutput* output)                                \
  {                                                                                                \
    this->AddInputConnection(port, output);                                                        \
  }                                                                                                \
  void className::AddMembraneData(vtkPolyData* membrane)                                           \
  {                                                                                                \
    this->AddInputDataInternal(port, membrane);                                                    \
  }                                                                                                \
  void className::RemoveAllMembranes()                                                             \
  {                                                                                                \
    this->SetInputConnection(port, nullptr);                                                       \
  }                                                                                                \
  int className::GetNumberOfMembranes()                                                            \
  {                                                                                                \
    return this->GetNumberOfInputConnections(port);                                                \
  }

namespace meniscus
{

/**
 * New list of one interface with default values. The interface is made here, since one that is made
 * later would modify the list, and with it the owner.
 */
inline vtkSmartPointer<vtkRefractingInterfaceCollection> MakeInterfaces()
{
  auto interfaces = vtkSmartPointer<vtkRefractingInterfaceCollection>::New();
  interfaces->GetFirstInterface();
  return interfaces;
}

}
