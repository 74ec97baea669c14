// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/** Scenes besides the plain volume: with lighting, of isosurfaces, and behind a membrane. */
#pragma once

#include <array>
#include <string>

class vtkUnstructuredGrid;
class vtkUnstructuredGridVolumeMapper;
class vtkVolumeProperty;

namespace meniscus::benchmark
{

enum class VolumeMode
{
  Composite,  ///< no lights, composite blending
  Lit,        ///< the same with the camera's light
  Isosurface, ///< three isosurfaces, lit
  Membrane    ///< composite blending behind waves that cover the image
};

/** Finds a mode by name: composite, lit, isosurface, membrane. Returns false for other names. */
bool FindVolumeMode(const std::string& name, VolumeMode& mode);
std::string NameOf(VolumeMode mode);

/** Settings of the mode, on our mapper for all modes but Composite, and on the property. */
void ApplyMode(VolumeMode mode, vtkUnstructuredGrid* grid, vtkUnstructuredGridVolumeMapper* mapper,
  vtkVolumeProperty* property);

/**
 * Angles (azimuth, elevation) of a view. Those of a membrane are above it, from 35 to 75 degrees.
 */
std::array<double, 2> ViewAnglesOf(VolumeMode mode, int view);

} // namespace meniscus::benchmark
