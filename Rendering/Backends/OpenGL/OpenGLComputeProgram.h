// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Rendering_Backends_OpenGL_OpenGLComputeProgram_h
#define meniscus_Rendering_Backends_OpenGL_OpenGLComputeProgram_h

#include "vtkShaderProgram.h"

#include <string>

class vtkOpenGLRenderWindow;

namespace meniscus
{

/**
 * A program of one compute shader (OpenGL 4.3), which VTK's shader cache does not know (VTK 9.1),
 * with the uniforms of vtkShaderProgram. All calls want the window's context to be current.
 */
class OpenGLComputeProgram : public vtkShaderProgram
{
public:
  static OpenGLComputeProgram* New();
  vtkTypeMacro(OpenGLComputeProgram, vtkShaderProgram);

  /** Whether the current context has compute shaders. */
  static bool IsSupported();

  /** Compiles and links; false if that fails. */
  bool Build(const std::string& source);

  /** Makes it the current program, in place of what VTK believes to be. */
  void Use(vtkOpenGLRenderWindow* window);

  /** Runs the groups and waits with later reads until images are written; unbinds the program. */
  void Dispatch(int groupsX, int groupsY);

  /** Frees the program. */
  void Free();

protected:
  OpenGLComputeProgram() = default;
  ~OpenGLComputeProgram() override = default;
};

}

#endif
