// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

class vtkRenderer;

namespace meniscus
{

/** True if a part of the box may be in view: if no plane of the frustum has all corners outside. */
bool MayBeInView(vtkRenderer* renderer, const double bounds[6]);

/**
 * Widens the camera's clipping range so that it contains the bounds, as the renderer does for its
 * own props; never narrows it.
 */
void HoldInClippingRange(vtkRenderer* renderer, const double bounds[6]);

}
