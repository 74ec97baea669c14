// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkNew.h"
#include "vtkOpenGLBufferObject.h"
#include "vtkTextureObject.h"

#include <cstddef>
#include <cstdint>
#include <string>

class vtkOpenGLRenderWindow;
class vtkShaderProgram;
class vtkWindow;

namespace meniscus
{

/** Rows of floats or 32-bit integers in a buffer that shaders read as a texture. */
class OpenGLTable
{
public:
  OpenGLTable() = default;
  ~OpenGLTable() = default;
  OpenGLTable(const OpenGLTable&) = delete;
  void operator=(const OpenGLTable&) = delete;

  bool IsFilled() const { return this->Bytes > 0; }
  std::int64_t GetNumberOfRows() const { return this->Rows; }
  std::int64_t GetBytes() const { return this->Bytes; }

  /**
   * Replaces the contents by `count` values in texels of 1 or 4. Returns an error or an empty
   * string. As many values as before go to the same place on the device.
   * @param texelsPerRow used by GetNumberOfRows() only. A table has one number of them, as well as
   *                     one type of values.
   */
  std::string Upload(vtkOpenGLRenderWindow* window, const float* values, std::size_t count,
    int components, int texelsPerRow);
  std::string Upload(vtkOpenGLRenderWindow* window, const std::int32_t* values, std::size_t count,
    int components, int texelsPerRow);

  /** Allocates rows of one texel of 4 integers each, to be filled on the device. */
  std::string Allocate(vtkOpenGLRenderWindow* window, std::size_t rows);
  unsigned int GetBufferHandle() const;

  void Activate(vtkShaderProgram* program, const char* name);
  void Deactivate() { this->Texture->Deactivate(); }
  /** Requires the window's context to be current. */
  void Release(vtkWindow* window);

private:
  static std::string DescribeExcess(std::int64_t texels);
  bool MakeTexture(vtkOpenGLRenderWindow* window, std::int64_t texels, int components, int vtkType);
  bool Overwrite(const void* values);
  template <typename T>
  std::string UploadValues(vtkOpenGLRenderWindow* window, const T* values, std::size_t count,
    int components, int texelsPerRow, int vtkType);

  vtkNew<vtkOpenGLBufferObject> Buffer;
  vtkNew<vtkTextureObject> Texture;
  std::int64_t Rows = 0;
  std::int64_t Bytes = 0;
};

}
