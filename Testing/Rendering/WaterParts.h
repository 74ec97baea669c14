// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_WaterParts_h
#define meniscus_WaterParts_h

#include <vtkPlaneSource.h>
#include <vtkSmartPointer.h>

class vtkActor;
class vtkAlgorithmOutput;

namespace meniscus
{
namespace test
{

/** A square about the z axis at a height, of resolution x resolution quads. */
vtkSmartPointer<vtkPlaneSource> makePlane(double halfWidth, double height, int resolution);

/** Without colours from scalars. */
vtkSmartPointer<vtkActor> makeActor(vtkAlgorithmOutput* port);

/** Colours of its own, whatever the light. */
void setFlatColor(vtkActor* actor, double red, double green, double blue);

} // namespace test
} // namespace meniscus

#endif
