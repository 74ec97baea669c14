// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rendering/Present/RayCastPresenter.h"

#include "vtkTetrahedraComposeFS.h"
#include "vtkTetrahedraSelectFS.h"

#include "vtkOpenGLError.h"
#include "vtkOpenGLQuadHelper.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLShaderCache.h"
#include "vtkOpenGLState.h"
#include "vtkShaderProgram.h"
#include "vtkTextureObject.h"

#include <glm/gtc/type_ptr.hpp>

#include <cstddef>
#include <utility>

namespace meniscus
{
namespace
{

/** Depths of a viewport at the pixels of an image of another size. */
std::vector<float> SampleDepths(
  const std::vector<float>& all, int width, int height, const int (&size)[2])
{
  std::vector<float> depths;
  depths.reserve(static_cast<std::size_t>(size[0]) * size[1]);
  for (int y = 0; y < size[1]; ++y)
  {
    const std::size_t row = static_cast<std::size_t>((y + 0.5) * height / size[1]) * width;
    for (int x = 0; x < size[0]; ++x)
    {
      depths.push_back(all[row + static_cast<std::size_t>((x + 0.5) * width / size[0])]);
    }
  }
  return depths;
}

}

//------------------------------------------------------------------------------
RayCastPresenter::RayCastPresenter() = default;

//------------------------------------------------------------------------------
RayCastPresenter::~RayCastPresenter()
{
  this->Release(nullptr);
}

//------------------------------------------------------------------------------
std::string RayCastPresenter::SetWindow(vtkOpenGLRenderWindow* window)
{
  if (window != this->Window)
  {
    this->Release(nullptr);
    this->Window = window;
    window->MakeCurrent();
  }
  GLint version[2] = { 0, 0 };
  glGetIntegerv(GL_MAJOR_VERSION, &version[0]);
  glGetIntegerv(GL_MINOR_VERSION, &version[1]);
  if (version[0] < 3 || (version[0] == 3 && version[1] < 2))
  {
    return "OpenGL 3.2 is needed, the window has " + std::to_string(version[0]) + "." +
      std::to_string(version[1]);
  }
  return std::string();
}

//------------------------------------------------------------------------------
vtkOpenGLRenderWindow* RayCastPresenter::GetWindow() const
{
  return this->Window;
}

//------------------------------------------------------------------------------
void RayCastPresenter::GetViewport(int viewport[4]) const
{
  this->Window->GetState()->vtkglGetIntegerv(GL_VIEWPORT, viewport);
}

//------------------------------------------------------------------------------
std::string RayCastPresenter::Present(const RayCastOutput& output, bool sameFrame,
  const std::function<std::string(RayCastTarget&)>& makeImage)
{
  vtkOpenGLState* state = this->Window->GetState();
  vtkOpenGLState::ScopedglViewport viewportScope(state);
  vtkOpenGLState::ScopedglScissor scissorScope(state);
  vtkOpenGLState::ScopedglEnableDisable scissorTestScope(state, GL_SCISSOR_TEST);
  vtkOpenGLState::ScopedglEnableDisable depthTestScope(state, GL_DEPTH_TEST);
  vtkOpenGLState::ScopedglEnableDisable blendScope(state, GL_BLEND);
  vtkOpenGLState::ScopedglEnableDisable cullScope(state, GL_CULL_FACE);
  vtkOpenGLState::ScopedglDepthMask depthMaskScope(state);
  vtkOpenGLState::ScopedglColorMask colorMaskScope(state);
  vtkOpenGLState::ScopedglBlendFuncSeparate blendFuncScope(state);
  vtkOpenGLState::ScopedglActiveTexture activeTextureScope(state);

  int viewport[4];
  this->GetViewport(viewport);
  this->Depth.Update(this->Window, viewport);
  this->Depths.reset();
  std::string error = this->Resize(output.ImageSize[0], output.ImageSize[1]);
  if (!error.empty())
  {
    return error;
  }
  state->vtkglDisable(GL_DEPTH_TEST);
  state->vtkglDisable(GL_CULL_FACE);
  state->vtkglDepthMask(GL_FALSE);
  state->vtkglColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  {
    vtkOpenGLState::ScopedglEnableDisable imageScissorScope(state, GL_SCISSOR_TEST);
    state->vtkglDisable(GL_SCISSOR_TEST);
    state->vtkglDisable(GL_BLEND);
    state->PushFramebufferBindings();
    if (!this->HoldsImageOfDepths(sameFrame))
    {
      error = makeImage(*this);
      this->DepthsOfImage = std::move(this->Depths);
      this->Depths.reset();
    }
    state->PopFramebufferBindings();
  }
  return error.empty() ? this->Blend(output, viewport) : error;
}

//------------------------------------------------------------------------------
bool RayCastPresenter::IsSoftware()
{
  const auto* name = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  const std::string renderer(name ? name : "");
  for (const char* software : { "llvmpipe", "softpipe", "swrast", "SWR" })
  {
    if (renderer.find(software) != std::string::npos)
    {
      return true;
    }
  }
  return false;
}

//------------------------------------------------------------------------------
std::vector<float> RayCastPresenter::ReadDepths()
{
  if (!this->Depths)
  {
    const std::vector<float> all = this->Depth.Read(this->Window);
    const int width = static_cast<int>(this->Depth.GetTexture()->GetWidth());
    const int height = static_cast<int>(this->Depth.GetTexture()->GetHeight());
    const bool whole = width == this->Size[0] && height == this->Size[1];
    this->Depths = whole ? all : SampleDepths(all, width, height, this->Size);
  }
  return *this->Depths;
}

//------------------------------------------------------------------------------
const std::vector<float>* RayCastPresenter::GetDepthsOfImage()
{
  return this->DepthsOfImage ? &*this->DepthsOfImage : nullptr;
}

//------------------------------------------------------------------------------
/**
 * True if the image held is that of the frame at hand. Depths are read only where the frame may be
 * the same, so that the first repetition of a frame may not be recognised, but a moving camera
 * costs nothing.
 */
bool RayCastPresenter::HoldsImageOfDepths(bool sameFrame)
{
  if (!sameFrame)
  {
    this->DepthsOfImage.reset();
    return false;
  }
  const std::vector<float> depths = this->ReadDepths();
  return this->DepthsOfImage && *this->DepthsOfImage == depths;
}

//------------------------------------------------------------------------------
std::string RayCastPresenter::WriteImage(const std::vector<float>& rgba)
{
  const std::size_t values = std::size_t{ 4 } * this->Size[0] * this->Size[1];
  if (rgba.size() != values)
  {
    return "an image of " + std::to_string(rgba.size()) + " numbers was made, not of " +
      std::to_string(values);
  }
  // Copied into the texture, not changed.
  void* pixels = const_cast<float*>(rgba.data());
  const bool made =
    this->Image->Create2DFromRaw(this->Size[0], this->Size[1], 4, VTK_FLOAT, pixels);
  return made ? std::string() : "the image could not be sent to the graphics device";
}

//------------------------------------------------------------------------------
void RayCastPresenter::Finish()
{
  glFinish();
}

//------------------------------------------------------------------------------
std::string RayCastPresenter::Resize(int width, int height)
{
  if (width == this->Size[0] && height == this->Size[1])
  {
    return std::string();
  }
  this->Image = vtkSmartPointer<vtkTextureObject>::New();
  this->Image->SetContext(this->Window);
  this->Image->SetMinificationFilter(vtkTextureObject::Nearest);
  this->Image->SetMagnificationFilter(vtkTextureObject::Nearest);
  if (!this->Image->Allocate2D(width, height, 4, VTK_FLOAT))
  {
    this->Size[0] = this->Size[1] = 0;
    return "no float image of " + std::to_string(width) + " x " + std::to_string(height) +
      " pixels can be made on the graphics device";
  }
  this->Size[0] = width;
  this->Size[1] = height;
  return std::string();
}

//------------------------------------------------------------------------------
/** Makes the program that draws the image, or that draws where it is visible, the current one. */
std::string RayCastPresenter::ReadyDrawer(bool selecting)
{
  std::unique_ptr<vtkOpenGLQuadHelper>& drawer = selecting ? this->Selector : this->Composer;
  if (!drawer)
  {
    const char* source = selecting ? vtkTetrahedraSelectFS : vtkTetrahedraComposeFS;
    drawer = std::make_unique<vtkOpenGLQuadHelper>(this->Window, nullptr, source, "");
  }
  else
  {
    this->Window->GetShaderCache()->ReadyShaderProgram(drawer->Program);
  }
  const bool ready = drawer->Program && drawer->Program->GetCompiled();
  return ready ? std::string() : "a shader does not compile on this graphics device";
}

//------------------------------------------------------------------------------
std::string RayCastPresenter::Blend(const RayCastOutput& output, const int viewport[4])
{
  vtkOpenGLState* state = this->Window->GetState();
  state->vtkglViewport(viewport[0], viewport[1], viewport[2], viewport[3]);
  const std::string error = this->ReadyDrawer(output.Selecting);
  if (!error.empty())
  {
    return error;
  }
  vtkOpenGLQuadHelper* drawer = (output.Selecting ? this->Selector : this->Composer).get();
  // Rasterisers in software blend with 8 bits in 8 bits, which rounds three times; a picture that
  // is composited later is rounded by the shader, which has to know all of the sum.
  const bool blends = !this->IsSoftware() && output.ColorBias == 0.0f;
  const bool hasUnder = !output.Selecting && !blends && this->Under.Update(this->Window, viewport);
  if (output.Selecting)
  {
    state->vtkglDisable(GL_BLEND);
    drawer->Program->SetUniform3f("selectionValue", glm::value_ptr(output.SelectionValue));
  }
  else
  {
    drawer->Program->SetUniformf("colorBias", output.ColorBias);
    const float corner[2] = { static_cast<float>(viewport[0]), static_cast<float>(viewport[1]) };
    drawer->Program->SetUniform2f("corner", corner);
    drawer->Program->SetUniformi("hasUnder", hasUnder ? 1 : 0);
    state->SetEnumState(GL_BLEND, !hasUnder);
    state->vtkglBlendFuncSeparate(GL_ONE, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  }
  const bool whole = this->Size[0] == viewport[2] && this->Size[1] == viewport[3];
  this->Image->SetMagnificationFilter(whole ? vtkTextureObject::Nearest : vtkTextureObject::Linear);
  this->Image->Activate();
  drawer->Program->SetUniformi("image", this->Image->GetTextureUnit());
  // A sampler wants a texture even where it is not read.
  vtkTextureObject* under = hasUnder ? this->Under.GetTexture() : this->Image.Get();
  under->Activate();
  if (!output.Selecting)
  {
    drawer->Program->SetUniformi("under", under->GetTextureUnit());
  }
  drawer->Render();
  under->Deactivate();
  this->Image->Deactivate();
  return std::string();
}

//------------------------------------------------------------------------------
void RayCastPresenter::Release(vtkWindow* window)
{
  vtkOpenGLRenderWindow* owner =
    window ? vtkOpenGLRenderWindow::SafeDownCast(window) : this->Window.Get();
  if (owner)
  {
    owner->PushContext();
  }
  this->Depth.Release(owner);
  this->Under.Release(owner);
  this->Composer.reset();
  this->Selector.reset();
  this->Image = nullptr;
  this->Size[0] = this->Size[1] = 0;
  this->DepthsOfImage.reset();
  this->Window = nullptr;
  if (owner)
  {
    owner->PopContext();
  }
}

}
