// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "VolumeDevice.h"

#include <vtkNew.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSMPTools.h>
#include <vtkVersion.h>
#include <vtk_glew.h>

#include <algorithm>
#include <chrono>

namespace meniscus
{
namespace benchmark
{

namespace
{

constexpr GLsizeiptr CopySize = GLsizeiptr(256) << 20;
constexpr int Copies = 5;

//------------------------------------------------------------------------------
void PrintName(std::ostream& out, const char* title, GLenum name)
{
  const GLubyte* text = glGetString(name);
  out << title << ": " << (text ? reinterpret_cast<const char*>(text) : "unknown") << '\n';
}

//------------------------------------------------------------------------------
void PrintLimit(std::ostream& out, const char* title, GLenum name)
{
  GLint64 value = 0;
  glGetInteger64v(name, &value);
  if (glGetError() == GL_NO_ERROR)
  {
    out << title << ": " << value << '\n';
  }
}

} // anonymous namespace

//------------------------------------------------------------------------------
void PrintDevice(std::ostream& out)
{
  vtkNew<vtkRenderWindow> window;
  vtkNew<vtkRenderer> renderer;
  window->SetOffScreenRendering(1);
  window->SetSize(8, 8);
  window->AddRenderer(renderer);
  window->Render();
  window->MakeCurrent();
  PrintName(out, "GL_VENDOR", GL_VENDOR);
  PrintName(out, "GL_RENDERER", GL_RENDERER);
  PrintName(out, "GL_VERSION", GL_VERSION);
  PrintName(out, "GL_SHADING_LANGUAGE_VERSION", GL_SHADING_LANGUAGE_VERSION);
  while (glGetError() != GL_NO_ERROR)
  {
  }
  PrintLimit(out, "GL_MAX_TEXTURE_BUFFER_SIZE", GL_MAX_TEXTURE_BUFFER_SIZE);
  PrintLimit(out, "GL_MAX_SHADER_STORAGE_BLOCK_SIZE", GL_MAX_SHADER_STORAGE_BLOCK_SIZE);
  if (GLEW_NVX_gpu_memory_info)
  {
    PrintLimit(out, "dedicated video memory (KiB)", GL_GPU_MEMORY_INFO_DEDICATED_VIDMEM_NVX);
  }
  const double bandwidth = MeasureCopyBandwidth(window);
  if (bandwidth > 0.0)
  {
    out << "copies on the device, read and written (GB/s): " << 1e-9 * bandwidth << '\n';
  }
  out << "VTK: " << vtkVersion::GetVTKVersion() << '\n'
      << "threads: " << vtkSMPTools::GetEstimatedNumberOfThreads() << " ("
      << vtkSMPTools::GetBackend() << ")\n";
}

//------------------------------------------------------------------------------
double MeasureCopyBandwidth(vtkRenderWindow* window)
{
  window->MakeCurrent();
  while (glGetError() != GL_NO_ERROR)
  {
  }
  GLuint buffers[2];
  glGenBuffers(2, buffers);
  const GLenum targets[2] = { GL_COPY_READ_BUFFER, GL_COPY_WRITE_BUFFER };
  for (int i = 0; i < 2; ++i)
  {
    glBindBuffer(targets[i], buffers[i]);
    glBufferData(targets[i], CopySize, nullptr, GL_STATIC_COPY);
  }
  double best = 0.0;
  // The first copy may only provide the pages of the buffers.
  for (int i = 0; i <= Copies && glGetError() == GL_NO_ERROR; ++i)
  {
    glFinish();
    const auto begin = std::chrono::steady_clock::now();
    glCopyBufferSubData(targets[0], targets[1], 0, 0, CopySize);
    glFinish();
    const std::chrono::duration<double> time = std::chrono::steady_clock::now() - begin;
    best = i > 0 && time.count() > 0.0
      ? std::max(best, 2.0 * static_cast<double>(CopySize) / time.count())
      : best;
  }
  const bool failed = glGetError() != GL_NO_ERROR;
  for (const GLenum target : targets)
  {
    glBindBuffer(target, 0);
  }
  glDeleteBuffers(2, buffers);
  return failed ? 0.0 : best;
}

} // namespace benchmark
} // namespace meniscus
