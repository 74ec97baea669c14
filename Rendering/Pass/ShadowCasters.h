// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Filters/Object/ObjectSurface.h"
#include "Rendering/Backends/OpenGL/OpenGLTable.h"

#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <glm/vec3.hpp>

#include <map>
#include <string>
#include <vector>

class vtkDataObject;
class vtkOpenGLRenderWindow;
class vtkPolyData;
class vtkShaderProgram;
class vtkWindow;

namespace meniscus
{

/**
 * Triangles of the objects behind a membrane that hide light, as a tree of boxes in tables. The
 * shader vtkRefractionShadows.glsl follows the light's way from each fragment through them. The
 * tree does not depend on lights, the camera or the membrane.
 */
class ShadowCasters
{
public:
  /** An object, or a data set of several blocks, in world coordinates. */
  struct Caster
  {
    int Number; ///< by which a fragment of the object knows its own triangles
    vtkDataObject* Data;
  };

  /** Sorts the polygons and strips of the objects into a tree if they are others than before. */
  void Update(const std::vector<Caster>& casters);
  /** Number of times since construction that a tree was made. */
  vtkTypeInt64 GetNumberOfUpdates() const { return this->Updates; }
  /** Without triangles there are no tables. */
  bool IsEmpty() const { return this->Triangles.empty(); }

  /** Uploads tables that changed. Returns an error or an empty string. */
  std::string Upload(vtkOpenGLRenderWindow* window);
  /**
   * Activates the tables for the fragments of an object.
   * @param number as of Caster.
   * @param origin point that the object's places are relative to.
   * @pre Upload() had no error
   */
  void Activate(vtkShaderProgram* program, int number, const glm::dvec3& origin);
  void Deactivate();
  void Release(vtkWindow* window);

private:
  /** A surface, and the time for which its triangles are in the tables. */
  struct Source
  {
    int Number;
    vtkSmartPointer<vtkPolyData> Surface;
    vtkMTimeType Time;

    bool operator==(const Source& other) const;
  };
  struct Box;

  std::vector<Source> ListSources(const std::vector<Caster>& casters);
  static void ListTriangles(const Source& source, std::vector<Box>& boxes);
  void AddTriangle(const Box& box);
  void AddNode(std::vector<Box>& boxes, std::size_t first, std::size_t last);

  ObjectSurfaces Surfaces;
  std::vector<Source> Sources;
  vtkTypeInt64 Updates = 0;
  /** Point that the tables are relative to, in the middle of all triangles. */
  glm::dvec3 Origin{ 0.0 };
  /** Four texels for each triangle: its corners, the first with the number, and its plane. */
  std::vector<float> Triangles;
  /**
   * Two texels for each box, in the order of a walk: its low corner and the box that comes next if
   * this one is missed; its high corner and the triangle in it, or -1.
   */
  std::vector<float> Nodes;
  /** Largest coordinate relative to Origin. */
  double Reach = 0.0;
  /** By number: how far surfaces may be off the triangles, as polygons that are not flat have it.
   */
  std::map<int, double> Twists;

  bool IsUploaded = false;
  OpenGLTable NodeTable;
  OpenGLTable TriangleTable;
};

}
