// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkTetrahedraRayCastOpenGL_h
#define vtkTetrahedraRayCastOpenGL_h

#include "Volume/BoundaryTree.h"
#include "Volume/RayFrame.h"
#include "Volume/TetrahedralMesh.h"
#include "Volume/TransferFunction.h"

#include "vtkNew.h"
#include "vtkSmartPointer.h"
#include "vtkWeakPointer.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

class vtkOpenGLFramebufferObject;
class vtkOpenGLQuadHelper;
class vtkOpenGLRenderWindow;
class vtkOpenGLState;
class vtkShaderProgram;
class vtkTextureObject;

namespace meniscus
{

/** A table in a buffer, seen by shaders as a texture. */
class OpenGLTable;

/** What a frame needs beside the tables. */
struct RayCastFrame
{
  RayFrame Rays;
  double EarlyTerminationOpacity;
};

/** Sums over the rays of a frame. */
struct RayStatistics
{
  std::int64_t Steps = 0;
  std::int64_t Rays = 0;
  std::int64_t Lost = 0;
};

/**
 * The ray caster on OpenGL 3.2: tables in texture buffers, one pass of a fragment shader into a
 * float image of the viewport's size, and a second one that blends it into the framebuffer.
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
  bool HasMesh() const;
  bool HasVertices() const;
  bool HasIntervals() const;

  std::string UploadMesh(const TetrahedralMesh& mesh, const BoundaryTree& tree);
  /** @param scalars  one normalised scalar per vertex. */
  std::string UploadVertices(const TetrahedralMesh& mesh, const std::vector<float>& scalars);
  std::string UploadIntervals(const std::vector<TransferFunctionInterval>& intervals);

  /** Viewport of the current framebuffer: x, y, width, height. */
  void GetViewport(int viewport[4]) const;

  /** Casts the rays of the current viewport and blends them into the current framebuffer. */
  std::string Draw(const RayCastFrame& frame);

  /** Of the last frame; read back on the first call after it. */
  RayStatistics GetStatistics();

  std::int64_t GetUploadedBytes() const { return this->UploadedBytes; }

  void Release();

private:
  class DepthCopy;

  std::string Resize(int width, int height);
  std::string CastRays(const RayCastFrame& frame, int width, int height);
  void SetUniforms(vtkShaderProgram* program, const RayCastFrame& frame, int width, int height);
  std::string Blend(const int viewport[4]);
  std::string Count(OpenGLTable& table, const std::string& error);

  vtkWeakPointer<vtkOpenGLRenderWindow> Window;
  std::unique_ptr<OpenGLTable> Vertices;
  std::unique_ptr<OpenGLTable> Cells;
  std::unique_ptr<OpenGLTable> TreeNodes;
  std::unique_ptr<OpenGLTable> TreeFaces;
  std::unique_ptr<OpenGLTable> Intervals;
  std::unique_ptr<DepthCopy> Depth;
  std::unique_ptr<vtkOpenGLQuadHelper> RayCaster;
  std::unique_ptr<vtkOpenGLQuadHelper> Composer;
  vtkSmartPointer<vtkOpenGLFramebufferObject> Framebuffer;
  vtkSmartPointer<vtkTextureObject> Image;
  vtkSmartPointer<vtkTextureObject> StatisticsImage;
  RayStatistics Statistics;
  bool StatisticsStale = false;
  std::int64_t UploadedBytes = 0;
};

}

#endif
