// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkRect.h"

class vtkRenderer;

namespace meniscus
{

/** True if a part of the box may be in view: if no plane of the frustum has all corners outside. */
bool MayBeInView(vtkRenderer* renderer, const double bounds[6]);

/**
 * Rectangle of the pixels that a box may cover in a picture of this width and height. It is the
 * whole picture if a corner of the box is not in front of the eye.
 */
vtkRecti FindPixels(vtkRenderer* renderer, const double bounds[6], const int (&size)[2]);

/**
 * Widens the camera's clipping range so that it contains the bounds, as the renderer does for its
 * own props; never narrows it.
 */
void HoldInClippingRange(vtkRenderer* renderer, const double bounds[6]);

}
