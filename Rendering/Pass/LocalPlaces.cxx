// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rendering/Pass/LocalPlaces.h"

#include "vtkDataSet.h"
#include "vtkOpenGLPolyDataMapper.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLVertexBufferObjectCache.h"
#include "vtkOpenGLVertexBufferObjectGroup.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <cmath>
#include <cstddef>

namespace meniscus
{

//------------------------------------------------------------------------------
glm::dvec3 LocalPlaces::MiddleOf(vtkDataObject* data)
{
  glm::dvec3 middle(0.0);
  if (auto* set = vtkDataSet::SafeDownCast(data))
  {
    double bounds[6];
    set->GetBounds(bounds);
    for (int axis = 0; axis < 3; ++axis)
    {
      const double mean = 0.5 * bounds[2 * axis] + 0.5 * bounds[2 * axis + 1];
      middle[axis] = std::isfinite(mean) && bounds[2 * axis] <= bounds[2 * axis + 1] ? mean : 0.0;
    }
  }
  return middle;
}

//------------------------------------------------------------------------------
void LocalPlaces::Prepare(vtkOpenGLRenderWindow* window, vtkPolyData* images,
  const std::vector<std::string>& arrays, const glm::dvec3& origin)
{
  for (const std::string& name : arrays)
  {
    vtkDataArray* array = images ? images->GetPointData()->GetArray(name.c_str()) : nullptr;
    if (!array || array->GetNumberOfTuples() == 0)
    {
      continue;
    }
    // The window keeps one buffer for each array, which the mapper then finds and fills.
    const auto buffer = vtk::TakeSmartPointer(window->GetVBOCache()->GetVBO(array, VTK_FLOAT));
    if (buffer->GetUploadTime().GetMTime() == 0)
    {
      buffer->SetCoordShiftAndScaleMethod(
        vtkOpenGLVertexBufferObject::ShiftScaleMethod::MANUAL_SHIFT_SCALE);
      buffer->SetScale(1.0, 1.0, 1.0);
      buffer->SetShift(origin.x, origin.y, origin.z);
    }
    this->Buffers.push_back(buffer);
  }
}

//------------------------------------------------------------------------------
glm::dvec3 LocalPlaces::OriginOf(vtkAbstractMapper* mapper, const char* attribute)
{
  auto* drawn = vtkOpenGLPolyDataMapper::SafeDownCast(mapper);
  vtkOpenGLVertexBufferObject* buffer = drawn ? drawn->GetVBOs()->GetVBO(attribute) : nullptr;
  glm::dvec3 origin(0.0);
  if (buffer && buffer->GetCoordShiftAndScaleEnabled() && buffer->GetShift().size() == 3)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      origin[static_cast<int>(axis)] = buffer->GetShift()[axis];
    }
  }
  return origin;
}

}
