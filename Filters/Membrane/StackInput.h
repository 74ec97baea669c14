// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/** Lists of interfaces and the surfaces at a port of their owner: validation and set-up. */
#ifndef meniscus_Filters_Membrane_StackInput_h
#define meniscus_Filters_Membrane_StackInput_h

#include "Filters/Membrane/StackScene.h"

#include <array>
#include <string>
#include <vector>

class vtkInformationVector;
class vtkObject;

namespace meniscus
{

/** True if a list or its port has several entries, so that the owner needs a StackScene. */
bool HasStack(vtkRefractingInterfaceCollection* interfaces, vtkInformationVector* surfaces);

/** Text of the error for a membrane model that several interfaces do not support; empty if none. */
std::string FindModelFault(bool curved);

/** Surfaces at a port. Sets an error if one of them is missing. */
std::vector<vtkPolyData*> ListSurfaces(vtkInformationVector* port, SceneMessages& messages);

/**
 * Hands the surfaces at port `number`, their interfaces and an eye to a scene. Returns false, with
 * an error, if they cannot be used. An error in `messages` is kept unless the list has one.
 */
bool UpdateStack(StackScene& scene, vtkInformationVector* port, int number,
  vtkRefractingInterfaceCollection* interfaces, const std::array<double, 3>& eye,
  SceneMessages& messages);

/** The same without an eye, for the rays of SightRayTracer. */
bool UpdateSurfaces(StackScene& scene, vtkInformationVector* port, int number,
  vtkRefractingInterfaceCollection* interfaces, SceneMessages& messages);

/** Requests all data of a port whole: every piece of the output needs the whole surfaces. */
void RequestWhole(vtkInformationVector* port);

/** Reports error and warning by an object whose output is empty after an error. */
void Report(vtkObject* owner, const SceneMessages& messages);

}

#endif
