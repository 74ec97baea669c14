// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rendering/Backends/OpenGL/RayCastOpenGL.h"

#include "Rendering/Backends/OpenGL/RayCastShader.h"
#include "Rendering/Backends/RayCastFrame.h"
#include "Rendering/Backends/RayCastTables.h"
#include "Rendering/Present/OpenGLTools.h"
#include "Volume/Rays/FixedPointRays.h"
#include "Volume/Rays/PlacedVertices.h"

#include "vtkTetrahedraEntryTilesCS.h"
#include "vtkTetrahedraEntryTilesFS.h"
#include "vtkTetrahedraRayCastCS.h"
#include "vtkTetrahedraRayCastFS.h"

#include "vtkOpenGLError.h"
#include "vtkOpenGLFramebufferObject.h"
#include "vtkOpenGLQuadHelper.h"
#include "vtkOpenGLRenderWindow.h"
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
/** Pixels of a group of the compute shader, as there. */
constexpr int GroupSize[2] = { 8, 4 };

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
  this->ReleaseGraphicsResources(nullptr);
}

//------------------------------------------------------------------------------
/** Binds to a window; on a change of window all that was on the device is gone. */
void RayCastOpenGL::SetWindow(vtkOpenGLRenderWindow* window)
{
  if (window != this->Window)
  {
    this->ReleaseGraphicsResources(nullptr);
    this->Window = window;
    this->Tables.SetWindow(window);
    window->MakeCurrent();
  }
}

//------------------------------------------------------------------------------
std::string RayCastOpenGL::DescribeExcess(const RayCastRequest& request)
{
  const RayCastFrame& frame = request.Frame;
  const bool refracts = frame.Refracting.Wanted;
  const int interfaces = request.Tables.Membrane.GetNumberOfInterfaces();
  const TetrahedralMesh& mesh = request.Tables.Input.GetMesh();
  const std::string error = OpenGLTables::DescribeExcess(mesh,
    frame.Optics.CompactCells || OpenGLTables::NeedsCompactCells(mesh, frame.MaximumTableSize),
    refracts ? 1 + RefractionFrames::Number : 1, frame.MaximumTableSize);
  if (!error.empty() || !refracts)
  {
    return error;
  }
  GLint layers = 0;
  glGetIntegerv(GL_MAX_3D_TEXTURE_SIZE, &layers);
  if (std::int64_t{ interfaces } * TileLayers > layers)
  {
    return "the lists of entries behind " + std::to_string(interfaces) +
      " refracting interfaces exceed the graphics device's limit of " + std::to_string(layers) +
      " layers";
  }
  return OpenGLRefractedRays::DescribeExcess(
    frame.Output.ImageSize, 1 + interfaces, frame.MaximumTableSize);
}

//------------------------------------------------------------------------------
std::string RayCastOpenGL::Update(const RayCastRequest& request)
{
  this->SetWindow(request.GetWindow());
  RayCastTables& tables = request.Tables;
  this->Frame = request.Frame;
  this->Frame.Optics.NumberOfLegs =
    request.Frame.Refracting.Met ? 1 + tables.Membrane.GetNumberOfInterfaces() : 1;
  if (OpenGLTables::NeedsCompactCells(tables.Input.GetMesh(), this->Frame.MaximumTableSize))
  {
    this->Frame.Optics.CompactCells = true;
  }
  this->Frame.Optics.WideCells = OpenGLTables::NeedsWideCells(
    tables.Input.GetMesh(), this->Frame.Optics.CompactCells, this->Frame.MaximumTableSize);
  this->Frame.Optics.LongLists = !this->Frame.Optics.IsRefracting() &&
    this->LongLists.Update(tables.Input, this->Frame, this->Tables);
  const std::string error = this->Tables.Update(tables, this->Frame);
  if (error.empty() && this->Frame.Optics.IsRefracting())
  {
    this->BeginsInside = tables.Membrane.BeginsInside(tables.Input);
    this->RefractedVersions = { tables.Membrane.GetSightVersion(), tables.Input.GetLinkVersion(),
      tables.Input.GetMeshVersion() };
  }
  return error;
}

