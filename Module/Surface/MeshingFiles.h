// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Files by which a program asks another one for tetrahedra. Both run on one machine and are built
 * from the same sources: numbers are binary, in the machine's own order of bytes.
 */
#pragma once

#include "Surface/SolidCells.h"

#include <string>

namespace meniscus
{

/** Work for the mesher. */
struct MeshingTask
{
  TriangleSurface Surface; ///< without Sources
  /** Bound of radius to shortest edge; 0 adds no points for quality. */
  double RadiusEdgeRatio = 0.0;
  /** Largest volume of a cell; 0 for none. */
  double MaximumVolume = 0.0;
  /** Whether no points may be added on the surface. */
  bool KeepsSurface = false;
  /** Whether to fill the convex hull of the points instead of the inside of the surface. */
  bool FillsHull = false;
};

/** How the mesher ended; values of TetGen's exceptions, where it has one. */
enum class MeshingEnd
{
  Done = 0,
  OutOfMemory = 1,
  InternalError = 2,
  SelfIntersection = 3,
  SmallFeature = 4,
  CloseFacets = 5,
  BadInput = 10,
  OtherError = 99
};

struct MeshingAnswer
{
  MeshingEnd End = MeshingEnd::OtherError;
  TetrahedronCells Cells;
};

/** @{ */
/** Writes or reads a file. Returns false if that fails or if the file is of another kind. */
bool WriteMeshingTask(const std::string& name, const MeshingTask& task);
bool ReadMeshingTask(const std::string& name, MeshingTask& task);
bool WriteMeshingAnswer(const std::string& name, const MeshingAnswer& answer);
bool ReadMeshingAnswer(const std::string& name, MeshingAnswer& answer);
/** @} */

} // namespace meniscus
