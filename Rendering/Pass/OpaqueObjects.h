// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

class vtkActor;
class vtkOpaquePass;
class vtkOpenGLState;
class vtkRenderState;

namespace meniscus
{

/**
 * True if no fragment of the actor's opaque geometry can let anything behind it through. False
 * where its mapper, its textures or its shaders may make the opacity of fragments smaller.
 */
bool HidesAllBehind(vtkActor* actor);

/**
 * Draws the opaque geometry of the actors of a render state. Blending is turned off if
 * HidesAllBehind() is true for all of them. The colours are the same, and a software rasteriser
 * need not read the image.
 */
void DrawOpaque(vtkOpaquePass* pass, const vtkRenderState* actors, vtkOpenGLState* state);

}
