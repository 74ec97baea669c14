// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rendering/Backends/OpenGL/OpenGLPreIntegration.h"

#include "Rendering/Present/OpenGLTools.h"
#include "Volume/Optics/PreIntegration.h"

#include "vtkOpenGLError.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkShaderProgram.h"

#include <algorithm>

namespace meniscus
{

//------------------------------------------------------------------------------
std::string OpenGLPreIntegration::Upload(
  vtkOpenGLRenderWindow* window, const PreIntegrationTable& table)
{
  this->Release(window);
  const int scalars = table.GetNumberOfScalars();
  const int lengths = table.GetNumberOfLengths();
  GLint limit = 0;
  glGetIntegerv(GL_MAX_3D_TEXTURE_SIZE, &limit);
  if (std::max(scalars, lengths) > limit)
  {
    return "a pre-integration table of " + std::to_string(scalars) + " scalars and " +
      std::to_string(lengths) +
      " lengths exceeds this graphics device's GL_MAX_3D_TEXTURE_SIZE of " + std::to_string(limit);
  }
  auto texture = MakeTexelTexture(window);
  texture->SetWrapS(vtkTextureObject::ClampToEdge);
  texture->SetWrapT(vtkTextureObject::ClampToEdge);
  texture->SetWrapR(vtkTextureObject::ClampToEdge);
  // VTK only reads the values, but requires a pointer to non-const data.
  auto* values = const_cast<float*>(table.GetValues().data());
  if (!texture->Create3DFromRaw(scalars, scalars, lengths, 4, VTK_FLOAT, values))
  {
    return "a pre-integration table of " +
      std::to_string(table.GetValues().size() * sizeof(float)) +
      " bytes could not be created on the graphics device";
  }
  this->Texture = texture;
  this->Scalars = scalars;
  this->Shortest = table.GetShortest();
  this->LengthsPerOctave = table.GetLengthsPerOctave();
  this->Range[0] = static_cast<float>(table.GetMiddle());
  this->Range[1] = static_cast<float>(table.GetPerHalfRange());
  this->Bytes = static_cast<std::int64_t>(table.GetValues().size() * sizeof(float));
  return std::string();
}

//------------------------------------------------------------------------------
void OpenGLPreIntegration::Activate(vtkShaderProgram* program)
{
  this->Texture->Activate();
  program->SetUniformi("preIntegrated", this->Texture->GetTextureUnit());
  program->SetUniformf("preIntegratedScalars", static_cast<float>(this->Scalars));
  program->SetUniform2f("preIntegratedRange", this->Range);
  program->SetUniformf("shortestLengthReciprocal", static_cast<float>(1.0 / this->Shortest));
  program->SetUniformf("lengthsPerOctave", static_cast<float>(this->LengthsPerOctave));
}

//------------------------------------------------------------------------------
void OpenGLPreIntegration::Release(vtkWindow* window)
{
  if (this->Texture)
  {
    this->Texture->ReleaseGraphicsResources(window);
  }
  this->Texture = nullptr;
  this->Bytes = 0;
}

}
