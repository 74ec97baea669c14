// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkShaderProgram.h"

#include <string>

class vtkOpenGLRenderWindow;

namespace meniscus
{

/**
 * A program of one compute shader (OpenGL 4.3), which VTK's shader cache does not support (VTK
 * 9.1), with the uniforms of vtkShaderProgram. All calls require the window's context to be
 * current.
 */
class OpenGLComputeProgram : public vtkShaderProgram
{
public:
  static OpenGLComputeProgram* New();
  vtkTypeMacro(OpenGLComputeProgram, vtkShaderProgram);

  /** True if the current context has compute shaders. */
  static bool IsSupported();

  /** Compiles and links; returns the driver's messages on failure, and nothing on success. */
  std::string Build(const std::string& source);

  /** Makes it the current program, regardless of VTK's record of the current one. */
  void Use(vtkOpenGLRenderWindow* window);

  /** Runs the groups, delays later reads until images are written, and unbinds the program. */
  void Dispatch(int groupsX, int groupsY);

  /** Frees the program. */
  void Free();

protected:
  OpenGLComputeProgram() = default;
  ~OpenGLComputeProgram() override = default;
};

}
