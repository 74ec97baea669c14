// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkType.h"

#include <glm/vec3.hpp>

#include <vector>

namespace meniscus
{

/**
 * Small triangles that face the light, around the points of a lit surface whose own cells cannot
 * tell how dense the light is there: those that the light grazes, and slivers. The density is the
 * light of a cell over the cell's cross-section, so the error of the light is divided by the
 * cross-section as well. The density at a point does not depend on the surface, so a triangle
 * across the light, of the size of the cells, has it without this error.
 */
class LightPatches
{
public:
  /**
   * Makes the patches.
   * @param lit triangles with the point arrays of vtkRefractedLightFilter and its light vectors;
   *   without them there are no patches.
   */
  void Build(vtkPolyData* lit);

  /** Points of the lit surface that have a patch. */
  const std::vector<vtkIdType>& GetPoints() const { return this->Points; }
  /** The patches. The middle of patch i, where its cells meet, is point MiddleOf(i). */
  vtkPolyData* GetPatches() const { return this->Patches; }
  static vtkIdType MiddleOf(std::size_t patch) { return static_cast<vtkIdType>(4 * patch + 3); }

private:
  /** Neighbourhood of a point. */
  struct Ring
  {
    glm::dvec3 ToLight{ 0.0 };  ///< unit vector; 0 if no light is known
    double SquaredRadius = 0.0; ///< square of the longest side of the point's cells
    bool HasThinCell = false;   ///< seen from the light
  };

  static std::vector<Ring> ListRings(vtkPolyData* lit, vtkDataArray* vectors);

  std::vector<vtkIdType> Points;
  vtkNew<vtkPolyData> Patches;
};

}
