// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Rendering_Present_OpenGLColorCopy_h
#define meniscus_Rendering_Present_OpenGLColorCopy_h

#include "vtkSmartPointer.h"
#include "vtkTextureObject.h"

class vtkOpenGLRenderWindow;
class vtkWindow;

namespace meniscus
{

/** The colours of the framebuffer object being drawn to, of 8 bits, as a texture. */
class OpenGLColorCopy
{
public:
  vtkTextureObject* GetTexture() { return this->Texture; }

  /**
   * Copies the viewport (x, y, width, height). Returns false, and copies nothing, if what is drawn
   * to is multisampled, has no colours of 8 bits, or is the window itself.
   */
  bool Update(vtkOpenGLRenderWindow* window, const int viewport[4]);

  void Release(vtkWindow* window);

private:
  vtkSmartPointer<vtkTextureObject> Texture;
};

}

#endif
