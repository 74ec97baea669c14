// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rendering/Backends/OpenGL/OpenGLTable.h"

#include "vtkOpenGLError.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkShaderProgram.h"

namespace meniscus
{

//------------------------------------------------------------------------------
std::string OpenGLTable::DescribeExcess(std::int64_t texels)
{
  GLint limit = 0;
  glGetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &limit);
  return texels <= limit ? std::string()
                         : "a table of " + std::to_string(texels) +
      " texels exceeds this graphics device's GL_MAX_TEXTURE_BUFFER_SIZE of " +
      std::to_string(limit);
}

//------------------------------------------------------------------------------
/** Creates the texture of the buffer. */
bool OpenGLTable::MakeTexture(
  vtkOpenGLRenderWindow* window, std::int64_t texels, int components, int vtkType)
{
  this->Texture->SetContext(window);
  if (vtkType == VTK_INT)
  {
    // VTK 9.1 has no default format for a texture buffer of integers.
    this->Texture->SetInternalFormat(components == 1 ? GL_R32I : GL_RGBA32I);
    this->Texture->SetFormat(components == 1 ? GL_RED_INTEGER : GL_RGBA_INTEGER);
    this->Texture->SetDataType(GL_INT);
  }
  return this->Texture->CreateTextureBuffer(
    static_cast<unsigned int>(texels), components, vtkType, this->Buffer);
}

//------------------------------------------------------------------------------
/** Sends values into the buffer of as many others. Returns false if the device fails. */
bool OpenGLTable::Overwrite(const void* values)
{
  if (!this->Buffer->Bind())
  {
    return false;
  }
  glBufferSubData(GL_TEXTURE_BUFFER, 0, static_cast<GLsizeiptr>(this->Bytes), values);
  return glGetError() == GL_NO_ERROR && this->Buffer->Release();
}

//------------------------------------------------------------------------------
template <typename T>
std::string OpenGLTable::UploadValues(vtkOpenGLRenderWindow* window, const T* values,
  std::size_t count, int components, int texelsPerRow, int vtkType)
{
  const auto bytes = static_cast<std::int64_t>(count * sizeof(T));
  const std::int64_t texels = static_cast<std::int64_t>(count) / components;
  const bool alike = bytes == this->Bytes && texels / texelsPerRow == this->Rows;
  if (this->IsFilled() && alike && this->Overwrite(values))
  {
    return std::string();
  }
  this->Release(window);
  const std::string excess = DescribeExcess(texels);
  if (!excess.empty())
  {
    return excess;
  }
  this->Buffer->SetType(vtkOpenGLBufferObject::TextureBuffer);
  if (!this->Buffer->Upload(values, count, vtkOpenGLBufferObject::TextureBuffer) ||
    !this->MakeTexture(window, texels, components, vtkType))
  {
    return "a table of " + std::to_string(bytes) +
      " bytes could not be created on the graphics device";
  }
  this->Rows = texels / texelsPerRow;
  this->Bytes = bytes;
  return std::string();
}

//------------------------------------------------------------------------------
std::string OpenGLTable::Allocate(vtkOpenGLRenderWindow* window, std::size_t rows)
{
  this->Release(window);
  const auto texels = static_cast<std::int64_t>(rows);
  const std::string excess = DescribeExcess(texels);
  if (!excess.empty())
  {
    return excess;
  }
  const std::size_t bytes = 4 * sizeof(std::int32_t) * rows;
  bool made =
    this->Buffer->GenerateBuffer(vtkOpenGLBufferObject::TextureBuffer) && this->Buffer->Bind();
  if (made)
  {
    glBufferData(GL_TEXTURE_BUFFER, static_cast<GLsizeiptr>(bytes), nullptr, GL_DYNAMIC_COPY);
    made = glGetError() == GL_NO_ERROR && this->Buffer->Release() &&
      this->MakeTexture(window, texels, 4, VTK_INT);
  }
  if (!made)
  {
    return "a table of " + std::to_string(bytes) +
      " bytes could not be created on the graphics device";
  }
  this->Rows = texels;
  this->Bytes = static_cast<std::int64_t>(bytes);
  return std::string();
}

//------------------------------------------------------------------------------
unsigned int OpenGLTable::GetBufferHandle() const
{
  return static_cast<unsigned int>(this->Buffer->GetHandle());
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
