// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/** Objects of OpenGL that several classes make alike. */
#pragma once

#include "vtkSmartPointer.h"

#include <functional>
#include <memory>
#include <string>

class vtkOpenGLQuadHelper;
class vtkOpenGLRenderWindow;
class vtkTextureObject;

namespace meniscus
{

/** A texture, without room for values yet, whose texels are read without interpolation. */
vtkSmartPointer<vtkTextureObject> MakeTexelTexture(vtkOpenGLRenderWindow* window);

/**
 * Makes the program of a quad over the viewport the current one. A null quad is made, with the
 * fragment shader that `makeSource` returns. Returns an error, or an empty text.
 */
std::string ReadyQuad(vtkOpenGLRenderWindow* window, std::unique_ptr<vtkOpenGLQuadHelper>& quad,
  const std::function<std::string()>& makeSource);

}
