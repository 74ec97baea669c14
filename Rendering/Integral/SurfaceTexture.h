// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/** Pictures on surfaces, sampled without a window. */
#pragma once

#include "vtkSmartPointer.h"
#include "vtkType.h"
#include "vtkUnsignedCharArray.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <string>

class vtkDataArray;
class vtkScalarsToColors;
class vtkTexture;

namespace meniscus
{

/**
 * Colours of scalars by vtkMapper's rules: unsigned char values are colours, others are mapped.
 * @param table null for a vtkLookupTable over the range of the scalars.
 */
vtkSmartPointer<vtkUnsignedCharArray> MapToColors(
  vtkDataArray* scalars, vtkScalarsToColors* table, int colorMode);

/** Colour of the tuple of an array, from 0 to 1. */
glm::dvec3 GetColor(vtkUnsignedCharArray* colors, vtkIdType tuple);

/** The image of a vtkTexture, with its wrapping and interpolation as OpenGL defines them. */
class SurfaceTexture
{
public:
  /** Updates and reads the image; null for none. Returns an error or an empty string. */
  std::string Read(vtkTexture* texture);
  bool IsEmpty() const { return !this->Texels; }

  /** Colour at texture coordinates; white if they are not finite. */
  glm::dvec3 At(const glm::dvec2& coordinates) const;

private:
  vtkIdType Wrap(vtkIdType texel, int axis) const;
  glm::dvec3 GetTexel(vtkIdType column, vtkIdType row) const;

  vtkSmartPointer<vtkUnsignedCharArray> Texels;
  vtkIdType Size[2] = { 0, 0 };
  int WrapMode = 0;
  bool IsInterpolated = false;
  glm::dvec3 Border{ 0.0 };
};

}
