// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkLight.h"
#include "vtkLightCollection.h"
#include "vtkNew.h"
#include "vtkOpenGLRenderer.h"

namespace meniscus
{

/**
 * A light in a renderer without one, as long as the object lives: VTK's mapper passes normals to
 * shaders only where a light is on.
 */
class LightForNormals
{
public:
  explicit LightForNormals(vtkRenderer* renderer)
    : Renderer(vtkOpenGLRenderer::SafeDownCast(renderer))
  {
    if (!this->Renderer || this->Renderer->GetLightingComplexity() > 0)
    {
      this->Renderer = nullptr;
      return;
    }
    this->Renderer->GetLights()->AddItem(this->Light);
    this->Renderer->UpdateLights();
  }
  ~LightForNormals()
  {
    if (this->Renderer)
    {
      this->Renderer->GetLights()->RemoveItem(this->Light);
      this->Renderer->UpdateLights();
    }
  }
  LightForNormals(const LightForNormals&) = delete;
  LightForNormals& operator=(const LightForNormals&) = delete;

private:
  vtkOpenGLRenderer* Renderer;
  vtkNew<vtkLight> Light;
};

}
