// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rendering/Backends/OpenGL/RayCastOpenGL.h"

#include "Rendering/Backends/OpenGL/RayCastShader.h"
#include "Volume/Rays/FixedPointRays.h"
#include "Volume/Rays/PlacedVertices.h"

#include "vtkTetrahedraComposeFS.h"
#include "vtkTetrahedraEntryTilesFS.h"
#include "vtkTetrahedraRayCastCS.h"
#include "vtkTetrahedraRayCastFS.h"
#include "vtkTetrahedraSelectFS.h"

#include "vtkOpenGLError.h"
#include "vtkOpenGLFramebufferObject.h"
#include "vtkOpenGLQuadHelper.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLShaderCache.h"
#include "vtkOpenGLState.h"
#include "vtkPixelBufferObject.h"
#include "vtkShaderProgram.h"
#include "vtkTextureObject.h"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <numeric>

namespace meniscus
{
namespace
{

/**
 * Number of texels, with four faces each, of a tile's list of entries; also in
 * vtkTetrahedraEntryTilesFS.
 */
constexpr unsigned int TileLayers = 8;
void Deactivate(const std::vector<OpenGLTable*>& tables)
{
  for (OpenGLTable* table : tables)
  {
    table->Deactivate();
  }
}

/**
 * Draws to the first `count` color attachments of the bound target. VTK 9.1 skips the OpenGL call
 * if another framebuffer drew to attachments of the same numbers before, which leaves this one with
 * its default, the first attachment alone (seen by the counters: no steps).
 */
void DrawToAttachments(vtkOpenGLFramebufferObject* target, unsigned int count)
{
  target->ActivateDrawBuffers(count);
  std::vector<GLenum> attachments(count);
  std::iota(attachments.begin(), attachments.end(), GLenum{ GL_COLOR_ATTACHMENT0 });
  glDrawBuffers(static_cast<GLsizei>(count), attachments.data());
}

}

//------------------------------------------------------------------------------
RayCastOpenGL::RayCastOpenGL() = default;

//------------------------------------------------------------------------------
RayCastOpenGL::~RayCastOpenGL()
{
  this->Release(nullptr);
}

//------------------------------------------------------------------------------
std::string RayCastOpenGL::SetWindow(vtkOpenGLRenderWindow* window)
{
  if (window != this->Window)
  {
    this->Release(nullptr);
    this->Window = window;
    this->Tables.SetWindow(window);
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
void RayCastOpenGL::GetViewport(int viewport[4]) const
{
  this->Window->GetState()->vtkglGetIntegerv(GL_VIEWPORT, viewport);
}

//------------------------------------------------------------------------------
template <typename Function>
std::string RayCastOpenGL::DrawImage(const RayCastOutput& output, Function&& makeImage)
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
    error = makeImage();
    state->PopFramebufferBindings();
  }
  return error.empty() ? this->Blend(output, viewport) : error;
}

//------------------------------------------------------------------------------
bool RayCastOpenGL::IsSoftware() const
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
std::string RayCastOpenGL::Draw(const RayCastFrame& frame)
{
  return this->DrawImage(frame.Output,
    [this, &frame]()
    {
      std::string error = this->Tables.PlaceVertices(
        FixedPointRays(frame.Rays, this->Size[0], this->Size[1]), frame.Optics.Refracting);
      if (error.empty() && frame.Refracting.Part != MembranePart::Behind && !frame.Optics.LongLists)
      {
        error = this->ListEntries(frame, false);
      }
      if (error.empty() && frame.Optics.Refracting)
      {
        error = this->ListRefractedEntries(frame);
      }
      if (!error.empty())
      {
        return error;
      }
      return frame.Compute ? this->DispatchRays(frame) : this->CastRays(frame);
    });
}

//------------------------------------------------------------------------------
std::string RayCastOpenGL::DrawImageOf(const ImageMaker& maker, const RayCastOutput& output)
{
  return this->DrawImage(output,
    [this, &maker]() -> std::string
    {
      const std::vector<float> depths = this->ReadDepths();
      std::vector<float> image;
      this->Statistics = maker(this->Size[0], this->Size[1], depths, image);
      this->StatisticsStale = false;
      const bool made =
        this->Image->Create2DFromRaw(this->Size[0], this->Size[1], 4, VTK_FLOAT, image.data());
      return made ? std::string() : "the image could not be sent to the graphics device";
    });
}

//------------------------------------------------------------------------------
std::vector<float> RayCastOpenGL::ReadDepths()
{
  const std::vector<float> all = this->Depth.Read(this->Window);
  const int width = static_cast<int>(this->Depth.GetTexture()->GetWidth());
  const int height = static_cast<int>(this->Depth.GetTexture()->GetHeight());
  if (width == this->Size[0] && height == this->Size[1])
  {
    return all;
  }
  std::vector<float> depths;
  depths.reserve(static_cast<std::size_t>(this->Size[0]) * this->Size[1]);
  for (int y = 0; y < this->Size[1]; ++y)
  {
    const std::size_t row = static_cast<std::size_t>((y + 0.5) * height / this->Size[1]) * width;
    for (int x = 0; x < this->Size[0]; ++x)
    {
      depths.push_back(all[row + static_cast<std::size_t>((x + 0.5) * width / this->Size[0])]);
    }
  }
  return depths;
}

//------------------------------------------------------------------------------
void RayCastOpenGL::Finish()
{
  glFinish();
}

//------------------------------------------------------------------------------
std::string RayCastOpenGL::Resize(int width, int height)
{
  if (width == this->Size[0] && height == this->Size[1])
  {
    return std::string();
  }
  this->Image = vtkSmartPointer<vtkTextureObject>::New();
  this->StatisticsImage = vtkSmartPointer<vtkTextureObject>::New();
  this->RefractedTiles = nullptr;
  for (const auto& texture : { this->Image, this->StatisticsImage })
  {
    texture->SetContext(this->Window);
    texture->SetMinificationFilter(vtkTextureObject::Nearest);
    texture->SetMagnificationFilter(vtkTextureObject::Nearest);
  }
  this->Tiles[0] = (width + TileSize - 1) / TileSize;
  this->Tiles[1] = (height + TileSize - 1) / TileSize;
  if (!this->Image->Allocate2D(width, height, 4, VTK_FLOAT) ||
    !this->StatisticsImage->Allocate2D(width, height, 2, VTK_FLOAT) ||
    !this->AllocateTiles(this->EntryTiles).empty())
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
template <typename Function>
std::string RayCastOpenGL::ReadyQuad(
  std::unique_ptr<vtkOpenGLQuadHelper>& quad, Function&& makeFragmentShader)
{
  if (!quad)
  {
    const std::string source = makeFragmentShader();
    quad = std::make_unique<vtkOpenGLQuadHelper>(this->Window, nullptr, source.c_str(), "");
  }
  else
  {
    this->Window->GetShaderCache()->ReadyShaderProgram(quad->Program);
  }
  const bool ready = quad->Program && quad->Program->GetCompiled();
  return ready ? std::string() : "a shader does not compile on this graphics device";
}

//------------------------------------------------------------------------------
std::string RayCastOpenGL::AllocateTiles(vtkSmartPointer<vtkTextureObject>& tiles)
{
  tiles = vtkSmartPointer<vtkTextureObject>::New();
  tiles->SetContext(this->Window);
  tiles->SetMinificationFilter(vtkTextureObject::Nearest);
  tiles->SetMagnificationFilter(vtkTextureObject::Nearest);
  return tiles->Allocate3D(this->Tiles[0], this->Tiles[1], TileLayers, 4, VTK_FLOAT)
    ? std::string()
    : "no lists of entries can be made on the graphics device";
}

//------------------------------------------------------------------------------
/**
 * Lists the entries of refracted rays, if these rays or the boundary by which they enter have
 * changed.
 */
std::string RayCastOpenGL::ListRefractedEntries(const RayCastFrame& frame)
{
  if (this->RefractedTiles && this->RefractedTilesVersion == frame.Refracting.Version)
  {
    return std::string();
  }
  std::string error =
    this->RefractedTiles ? std::string() : this->AllocateTiles(this->RefractedTiles);
  if (error.empty())
  {
    error = this->ListEntries(frame, true);
    ++this->RefractedEntryLists;
  }
  this->RefractedTilesVersion =
    error.empty() ? frame.Refracting.Version : std::array<std::int64_t, 2>{ 0, 0 };
  return error;
}

//------------------------------------------------------------------------------
/** @param refracted true: the entries of the refracted rays. */
std::string RayCastOpenGL::ListEntries(const RayCastFrame& frame, bool refracted)
{
  if (!this->TileTarget)
  {
    this->TileTarget = vtkSmartPointer<vtkOpenGLFramebufferObject>::New();
    this->TileTarget->SetContext(this->Window);
  }
  this->TileTarget->Bind();
  for (unsigned int layer = 0; layer < TileLayers; ++layer)
  {
    this->TileTarget->AddColorAttachment(
      layer, refracted ? this->RefractedTiles : this->EntryTiles, layer);
  }
  DrawToAttachments(this->TileTarget, TileLayers);
  this->Window->GetState()->vtkglViewport(0, 0, this->Tiles[0], this->Tiles[1]);

  const bool refracting = frame.Optics.Refracting;
  std::unique_ptr<vtkOpenGLQuadHelper>& lister = this->TileListers[refracting ? 1 + refracted : 0];
  const std::string error = this->ReadyQuad(lister,
    [refracting, refracted]()
    {
      RayCastOptics optics;
      optics.Refracting = refracting;
      std::string source = RayCastShaderSource(vtkTetrahedraEntryTilesFS, optics);
      vtkShaderProgram::Substitute(source, "//VTK::TetrahedraBehind::Dec",
        refracted ? "#define BEHIND 1" : "#define BEHIND 0");
      return source;
    });
  if (!error.empty())
  {
    return error;
  }
  vtkShaderProgram* program = lister->Program;
  const std::vector<OpenGLTable*> tables = this->ActivateRays(program, frame.Rays);
  const float tiles[2] = { static_cast<float>(this->Tiles[0]), static_cast<float>(this->Tiles[1]) };
  program->SetUniform2f("tileCount", tiles);
  if (refracting)
  {
    this->Tables.ActivateRefractedRays(program);
  }
  lister->Render();
  if (refracting)
  {
    this->Tables.GetRefractedRays().Deactivate();
  }
  Deactivate(tables);
  return std::string();
}

//------------------------------------------------------------------------------
std::string RayCastOpenGL::CastRays(const RayCastFrame& frame)
{
  if (!this->ImageTarget)
  {
    this->ImageTarget = vtkSmartPointer<vtkOpenGLFramebufferObject>::New();
    this->ImageTarget->SetContext(this->Window);
  }
  this->ImageTarget->Bind();
  this->ImageTarget->AddColorAttachment(0, this->Image);
  this->ImageTarget->AddColorAttachment(1, this->StatisticsImage);
  DrawToAttachments(this->ImageTarget, 2);
  this->Window->GetState()->vtkglViewport(0, 0, this->Size[0], this->Size[1]);

  std::unique_ptr<vtkOpenGLQuadHelper>& caster =
    this->RayCasters[RayCastShaderOptions(frame.Optics)];
  const std::string error = this->ReadyQuad(
    caster, [&frame]() { return RayCastShaderSource(vtkTetrahedraRayCastFS, frame.Optics); });
  if (!error.empty())
  {
    return error;
  }
  this->RunCaster(caster->Program, frame, [&caster]() { caster->Render(); });
  return std::string();
}

//------------------------------------------------------------------------------
std::string RayCastOpenGL::DispatchRays(const RayCastFrame& frame)
{
  constexpr int groupSize = 8; // as in the shader
  vtkSmartPointer<OpenGLComputeProgram>& caster =
    this->ComputeCasters[RayCastShaderOptions(frame.Optics)];
  if (!caster)
  {
    const auto program = vtkSmartPointer<OpenGLComputeProgram>::New();
    if (!program->Build(RayCastShaderSource(vtkTetrahedraRayCastCS, frame.Optics)))
    {
      return "a compute shader does not compile on this graphics device";
    }
    caster = program;
  }
  caster->Use(this->Window);
  glBindImageTexture(0, this->Image->GetHandle(), 0, GL_FALSE, 0, GL_WRITE_ONLY, GL_RGBA32F);
  glBindImageTexture(
    1, this->StatisticsImage->GetHandle(), 0, GL_FALSE, 0, GL_WRITE_ONLY, GL_RG32F);
  this->RunCaster(caster, frame,
    [this, &caster]()
    {
      caster->Dispatch(
        (this->Size[0] + groupSize - 1) / groupSize, (this->Size[1] + groupSize - 1) / groupSize);
    });
  return std::string();
}

//------------------------------------------------------------------------------
template <typename Function>
void RayCastOpenGL::RunCaster(vtkShaderProgram* program, const RayCastFrame& frame, Function&& run)
{
  const std::vector<OpenGLTable*> rayTables = this->ActivateRays(program, frame.Rays);
  const std::vector<OpenGLTable*> tables = this->Tables.Activate(program, frame.Optics);
  if (!frame.Optics.LongLists)
  {
    this->EntryTiles->Activate();
    program->SetUniformi("entryTiles", this->EntryTiles->GetTextureUnit());
  }
  this->Depth.GetTexture()->Activate();
  program->SetUniformi("opaqueDepth", this->Depth.GetTexture()->GetTextureUnit());
  this->SetCastUniforms(program, frame);
  SetOpticsUniforms(program, frame.Optics);
  if (frame.Optics.PreIntegrated)
  {
    this->Tables.GetPreIntegration().Activate(program);
  }
  if (frame.Optics.Refracting)
  {
    this->Tables.ActivateRefractedRays(program);
    this->RefractedTiles->Activate();
    program->SetUniformi("refractedTiles", this->RefractedTiles->GetTextureUnit());
    program->SetUniformi("beginsInside", frame.Refracting.BeginsInside ? 1 : 0);
    program->SetUniformi("membranePart", static_cast<int>(frame.Refracting.Part));
  }
  run();
  if (frame.Optics.Refracting)
  {
    this->RefractedTiles->Deactivate();
    this->Tables.GetRefractedRays().Deactivate();
  }
  if (frame.Optics.PreIntegrated)
  {
    this->Tables.GetPreIntegration().Deactivate();
  }
  this->Depth.GetTexture()->Deactivate();
  if (!frame.Optics.LongLists)
  {
    this->EntryTiles->Deactivate();
  }
  Deactivate(tables);
  Deactivate(rayTables);
  this->StatisticsStale = true;
}

//------------------------------------------------------------------------------
std::vector<OpenGLTable*> RayCastOpenGL::ActivateRays(
  vtkShaderProgram* program, const RayFrame& rays)
{
  const auto set2 = [program](const char* name, const glm::dvec2& value)
  { program->SetUniform2f(name, glm::value_ptr(glm::vec2(value))); };
  const auto set3 = [program](const char* name, const glm::dvec3& value)
  { program->SetUniform3f(name, glm::value_ptr(glm::vec3(value))); };

  program->SetUniformf("tileSize", static_cast<float>(TileSize));
  program->SetUniformf("longListTileSize", static_cast<float>(LongListTileSize));
  set2("imageCenter", 0.5 * glm::dvec2(this->Size[0], this->Size[1]));
  set3("rowX", rays.RowX);
  set3("rowY", rays.RowY);
  set3("rowDepth", rays.RowDepth);
  set2("originBase", rays.Origin.Base);
  set2("originPerColumn", rays.Origin.PerColumn);
  set2("originPerRow", rays.Origin.PerRow);
  set2("slopeBase", rays.Slope.Base);
  set2("slopePerColumn", rays.Slope.PerColumn);
  set2("slopePerRow", rays.Slope.PerRow);
  const FixedPointRays grid(rays, this->Size[0], this->Size[1]);
  const FixedPointRays::FixedPointMap offset = grid.GetFixedPointOffset();
  const FixedPointRays::FixedPointMap slope = grid.GetFixedPointSlope();
  program->SetUniformf("gridPerUnit", static_cast<float>(1.0 / grid.GetGridUnit()));
  program->SetUniform1iv("gridOffset", static_cast<int>(offset.size()), offset.data());
  program->SetUniform1iv("gridSlope", static_cast<int>(slope.size()), slope.data());
  program->SetUniformi("enteringSign", rays.Handedness);
  return this->Tables.ActivateRays(program);
}

//------------------------------------------------------------------------------
void RayCastOpenGL::SetCastUniforms(vtkShaderProgram* program, const RayCastFrame& frame)
{
  const RayFrame& rays = frame.Rays;
  this->Tables.SetUniforms(program, frame.Optics);
  // The matrix without its unit, whose square may exceed single precision.
  const glm::dmat3& toWorld = rays.ViewToWorld;
  const double unit =
    std::max({ glm::length(toWorld[0]), glm::length(toWorld[1]), glm::length(toWorld[2]) });
  glm::mat3 viewToWorld(toWorld / unit);
  program->SetUniformf("viewToWorldUnit", static_cast<float>(unit));
  program->SetUniformMatrix3x3("viewToWorld", glm::value_ptr(viewToWorld));
  program->SetUniformf("nearDepth", static_cast<float>(rays.NearDepth));
  program->SetUniform2f("depthNumerator", glm::value_ptr(glm::vec2(rays.DepthNumerator)));
  program->SetUniform2f("depthDenominator", glm::value_ptr(glm::vec2(rays.DepthDenominator)));
  program->SetUniformf(
    "terminationTransmittance", static_cast<float>(frame.TerminationTransmittance()));
}

//------------------------------------------------------------------------------
std::string RayCastOpenGL::Blend(const RayCastOutput& output, const int viewport[4])
{
  vtkOpenGLState* state = this->Window->GetState();
  state->vtkglViewport(viewport[0], viewport[1], viewport[2], viewport[3]);
  std::unique_ptr<vtkOpenGLQuadHelper>& drawer = output.Selecting ? this->Selector : this->Composer;
  const std::string error = this->ReadyQuad(drawer,
    [&output]()
    { return std::string(output.Selecting ? vtkTetrahedraSelectFS : vtkTetrahedraComposeFS); });
  if (!error.empty())
  {
    return error;
  }
  // Software rasterisers blend 8-bit values in 8 bits, which rounds three times. An image that is
  // composited later is rounded by the shader, which needs the complete sum.
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
  // A sampler needs a texture even if it is not read.
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
RayStatistics RayCastOpenGL::GetStatistics()
{
  if (!this->StatisticsStale || !this->Window || !this->StatisticsImage)
  {
    return this->Statistics;
  }
  this->Window->PushContext();
  const bool read = this->ReadStatistics();
  this->Window->PopContext();
  this->StatisticsStale = !read;
  return this->Statistics;
}

//------------------------------------------------------------------------------
bool RayCastOpenGL::ReadStatistics()
{
  // In VTK 9.6 a window that releases its context frees textures before it notifies the mappers.
  if (this->StatisticsImage->GetHandle() == 0)
  {
    return false;
  }
  unsigned int size[2] = { this->StatisticsImage->GetWidth(), this->StatisticsImage->GetHeight() };
  vtkIdType increments[2] = { 0, 0 };
  std::vector<float> values(std::size_t{ 2 } * size[0] * size[1]);
  vtkSmartPointer<vtkPixelBufferObject> pixels;
  pixels.TakeReference(this->StatisticsImage->Download());
  if (!pixels || !pixels->Download2D(VTK_FLOAT, values.data(), size, 2, increments))
  {
    return false;
  }
  this->Statistics = RayStatistics();
  for (std::size_t i = 0; i < values.size(); i += 2)
  {
    this->Statistics.Steps += static_cast<std::int64_t>(values[i]);
    this->Statistics.Rays += values[i] > 0.0f ? 1 : 0;
    this->Statistics.Lost += static_cast<std::int64_t>(values[i + 1]);
  }
  return true;
}

//------------------------------------------------------------------------------
void RayCastOpenGL::ClearStatistics()
{
  this->Statistics = RayStatistics();
  this->StatisticsStale = false;
}

//------------------------------------------------------------------------------
void RayCastOpenGL::Release(vtkWindow* window)
{
  vtkOpenGLRenderWindow* owner =
    window ? vtkOpenGLRenderWindow::SafeDownCast(window) : this->Window.Get();
  if (owner)
  {
    owner->PushContext();
  }
  this->GetStatistics();
  this->Tables.Release(owner);
  this->Depth.Release(owner);
  this->Under.Release(owner);
  for (std::unique_ptr<vtkOpenGLQuadHelper>& lister : this->TileListers)
  {
    lister.reset();
  }
  this->RayCasters.clear();
  for (auto& caster : this->ComputeCasters)
  {
    if (caster.second && owner)
    {
      caster.second->Free();
    }
  }
  this->ComputeCasters.clear();
  this->Composer.reset();
  this->Selector.reset();
  this->TileTarget = nullptr;
  this->ImageTarget = nullptr;
  this->EntryTiles = nullptr;
  this->RefractedTiles = nullptr;
  this->Image = nullptr;
  this->StatisticsImage = nullptr;
  this->Size[0] = this->Size[1] = 0;
  this->StatisticsStale = false;
  this->Window = nullptr;
  if (owner)
  {
    owner->PopContext();
  }
}

}
