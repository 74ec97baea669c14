// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkOpenGLFramebufferObject.h"
#include "vtkRect.h"
#include "vtkSmartPointer.h"
#include "vtkTextureObject.h"

class vtkOpenGLRenderWindow;
class vtkOpenGLState;
class vtkWindow;

namespace meniscus
{

/** An off-screen image of the size of the viewport, with depth. */
struct RefractionTarget
{
  vtkSmartPointer<vtkOpenGLFramebufferObject> Buffer;
  vtkSmartPointer<vtkTextureObject> Color;
  vtkSmartPointer<vtkTextureObject> Depth;
  int Size[2] = { 0, 0 };

  bool Ready(vtkOpenGLRenderWindow* window, int width, int height, int colorType);
  /**
   * Binds the framebuffer, limits drawing to a part of it and clears that: colour (0, 0, 0, 0),
   * depth 1.
   */
  void Begin(vtkOpenGLState* state, const vtkRecti& part);
  void Release(vtkWindow* window);
};

}
