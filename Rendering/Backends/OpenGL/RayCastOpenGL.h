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

/** Drawing of an image to the framebuffer. */
struct RayCastOutput
{
  /**
   * Number of rays of the image; if there are fewer than the viewport's pixels, they are
   * interpolated.
   */
  int ImageSize[2] = { 0, 0 };
  /** Hardware selection: a value is drawn where the image is visible, instead of its colour. */
  bool Selecting = false;
  glm::vec3 SelectionValue{ 0.0f };
  /** Bias of an image that is composited later, in steps of 1/255. */
  float ColorBias = 0.0f;
};

/** Refraction of rays at a membrane. */
struct RayCastRefraction
{
  MembranePart Part = MembranePart::Whole;
  /** True if there is a membrane that refracts them. */
  bool Wanted = false;
  double Exterior = 1.0;
  double Interior = 1.0;
  /** Origin of the frame in world coordinates, and depth of the eye in the frame. */
  glm::dvec3 Center{ 0.0 };
  double EyeDepth = 0.0;
  /**
   * True if a refracted ray may begin inside the mesh; like the next member, for optics with
   * Refracting.
   */
  bool BeginsInside = false;
  /** Version of the refracted rays and of the boundary by which they enter. */
  std::array<std::int64_t, 2> Version{ 0, 0 };
};

/** Data of a frame besides the tables. */
struct RayCastFrame
{
  RayFrame Rays;
  double EarlyTerminationOpacity;
  /**
   * Transmittance at which a ray ends. It is so small that single precision has no digits to lose.
   */
  double TerminationTransmittance() const
  {
    return std::max(1.0 - this->EarlyTerminationOpacity, 1.0e-30);
  }
  RayCastOptics Optics;
  RayCastRefraction Refracting;
  RayCastOutput Output;
  /** true: a compute shader; false: a fragment shader. */
  bool Compute = false;
};

/**
 * The ray caster on OpenGL 3.2: tables in texture buffers; a pass that lists the possible entries
 * of each tile of the image, one that casts the rays into a float image of the viewport's size (a
 * fragment or a compute shader of the same functions), and one that blends it into the framebuffer.
 * All calls require the window's context to be current. Errors are returned as texts, empty if
 * there is none.
 */
class RayCastOpenGL
{
public:
  RayCastOpenGL();
  ~RayCastOpenGL();
  RayCastOpenGL(const RayCastOpenGL&) = delete;
  void operator=(const RayCastOpenGL&) = delete;

  /** Binds to a window; a change of the window drops all tables. */
  std::string SetWindow(vtkOpenGLRenderWindow* window);
  OpenGLTables& GetTables() { return this->Tables; }
  const OpenGLTables& GetTables() const { return this->Tables; }

  /**
   * Side of a tile in pixels; its rays share a list of entries. With 8, the lists of 7-14 % of the
   * tiles of meshes of 200k cells overflow.
   */
  static constexpr int TileSize = 4;
  /**
   * Side of a tile for lists of any length: cells that share no points are numerous and small.
   * Lists of larger tiles have more faces by which a ray does not enter, lists of smaller tiles
   * take more bytes in all.
   */
  static constexpr int LongListTileSize = 2;
  /** Number of faces that the lists made on the device hold. */
  static constexpr int TileCapacity = EntryTileCapacity;

  /** True if the window's context has compute shaders (OpenGL 4.3). */
  bool HasCompute() const { return OpenGLComputeProgram::IsSupported(); }

  /** True if the window's OpenGL runs on the CPU: Mesa's llvmpipe, softpipe or swr. */
  bool IsSoftware() const;

  /** Viewport of the current framebuffer: x, y, width, height. */
  void GetViewport(int viewport[4]) const;

  /** Casts the rays of the current viewport and blends them into the current framebuffer. */
  std::string Draw(const RayCastFrame& frame);

  /** Creates an image of width x height premultiplied RGBA from as many window depths. */
  using ImageMaker = std::function<RayStatistics(
    int width, int height, const std::vector<float>& opaqueDepth, std::vector<float>& image)>;
  /** As Draw(), with rays cast elsewhere; needs no tables. */
  std::string DrawImageOf(const ImageMaker& maker, const RayCastOutput& output);

  /** Waits until the device has finished drawing. */
  void Finish();

  /** Number of times that the entries of refracted rays were listed. */
  std::int64_t GetNumberOfRefractedEntryLists() const { return this->RefractedEntryLists; }

  /** Statistics of the last frame; read back on the first call after it. */
  RayStatistics GetStatistics();
  /** Records a frame without rays. */
  void ClearStatistics();

  /**
   * Frees all graphics resources in the context of their window; null for the window last drawn to.
   * For a window that is being destroyed it must be passed, since weak pointers to it are empty by
   * then.
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
  /** Listers without a membrane, in front of one, and behind it. */
  std::unique_ptr<vtkOpenGLQuadHelper> TileListers[3];
  /** Casters by RayCastShaderOptions(). */
  std::map<std::string, std::unique_ptr<vtkOpenGLQuadHelper>> RayCasters;
  std::map<std::string, vtkSmartPointer<OpenGLComputeProgram>> ComputeCasters;
  std::unique_ptr<vtkOpenGLQuadHelper> Composer;
  std::unique_ptr<vtkOpenGLQuadHelper> Selector;
  vtkSmartPointer<vtkOpenGLFramebufferObject> TileTarget;
  vtkSmartPointer<vtkOpenGLFramebufferObject> ImageTarget;
  vtkSmartPointer<vtkTextureObject> EntryTiles;
  /**
   * Entries of the refracted rays, and the RayCastRefraction::Version for which they were listed.
   */
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