//------------------------------------------------------------------------------
std::string RayCastOpenGL::Cast(RayCastTarget& target, RayProgram program)
{
  this->Image = target.GetImageTexture();
  this->Depth = target.GetDepthTexture();
  const bool refracting = this->Frame.Optics.IsRefracting();
  const bool drawsSight = LegsOf(this->Frame.Refracting.Part).First == 0;
  std::string error = this->Resize(target.GetWidth(), target.GetHeight());
  if (error.empty())
  {
    error = this->Tables.PlaceVertices(
      FixedPointRays(this->Frame.Rays, this->Size[0], this->Size[1]), refracting);
  }
  if (error.empty() && drawsSight && !this->Frame.Optics.LongLists)
  {
    error = this->ListEntries(this->Frame, 0, program);
  }
  if (error.empty() && refracting)
  {
    error = this->ListRefractedEntries(this->Frame, program);
  }
  if (!error.empty())
  {
    return error;
  }
  this->CastPixels += std::int64_t{ this->Size[0] } * this->Size[1];
  return program == RayProgram::Compute ? this->DispatchRays(this->Frame)
                                        : this->CastRays(this->Frame);
}

//------------------------------------------------------------------------------
std::string RayCastOpenGL::Resize(int width, int height)
{
  if (width == this->Size[0] && height == this->Size[1])
  {
    return std::string();
  }
  this->StatisticsImage = MakeTexelTexture(this->Window);
  this->RefractedTiles = nullptr;
  this->Tiles[0] = (width + OpenGLEntryLists::TileSize - 1) / OpenGLEntryLists::TileSize;
  this->Tiles[1] = (height + OpenGLEntryLists::TileSize - 1) / OpenGLEntryLists::TileSize;
  if (!this->StatisticsImage->Allocate2D(width, height, 2, VTK_FLOAT) ||
    !this->AllocateTiles(this->EntryTiles, 1).empty())
  {
    this->Size[0] = this->Size[1] = 0;
    return "no statistics and lists for " + std::to_string(width) + " x " + std::to_string(height) +
      " pixels can be made on the graphics device";
  }
  this->Size[0] = width;
  this->Size[1] = height;
  return std::string();
}

//------------------------------------------------------------------------------
/** Makes a compute program the current one. */
template <typename Function>
std::string RayCastOpenGL::ReadyCompute(
  vtkSmartPointer<OpenGLComputeProgram>& compute, Function&& makeShader)
{
  if (!compute)
  {
    const auto program = vtkSmartPointer<OpenGLComputeProgram>::New();
    const std::string error = program->Build(makeShader());
    if (!error.empty())
    {
      return "a compute shader does not compile on this graphics device: " + error;
    }
    compute = program;
  }
  compute->Use(this->Window);
  return std::string();
}

//------------------------------------------------------------------------------
/** Makes room for a number of lists per tile. */
std::string RayCastOpenGL::AllocateTiles(vtkSmartPointer<vtkTextureObject>& tiles, int lists)
{
  tiles = MakeTexelTexture(this->Window);
  return tiles->Allocate3D(this->Tiles[0], this->Tiles[1], lists * TileLayers, 4, VTK_FLOAT)
    ? std::string()
    : "no lists of entries can be made on the graphics device";
}

//------------------------------------------------------------------------------
/**
 * Lists the entries of refracted rays, if these rays or the boundary by which they enter have
 * changed.
 */
std::string RayCastOpenGL::ListRefractedEntries(const RayCastFrame& frame, RayProgram program)
{
  const int legs = frame.Optics.NumberOfLegs;
  const bool hasRoom = this->RefractedTiles && this->RefractedTilesLegs == legs;
  if (hasRoom && this->RefractedTilesVersions == this->RefractedVersions)
  {
    return std::string();
  }
  std::string error = hasRoom ? std::string() : this->AllocateTiles(this->RefractedTiles, legs - 1);
  this->RefractedTilesLegs = legs;
  for (int leg = 1; leg < legs && error.empty(); ++leg)
  {
    error = this->ListEntries(frame, leg, program);
    ++this->RefractedEntryLists;
  }
  this->RefractedTilesVersions = error.empty() ? this->RefractedVersions : TableVersions();
  return error;
}

//------------------------------------------------------------------------------
/** Lists the entries of a leg of the rays. */
std::string RayCastOpenGL::ListEntries(const RayCastFrame& frame, int leg, RayProgram program)
{
  return program == RayProgram::Compute ? this->DispatchEntries(frame, leg)
                                        : this->DrawEntries(frame, leg);
}

