// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTetrahedraRayCastOpenGL.h"

#include "vtkTetrahedraComposeFS.h"
#include "vtkTetrahedraRayCastFS.h"

#include "vtkOpenGLBufferObject.h"
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
#include <array>

namespace meniscus
{

//------------------------------------------------------------------------------
class OpenGLTable
{
public:
  ~OpenGLTable() { this->Release(); }

  bool IsFilled() const { return this->Filled; }
  std::int64_t GetNumberOfTuples() const { return this->Tuples; }
  std::int64_t GetBytes() const { return this->Bytes; }

  /** Replaces the contents by rows of `components` values; returns an error or nothing. */
  template <typename T>
  std::string Upload(
    vtkOpenGLRenderWindow* window, const std::vector<T>& values, int components, int vtkType)
  {
    this->Release();
    const std::int64_t tuples = static_cast<std::int64_t>(values.size()) / components;
    GLint limit = 0;
    glGetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &limit);
    if (tuples > limit)
    {
      return "a table of " + std::to_string(tuples) +
        " texels exceeds this graphics device's GL_MAX_TEXTURE_BUFFER_SIZE of " +
        std::to_string(limit);
    }
    this->Buffer->SetType(vtkOpenGLBufferObject::TextureBuffer);
    this->Texture->SetContext(window);
    if (vtkType == VTK_INT)
    {
      // VTK 9.1 has no default format for a texture buffer of integers.
      this->Texture->SetInternalFormat(components == 1 ? GL_R32I : GL_RGBA32I);
      this->Texture->SetFormat(components == 1 ? GL_RED_INTEGER : GL_RGBA_INTEGER);
      this->Texture->SetDataType(GL_INT);
    }
    if (!this->Buffer->Upload(values, vtkOpenGLBufferObject::TextureBuffer) ||
      !this->Texture->CreateTextureBuffer(
        static_cast<unsigned int>(tuples), components, vtkType, this->Buffer))
    {
      return "a table of " + std::to_string(values.size() * sizeof(T)) +
        " bytes could not be created on the graphics device";
    }
    this->Filled = true;
    this->Tuples = tuples;
    this->Bytes = static_cast<std::int64_t>(values.size() * sizeof(T));
    return std::string();
  }

  void Activate(vtkShaderProgram* program, const char* name)
  {
    this->Texture->Activate();
    program->SetUniformi(name, this->Texture->GetTextureUnit());
  }
  void Deactivate() { this->Texture->Deactivate(); }

  void Release()
  {
    if (this->Filled)
    {
      this->Texture->ReleaseGraphicsResources(this->Texture->GetContext());
      this->Buffer->ReleaseGraphicsResources();
    }
    this->Filled = false;
    this->Tuples = 0;
    this->Bytes = 0;
  }

private:
  vtkNew<vtkOpenGLBufferObject> Buffer;
  vtkNew<vtkTextureObject> Texture;
  bool Filled = false;
  std::int64_t Tuples = 0;
  std::int64_t Bytes = 0;
};

//------------------------------------------------------------------------------
/** The depth buffer of the framebuffer being drawn to, as a texture of the viewport's size. */
class RayCastOpenGL::DepthCopy
{
public:
  vtkTextureObject* GetTexture() { return this->Texture; }

  /** Copies the viewport; multisampled depth is resolved. Without a depth buffer all is far. */
  std::string Update(vtkOpenGLRenderWindow* window, const int viewport[4])
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
    if (format.DepthBits == 0 || samples > 1)
    {
      this->Target->SetContext(window);
      this->Target->Bind(GL_DRAW_FRAMEBUFFER);
      this->Target->AddDepthAttachment(this->Texture);
      if (format.DepthBits == 0)
      {
        vtkOpenGLState::ScopedglDepthMask depthMask(state);
        state->vtkglDepthMask(GL_TRUE);
        state->vtkglClearDepth(1.0);
        state->vtkglClear(GL_DEPTH_BUFFER_BIT);
      }
      else
      {
        const int right = viewport[0] + viewport[2];
        const int top = viewport[1] + viewport[3];
        vtkOpenGLState::ScopedglEnableDisable scissor(state, GL_SCISSOR_TEST);
        state->vtkglDisable(GL_SCISSOR_TEST);
        state->vtkglBlitFramebuffer(viewport[0], viewport[1], right, top, 0, 0, viewport[2],
          viewport[3], GL_DEPTH_BUFFER_BIT, GL_NEAREST);
      }
    }
    else
    {
      this->Texture->CopyFromFrameBuffer(viewport[0], viewport[1], 0, 0, viewport[2], viewport[3]);
    }
    state->PopFramebufferBindings();
    return std::string();
  }

  void Release(vtkWindow* window)
  {
    this->Texture->ReleaseGraphicsResources(window);
    this->Target->ReleaseGraphicsResources(window);
    this->Allocated = Format();
    this->Width = 0;
    this->Height = 0;
  }

