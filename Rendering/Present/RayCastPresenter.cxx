// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rendering/Present/RayCastPresenter.h"

#include "Rendering/Present/OpenGLTools.h"

#include "vtkTetrahedraComposeFS.h"
#include "vtkTetrahedraDepthFS.h"
#include "vtkTetrahedraSelectFS.h"

#include "vtkCommand.h"
#include "vtkNew.h"
#include "vtkOpenGLError.h"
#include "vtkOpenGLQuadHelper.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLState.h"
#include "vtkShaderProgram.h"
#include "vtkTextureObject.h"

#include <glm/gtc/type_ptr.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace meniscus
{
namespace
{

/** Pixel of a viewport, along one axis, in which the middle of a pixel of an image is. */
int PixelBelow(int pixel, int length, int size)
{
  return static_cast<int>((pixel + 0.5) * length / size);
}

/**
 * Replaces window depths of an image by those of other clipping planes at which rays end in the
 * same places, and by no depth of the window where they do not.
 */
void TakeOverEnds(const RayFrame& before, const RayFrame& rays, const std::vector<float>& depths,
  std::vector<float>& ofImage)
{
  float window[2] = { -1.0f, -1.0f };
  bool isSame = false;
  for (std::size_t i = 0; i < ofImage.size(); ++i)
  {
    // Consecutive pixels mostly have the same depth, the background's.
    if (ofImage[i] != window[0] || depths[i] != window[1])
    {
      window[0] = ofImage[i];
      window[1] = depths[i];
      isSame = before.EndAt(window[0]) == rays.EndAt(window[1]);
    }
    ofImage[i] = isSame ? depths[i] : -1.0f;
  }
}

/**
 * Source of the shader that blends an image into the framebuffer.
 * @param biased for images that are composited later.
 * @param sampled for framebuffers with several samples per pixel.
 */
std::string ComposeSource(bool biased, bool sampled)
{
  std::string source = vtkTetrahedraComposeFS;
  vtkShaderProgram::Substitute(source, "//VTK::Samples::Dec", sampled ? "#define HAS_SAMPLES" : "");
  vtkShaderProgram::Substitute(
    source, "//VTK::ColorBias::Dec", biased ? "#define HAS_COLOR_BIAS" : "");
  return source;
}

/** The box with `margin` more pixels on each side, as far as the image reaches. */
RayCastImageBox Grown(const RayCastImageBox& box, int margin, const int (&size)[2])
{
  return { std::max(box.Left - margin, 0), std::min(box.Right + margin, size[0]),
    std::max(box.Bottom - margin, 0), std::min(box.Top + margin, size[1]) };
}

bool IsEmpty(const RayCastImageBox& box)
{
  return box.Left >= box.Right || box.Bottom >= box.Top;
}

/** Pixels of a viewport in which the middles of the pixels of a box of an image are. */
RayCastImageBox PixelsBelow(
  const RayCastImageBox& box, const int (&viewport)[4], const int (&size)[2])
{
  if (IsEmpty(box))
  {
    return { 0, 0, 0, 0 };
  }
  return { PixelBelow(box.Left, viewport[2], size[0]),
    PixelBelow(box.Right - 1, viewport[2], size[0]) + 1,
    PixelBelow(box.Bottom, viewport[3], size[1]),
    PixelBelow(box.Top - 1, viewport[3], size[1]) + 1 };
}

/**
 * Range of a viewport's pixels in which the pixels of an image appear.
 * @param origin,length of the viewport; `size` pixels of the image appear in it.
 */
glm::ivec2 Shown(int first, int last, int origin, int length, int size)
{
  const double scale = static_cast<double>(length) / size;
  return { origin + static_cast<int>(std::floor(first * scale)),
    origin + static_cast<int>(std::ceil(last * scale)) };
}

/**
 * Sets how an image is blended over the window's colours.
 * @param hasUnder true if the shader has a copy of these colours and blends; otherwise OpenGL does.
 */
void SetBlending(vtkOpenGLState& state, vtkShaderProgram& shader, const RayCastOutput& output,
  const int viewport[4], bool hasUnder)
{
  if (output.Selecting)
  {
    state.vtkglDisable(GL_BLEND);
    shader.SetUniform3f("selectionValue", glm::value_ptr(output.SelectionValue));
    return;
  }
  if (output.ColorBias > 0.0f)
  {
    shader.SetUniformf("colorBias", output.ColorBias);
  }
  const float corner[2] = { static_cast<float>(viewport[0]), static_cast<float>(viewport[1]) };
  shader.SetUniform2f("corner", corner);
  shader.SetUniformi("hasUnder", hasUnder ? 1 : 0);
  state.SetEnumState(GL_BLEND, !hasUnder);
  state.vtkglBlendFuncSeparate(GL_ONE, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
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
std::string RayCastPresenter::Present(const RayCastFrame& frame, const RayFrame* before,
  bool sameView, const std::function<std::string(RayCastTarget&)>& makeImage)
{
  const RayCastOutput& output = frame.Output;
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
  this->Meeting = output.Meeting;
  this->Depth.Update(
    this->Window, viewport, PixelsBelow(output.Meeting, viewport, output.ImageSize));
  this->HasDepths = false;
  this->Stoppable = output.MayStop;
  const HeldImage last{ this->Image, { this->Size[0], this->Size[1] }, this->Filled };
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
    if (!this->HoldsImageOfDepths(frame.Rays, before))
    {
      this->Filled = { 0, this->Size[0], 0, this->Size[1] };
      this->Finished = true;
      error = makeImage(*this);
      // A rasteriser on the processor reads them in less time than it takes for blending twice.
      if (this->Depth.HasSamples() && this->BlendsSamples(output, viewport) && IsSoftware())
      {
        this->ReadDepths();
      }
      this->DepthsOfImage.swap(this->Depths);
      this->HasDepthsOfImage = this->HasDepths;
      this->HasDepths = false;
    }
    state->PopFramebufferBindings();
  }
  if (!this->Finished)
  {
    this->ShowAgain(last, sameView);
  }
  return error.empty() ? this->Blend(output, viewport) : error;
}

//------------------------------------------------------------------------------
/** Takes back the image that was held before a frame that is given up. */
void RayCastPresenter::ShowAgain(const HeldImage& last, bool sameView)
{
  if (sameView && last.Image)
  {
    this->Image = last.Image;
    std::copy(last.Size, last.Size + 2, this->Size);
    this->Filled = last.Filled;
    return;
  }
  this->Filled = { 0, 0, 0, 0 };
}

//------------------------------------------------------------------------------
bool RayCastPresenter::MayStop()
{
  return this->Stoppable && this->Window->HasObserver(vtkCommand::AbortCheckEvent);
}

//------------------------------------------------------------------------------
bool RayCastPresenter::GoOn()
{
  if (!this->MayStop() || !this->Window->CheckAbortStatus())
  {
    return true;
  }
  this->Finished = false;
  return false;
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
const std::vector<float>& RayCastPresenter::ReadDepths()
{
  if (!this->HasDepths)
  {
    // Elsewhere, depths do not matter.
    this->Depths.assign(static_cast<std::size_t>(this->Size[0]) * this->Size[1], 1.0f);
    if (!IsEmpty(this->Meeting))
    {
      this->ReadMeetingDepths();
    }
    this->HasDepths = true;
  }
  return this->Depths;
}

//------------------------------------------------------------------------------
/** Reads the depths in the middles of the pixels whose rays may meet the mesh. */
void RayCastPresenter::ReadMeetingDepths()
{
  const int viewport[4] = { 0, 0, static_cast<int>(this->Depth.GetTexture()->GetWidth()),
    static_cast<int>(this->Depth.GetTexture()->GetHeight()) };
  const RayCastImageBox& box = this->Meeting;
  const RayCastImageBox below = PixelsBelow(box, viewport, this->Size);
  std::vector<float> read;
  this->Depth.Read(this->Window, below, read);
  std::vector<int> columns;
  for (int x = box.Left; x < box.Right; ++x)
  {
    columns.push_back(PixelBelow(x, viewport[2], this->Size[0]) - below.Left);
  }
  for (int y = box.Bottom; y < box.Top; ++y)
  {
    const int row = PixelBelow(y, viewport[3], this->Size[1]) - below.Bottom;
    const float* from = read.data() + std::ptrdiff_t{ row } * (below.Right - below.Left);
    std::transform(columns.begin(), columns.end(),
      this->Depths.begin() + std::ptrdiff_t{ y } * this->Size[0] + box.Left,
      [from](int column) { return from[column]; });
  }
}

//------------------------------------------------------------------------------
/**
 * True if the image held shows the frame at hand. Depths are read only where the frame may be the
 * same, so that the first repetition of a frame may not be recognised, but a moving camera costs
 * nothing.
 */
bool RayCastPresenter::HoldsImageOfDepths(const RayFrame& rays, const RayFrame* before)
{
  if (!before)
  {
    this->HasDepthsOfImage = false;
    // A moving camera needs the memory of one image of depths only.
    this->Depths.swap(this->DepthsOfImage);
    return false;
  }
  const std::vector<float>& depths = this->ReadDepths();
  if (this->HasDepthsOfImage && !(*before == rays))
  {
    TakeOverEnds(*before, rays, depths, this->DepthsOfImage);
  }
  return this->Finished && this->HasDepthsOfImage && this->DepthsOfImage == depths;
}

//------------------------------------------------------------------------------
std::string RayCastPresenter::WriteImage(
  const std::vector<float>& rgba, const RayCastImageBox& filled)
{
  const std::size_t values = std::size_t{ 4 } * this->Size[0] * this->Size[1];
  if (rgba.size() != values)
  {
    return "an image of " + std::to_string(rgba.size()) + " numbers was made, not of " +
      std::to_string(values);
  }
  this->Filled = filled;
  this->Finished = true;
  if (IsEmpty(filled))
  {
    return std::string();
  }
  // Linear filtering reads one pixel beyond those drawn, which are one more than those filled.
  const RayCastImageBox sent = Grown(filled, 2, this->Size);
  const std::size_t first = static_cast<std::size_t>(sent.Bottom) * this->Size[0] + sent.Left;
  this->Image->Activate();
  glPixelStorei(GL_UNPACK_ROW_LENGTH, this->Size[0]);
  glTexSubImage2D(GL_TEXTURE_2D, 0, sent.Left, sent.Bottom, sent.Right - sent.Left,
    sent.Top - sent.Bottom, GL_RGBA, GL_FLOAT, rgba.data() + 4 * first);
  glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
  this->Image->Deactivate();
  // Not checked by glGetError(): it would report errors of earlier calls, and this one cannot fail
  // in a texture that was allocated.
  return std::string();
}

//------------------------------------------------------------------------------
std::string RayCastPresenter::MakeMean(
  int count, const std::function<std::string(int, RayCastTarget&)>& makeImage)
{
  // The image that is held is none of these, and the mean is made of all of them.
  this->HasDepthsOfImage = false;
  this->Stoppable = false;
  std::string error = this->Mean.Clear(this->Window, this->Size[0], this->Size[1]);
  for (int i = 0; i < count && error.empty(); ++i)
  {
    this->Filled = { 0, this->Size[0], 0, this->Size[1] };
    error = makeImage(i, *this);
    if (error.empty())
    {
      error =
        this->Mean.Add(this->Window, this->Image, this->Filled, static_cast<float>(1.0 / count));
    }
  }
  if (error.empty())
  {
    this->Image = this->Mean.Take();
    this->Filled = { 0, this->Size[0], 0, this->Size[1] };
  }
  return error;
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
  this->Image = MakeFloatImage(this->Window, width, height);
  if (!this->Image)
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
/** Limits drawing to the part of the viewport in which the image is not empty. */
void RayCastPresenter::LimitToFilled(const int viewport[4])
{
  const RayCastImageBox drawn = Grown(this->Filled, 1, this->Size);
  glm::ivec2 x = Shown(drawn.Left, drawn.Right, viewport[0], viewport[2], this->Size[0]);
  glm::ivec2 y = Shown(drawn.Bottom, drawn.Top, viewport[1], viewport[3], this->Size[1]);
  vtkOpenGLState* state = this->Window->GetState();
  if (state->GetEnumState(GL_SCISSOR_TEST))
  {
    int set[4];
    state->vtkglGetIntegerv(GL_SCISSOR_BOX, set);
    x = { std::max(x[0], set[0]), std::min(x[1], set[0] + set[2]) };
    y = { std::max(y[0], set[1]), std::min(y[1], set[1] + set[3]) };
  }
  state->vtkglEnable(GL_SCISSOR_TEST);
  state->vtkglScissor(x[0], y[0], std::max(x[1] - x[0], 0), std::max(y[1] - y[0], 0));
}

//------------------------------------------------------------------------------
std::string RayCastPresenter::Blend(const RayCastOutput& output, const int viewport[4])
{
  if (IsEmpty(this->Filled))
  {
    return std::string();
  }
  vtkOpenGLState* state = this->Window->GetState();
  state->vtkglViewport(viewport[0], viewport[1], viewport[2], viewport[3]);
  this->LimitToFilled(viewport);
  const bool biased = output.ColorBias > 0.0f;
  const bool whole = this->Size[0] == viewport[2] && this->Size[1] == viewport[3];
  const bool sampled = this->BlendsSamples(output, viewport) && this->MayHaveSteps();
  std::unique_ptr<vtkOpenGLQuadHelper>& composer =
    biased ? this->BiasedComposer : (sampled ? this->SampleComposer : this->Composer);
  const std::string error = output.Selecting
    ? ReadyQuad(this->Window, this->Selector, []() { return vtkTetrahedraSelectFS; })
    : ReadyQuad(
        this->Window, composer, [biased, sampled]() { return ComposeSource(biased, sampled); });
  if (!error.empty())
  {
    return error;
  }
  vtkOpenGLQuadHelper* drawer = (output.Selecting ? this->Selector : composer).get();
  // Devices that blend into 8 bits round more than once: Mesa's rasterisers do, and an NVIDIA H200
  // is up to 1.26 steps off. A picture that is composited later is rounded by the shader, which has
  // to know all of the sum.
  const bool hasUnder = !output.Selecting && this->Under.Update(this->Window, viewport);
  SetBlending(*state, *drawer->Program, output, viewport, hasUnder);
  // With one filter for both, a software rasteriser need not compute the size of a texel.
  const int filter = whole ? vtkTextureObject::Nearest : vtkTextureObject::Linear;
  this->Image->SetMagnificationFilter(filter);
  this->Image->SetMinificationFilter(filter);
  this->Image->Activate();
  drawer->Program->SetUniformi("image", this->Image->GetTextureUnit());
  // A sampler wants a texture even where it is not read.
  vtkTextureObject* under = hasUnder ? this->Under.GetTexture() : this->Image.Get();
  under->Activate();
  if (!output.Selecting)
  {
    drawer->Program->SetUniformi("under", under->GetTextureUnit());
  }
  if (sampled)
  {
    this->DrawSamples(*drawer);
  }
  else
  {
    drawer->Render();
  }
  under->Deactivate();
  this->Image->Deactivate();
  return std::string();
}

//------------------------------------------------------------------------------
/** True if the samples of a pixel at a step of depths get the colours of their sides of it. */
bool RayCastPresenter::BlendsSamples(const RayCastOutput& output, const int viewport[4]) const
{
  return this->Size[0] == viewport[2] && this->Size[1] == viewport[3] &&
    !(output.ColorBias > 0.0f) && !output.Selecting;
}

//------------------------------------------------------------------------------
/** False if all samples of each pixel are known to be on the same side of every step of depths. */
bool RayCastPresenter::MayHaveSteps() const
{
  const std::vector<float>& depths = this->DepthsOfImage;
  return this->Depth.HasSamples() &&
    (!this->HasDepthsOfImage ||
      std::any_of(
        depths.begin(), depths.end(), [&depths](float depth) { return depth != depths[0]; }));
}

//------------------------------------------------------------------------------
/** Blends over the samples of pixels by their depths, which the shader compares with. */
void RayCastPresenter::DrawSamples(vtkOpenGLQuadHelper& composer)
{
  vtkOpenGLState* state = this->Window->GetState();
  vtkOpenGLState::ScopedglDepthFunc depthFuncScope(state);
  state->vtkglEnable(GL_DEPTH_TEST);
  this->Depth.GetTexture()->Activate();
  composer.Program->SetUniformi("depths", this->Depth.GetTexture()->GetTextureUnit());
  for (const bool drawsFront : { true, false })
  {
    composer.Program->SetUniformi("drawsFront", drawsFront ? 1 : 0);
    state->vtkglDepthFunc(drawsFront ? GL_GREATER : GL_LEQUAL);
    composer.Render();
  }
  this->Depth.GetTexture()->Deactivate();
}

//------------------------------------------------------------------------------
std::string RayCastPresenter::WriteDepths(const std::vector<float>& depths, const int size[2])
{
  vtkOpenGLState* state = this->Window->GetState();
  vtkOpenGLState::ScopedglEnableDisable depthTestScope(state, GL_DEPTH_TEST);
  vtkOpenGLState::ScopedglEnableDisable blendScope(state, GL_BLEND);
  vtkOpenGLState::ScopedglEnableDisable cullScope(state, GL_CULL_FACE);
  vtkOpenGLState::ScopedglDepthMask depthMaskScope(state);
  vtkOpenGLState::ScopedglDepthFunc depthFuncScope(state);
  vtkOpenGLState::ScopedglColorMask colorMaskScope(state);
  vtkOpenGLState::ScopedglActiveTexture activeTextureScope(state);
  state->vtkglEnable(GL_DEPTH_TEST);
  state->vtkglDisable(GL_BLEND);
  state->vtkglDisable(GL_CULL_FACE);
  state->vtkglDepthMask(GL_TRUE);
  state->vtkglDepthFunc(GL_LESS);
  state->vtkglColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  const std::string error =
    ReadyQuad(this->Window, this->DepthWriter, []() { return vtkTetrahedraDepthFS; });
  if (!error.empty())
  {
    return error;
  }
  const auto texture = MakeTexelTexture(this->Window);
  // VTK does not change the data, although it does not say so.
  if (!texture->Create2DFromRaw(static_cast<unsigned int>(size[0]),
        static_cast<unsigned int>(size[1]), 1, VTK_FLOAT, const_cast<float*>(depths.data())))
  {
    return "no image of depths can be made on the graphics device";
  }
  texture->Activate();
  this->DepthWriter->Program->SetUniformi("depths", texture->GetTextureUnit());
  this->DepthWriter->Render();
  texture->Deactivate();
  texture->ReleaseGraphicsResources(this->Window);
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
  this->BiasedComposer.reset();
  this->SampleComposer.reset();
  this->Selector.reset();
  this->DepthWriter.reset();
  this->Image = nullptr;
  this->Mean.Release();
  this->Size[0] = this->Size[1] = 0;
  this->HasDepthsOfImage = false;
  this->Window = nullptr;
  if (owner)
  {
    owner->PopContext();
  }
}

}