//------------------------------------------------------------------------------
std::string RayCastOpenGL::DrawEntries(const RayCastFrame& frame, int leg)
{
  const bool refracted = leg > 0;
  if (!this->TileTarget)
  {
    this->TileTarget = vtkSmartPointer<vtkOpenGLFramebufferObject>::New();
    this->TileTarget->SetContext(this->Window);
  }
  this->TileTarget->Bind();
  // VTK 9.1 ignores a new layer of a texture that is attached already.
  this->TileTarget->RemoveColorAttachments(TileLayers);
  for (unsigned int layer = 0; layer < TileLayers; ++layer)
  {
    this->TileTarget->AddColorAttachment(layer, refracted ? this->RefractedTiles : this->EntryTiles,
      layer + (refracted ? (leg - 1) * TileLayers : 0));
  }
  DrawToAttachments(this->TileTarget, TileLayers);
  this->Window->GetState()->vtkglViewport(0, 0, this->Tiles[0], this->Tiles[1]);

  const int legs = frame.Optics.NumberOfLegs;
  std::unique_ptr<vtkOpenGLQuadHelper>& lister = this->TileListers[{ legs, refracted }];
  const std::string error = ReadyQuad(this->Window, lister,
    [legs, refracted]() { return EntryListerSource(vtkTetrahedraEntryTilesFS, legs, refracted); });
  if (!error.empty())
  {
    return error;
  }
  const float tiles[2] = { static_cast<float>(this->Tiles[0]), static_cast<float>(this->Tiles[1]) };
  lister->Program->SetUniform2f("tileCount", tiles);
  this->RunLister(lister->Program, frame, leg, [&lister]() { lister->Render(); });
  return std::string();
}

//------------------------------------------------------------------------------
std::string RayCastOpenGL::DispatchEntries(const RayCastFrame& frame, int leg)
{
  const bool refracted = leg > 0;
  const int legs = frame.Optics.NumberOfLegs;
  vtkSmartPointer<OpenGLComputeProgram>& lister = this->ComputeListers[{ legs, refracted }];
  const std::string error = this->ReadyCompute(lister,
    [legs, refracted]() { return EntryListerSource(vtkTetrahedraEntryTilesCS, legs, refracted); });
  if (!error.empty())
  {
    return error;
  }
  vtkTextureObject* tiles = refracted ? this->RefractedTiles : this->EntryTiles;
  glBindImageTexture(0, tiles->GetHandle(), 0, GL_TRUE, 0, GL_WRITE_ONLY, GL_RGBA32F);
  lister->SetUniformi("firstLayer", refracted ? (leg - 1) * static_cast<int>(TileLayers) : 0);
  this->RunLister(
    lister, frame, leg, [this, &lister]() { lister->Dispatch(this->Tiles[0], this->Tiles[1]); });
  return std::string();
}

