// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rendering/Pass/RefractionTarget.h"

#include "vtkOpenGLError.h" // OpenGL itself, with whichever loader VTK uses
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLState.h"

namespace meniscus
{

//------------------------------------------------------------------------------
bool RefractionTarget::Ready(vtkOpenGLRenderWindow* window, int width, int height, int colorType)
{
  if (this->Buffer && this->Size[0] == width && this->Size[1] == height)
  {
    return true;
  }
  this->Release(window);
  this->Color = vtkSmartPointer<vtkTextureObject>::New();
  this->Color->SetContext(window);
  this->Depth = vtkSmartPointer<vtkTextureObject>::New();
  this->Depth->SetContext(window);
  const auto w = static_cast<unsigned int>(width);
  const auto h = static_cast<unsigned int>(height);
  if (!this->Color->Allocate2D(w, h, 4, colorType) ||
    !this->Depth->AllocateDepth(w, h, vtkTextureObject::Float32))
  {
    return false;
  }
  this->Buffer = vtkSmartPointer<vtkOpenGLFramebufferObject>::New();
  this->Buffer->SetContext(window);
  this->Buffer->Bind();
  this->Buffer->AddColorAttachment(0, this->Color);
  this->Buffer->AddDepthAttachment(this->Depth);
  this->Size[0] = width;
  this->Size[1] = height;
  return this->Buffer->CheckFrameBufferStatus(GL_FRAMEBUFFER) != 0;
}

//------------------------------------------------------------------------------
void RefractionTarget::Begin(vtkOpenGLState* state, const vtkRecti& part)
{
  this->Buffer->Bind();
  this->Buffer->ActivateDrawBuffers(1);
  state->vtkglViewport(0, 0, this->Size[0], this->Size[1]);
  state->vtkglEnable(GL_SCISSOR_TEST);
  state->vtkglScissor(part.GetX(), part.GetY(), part.GetWidth(), part.GetHeight());
  state->vtkglEnable(GL_DEPTH_TEST);
  state->vtkglDepthFunc(GL_LEQUAL);
  state->vtkglDepthMask(GL_TRUE);
  state->vtkglColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  state->vtkglClearColor(0.0f, 0.0f, 0.0f, 0.0f);
  state->vtkglClearDepth(1.0);
  state->vtkglClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

//------------------------------------------------------------------------------
void RefractionTarget::Release(vtkWindow* window)
{
  if (this->Buffer)
  {
    this->Buffer->ReleaseGraphicsResources(window);
    this->Color->ReleaseGraphicsResources(window);
    this->Depth->ReleaseGraphicsResources(window);
  }
  this->Buffer = nullptr;
  this->Color = nullptr;
  this->Depth = nullptr;
}

}
