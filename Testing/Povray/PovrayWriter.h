// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "ComparisonScene.h"

namespace meniscus::test
{

/** A number as POV-Ray reads it, with all its digits. */
std::string PovrayNumber(double value);

/** A vector, "<x, y, z>". */
std::string PovrayVector(const glm::dvec3& value);

/** A square of a camera's picture, which goes from -1/2 to 1/2 to the right and up. */
struct PictureWindow
{
  double Right = 0.0; ///< of its middle
  double Up = 0.0;
  double Size = 1.0;
};

/**
 * Camera of a square of the picture. The ray through the middle of a pixel is VTK's: POV-Ray's is
 * direction + x right + y up with x and y from -1/2 to 1/2; given as vectors in world coordinates,
 * they need no change of POV-Ray's left-handed axes and no angle (POV-Ray's is horizontal, VTK's
 * vertical).
 */
std::string PovrayCamera(const SceneCamera& camera, const PictureWindow& window = {});

/** Mesh of the triangles, each in its flat colour. */
std::string PovrayMesh(vtkPolyData* object);

/** Clear body of the interior medium, without reflection; nothing without a membrane. */
std::string PovraySurface(const RefractingSurface& surface);

/** The whole scene. */
std::string PovrayScene(const ComparisonScene& scene, const PictureWindow& window = {});

/**
 * Options of a picture of NAME.pov to NAME-povray.png: no antialiasing, no gamma, nothing on a
 * display.
 */
std::string PovrayOptions(const std::string& name, int pixels);

} // namespace meniscus::test
