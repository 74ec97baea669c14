// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rendering/Present/OpenGLColorCopy.h"

#include "Rendering/Present/OpenGLTools.h"

#include "vtkOpenGLError.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLState.h"

namespace meniscus
{

namespace
{

int GetInteger(GLenum name)
{
  GLint value = 0;
  glGetIntegerv(name, &value);
  return value;
}

bool HasEightBits(int colors)
{
  const auto get = [colors](GLenum name)
  {
    GLint value = 0;
    glGetFramebufferAttachmentParameteriv(
      GL_DRAW_FRAMEBUFFER, static_cast<GLenum>(colors), name, &value);
    return value;
  };
  return get(GL_FRAMEBUFFER_ATTACHMENT_COMPONENT_TYPE) == GL_UNSIGNED_NORMALIZED &&
    get(GL_FRAMEBUFFER_ATTACHMENT_RED_SIZE) == 8;
}

}

//------------------------------------------------------------------------------
bool OpenGLColorCopy::Update(vtkOpenGLRenderWindow* window, const int viewport[4])
{
  const int target = GetInteger(GL_DRAW_FRAMEBUFFER_BINDING);
  const int colors = GetInteger(GL_DRAW_BUFFER);
  if (target == 0 || colors == GL_NONE || GetInteger(GL_SAMPLES) > 0 || !HasEightBits(colors))
  {
    return false;
  }
  const auto width = static_cast<unsigned int>(viewport[2]);
  const auto height = static_cast<unsigned int>(viewport[3]);
  if (!this->Texture || this->Texture->GetWidth() != width || this->Texture->GetHeight() != height)
  {
    this->Release(window);
    this->Texture = MakeTexelTexture(window);
    if (!this->Texture->Allocate2D(width, height, 4, VTK_UNSIGNED_CHAR))
    {
      this->Texture = nullptr;
      return false;
    }
  }
  vtkOpenGLState* state = window->GetState();
  state->PushFramebufferBindings();
  state->vtkglBindFramebuffer(GL_READ_FRAMEBUFFER, static_cast<unsigned int>(target));
  const int readBuffer = GetInteger(GL_READ_BUFFER);
  state->vtkglReadBuffer(static_cast<unsigned int>(colors));
  this->Texture->Activate();
  glCopyTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, viewport[0], viewport[1], viewport[2], viewport[3]);
  this->Texture->Deactivate();
  state->vtkglReadBuffer(static_cast<unsigned int>(readBuffer));
  state->PopFramebufferBindings();
  return true;
}

//------------------------------------------------------------------------------
void OpenGLColorCopy::Release(vtkWindow* window)
{
  if (this->Texture)
  {
    this->Texture->ReleaseGraphicsResources(window);
  }
  this->Texture = nullptr;
}

}
