// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "OpenGLTable.h"

#include "vtkOpenGLError.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkShaderProgram.h"

namespace meniscus
{

//------------------------------------------------------------------------------
template <typename T>
std::string OpenGLTable::UploadValues(vtkOpenGLRenderWindow* window, const T* values,
  std::size_t count, int components, int texelsPerRow, int vtkType)
{
  this->Release(window);
  const std::int64_t texels = static_cast<std::int64_t>(count) / components;
  GLint limit = 0;
  glGetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &limit);
  if (texels > limit)
  {
    return "a table of " + std::to_string(texels) +
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
  if (!this->Buffer->Upload(values, count, vtkOpenGLBufferObject::TextureBuffer) ||
    !this->Texture->CreateTextureBuffer(
      static_cast<unsigned int>(texels), components, vtkType, this->Buffer))
  {
    return "a table of " + std::to_string(count * sizeof(T)) +
      " bytes could not be created on the graphics device";
  }
  this->Rows = texels / texelsPerRow;
  this->Bytes = static_cast<std::int64_t>(count * sizeof(T));
  return std::string();
}

//------------------------------------------------------------------------------
std::string OpenGLTable::Upload(vtkOpenGLRenderWindow* window, const float* values,
  std::size_t count, int components, int texelsPerRow)
{
  return this->UploadValues(window, values, count, components, texelsPerRow, VTK_FLOAT);
}

//------------------------------------------------------------------------------
std::string OpenGLTable::Upload(vtkOpenGLRenderWindow* window, const std::int32_t* values,
  std::size_t count, int components, int texelsPerRow)
{
  return this->UploadValues(window, values, count, components, texelsPerRow, VTK_INT);
}

//------------------------------------------------------------------------------
void OpenGLTable::Activate(vtkShaderProgram* program, const char* name)
{
  this->Texture->Activate();
  program->SetUniformi(name, this->Texture->GetTextureUnit());
}

//------------------------------------------------------------------------------
void OpenGLTable::Release(vtkWindow* window)
{
  if (this->IsFilled())
  {
    this->Texture->ReleaseGraphicsResources(window);
    this->Buffer->ReleaseGraphicsResources();
  }
  this->Rows = 0;
  this->Bytes = 0;
}

}
