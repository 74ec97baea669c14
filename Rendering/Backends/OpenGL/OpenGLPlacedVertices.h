// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Common/TableVersion.h"
#include "Rendering/Backends/OpenGL/OpenGLTable.h"
#include "Volume/Rays/FixedPointRays.h"

#include "vtkSmartPointer.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

class vtkOpenGLFramebufferObject;
class vtkOpenGLQuadHelper;
class vtkOpenGLRenderWindow;
class vtkTextureObject;
class vtkWindow;

namespace meniscus
{

/**
 * The vertices of a mesh in the grids of one or several frames, computed by the graphics device
 * from the table of the mesh, without uploads. All calls require the window's context to be
 * current.
 */
class OpenGLPlacedVertices
{
public:
  OpenGLPlacedVertices();
  ~OpenGLPlacedVertices();
  OpenGLPlacedVertices(const OpenGLPlacedVertices&) = delete;
  void operator=(const OpenGLPlacedVertices&) = delete;

  using FrameRows = FixedPointRays::FixedPointRows;

  /**
   * Places the vertices unless they are placed in this way already; the vertices of frame i begin
   * at i times their number. Binds a framebuffer and sets the viewport. Returns an error or an
   * empty string.
   * @param vertices (x, y, z, scalar) of each vertex in fixed point.
   * @param version changes with the vertices.
   */
  std::string Update(vtkOpenGLRenderWindow* window, OpenGLTable& vertices, TableVersion version,
    const std::vector<FrameRows>& frames);

  OpenGLTable& GetTable() { return this->Table; }
  const OpenGLTable& GetTable() const { return this->Table; }

  void Release(vtkWindow* window);

private:
  std::string Prepare(vtkOpenGLRenderWindow* window, std::int64_t vertices);
  void Place(OpenGLTable& vertices, const FrameRows& frame, std::int64_t first);

  OpenGLTable Table;
  std::vector<FrameRows> Frames;
  TableVersion Version;
  std::unique_ptr<vtkOpenGLQuadHelper> Quad;
  vtkSmartPointer<vtkOpenGLFramebufferObject> Target;
  vtkSmartPointer<vtkTextureObject> Fragments;
  vtkOpenGLRenderWindow* Window = nullptr;
};

}
