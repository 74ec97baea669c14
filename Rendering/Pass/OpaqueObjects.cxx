// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rendering/Pass/OpaqueObjects.h"

#include "vtkActor.h"
#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkMapper.h"
#include "vtkOpaquePass.h"
#include "vtkOpenGLError.h" // OpenGL itself, with whichever loader VTK uses
#include "vtkOpenGLState.h"
#include "vtkPointData.h"
#include "vtkProperty.h"
#include "vtkRenderState.h"
#include "vtkShaderProperty.h"
#include "vtkTexture.h"

#include <cstring>

namespace meniscus
{
namespace
{

/** True for images of red, green and blue, whose texels VTK's shader takes for opaque. */
bool HasOpaqueTexels(vtkTexture* texture)
{
  vtkImageData* image = texture->GetInput();
  vtkDataArray* scalars = image ? image->GetPointData()->GetScalars() : nullptr;
  return scalars && scalars->GetNumberOfComponents() == 3 &&
    scalars->GetDataType() == VTK_UNSIGNED_CHAR;
}

}

//------------------------------------------------------------------------------
// Mappers that derive from VTK's draw as they like.
bool HidesAllBehind(vtkActor* actor)
{
  vtkMapper* mapper = actor->GetMapper();
  vtkTexture* texture = actor->GetTexture();
  vtkShaderProperty* shader = actor->GetShaderProperty();
  return mapper && std::strcmp(mapper->GetClassName(), "vtkOpenGLPolyDataMapper") == 0 &&
    (!texture || HasOpaqueTexels(texture)) && actor->GetProperty()->GetNumberOfTextures() == 0 &&
    !shader->HasFragmentShaderCode() && shader->GetNumberOfShaderReplacements() == 0;
}

//------------------------------------------------------------------------------
void DrawOpaque(vtkOpaquePass* pass, const vtkRenderState* actors, vtkOpenGLState* state)
{
  vtkOpenGLState::ScopedglEnableDisable blending(state, GL_BLEND);
  bool hides = true;
  for (int i = 0; i < actors->GetPropArrayCount() && hides; ++i)
  {
    auto* actor = vtkActor::SafeDownCast(actors->GetPropArray()[i]);
    hides = actor && HidesAllBehind(actor);
  }
  if (hides)
  {
    state->vtkglDisable(GL_BLEND);
  }
  pass->Render(actors);
}

}
