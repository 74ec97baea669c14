// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "VTKBasics.h"

class vtkAlgorithmOutput;

namespace meniscus::test
{

/** A square around the z axis at a given height, of resolution x resolution quads. */
vtkSmartPointer<vtkPlaneSource> MakePlane(double halfWidth, double height, int resolution);

/** An actor without colours from scalars. */
vtkSmartPointer<vtkActor> MakeActor(vtkAlgorithmOutput* port);

/** Sets a colour that does not depend on lights. */
void SetFlatColor(vtkActor* actor, double red, double green, double blue);

} // namespace meniscus::test
