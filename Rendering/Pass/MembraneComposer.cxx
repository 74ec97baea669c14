// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rendering/Pass/MembraneComposer.h"

#include "Rendering/Pass/PlateUniforms.h"
#include "Rendering/Present/OpenGLTools.h"

#include "vtkRefractionMembraneFS.h"

#include "vtkCamera.h"
#include "vtkMatrix3x3.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkOpenGLError.h" // For OpenGL
#include "vtkOpenGLQuadHelper.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLState.h"
#include "vtkOpenGLTexture.h"
#include "vtkRenderer.h"
#include "vtkShaderProgram.h"
#include "vtkTexture.h"
#include "vtkTextureObject.h"

#include <algorithm>

namespace meniscus
{

//------------------------------------------------------------------------------
vtkTexture* FindCubeMap(vtkRenderer* renderer, vtkTexture* chosen)
{
  vtkTexture* texture = chosen ? chosen : renderer->GetEnvironmentTexture();
  return texture && texture->GetCubeMap() ? texture : nullptr;
}

//------------------------------------------------------------------------------
std::string MembraneShaderSource(bool hasCubeMap)
{
  std::string source = vtkRefractionMembraneFS;
  using Model = MembraneLook::Reflectances;
  const auto define = [](const char* name, int value)
  { return "#define " + std::string(name) + " " + std::to_string(value) + "\n"; };
  vtkShaderProgram::Substitute(source, "//VTK::Environment::Dec",
    define("HAS_ENVIRONMENT", hasCubeMap ? 1 : 0) +
      define("NO_REFLECTANCE", static_cast<int>(Model::None)) +
      define("SCHLICK", static_cast<int>(Model::Schlick)) +
      define("MIRROR", static_cast<int>(Model::Mirror)) + PlateShaderSource());
  return source;
}

//------------------------------------------------------------------------------
MembraneComposer::MembraneComposer() = default;

//------------------------------------------------------------------------------
MembraneComposer::~MembraneComposer() = default;

//------------------------------------------------------------------------------
std::string MembraneComposer::Compose(
  vtkRenderer* renderer, vtkOpenGLRenderWindow* window, const MembraneLook& look)
{
  if (look.CubeMap)
  {
    look.CubeMap->Render(renderer);
  }
  auto& quad = this->Quads[look.CubeMap ? 1 : 0];
  if (!ReadyQuad(window, quad, [&look]() { return MembraneShaderSource(look.CubeMap != nullptr); })
         .empty())
  {
    return "The shader of membranes does not compile on this graphics device.";
  }
  vtkOpenGLState* state = window->GetState();
  state->vtkglEnable(GL_DEPTH_TEST);
  state->vtkglDepthFunc(GL_LEQUAL);
  state->vtkglDepthMask(GL_TRUE);
  state->vtkglDisable(GL_BLEND);
  const auto bind = [&quad](vtkTextureObject* texture, const char* name)
  {
    texture->Activate();
    quad->Program->SetUniformi(name, texture->GetTextureUnit());
  };
  vtkTextureObject* const mirrored = look.Mirrored ? look.Mirrored : look.Behind;
  bind(look.Behind, "refracted");
  bind(mirrored, "mirroredScene"); // any image if it is not read
  quad->Program->SetUniformi("mirrorsScene", look.Mirrored != nullptr);
  bind(look.Normal, "membraneNormal");
  bind(look.Depth, "membraneDepth");
  if (look.CubeMap)
  {
    quad->Program->SetUniformi("environment", look.CubeMap->GetTextureUnit());
  }
  this->SetOptics(renderer, look, quad->Program);
  quad->Render();
  if (look.CubeMap)
  {
    look.CubeMap->PostRender(renderer);
  }
  for (vtkTextureObject* texture : { look.Behind, mirrored, look.Normal, look.Depth })
  {
    texture->Deactivate();
  }
  return std::string();
}

//------------------------------------------------------------------------------
void MembraneComposer::SetOptics(
  vtkRenderer* renderer, const MembraneLook& look, vtkShaderProgram* program) const
{
  vtkCamera* camera = renderer->GetActiveCamera();
  vtkNew<vtkMatrix4x4> clipToView;
  clipToView->DeepCopy(
    camera->GetProjectionTransformMatrix(renderer->GetTiledAspectRatio(), -1.0, 1.0));
  clipToView->Invert();
  clipToView->Transpose(); // OpenGL's order
  vtkMatrix4x4* worldToView = camera->GetModelViewTransformMatrix();
  vtkNew<vtkMatrix3x3> viewToWorld;
  for (int i = 0; i < 3; ++i)
  {
    for (int j = 0; j < 3; ++j)
    {
      // The inverse of a rotation in OpenGL's order.
      viewToWorld->SetElement(i, j, worldToView->GetElement(i, j));
    }
  }
  program->SetUniformMatrix("clipToView", clipToView);
  if (program->IsUniformUsed("viewToWorld"))
  {
    program->SetUniformMatrix("viewToWorld", viewToWorld);
  }
  double behind[3];
  float background[3];
  float backdrop[3];
  renderer->GetBackground(behind);
  std::copy_n(behind, 3, background);
  std::copy_n(look.Backdrop.begin(), 3, backdrop);
  program->SetUniform3f("background", background);
  program->SetUniform3f("backdrop", backdrop);
  program->SetUniformi("parallelView", camera->GetParallelProjection());
  program->SetUniformi("reflectanceModel", static_cast<int>(look.Reflectance));
  SetPlateUniforms(program, look.RelativeIndices);
}

//------------------------------------------------------------------------------
void MembraneComposer::Release()
{
  for (auto& quad : this->Quads)
  {
    quad.reset();
  }
}

}
