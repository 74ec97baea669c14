// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Rendering/Backends/RayCastBackend.h"
#include "vtkNew.h"
#include "vtkOpenGLFramebufferObject.h"
#include "vtkSmartPointer.h"
#include "vtkTextureObject.h"

#include <vector>

class vtkOpenGLRenderWindow;
class vtkWindow;

namespace meniscus
{

/** Copy of the depth buffer of the current framebuffer, as a texture of the viewport's size. */
class OpenGLDepthCopy
{
public:
  vtkTextureObject* GetTexture() { return this->Texture; }
  /** True if each depth of the last copy is one of several of its pixel. */
  bool HasSamples() const { return this->Sampled; }

  /**
   * Copies at least a box of the viewport (x, y, width, height). Multisampled depth is resolved; a
   * framebuffer without a depth buffer is taken as infinitely far.
   */
  void Update(vtkOpenGLRenderWindow* window, const int viewport[4], const RayCastImageBox& box);

  /** Replaces `depths` by the window depths of a box of the last copy, in rows from the bottom. */
  void Read(vtkOpenGLRenderWindow* window, const RayCastImageBox& box, std::vector<float>& depths);

  void Release(vtkWindow* window);

private:
  struct Format
  {
    int DepthBits = 0;
    int StencilBits = 0;
    bool Float = false;

    bool operator==(const Format& other) const
    {
      return this->DepthBits == other.DepthBits && this->StencilBits == other.StencilBits &&
        this->Float == other.Float;
    }
  };

  static Format ReadFormat(int framebuffer);
  void Allocate(vtkOpenGLRenderWindow* window, const Format& format, int width, int height);
  void Clear(vtkOpenGLRenderWindow* window);
  void Resolve(vtkOpenGLRenderWindow* window, const int viewport[4]);

  vtkSmartPointer<vtkTextureObject> Texture;
  vtkNew<vtkOpenGLFramebufferObject> Target;
  Format Allocated;
  bool Sampled = false;
  int Width = 0;
  int Height = 0;
};

}