private:
  struct Format
  {
    GLint DepthBits = 0;
    GLint StencilBits = 0;
    GLint ComponentType = GL_UNSIGNED_NORMALIZED;

    bool operator==(const Format& other) const
    {
      return this->DepthBits == other.DepthBits && this->StencilBits == other.StencilBits &&
        this->ComponentType == other.ComponentType;
    }
  };

  /** Format of the read framebuffer's depth attachment; 0 bits if there is none. */
  static Format ReadFormat(GLint framebuffer)
  {
    Format format;
    const GLenum depth = framebuffer == 0 ? GL_DEPTH : GL_DEPTH_ATTACHMENT;
    const GLenum stencil = framebuffer == 0 ? GL_STENCIL : GL_STENCIL_ATTACHMENT;
    GLint type = GL_NONE;
    const auto get = [](GLenum attachment, GLenum name, GLint* value)
    { glGetFramebufferAttachmentParameteriv(GL_READ_FRAMEBUFFER, attachment, name, value); };
    get(depth, GL_FRAMEBUFFER_ATTACHMENT_OBJECT_TYPE, &type);
    if (type == GL_NONE)
    {
      return format;
    }
    get(depth, GL_FRAMEBUFFER_ATTACHMENT_DEPTH_SIZE, &format.DepthBits);
    get(depth, GL_FRAMEBUFFER_ATTACHMENT_COMPONENT_TYPE, &format.ComponentType);
    get(stencil, GL_FRAMEBUFFER_ATTACHMENT_OBJECT_TYPE, &type);
    if (type != GL_NONE)
    {
      get(stencil, GL_FRAMEBUFFER_ATTACHMENT_STENCIL_SIZE, &format.StencilBits);
    }
    return format;
  }

  /** A texture of the same depth format: a multisampled blit demands it. */
  void Allocate(vtkOpenGLRenderWindow* window, const Format& format, int width, int height)
  {
    if (this->Width == width && this->Height == height && this->Allocated == format)
    {
      return;
    }
    this->Release(window);
    this->Texture->SetContext(window);
    this->Texture->SetMinificationFilter(vtkTextureObject::Nearest);
    this->Texture->SetMagnificationFilter(vtkTextureObject::Nearest);
    if (format.StencilBits > 0)
    {
      this->Texture->AllocateDepthStencil(width, height);
    }
    else
    {
      const int depthFormat = format.ComponentType == GL_FLOAT
        ? vtkTextureObject::Float32
        : (format.DepthBits == 16
              ? vtkTextureObject::Fixed16
              : (format.DepthBits == 32 ? vtkTextureObject::Fixed32 : vtkTextureObject::Fixed24));
      this->Texture->AllocateDepth(width, height, depthFormat);
    }
    this->Allocated = format;
    this->Width = width;
    this->Height = height;
  }

  vtkNew<vtkTextureObject> Texture;
  vtkNew<vtkOpenGLFramebufferObject> Target;
  Format Allocated;
  int Width = 0;
  int Height = 0;
};

//------------------------------------------------------------------------------
RayCastOpenGL::RayCastOpenGL()
  : Vertices(new OpenGLTable)
  , Cells(new OpenGLTable)
  , TreeNodes(new OpenGLTable)
  , TreeFaces(new OpenGLTable)
  , Intervals(new OpenGLTable)
  , Depth(new DepthCopy)
{
}

//------------------------------------------------------------------------------
RayCastOpenGL::~RayCastOpenGL() = default;

