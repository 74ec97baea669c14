// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rendering/Backends/OpenGL/OpenGLRefractedRays.h"

#include "Rendering/Present/OpenGLTools.h"

#include "vtkOpenGLError.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkShaderProgram.h"

#include <glm/gtc/matrix_access.hpp>
#include <glm/vec3.hpp>

#include <algorithm>

namespace meniscus
{

//------------------------------------------------------------------------------
std::string OpenGLRefractedRays::DescribeExcess(
  const int (&imageSize)[2], int legs, std::int64_t limit)
{
  GLint side = 0;
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &side);
  const std::int64_t columns = std::int64_t{ 2 } * imageSize[0];
  const std::int64_t rows = std::int64_t{ legs - 1 } * imageSize[1];
  const std::int64_t texels = columns * rows;
  if (texels <= limit && columns <= side && rows <= side)
  {
    return std::string();
  }
  return "a table of " + std::to_string(texels) + " texels for the rays of " +
    std::to_string(imageSize[0]) + " x " + std::to_string(imageSize[1]) +
    " pixels behind the membrane exceeds the graphics device's limit of " +
    std::to_string(std::min(limit, std::int64_t{ side } * side));
}

//------------------------------------------------------------------------------
std::string OpenGLRefractedRays::Upload(vtkOpenGLRenderWindow* window,
  const std::vector<RefractedRayLine>& lines, int width, const RefractionFrames& frames)
{
  static_assert(sizeof(RefractedRayLine) == 8 * sizeof(std::int32_t), "two texels of four numbers");
  this->Release(window);
  auto texture = MakeTexelTexture(window);
  // VTK 9.1 has no default formats for integers.
  texture->SetInternalFormat(GL_RGBA32I);
  texture->SetFormat(GL_RGBA_INTEGER);
  texture->SetDataType(GL_INT);
  // VTK only reads the values, but requires a pointer to non-const data.
  auto* values = const_cast<RefractedRayLine*>(lines.data());
  const auto height = static_cast<unsigned int>(lines.size() / static_cast<std::size_t>(width));
  if (!texture->Create2DFromRaw(2 * width, height, 4, VTK_INT, values))
  {
    return "a table of " + std::to_string(lines.size() * sizeof(RefractedRayLine)) +
      " bytes for the rays behind the membrane could not be created on the graphics device";
  }
  this->Texture = texture;
  this->Bytes = static_cast<std::int64_t>(lines.size() * sizeof(RefractedRayLine));
  for (int k = 0; k < 3; ++k)
  {
    this->Rows[k].clear();
    this->Axes[k].clear();
  }
  this->GridPerUnit.clear();
  this->Places.clear();
  this->FixedRows.clear();
  const auto append = [](std::vector<float>& values3, const glm::dvec3& v)
  {
    const glm::vec3 rounded(v);
    values3.insert(values3.end(), { rounded.x, rounded.y, rounded.z });
  };
  for (int index = 0; index < RefractionFrames::Number; ++index)
  {
    const RefractionFrame& frame = frames.Get(index);
    const RayFrame& rows = frame.Rays.GetFrame();
    append(this->Rows[0], rows.RowX);
    append(this->Rows[1], rows.RowY);
    append(this->Rows[2], rows.RowDepth);
    for (int k = 0; k < 3; ++k)
    {
      append(this->Axes[k], glm::row(frame.FromView, k));
    }
    const bool needed = frame.Extent > 0.0;
    if (needed)
    {
      this->FixedRows.push_back(frame.Rays.GetFixedPointRows());
    }
    this->GridPerUnit.push_back(static_cast<float>(1.0 / frame.Rays.GetGridUnit()));
    this->Places.push_back(needed ? static_cast<int>(this->FixedRows.size()) : 0);
  }
  return std::string();
}

//------------------------------------------------------------------------------
void OpenGLRefractedRays::Activate(vtkShaderProgram* program, std::int64_t vertices)
{
  this->Texture->Activate();
  program->SetUniformi("refractedRays", this->Texture->GetTextureUnit());
  const char* const rows[3] = { "frameRowX", "frameRowY", "frameRowDepth" };
  const char* const axes[3] = { "frameAxisX", "frameAxisY", "frameAxisDepth" };
  for (int k = 0; k < 3; ++k)
  {
    program->SetUniform3fv(rows[k], RefractionFrames::Number, this->Rows[k].data());
    program->SetUniform3fv(axes[k], RefractionFrames::Number, this->Axes[k].data());
  }
  std::vector<int> firsts(this->Places);
  for (int& first : firsts)
  {
    first *= static_cast<int>(vertices);
  }
  program->SetUniform1fv("frameGridPerUnit", RefractionFrames::Number, this->GridPerUnit.data());
  program->SetUniform1iv("frameFirstVertex", RefractionFrames::Number, firsts.data());
}

//------------------------------------------------------------------------------
void OpenGLRefractedRays::Release(vtkWindow* window)
{
  if (this->Texture)
  {
    this->Texture->ReleaseGraphicsResources(window);
  }
  this->Texture = nullptr;
  this->Bytes = 0;
}

}
