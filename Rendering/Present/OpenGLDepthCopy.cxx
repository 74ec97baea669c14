// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rendering/Present/OpenGLDepthCopy.h"

#include "Rendering/Present/OpenGLTools.h"

#include "vtkOpenGLError.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLState.h"

namespace meniscus
{

//------------------------------------------------------------------------------
OpenGLDepthCopy::Format OpenGLDepthCopy::ReadFormat(int framebuffer)
{
  // The buffers of a window's own framebuffer have other names than the buffers of a framebuffer
  // object.
  const GLenum depth = framebuffer == 0 ? GL_DEPTH : GL_DEPTH_ATTACHMENT;
  const GLenum stencil = framebuffer == 0 ? GL_STENCIL : GL_STENCIL_ATTACHMENT;
  const auto get = [](GLenum attachment, GLenum name)
  {
    GLint value = 0;
    glGetFramebufferAttachmentParameteriv(GL_READ_FRAMEBUFFER, attachment, name, &value);
    return value;
  };
  Format format;
  if (get(depth, GL_FRAMEBUFFER_ATTACHMENT_OBJECT_TYPE) == GL_NONE)
  {
    return format;
  }
  format.DepthBits = get(depth, GL_FRAMEBUFFER_ATTACHMENT_DEPTH_SIZE);
  format.Float = get(depth, GL_FRAMEBUFFER_ATTACHMENT_COMPONENT_TYPE) == GL_FLOAT;
  if (get(stencil, GL_FRAMEBUFFER_ATTACHMENT_OBJECT_TYPE) != GL_NONE)
  {
    format.StencilBits = get(stencil, GL_FRAMEBUFFER_ATTACHMENT_STENCIL_SIZE);
  }
  return format;
}

//------------------------------------------------------------------------------
void OpenGLDepthCopy::Update(
  vtkOpenGLRenderWindow* window, const int viewport[4], const RayCastImageBox& box)
{
  vtkOpenGLState* state = window->GetState();
  state->PushFramebufferBindings();
  GLint source = 0;
  GLint samples = 0;
  glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &source);
  glGetIntegerv(GL_SAMPLES, &samples);
  state->vtkglBindFramebuffer(GL_READ_FRAMEBUFFER, static_cast<unsigned int>(source));
  const Format format = ReadFormat(source);
  this->Allocate(window, format, viewport[2], viewport[3]);
  this->Sampled = samples > 1 && format.DepthBits > 0;
  if (format.DepthBits == 0)
  {
    this->Clear(window);
  }
  else if (samples > 0)
  {
    this->Resolve(window, viewport);
  }
  else
  {
    // CopyFromFrameBuffer() is not used: it checks the window's samples instead of the
    // framebuffer's (VTK 9.1; test MultisampledWindow).
    this->Texture->Activate();
    glCopyTexSubImage2D(GL_TEXTURE_2D, 0, box.Left, box.Bottom, viewport[0] + box.Left,
      viewport[1] + box.Bottom, box.Right - box.Left, box.Top - box.Bottom);
    this->Texture->Deactivate();
  }
  state->PopFramebufferBindings();
}

//------------------------------------------------------------------------------
void OpenGLDepthCopy::Clear(vtkOpenGLRenderWindow* window)
{
  vtkOpenGLState* state = window->GetState();
  this->Target->SetContext(window);
  this->Target->Bind(GL_DRAW_FRAMEBUFFER);
  this->Target->AddDepthAttachment(this->Texture);
  vtkOpenGLState::ScopedglEnableDisable scissor(state, GL_SCISSOR_TEST);
  vtkOpenGLState::ScopedglDepthMask depthMask(state);
  state->vtkglDisable(GL_SCISSOR_TEST);
  state->vtkglDepthMask(GL_TRUE);
  state->vtkglClearDepth(1.0);
  state->vtkglClear(GL_DEPTH_BUFFER_BIT);
}

//------------------------------------------------------------------------------
void OpenGLDepthCopy::Resolve(vtkOpenGLRenderWindow* window, const int viewport[4])
{
  vtkOpenGLState* state = window->GetState();
  this->Target->SetContext(window);
  this->Target->Bind(GL_DRAW_FRAMEBUFFER);
  this->Target->AddDepthAttachment(this->Texture);
  vtkOpenGLState::ScopedglEnableDisable scissor(state, GL_SCISSOR_TEST);
  state->vtkglDisable(GL_SCISSOR_TEST);
  state->vtkglBlitFramebuffer(viewport[0], viewport[1], viewport[0] + viewport[2],
    viewport[1] + viewport[3], 0, 0, viewport[2], viewport[3], GL_DEPTH_BUFFER_BIT, GL_NEAREST);
}

//------------------------------------------------------------------------------
void OpenGLDepthCopy::Read(
  vtkOpenGLRenderWindow* window, const RayCastImageBox& box, std::vector<float>& depths)
{
  const int width = box.Right - box.Left;
  const int height = box.Top - box.Bottom;
  depths.resize(static_cast<std::size_t>(width) * height);
  vtkOpenGLState* state = window->GetState();
  state->PushFramebufferBindings();
  this->Target->SetContext(window);
  this->Target->Bind();
  this->Target->AddDepthAttachment(this->Texture);
  glReadPixels(box.Left, box.Bottom, width, height, GL_DEPTH_COMPONENT, GL_FLOAT, depths.data());
  state->PopFramebufferBindings();
}

//------------------------------------------------------------------------------
void OpenGLDepthCopy::Allocate(
  vtkOpenGLRenderWindow* window, const Format& format, int width, int height)
{
  if (this->Width == width && this->Height == height && this->Allocated == format)
  {
    return;
  }
  this->Release(window);
  // A new object is needed: a released one still remembers its format (VTK 9.1; test
  // MultisampledWindow).
  this->Texture = MakeTexelTexture(window);
  // A multisampled blit requires the same format as the source.
  if (format.StencilBits > 0)
  {
    this->Texture->AllocateDepthStencil(width, height);
  }
  else
  {
    const int fixed = format.DepthBits == 16
      ? vtkTextureObject::Fixed16
      : (format.DepthBits == 32 ? vtkTextureObject::Fixed32 : vtkTextureObject::Fixed24);
    this->Texture->AllocateDepth(width, height, format.Float ? vtkTextureObject::Float32 : fixed);
  }
  this->Allocated = format;
  this->Width = width;
  this->Height = height;
}

//------------------------------------------------------------------------------
void OpenGLDepthCopy::Release(vtkWindow* window)
{
  if (this->Texture)
  {
    this->Texture->ReleaseGraphicsResources(window);
  }
  this->Target->ReleaseGraphicsResources(window);
  this->Allocated = Format();
  this->Width = 0;
  this->Height = 0;
}

}
