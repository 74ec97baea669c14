// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Filters/Object/ObjectSurface.h"
#include "Rendering/Backends/OpenGL/OpenGLTable.h"
#include "Rendering/Pass/LightPatches.h"
#include "Rendering/Pass/LitMesh.h"

#include "vtkNew.h"
#include "vtkRefractedLightFilter.h"
#include "vtkType.h"

#include <array>
#include <list>
#include <string>
#include <vector>

class vtkOpenGLRenderWindow;
class vtkRefractedGeometryFilter;
class vtkShaderProgram;
class vtkWindow;

namespace meniscus
{

/** A light in front of a membrane, in world coordinates. */
struct WaveSource
{
  std::array<double, 3> Place; ///< or the direction to it
  bool IsPositional;
};

/**
 * Light of lamps in front of a membrane on an object behind it. A vtkRefractedLightFilter computes
 * it for the cells of a LitMesh, another one for patches across the light where it grazes them, and
 * the shader vtkTrueSpaceLighting.glsl reads it from tables. It is computed again when a light, the
 * membrane or the object changes.
 */
class WaveLight
{
public:
  /**
   * Computes the light.
   * @param filter up to date; has the object, the membranes and their interfaces.
   * @param cells number of cells into which the object is divided.
   */
  void Update(
    vtkRefractedGeometryFilter* filter, const std::vector<WaveSource>& sources, int cells);
  /** Without lights, or without an object of one block, there are no tables. */
  bool IsEmpty() const { return this->Sources.empty(); }
  /** Number of times since construction that the light of one source was computed. */
  vtkTypeInt64 GetNumberOfUpdates() const { return this->Updates; }

  /** Uploads tables that changed. Returns an error or an empty string. */
  std::string Upload(vtkOpenGLRenderWindow* window, vtkPolyData* images);
  /**
   * Activates the tables and sets the uniforms of the shader.
   * @param areSurfaces false for points and lines, which have no places in the tables.
   * @param origin point that the object's places are relative to.
   * @pre Upload() had no error
   */
  void Activate(vtkShaderProgram* program, bool areSurfaces, const glm::dvec3& origin);
  void Deactivate();
  void Release(vtkWindow* window);

private:
  struct Source
  {
    vtkNew<vtkRefractedLightFilter> Filter;
    LightPatches Patches;
    vtkNew<vtkRefractedLightFilter> PatchFilter;
    vtkMTimeType Time = 0;                    ///< of the filter's output that is in the tables
    std::vector<std::array<float, 4>> Values; ///< vector and path at the points of the mesh
  };

  bool UpdateMesh(vtkRefractedGeometryFilter* filter, int cells);
  static void Compute(vtkRefractedLightFilter* light, vtkRefractedGeometryFilter* filter,
    const WaveSource& source, vtkPolyData* lit);
  static void ReadValues(
    Source& source, vtkRefractedGeometryFilter* filter, const WaveSource& wanted);
  std::vector<float> ListPlaces() const;

  ObjectSurfaces Surfaces;
  LitMesh Mesh;
  vtkMTimeType MeshTime = 0;
  vtkPolyData* MeshSurface = nullptr; ///< for comparison only
  int MeshCells = 0;
  std::list<Source> Sources;
  vtkTypeInt64 Updates = 0;

  bool IsUploaded = false;
  vtkMTimeType ImagesTime = 0;
  OpenGLTable Faces;
  OpenGLTable Places;
  OpenGLTable Primitives;
};

}
