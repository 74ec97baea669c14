// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Rendering_Backends_OpenGL_RayCastOpenGL_h
#define meniscus_Rendering_Backends_OpenGL_RayCastOpenGL_h

#include "Volume/Rays/RayFrame.h"
#include "Volume/Rays/RayStatistics.h"
#include "Volume/Refracted/RefractedRayField.h"

#include "Rendering/Backends/OpenGL/OpenGLComputeProgram.h"
#include "Rendering/Backends/OpenGL/OpenGLTables.h"
#include "Rendering/Backends/OpenGL/ShaderConstants.h"
#include "Rendering/Present/OpenGLColorCopy.h"
#include "Rendering/Present/OpenGLDepthCopy.h"
#include "Rendering/Property/RayCastOptics.h"
#include "vtkSmartPointer.h"
#include "vtkWeakPointer.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

class vtkOpenGLFramebufferObject;
class vtkOpenGLQuadHelper;
class vtkOpenGLRenderWindow;
class vtkOpenGLState;
class vtkShaderProgram;
class vtkTextureObject;
class vtkWindow;

namespace meniscus
{

/** How an image gets into the framebuffer. */
struct RayCastOutput
{
  /** Rays of the image; fewer than the viewport's pixels are interpolated. */
  int ImageSize[2] = { 0, 0 };
  /** Hardware selection: a value where the image is visible, in place of its colour. */
  bool Selecting = false;
  glm::vec3 SelectionValue{ 0.0f };
  /** Bias of a picture that is composited later, in steps of 1/255. */
  float ColorBias = 0.0f;
};

/** How rays bend at a membrane. */
struct RayCastRefraction
{
  MembranePart Part = MembranePart::Whole;
  /** Whether there is a membrane that bends them. */
  bool Wanted = false;
  double Exterior = 1.0;
  double Interior = 1.0;
  /** Of the frame, in world coordinates, and depth of the eye in it. */
  glm::dvec3 Center{ 0.0 };
  double EyeDepth = 0.0;
  /** Whether a ray may begin within the mesh behind it; for optics with Refracting, as the next. */
  bool BeginsInside = false;
  /** Of the rays behind it and of the boundary that they enter by. */
  std::array<std::int64_t, 2> Version{ 0, 0 };
};

/** What a frame needs beside the tables. */
struct RayCastFrame
{
  RayFrame Rays;
  double EarlyTerminationOpacity;
  /** What of a ray ends it. Where so little is left, single precision has no digits to lose. */
  double TerminationTransmittance() const
  {
    return std::max(1.0 - this->EarlyTerminationOpacity, 1.0e-30);
  }
  RayCastOptics Optics;
  RayCastRefraction Refracting;
  RayCastOutput Output;
  /** By a compute shader, not a fragment shader. */
  bool Compute = false;
};

/**
 * The ray caster on OpenGL 3.2: tables in texture buffers; a pass that lists the possible entries
 * of each tile of the image, one that casts the rays into a float image of the viewport's size (a
 * fragment or a compute shader of the same functions), and one that blends it into the framebuffer.
 * All calls want the window's context to be current. Errors are texts, empty if there is none.
 */
class RayCastOpenGL
{
public:
  RayCastOpenGL();
  ~RayCastOpenGL();
  RayCastOpenGL(const RayCastOpenGL&) = delete;
  void operator=(const RayCastOpenGL&) = delete;

  /** Binds to a window; on a change of window all tables are gone. */
  std::string SetWindow(vtkOpenGLRenderWindow* window);
  OpenGLTables& GetTables() { return this->Tables; }
  const OpenGLTables& GetTables() const { return this->Tables; }

  /**
   * Pixels along the side of a tile, whose rays share a list of entries: 8 overflows the lists of
   * 7-14 % of the tiles of meshes of 200k cells.
   */
  static constexpr int TileSize = 4;
  /**
   * The same where lists have any length: cells that share no points are many, and small. Lists of
   * larger tiles have more faces that a ray does not enter by, of smaller ones more bytes in all.
   */
  static constexpr int LongListTileSize = 2;
  /** Faces that the lists made on the device hold. */
  static constexpr int TileCapacity = EntryTileCapacity;

