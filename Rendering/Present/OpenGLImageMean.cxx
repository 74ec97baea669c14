// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rendering/Present/OpenGLImageMean.h"

#include "Rendering/Present/OpenGLTools.h"

#include "vtkTetrahedraMeanFS.h"

#include "vtkOpenGLError.h"
#include "vtkOpenGLFramebufferObject.h"
#include "vtkOpenGLQuadHelper.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLState.h"
#include "vtkShaderProgram.h"
#include "vtkTextureObject.h"

namespace meniscus
{

//------------------------------------------------------------------------------
vtkSmartPointer<vtkTextureObject> MakeFloatImage(
  vtkOpenGLRenderWindow* window, int width, int height)
{
  auto image = MakeTexelTexture(window);
  // VTK's default repeats the image: a linear filter would mix opposite edges.
  image->SetWrapS(vtkTextureObject::ClampToEdge);
  image->SetWrapT(vtkTextureObject::ClampToEdge);
  return image->Allocate2D(width, height, 4, VTK_FLOAT) ? image : nullptr;
}

//------------------------------------------------------------------------------
OpenGLImageMean::OpenGLImageMean() = default;
OpenGLImageMean::~OpenGLImageMean() = default;

//------------------------------------------------------------------------------
void OpenGLImageMean::Bind(vtkOpenGLRenderWindow* window)
{
  if (!this->Target)
  {
    this->Target = vtkSmartPointer<vtkOpenGLFramebufferObject>::New();
    this->Target->SetContext(window);
  }
  this->Target->Bind();
  this->Target->AddColorAttachment(0, this->Mean);
  this->Target->ActivateDrawBuffer(0);
  window->GetState()->vtkglViewport(
    0, 0, static_cast<int>(this->Mean->GetWidth()), static_cast<int>(this->Mean->GetHeight()));
}

//------------------------------------------------------------------------------
std::string OpenGLImageMean::Clear(vtkOpenGLRenderWindow* window, int width, int height)
{
  if (!this->Mean || static_cast<int>(this->Mean->GetWidth()) != width ||
    static_cast<int>(this->Mean->GetHeight()) != height)
  {
    this->Mean = MakeFloatImage(window, width, height);
  }
  if (!this->Mean)
  {
    return "no float image of " + std::to_string(width) + " x " + std::to_string(height) +
      " pixels can be made on the graphics device";
  }
  this->Bind(window);
  const float zero[4] = { 0.0f, 0.0f, 0.0f, 0.0f };
  glClearBufferfv(GL_COLOR, 0, zero);
  return std::string();
}

//------------------------------------------------------------------------------
std::string OpenGLImageMean::Add(
  vtkOpenGLRenderWindow* window, vtkTextureObject* image, const RayCastImageBox& box, float weight)
{
  if (box.Left >= box.Right || box.Bottom >= box.Top)
  {
    return std::string();
  }
  vtkOpenGLState* state = window->GetState();
  vtkOpenGLState::ScopedglEnableDisable blendScope(state, GL_BLEND);
  vtkOpenGLState::ScopedglBlendFuncSeparate blendFuncScope(state);
  vtkOpenGLState::ScopedglEnableDisable scissorTestScope(state, GL_SCISSOR_TEST);
  vtkOpenGLState::ScopedglScissor scissorScope(state);
  this->Bind(window);
  const std::string error = ReadyQuad(window, this->Adder, []() { return vtkTetrahedraMeanFS; });
  if (!error.empty())
  {
    return error;
  }
  state->vtkglEnable(GL_BLEND);
  state->vtkglBlendFuncSeparate(GL_ONE, GL_ONE, GL_ONE, GL_ONE);
  state->vtkglEnable(GL_SCISSOR_TEST);
  state->vtkglScissor(box.Left, box.Bottom, box.Right - box.Left, box.Top - box.Bottom);
  image->Activate();
  this->Adder->Program->SetUniformi("image", image->GetTextureUnit());
  this->Adder->Program->SetUniformf("weight", weight);
  this->Adder->Render();
  image->Deactivate();
  return std::string();
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkTextureObject> OpenGLImageMean::Take()
{
  const vtkSmartPointer<vtkTextureObject> mean = this->Mean;
  this->Mean = nullptr;
  return mean;
}

//------------------------------------------------------------------------------
void OpenGLImageMean::Release()
{
  this->Adder.reset();
  this->Target = nullptr;
  this->Mean = nullptr;
}

}
