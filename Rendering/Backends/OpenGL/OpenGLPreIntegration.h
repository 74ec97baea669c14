// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkSmartPointer.h"
#include "vtkTextureObject.h"

#include <cstdint>
#include <string>

class vtkOpenGLRenderWindow;
class vtkShaderProgram;
class vtkWindow;

namespace meniscus
{

class PreIntegrationTable;

/** A pre-integration table as a three-dimensional texture, which shaders interpolate. */
class OpenGLPreIntegration
{
public:
  std::int64_t GetBytes() const { return this->Bytes; }

  /** Replaces the contents. Returns an error or an empty string. */
  std::string Upload(vtkOpenGLRenderWindow* window, const PreIntegrationTable& table);

  /** Sets the uniforms of vtkTetrahedraPreIntegrated. */
  void Activate(vtkShaderProgram* program);
  void Deactivate() { this->Texture->Deactivate(); }
  /** Requires the window's context to be current. */
  void Release(vtkWindow* window);

private:
  vtkSmartPointer<vtkTextureObject> Texture;
  int Scalars = 0;
  double Shortest = 1.0;
  int LengthsPerOctave = 1;
  /** Middle of the scalars and the reciprocal of half their range. */
  float Range[2] = { 0.0f, 1.0f };
  std::int64_t Bytes = 0;
};

}