  /** Whether the window's context has compute shaders (OpenGL 4.3). */
  bool HasCompute() const { return OpenGLComputeProgram::IsSupported(); }

  /** Whether the window's OpenGL runs on the processor: Mesa's llvmpipe, softpipe or swr. */
  bool IsSoftware() const;

  /** Viewport of the current framebuffer: x, y, width, height. */
  void GetViewport(int viewport[4]) const;

  /** Casts the rays of the current viewport and blends them into the current framebuffer. */
  std::string Draw(const RayCastFrame& frame);

  /** Makes an image of width x height premultiplied RGBA from as many window depths. */
  using ImageMaker = std::function<RayStatistics(
    int width, int height, const std::vector<float>& opaqueDepth, std::vector<float>& image)>;
  /** The same with rays cast elsewhere; needs no tables. */
  std::string DrawImageOf(const ImageMaker& maker, const RayCastOutput& output);

  /** Waits until the device has drawn what it was told to. */
  void Finish();

  /** Times that the entries behind a membrane were listed. */
  std::int64_t GetNumberOfRefractedEntryLists() const { return this->RefractedEntryLists; }

  /** Of the last frame; read back on the first call after it. */
  RayStatistics GetStatistics();
  /** Notes a frame without rays. */
  void ClearStatistics();

  /**
   * Frees all graphics resources in the context of their window; null for the window last drawn to.
   * A window that is being destroyed must be given, weak pointers to it are empty by then.
   */
  void Release(vtkWindow* window);

private:
  bool ReadStatistics();
  template <typename Function>
  std::string DrawImage(const RayCastOutput& output, Function&& makeImage);
  std::vector<float> ReadDepths();
  std::string Resize(int width, int height);
  template <typename Function>
  std::string ReadyQuad(std::unique_ptr<vtkOpenGLQuadHelper>& quad, Function&& makeFragmentShader);
  std::string AllocateTiles(vtkSmartPointer<vtkTextureObject>& tiles);
  std::string ListEntries(const RayCastFrame& frame, bool refracted);
  std::string ListRefractedEntries(const RayCastFrame& frame);
  std::string CastRays(const RayCastFrame& frame);
  std::string DispatchRays(const RayCastFrame& frame);
  template <typename Function>
  void RunCaster(vtkShaderProgram* program, const RayCastFrame& frame, Function&& run);
  std::string Blend(const RayCastOutput& output, const int viewport[4]);
  std::vector<OpenGLTable*> ActivateRays(vtkShaderProgram* program, const RayFrame& rays);
  void SetCastUniforms(vtkShaderProgram* program, const RayCastFrame& frame);

  vtkWeakPointer<vtkOpenGLRenderWindow> Window;
  OpenGLTables Tables;
  OpenGLDepthCopy Depth;
  OpenGLColorCopy Under;
  /** Without a membrane; before one, behind it. */
  std::unique_ptr<vtkOpenGLQuadHelper> TileListers[3];
  /** By RayCastShaderOptions(). */
  std::map<std::string, std::unique_ptr<vtkOpenGLQuadHelper>> RayCasters;
  std::map<std::string, vtkSmartPointer<OpenGLComputeProgram>> ComputeCasters;
  std::unique_ptr<vtkOpenGLQuadHelper> Composer;
  std::unique_ptr<vtkOpenGLQuadHelper> Selector;
  vtkSmartPointer<vtkOpenGLFramebufferObject> TileTarget;
  vtkSmartPointer<vtkOpenGLFramebufferObject> ImageTarget;
  vtkSmartPointer<vtkTextureObject> EntryTiles;
  /** The same for the rays behind a membrane, and RayCastRefraction::Version of what they list. */
  vtkSmartPointer<vtkTextureObject> RefractedTiles;
  std::array<std::int64_t, 2> RefractedTilesVersion{ 0, 0 };
  std::int64_t RefractedEntryLists = 0;
  vtkSmartPointer<vtkTextureObject> Image;
  vtkSmartPointer<vtkTextureObject> StatisticsImage;
  int Size[2] = { 0, 0 };
  int Tiles[2] = { 0, 0 };
  RayStatistics Statistics;
  bool StatisticsStale = false;
};

}

#endif