//------------------------------------------------------------------------------
template <typename Function>
void RayCastOpenGL::RunLister(
  vtkShaderProgram* program, const RayCastFrame& frame, int leg, Function&& run)
{
  const std::vector<OpenGLTable*> tables = this->ActivateRays(program, frame.Rays);
  if (leg > 0)
  {
    program->SetUniformi("listedLeg", leg);
  }
  const bool refracting = frame.Optics.NumberOfLegs > 1;
  if (refracting)
  {
    this->Tables.ActivateRefractedRays(program);
  }
  run();
  if (refracting)
  {
    this->Tables.GetRefractedRays().Deactivate();
  }
  Deactivate(tables);
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
  const std::string error = ReadyQuad(this->Window, caster,
    [&frame]() { return RayCastShaderSource(vtkTetrahedraRayCastFS, frame.Optics); });
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
  vtkSmartPointer<OpenGLComputeProgram>& caster =
    this->ComputeCasters[RayCastShaderOptions(frame.Optics)];
  const std::string error = this->ReadyCompute(
    caster, [&frame]() { return RayCastShaderSource(vtkTetrahedraRayCastCS, frame.Optics); });
  if (!error.empty())
  {
    return error;
  }
  glBindImageTexture(0, this->Image->GetHandle(), 0, GL_FALSE, 0, GL_WRITE_ONLY, GL_RGBA32F);
  glBindImageTexture(
    1, this->StatisticsImage->GetHandle(), 0, GL_FALSE, 0, GL_WRITE_ONLY, GL_RG32F);
  this->RunCaster(caster, frame,
    [this, &caster]()
    {
      caster->Dispatch((this->Size[0] + GroupSize[0] - 1) / GroupSize[0],
        (this->Size[1] + GroupSize[1] - 1) / GroupSize[1]);
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
  this->Depth->Activate();
  program->SetUniformi("opaqueDepth", this->Depth->GetTextureUnit());
  this->SetCastUniforms(program, frame);
  SetOpticsUniforms(program, frame.Optics);
  if (frame.Optics.PreIntegrated)
  {
    this->Tables.GetPreIntegration().Activate(program);
  }
  if (frame.Optics.IsRefracting())
  {
    this->Tables.ActivateRefractedRays(program);
    this->RefractedTiles->Activate();
    program->SetUniformi("refractedTiles", this->RefractedTiles->GetTextureUnit());
    program->SetUniformi("beginsInside", this->BeginsInside ? 1 : 0);
    const LegRange drawn = LegsOf(frame.Refracting.Part);
    program->SetUniformi("firstLeg", drawn.First);
    program->SetUniformi("endLeg", drawn.End);
  }
  run();
  if (frame.Optics.IsRefracting())
  {
    this->RefractedTiles->Deactivate();
    this->Tables.GetRefractedRays().Deactivate();
  }
  if (frame.Optics.PreIntegrated)
  {
    this->Tables.GetPreIntegration().Deactivate();
  }
  this->Depth->Deactivate();
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

  program->SetUniformf("tileSize", static_cast<float>(OpenGLEntryLists::TileSize));
  program->SetUniformf("longListTileSize", static_cast<float>(OpenGLEntryLists::LongListTileSize));
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
  return this->Tables.ActivateRays(program, !this->Frame.Optics.LongLists);
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
  program->SetUniformf("farDepth", static_cast<float>(rays.FarDepth));
  program->SetUniform2f("depthNumerator", glm::value_ptr(glm::vec2(rays.DepthNumerator)));
  program->SetUniform2f("depthDenominator", glm::value_ptr(glm::vec2(rays.DepthDenominator)));
  program->SetUniformf(
    "terminationTransmittance", static_cast<float>(frame.TerminationTransmittance()));
}

//------------------------------------------------------------------------------
RayCastStatistics RayCastOpenGL::GetStatistics()
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
  this->Statistics = RayCastStatistics();
  for (std::size_t i = 0; i < values.size(); i += 2)
  {
    this->Statistics.Steps += static_cast<std::int64_t>(values[i]);
    this->Statistics.Rays += values[i] > 0.0f ? 1 : 0;
    this->Statistics.Lost += static_cast<std::int64_t>(values[i + 1]);
  }
  return true;
}

//------------------------------------------------------------------------------
RayCastCounters RayCastOpenGL::GetCounters()
{
  RayCastCounters counters;
  counters.UploadedBytes = this->Tables.GetUploadedBytes();
  counters.DeviceBytes = this->Tables.GetTableBytes();
  counters.HostBytes = this->LongLists.GetBytes();
  counters.EntryListBuilds = this->LongLists.GetBuilds();
  counters.RefractedEntryLists = this->RefractedEntryLists;
  counters.CastPixels = this->CastPixels;
  return counters;
}

//------------------------------------------------------------------------------
void RayCastOpenGL::ReleaseGraphicsResources(vtkWindow* window)
{
  vtkOpenGLRenderWindow* owner =
    window ? vtkOpenGLRenderWindow::SafeDownCast(window) : this->Window.Get();
  if (owner)
  {
    owner->PushContext();
  }
  this->GetStatistics();
  this->Tables.Release(owner);
  this->TileListers.clear();
  this->RayCasters.clear();
  const auto freeAll = [owner](auto& programs)
  {
    for (auto& program : programs)
    {
      if (program.second && owner)
      {
        program.second->Free();
      }
    }
    programs.clear();
  };
  freeAll(this->ComputeCasters);
  freeAll(this->ComputeListers);
  this->TileTarget = nullptr;
  this->ImageTarget = nullptr;
  this->EntryTiles = nullptr;
  this->RefractedTiles = nullptr;
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