//------------------------------------------------------------------------------
std::string RayCastOpenGL::SetWindow(vtkOpenGLRenderWindow* window)
{
  if (window != this->Window)
  {
    this->Release();
    this->Window = window;
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
bool RayCastOpenGL::HasMesh() const
{
  return this->Cells->IsFilled() && this->TreeNodes->IsFilled() && this->TreeFaces->IsFilled();
}

//------------------------------------------------------------------------------
bool RayCastOpenGL::HasVertices() const
{
  return this->Vertices->IsFilled();
}

//------------------------------------------------------------------------------
bool RayCastOpenGL::HasIntervals() const
{
  return this->Intervals->IsFilled();
}

//------------------------------------------------------------------------------
std::string RayCastOpenGL::Count(OpenGLTable& table, const std::string& error)
{
  this->UploadedBytes += table.GetBytes();
  return error;
}

//------------------------------------------------------------------------------
std::string RayCastOpenGL::UploadMesh(const TetrahedralMesh& mesh, const BoundaryTree& tree)
{
  // A node's indices travel as floats, which are whole up to 2^24.
  const std::int64_t largestIndex =
    static_cast<std::int64_t>(std::max(tree.GetNodes().size(), tree.GetFaces().size()));
  if (largestIndex > (std::int64_t{ 1 } << 24))
  {
    return "a mesh with " + std::to_string(tree.GetFaces().size()) +
      " boundary faces exceeds the limit of 16777216";
  }
  const auto* cellValues = reinterpret_cast<const std::int32_t*>(mesh.GetCells().data());
  const std::vector<std::int32_t> cells(cellValues, cellValues + 8 * mesh.GetNumberOfCells());
  std::string error = this->Cells->Upload(this->Window, cells, 1, VTK_INT);
  if (!this->Count(*this->Cells, error).empty())
  {
    return error;
  }

  std::vector<float> nodes;
  nodes.reserve(8 * tree.GetNodes().size());
  for (const auto& node : tree.GetNodes())
  {
    nodes.insert(nodes.end(),
      { node.Center.x, node.Center.y, node.Center.z, static_cast<float>(node.Skip), node.Half.x,
        node.Half.y, node.Half.z, static_cast<float>(node.FirstFace) });
  }
  error = this->TreeNodes->Upload(this->Window, nodes, 4, VTK_FLOAT);
  if (!this->Count(*this->TreeNodes, error).empty())
  {
    return error;
  }

  std::vector<std::int32_t> faces;
  faces.reserve(4 * tree.GetFaces().size());
  for (const auto& face : tree.GetFaces())
  {
    const auto& v = face.Vertices;
    faces.insert(faces.end(), { face.Outward > 0 ? v[0] : ~v[0], v[1], v[2], face.CellFace });
  }
  error = this->TreeFaces->Upload(this->Window, faces, 4, VTK_INT);
  return this->Count(*this->TreeFaces, error);
}

//------------------------------------------------------------------------------
std::string RayCastOpenGL::UploadVertices(
  const TetrahedralMesh& mesh, const std::vector<float>& scalars)
{
  std::vector<float> values;
  values.reserve(4 * scalars.size());
  for (std::size_t v = 0; v < scalars.size(); ++v)
  {
    const glm::vec3& p = mesh.GetPositions()[v];
    values.insert(values.end(), { p.x, p.y, p.z, scalars[v] });
  }
  const std::string error = this->Vertices->Upload(this->Window, values, 4, VTK_FLOAT);
  return this->Count(*this->Vertices, error);
}

//------------------------------------------------------------------------------
std::string RayCastOpenGL::UploadIntervals(const std::vector<TransferFunctionInterval>& intervals)
{
  std::vector<float> values;
  values.reserve(12 * intervals.size());
  for (const auto& i : intervals)
  {
    values.insert(values.end(),
      { i.Lower, i.Upper, i.Attenuation, i.AttenuationSlope, i.Color.r, i.Color.g, i.Color.b, 0.0f,
        i.ColorSlope.r, i.ColorSlope.g, i.ColorSlope.b, 0.0f });
  }
  const std::string error = this->Intervals->Upload(this->Window, values, 4, VTK_FLOAT);
  return this->Count(*this->Intervals, error);
}

//------------------------------------------------------------------------------
void RayCastOpenGL::GetViewport(int viewport[4]) const
{
  this->Window->GetState()->vtkglGetIntegerv(GL_VIEWPORT, viewport);
}

//------------------------------------------------------------------------------
std::string RayCastOpenGL::Draw(const RayCastFrame& frame)
{
  vtkOpenGLState* state = this->Window->GetState();
  vtkOpenGLState::ScopedglViewport viewportScope(state);
  vtkOpenGLState::ScopedglScissor scissorScope(state);
  vtkOpenGLState::ScopedglEnableDisable scissorTestScope(state, GL_SCISSOR_TEST);
  vtkOpenGLState::ScopedglEnableDisable depthTestScope(state, GL_DEPTH_TEST);
  vtkOpenGLState::ScopedglEnableDisable blendScope(state, GL_BLEND);
  vtkOpenGLState::ScopedglEnableDisable cullScope(state, GL_CULL_FACE);
  vtkOpenGLState::ScopedglDepthMask depthMaskScope(state);
  vtkOpenGLState::ScopedglBlendFuncSeparate blendFuncScope(state);
  vtkOpenGLState::ScopedglActiveTexture activeTextureScope(state);

  int viewport[4];
  this->GetViewport(viewport);
  std::string error = this->Depth->Update(this->Window, viewport);
  if (error.empty())
  {
    error = this->Resize(viewport[2], viewport[3]);
  }
  if (!error.empty())
  {
    return error;
  }
  state->vtkglDisable(GL_DEPTH_TEST);
  state->vtkglDisable(GL_CULL_FACE);
  state->vtkglDepthMask(GL_FALSE);

  state->PushFramebufferBindings();
  error = this->CastRays(frame, viewport[2], viewport[3]);
  state->PopFramebufferBindings();
  return error.empty() ? this->Blend(viewport) : error;
}

//------------------------------------------------------------------------------
std::string RayCastOpenGL::Resize(int width, int height)
{
  const unsigned int w = static_cast<unsigned int>(width);
  const unsigned int h = static_cast<unsigned int>(height);
  if (this->Image && this->Image->GetWidth() == w && this->Image->GetHeight() == h)
  {
    return std::string();
  }
  const auto allocate = [&](int components)
  {
    auto texture = vtkSmartPointer<vtkTextureObject>::New();
    texture->SetContext(this->Window);
    texture->SetMinificationFilter(vtkTextureObject::Nearest);
    texture->SetMagnificationFilter(vtkTextureObject::Nearest);
    return texture->Allocate2D(w, h, components, VTK_FLOAT) ? texture : nullptr;
  };
  this->Image = allocate(4);
  this->StatisticsImage = allocate(2);
  if (!this->Image || !this->StatisticsImage)
  {
    return "no float image of " + std::to_string(width) + " x " + std::to_string(height) +
      " pixels can be made on the graphics device";
  }
  return std::string();
}

//------------------------------------------------------------------------------
std::string RayCastOpenGL::CastRays(const RayCastFrame& frame, int width, int height)
{
  vtkOpenGLState* state = this->Window->GetState();
  if (!this->Framebuffer)
  {
    this->Framebuffer = vtkSmartPointer<vtkOpenGLFramebufferObject>::New();
    this->Framebuffer->SetContext(this->Window);
  }
  this->Framebuffer->Bind();
  this->Framebuffer->AddColorAttachment(0, this->Image);
  this->Framebuffer->AddColorAttachment(1, this->StatisticsImage);
  this->Framebuffer->ActivateDrawBuffers(2);
  state->vtkglViewport(0, 0, width, height);
  state->vtkglDisable(GL_SCISSOR_TEST);
  state->vtkglDisable(GL_BLEND);

  if (!this->RayCaster)
  {
    this->RayCaster =
      std::make_unique<vtkOpenGLQuadHelper>(this->Window, nullptr, vtkTetrahedraRayCastFS, "");
  }
  else
  {
    this->Window->GetShaderCache()->ReadyShaderProgram(this->RayCaster->Program);
  }
  vtkShaderProgram* program = this->RayCaster->Program;
  if (!program || !program->GetCompiled())
  {
    return "the ray casting shader does not compile on this graphics device";
  }
  const std::array<std::pair<OpenGLTable*, const char*>, 5> tables = { {
    { this->Vertices.get(), "vertices" },
    { this->Cells.get(), "cells" },
    { this->TreeNodes.get(), "treeNodes" },
    { this->TreeFaces.get(), "treeFaces" },
    { this->Intervals.get(), "intervals" },
  } };
  for (const auto& table : tables)
  {
    table.first->Activate(program, table.second);
  }
  this->Depth->GetTexture()->Activate();
  program->SetUniformi("opaqueDepth", this->Depth->GetTexture()->GetTextureUnit());
  this->SetUniforms(program, frame, width, height);
  this->RayCaster->Render();
  this->Depth->GetTexture()->Deactivate();
  for (const auto& table : tables)
  {
    table.first->Deactivate();
  }
  this->StatisticsStale = true;
  return std::string();
}

//------------------------------------------------------------------------------
void RayCastOpenGL::SetUniforms(
  vtkShaderProgram* program, const RayCastFrame& frame, int width, int height)
{
  const RayFrame& rays = frame.Rays;
  const auto set2 = [program](const char* name, const glm::dvec2& value)
  { program->SetUniform2f(name, glm::value_ptr(glm::vec2(value))); };
  const auto set3 = [program](const char* name, const glm::dvec3& value)
  { program->SetUniform3f(name, glm::value_ptr(glm::vec3(value))); };

  program->SetUniformi("numberOfNodes", static_cast<int>(this->TreeNodes->GetNumberOfTuples() / 2));
  program->SetUniformi("numberOfCells", static_cast<int>(this->Cells->GetNumberOfTuples() / 8));
  program->SetUniformi(
    "numberOfIntervals", static_cast<int>(this->Intervals->GetNumberOfTuples() / 3));
  set2("imageCenter", 0.5 * glm::dvec2(width, height));
  set3("rowX", rays.RowX);
  set3("rowY", rays.RowY);
  set3("rowDepth", rays.RowDepth);
  set2("originBase", rays.Origin.Base);
  set2("originPerColumn", rays.Origin.PerColumn);
  set2("originPerRow", rays.Origin.PerRow);
  set2("slopeBase", rays.Slope.Base);
  set2("slopePerColumn", rays.Slope.PerColumn);
  set2("slopePerRow", rays.Slope.PerRow);
  glm::mat3 viewToWorld(rays.ViewToWorld);
  program->SetUniformMatrix3x3("viewToWorld", glm::value_ptr(viewToWorld));
  program->SetUniformi("enteringSign", rays.Handedness);
  program->SetUniformf("nearDepth", static_cast<float>(rays.NearDepth));
  set2("depthNumerator", rays.DepthNumerator);
  set2("depthDenominator", rays.DepthDenominator);
  program->SetUniformf(
    "terminationTransmittance", static_cast<float>(1.0 - frame.EarlyTerminationOpacity));
}

//------------------------------------------------------------------------------
std::string RayCastOpenGL::Blend(const int viewport[4])
{
  vtkOpenGLState* state = this->Window->GetState();
  state->vtkglViewport(viewport[0], viewport[1], viewport[2], viewport[3]);
  state->vtkglEnable(GL_BLEND);
  state->vtkglBlendFuncSeparate(GL_ONE, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  if (!this->Composer)
  {
    this->Composer =
      std::make_unique<vtkOpenGLQuadHelper>(this->Window, nullptr, vtkTetrahedraComposeFS, "");
  }
  else
  {
    this->Window->GetShaderCache()->ReadyShaderProgram(this->Composer->Program);
  }
  vtkShaderProgram* program = this->Composer->Program;
  if (!program || !program->GetCompiled())
  {
    return "the blending shader does not compile on this graphics device";
  }
  this->Image->Activate();
  program->SetUniformi("image", this->Image->GetTextureUnit());
  this->Composer->Render();
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
  this->Window->MakeCurrent();
  unsigned int size[2] = { this->StatisticsImage->GetWidth(), this->StatisticsImage->GetHeight() };
  vtkIdType increments[2] = { 0, 0 };
  std::vector<float> values(std::size_t{ 2 } * size[0] * size[1]);
  vtkSmartPointer<vtkPixelBufferObject> pixels;
  pixels.TakeReference(this->StatisticsImage->Download());
  if (!pixels || !pixels->Download2D(VTK_FLOAT, values.data(), size, 2, increments))
  {
    return this->Statistics;
  }
  this->Statistics = RayStatistics();
  for (std::size_t i = 0; i < values.size(); i += 2)
  {
    this->Statistics.Steps += static_cast<std::int64_t>(values[i]);
    this->Statistics.Rays += values[i] > 0.0f ? 1 : 0;
    this->Statistics.Lost += static_cast<std::int64_t>(values[i + 1]);
  }
  this->StatisticsStale = false;
  return this->Statistics;
}

//------------------------------------------------------------------------------
void RayCastOpenGL::Release()
{
  if (this->Window)
  {
    this->Window->MakeCurrent();
    this->GetStatistics();
  }
  for (OpenGLTable* table : { this->Vertices.get(), this->Cells.get(), this->TreeNodes.get(),
         this->TreeFaces.get(), this->Intervals.get() })
  {
    table->Release();
  }
  if (this->Window)
  {
    this->Depth->Release(this->Window);
  }
  this->RayCaster.reset();
  this->Composer.reset();
  this->Framebuffer = nullptr;
  this->Image = nullptr;
  this->StatisticsImage = nullptr;
  this->StatisticsStale = false;
  this->Window = nullptr;
}

}
