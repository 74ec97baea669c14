// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkFrameBufferObjectBase.h"
#include "vtkOpenGLState.h"
#include "vtkRect.h"
#include "vtkRenderState.h"
#include "vtkRenderer.h"

namespace meniscus
{

/** Size of the image to which a pass draws. */
struct PictureSize
{
  int Size[2];
  int Origin[2] = { 0, 0 };

  explicit PictureSize(const vtkRenderState* drawn)
  {
    if (vtkFrameBufferObjectBase* buffer = drawn->GetFrameBuffer())
    {
      buffer->GetLastSize(this->Size); // the image of another pass, of any size
    }
    else
    {
      drawn->GetRenderer()->GetTiledSizeAndOrigin(
        &this->Size[0], &this->Size[1], &this->Origin[0], &this->Origin[1]);
    }
  }

  void Set(vtkOpenGLState* state) const
  {
    this->Set(state, { 0, 0, this->Size[0], this->Size[1] });
  }

  /** Limits drawing to a part of the image. */
  void Set(vtkOpenGLState* state, const vtkRecti& part) const
  {
    state->vtkglViewport(this->Origin[0], this->Origin[1], this->Size[0], this->Size[1]);
    state->vtkglScissor(this->Origin[0] + part.GetX(), this->Origin[1] + part.GetY(),
      part.GetWidth(), part.GetHeight());
  }
};

}
