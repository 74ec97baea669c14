// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkSmartPointer.h"
#include "vtkTextureObject.h"

class vtkOpenGLRenderWindow;
class vtkWindow;

namespace meniscus
{

/** Copy of the 8-bit colours of the current framebuffer object, as a texture. */
class OpenGLColorCopy
{
public:
  vtkTextureObject* GetTexture() { return this->Texture; }

  /**
   * Copies the viewport (x, y, width, height). Returns false, and copies nothing, if the draw
   * framebuffer is multisampled, has no 8-bit colours, or is the window itself.
   */
  bool Update(vtkOpenGLRenderWindow* window, const int viewport[4]);

  void Release(vtkWindow* window);

private:
  vtkSmartPointer<vtkTextureObject> Texture;
};

}
