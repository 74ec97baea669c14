// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Rendering/Backends/RayCastBackend.h"
#include "vtkSmartPointer.h"

#include <memory>
#include <string>

class vtkOpenGLFramebufferObject;
class vtkOpenGLQuadHelper;
class vtkOpenGLRenderWindow;
class vtkTextureObject;

namespace meniscus
{

/** An image of four floats per pixel. Returns null if the graphics device has no room for it. */
vtkSmartPointer<vtkTextureObject> MakeFloatImage(
  vtkOpenGLRenderWindow* window, int width, int height);

/** Mean of several float images, on the graphics device. Errors are texts, empty if there is none.
 */
class OpenGLImageMean
{
public:
  OpenGLImageMean();
  ~OpenGLImageMean();
  OpenGLImageMean(const OpenGLImageMean&) = delete;
  void operator=(const OpenGLImageMean&) = delete;

  /** Starts with an image of zeros. */
  std::string Clear(vtkOpenGLRenderWindow* window, int width, int height);
  /** Adds a box of an image, multiplied by a weight. */
  std::string Add(vtkOpenGLRenderWindow* window, vtkTextureObject* image,
    const RayCastImageBox& box, float weight);
  /** The mean, which stays with the caller; the object gives up its texture. */
  vtkSmartPointer<vtkTextureObject> Take();

  /** Frees all objects of the current context. */
  void Release();

private:
  void Bind(vtkOpenGLRenderWindow* window);

  vtkSmartPointer<vtkTextureObject> Mean;
  vtkSmartPointer<vtkOpenGLFramebufferObject> Target;
  std::unique_ptr<vtkOpenGLQuadHelper> Adder;
};

}
