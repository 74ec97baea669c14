// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Rendering/Backends/OpenGL/OpenGLComputeProgram.h"
#include "Rendering/Backends/OpenGL/OpenGLEntryLists.h"
#include "Rendering/Backends/OpenGL/OpenGLTables.h"
#include "Rendering/Backends/RayCastBackend.h"
#include "Rendering/Backends/RayCastFrame.h"
#include "vtkSmartPointer.h"
#include "vtkWeakPointer.h"

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

class vtkOpenGLFramebufferObject;
class vtkOpenGLQuadHelper;
class vtkOpenGLRenderWindow;
class vtkShaderProgram;
class vtkTextureObject;
class vtkWindow;

namespace meniscus
{

/** Kind of program that casts rays; both are made of the same functions. */
enum class RayProgram
{
  Fragment,
  Compute
};

/**
 * Ray caster on OpenGL 3.2: tables in texture buffers; a pass that lists the possible entries of
 * each tile of the image, and one that casts the rays into the target's image, a fragment or a
 * compute shader of the same functions. Backends of one mapper share it, so that a change between
 * them sends no table again. All calls want the window's context to be current. Errors are texts,
 * empty if there is none.
 */
class RayCastOpenGL : public RayCastResources
{
public:
  RayCastOpenGL();
  ~RayCastOpenGL() override;
  RayCastOpenGL(const RayCastOpenGL&) = delete;
  void operator=(const RayCastOpenGL&) = delete;

  /** Names the table of a frame that the device has no room for; empty if there is none. */
  static std::string DescribeExcess(const RayCastRequest& request);
  /** Brings the tables up to date that the frame reads. */
  std::string Update(const RayCastRequest& request);
  /** Casts the rays of the frame of the last update. */
  std::string Cast(RayCastTarget& target, RayProgram program);

  /** Statistics of the last frame; read back on the first call after it. */
  RayCastStatistics GetStatistics();
  RayCastCounters GetCounters() override;
  /** A window that is being destroyed must be given, weak pointers to it are empty by then. */
  void ReleaseGraphicsResources(vtkWindow* window) override;

private:
  void SetWindow(vtkOpenGLRenderWindow* window);
  bool ReadStatistics();
  std::string Resize(int width, int height);
  template <typename Function>
  std::string ReadyCompute(vtkSmartPointer<OpenGLComputeProgram>& compute, Function&& makeShader);
  std::string AllocateTiles(vtkSmartPointer<vtkTextureObject>& tiles, int lists);
  std::string ListEntries(const RayCastFrame& frame, int leg, RayProgram program);
  std::string DrawEntries(const RayCastFrame& frame, int leg);
  std::string DispatchEntries(const RayCastFrame& frame, int leg);
  template <typename Function>
  void RunLister(vtkShaderProgram* program, const RayCastFrame& frame, int leg, Function&& run);
  std::string ListRefractedEntries(const RayCastFrame& frame, RayProgram program);
  std::string CastRays(const RayCastFrame& frame);
  std::string DispatchRays(const RayCastFrame& frame);
  template <typename Function>
  void RunCaster(vtkShaderProgram* program, const RayCastFrame& frame, Function&& run);
  std::vector<OpenGLTable*> ActivateRays(vtkShaderProgram* program, const RayFrame& rays);
  void SetCastUniforms(vtkShaderProgram* program, const RayCastFrame& frame);

  vtkWeakPointer<vtkOpenGLRenderWindow> Window;
  OpenGLTables Tables;
  OpenGLEntryLists LongLists;
  /** Frame of the last update, with the options of the shaders. */
  RayCastFrame Frame;
  /** Image and depths of the frame at hand; the target's. */
  vtkTextureObject* Image = nullptr;
  vtkTextureObject* Depth = nullptr;
  /** By the number of legs of a ray, and whether the leg is refracted. */
  std::map<std::pair<int, bool>, std::unique_ptr<vtkOpenGLQuadHelper>> TileListers;
  std::map<std::pair<int, bool>, vtkSmartPointer<OpenGLComputeProgram>> ComputeListers;
  /** Casters by RayCastShaderOptions(). */
  std::map<std::string, std::unique_ptr<vtkOpenGLQuadHelper>> RayCasters;
  std::map<std::string, vtkSmartPointer<OpenGLComputeProgram>> ComputeCasters;
  vtkSmartPointer<vtkOpenGLFramebufferObject> TileTarget;
  vtkSmartPointer<vtkOpenGLFramebufferObject> ImageTarget;
  vtkSmartPointer<vtkTextureObject> EntryTiles;
  /**
   * The same for the refracted legs, one list behind the other; the number of them, and the
   * versions of the rays and links listed.
   */
  vtkSmartPointer<vtkTextureObject> RefractedTiles;
  int RefractedTilesLegs = 0;
  TableVersions RefractedTilesVersions;
  /** The same of the frame at hand, and whether its refracted rays may begin within the mesh. */
  TableVersions RefractedVersions;
  bool BeginsInside = false;
  std::int64_t RefractedEntryLists = 0;
  std::int64_t CastPixels = 0;
  vtkSmartPointer<vtkTextureObject> StatisticsImage;
  int Size[2] = { 0, 0 };
  int Tiles[2] = { 0, 0 };
  RayCastStatistics Statistics;
  bool StatisticsStale = false;
};

}
