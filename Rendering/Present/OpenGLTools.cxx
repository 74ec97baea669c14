// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rendering/Present/OpenGLTools.h"

#include "vtkOpenGLQuadHelper.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLShaderCache.h"
#include "vtkShaderProgram.h"
#include "vtkTextureObject.h"

namespace meniscus
{

//------------------------------------------------------------------------------
vtkSmartPointer<vtkTextureObject> MakeTexelTexture(vtkOpenGLRenderWindow* window)
{
  auto texture = vtkSmartPointer<vtkTextureObject>::New();
  texture->SetContext(window);
  texture->SetMinificationFilter(vtkTextureObject::Nearest);
  texture->SetMagnificationFilter(vtkTextureObject::Nearest);
  return texture;
}

//------------------------------------------------------------------------------
std::string ReadyQuad(vtkOpenGLRenderWindow* window, std::unique_ptr<vtkOpenGLQuadHelper>& quad,
  const std::function<std::string()>& makeSource)
{
  if (!quad)
  {
    quad = std::make_unique<vtkOpenGLQuadHelper>(window, nullptr, makeSource().c_str(), "");
  }
  else
  {
    window->GetShaderCache()->ReadyShaderProgram(quad->Program);
  }
  const bool ready = quad->Program && quad->Program->GetCompiled();
  return ready ? std::string() : "a shader does not compile on this graphics device";
}

}
