// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "ProjectionModes.h"
#include "RayCastScene.h"
#include "TracedImage.h"

namespace meniscus::test
{

/** Unchanged opacities, for modes that do not measure lengths. */
reference::ReferenceTransferFunction ToAlphas(vtkVolumeProperty* property);

/** The function by which a projection shows its number. */
reference::ReferenceTransferFunction FunctionOf(
  const ProjectionMode& mode, vtkVolumeProperty* property);

/** The material of a property, lit by the renderer's lights as they were in the last frame. */
reference::Material ToMaterial(vtkVolumeProperty* property, vtkRenderer* renderer);

/** The isosurfaces of a property. */
std::vector<reference::Surface> ToSurfaces(vtkVolumeProperty* property);

/**
 * Renders in float and expects every pixel to be within the tolerance of the exact result of its
 * ray, except for a fraction of pixels in which moving the ray by float rounding explains the
 * difference; no ray may be lost. Returns the comparison, whose figures are recorded as properties
 * of the test.
 */
TracedComparison ExpectTrace(RayCastScene& scene, const TraceRay& trace, const std::string& what,
  double tolerance = FloatTolerance, double excusedShare = LargestSilhouetteShare);

} // namespace meniscus::test
