// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkOpenGLVertexBufferObject.h"
#include "vtkSmartPointer.h"

#include <glm/vec3.hpp>

#include <string>
#include <vector>

class vtkAbstractMapper;
class vtkDataObject;
class vtkOpenGLRenderWindow;
class vtkPolyData;

namespace meniscus
{

/**
 * Places of an object in shaders, which are floats: relative to a point near the object, so that
 * scenes far from the origin of the world are as precise as others. The arrays stay as they are;
 * the vertex buffers that VTK makes of them are shifted. Those of mappers of several blocks are
 * not, since VTK lets nobody shift them: their point is the origin.
 */
class LocalPlaces
{
public:
  /** Middle of the bounds of a data set; the origin for others, and without finite bounds. */
  static glm::dvec3 MiddleOf(vtkDataObject* data);

  /** Shifts the buffers of arrays of places that the next drawing of the data makes. */
  void Prepare(vtkOpenGLRenderWindow* window, vtkPolyData* images,
    const std::vector<std::string>& arrays, const glm::dvec3& origin);
  /** Leaves the buffers to the mappers that have drawn with them. */
  void Clear() { this->Buffers.clear(); }

  /** Point that the places of a vertex attribute are relative to in the shader of a mapper. */
  static glm::dvec3 OriginOf(vtkAbstractMapper* mapper, const char* attribute);

private:
  std::vector<vtkSmartPointer<vtkOpenGLVertexBufferObject>> Buffers;
};

}
