// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rendering/Backends/OpenGL/OpenGLPlacedVertices.h"

#include "Rendering/Present/OpenGLTools.h"

#include "vtkTetrahedraPlaceFS.h"

#include "vtkOpenGLError.h"
#include "vtkOpenGLFramebufferObject.h"
#include "vtkOpenGLQuadHelper.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLState.h"
#include "vtkShaderProgram.h"
#include "vtkTextureObject.h"

#include <algorithm>

namespace meniscus
{
namespace
{

// Number of fragments of a pass: 4 MB.
constexpr int Columns = 1024;
constexpr int MostRows = 256;
constexpr std::int64_t BytesOfVertex = 16;

}

//------------------------------------------------------------------------------
OpenGLPlacedVertices::OpenGLPlacedVertices() = default;

//------------------------------------------------------------------------------
OpenGLPlacedVertices::~OpenGLPlacedVertices() = default;

//------------------------------------------------------------------------------
/** Creates the objects with which and to which the passes draw. */
std::string OpenGLPlacedVertices::Prepare(vtkOpenGLRenderWindow* window, std::int64_t vertices)
{
  const std::string error = ReadyQuad(window, this->Quad, []() { return vtkTetrahedraPlaceFS; });
  if (!error.empty())
  {
    return error;
  }
  const auto rows =
    static_cast<unsigned int>(std::min<std::int64_t>((vertices + Columns - 1) / Columns, MostRows));
  if (!this->Fragments || this->Fragments->GetHeight() < rows)
  {
    this->Fragments = MakeTexelTexture(window);
    // VTK 9.1 has no default formats for integers.
    this->Fragments->SetInternalFormat(GL_RGBA32I);
    this->Fragments->SetFormat(GL_RGBA_INTEGER);
    this->Fragments->SetDataType(GL_INT);
    if (!this->Fragments->Allocate2D(Columns, rows, 4, VTK_INT))
    {
      return "no image of integers can be made on the graphics device";
    }
  }
  if (!this->Target)
  {
    this->Target = vtkSmartPointer<vtkOpenGLFramebufferObject>::New();
    this->Target->SetContext(window);
  }
  this->Target->Bind();
  this->Target->AddColorAttachment(0, this->Fragments);
  this->Target->ActivateDrawBuffers(1);
  this->Target->ActivateReadBuffer(0);
  return std::string();
}

//------------------------------------------------------------------------------
/** Draws the vertices of a frame and copies them into the table, on the device. */
void OpenGLPlacedVertices::Place(OpenGLTable& vertices, const FrameRows& frame, std::int64_t first)
{
  vtkShaderProgram* program = this->Quad->Program;
  program->SetUniform1iv("toGrid", static_cast<int>(frame.Whole.size()), frame.Whole.data());
  program->SetUniform1fv("toGridRest", static_cast<int>(frame.Rests.size()), frame.Rests.data());
  program->SetUniformi("columns", Columns);
  const std::int64_t number = vertices.GetNumberOfRows();
  constexpr std::int64_t most = std::int64_t{ Columns } * MostRows;
  for (std::int64_t begin = 0; begin < number; begin += most)
  {
    const std::int64_t count = std::min(number - begin, most);
    const auto whole = static_cast<int>(count / Columns);
    const auto rest = static_cast<int>(count % Columns);
    const int rows = whole + (rest > 0 ? 1 : 0);
    this->Window->GetState()->vtkglViewport(0, 0, Columns, rows);
    program->SetUniformi("rows", rows);
    program->SetUniformi("firstVertex", static_cast<int>(begin));
    this->Quad->Render();
    glBindBuffer(GL_PIXEL_PACK_BUFFER, this->Table.GetBufferHandle());
    const auto copy = [](int firstRow, int columns, int numberOfRows, std::int64_t vertex)
    {
      if (columns > 0 && numberOfRows > 0)
      {
        glReadPixels(0, firstRow, columns, numberOfRows, GL_RGBA_INTEGER, GL_INT,
          reinterpret_cast<void*>(static_cast<std::intptr_t>(vertex * BytesOfVertex)));
      }
    };
    copy(0, Columns, whole, first + begin);
    copy(whole, rest, 1, first + begin + count - rest);
    glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
  }
}

//------------------------------------------------------------------------------
std::string OpenGLPlacedVertices::Update(vtkOpenGLRenderWindow* window, OpenGLTable& vertices,
  TableVersion version, const std::vector<FrameRows>& frames)
{
  if (this->Table.IsFilled() && this->Version == version && this->Frames == frames)
  {
    return std::string();
  }
  this->Window = window;
  this->Frames.clear();
  const std::int64_t number = vertices.GetNumberOfRows();
  const std::int64_t all = number * static_cast<std::int64_t>(frames.size());
  std::string error = this->Table.GetNumberOfRows() == all
    ? std::string()
    : this->Table.Allocate(window, static_cast<std::size_t>(all));
  if (error.empty())
  {
    error = this->Prepare(window, number);
  }
  if (!error.empty())
  {
    return error;
  }
  vertices.Activate(this->Quad->Program, "modelVertices");
  for (std::size_t i = 0; i < frames.size(); ++i)
  {
    this->Place(vertices, frames[i], static_cast<std::int64_t>(i) * number);
  }
  vertices.Deactivate();
  this->Frames = frames;
  this->Version = version;
  return std::string();
}

//------------------------------------------------------------------------------
void OpenGLPlacedVertices::Release(vtkWindow* window)
{
  this->Table.Release(window);
  this->Frames.clear();
  this->Quad.reset();
  this->Target = nullptr;
  this->Fragments = nullptr;
  this->Window = nullptr;
}

}
