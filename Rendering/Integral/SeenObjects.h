// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/** Opaque objects that bent rays see: from VTK data, and as arrays of an image. */
#pragma once

#include "Filters/Object/ObjectSurface.h"
#include "Volume/Graded/OpaqueTriangles.h"
#include "Volume/Mesh/TetrahedralMesh.h"

#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <vector>

class vtkDataSet;
class vtkImageData;
class vtkScalarsToColors;

namespace meniscus
{

class SurfaceTexture;

/** Light and colours of a picture of objects. */
struct ObjectShading
{
  vtkScalarsToColors* LookupTable = nullptr;
  /** Null or an empty one for none. */
  const SurfaceTexture* Texture = nullptr;
  /** 0 for light along the ray. */
  glm::dvec3 LightDirection{ 0.0 };
  double Ambient = 1.0;
  glm::dvec3 Background{ 0.0 };
};

class SeenObjects
{
public:
  /** Reads the polygons, in the units of a mesh. */
  void Read(vtkDataSet* objects, const TetrahedralMesh& mesh);

  const OpaqueTriangles& GetTriangles() const { return this->Triangles; }
  /** True if a triangle may be in the box around the mesh. */
  bool MayBeInMesh() const { return this->InMesh; }
  bool HasTextureCoordinates() const;
  /** Polygons with a point that is not finite or does not exist. */
  std::int64_t GetNumberOfBrokenCells() const { return this->BrokenCells; }

  /**
   * Adds the arrays of vtkTetrahedraMirage to an image.
   * @param eyes beginning of each ray in the mesh's units.
   */
  void Write(const std::vector<OpaqueSight>& sights, const std::vector<glm::dvec3>& eyes,
    const ObjectShading& shading, vtkImageData* output) const;

private:
  struct Colors;
  glm::dvec3 ColorOf(
    const OpaqueHit& hit, const Colors& colors, const ObjectShading& shading) const;
  glm::dvec3 SurfaceColorOf(
    const OpaqueHit& hit, const Colors& colors, const ObjectShading& shading) const;
  Colors MapColors(const ObjectShading& shading) const;
  glm::dvec3 PlaceOf(const OpaqueHit& hit) const;

  ObjectSurfaces Surfaces;
  ObjectSurface Surface;
  OpaqueTriangles Triangles;
  /** Points of the triangles in the surface, and their polygons. */
  std::vector<std::array<std::int32_t, 3>> Corners;
  std::vector<vtkIdType> Polygons;
  std::int64_t BrokenCells = 0;
  bool InMesh = false;
  double Radius = 1.0;
};

}
