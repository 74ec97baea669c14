// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Refraction/Curved/CurvedMembraneSolver.h"
#include "RefractionCheck.h"
#include "SightOracle.h"

namespace meniscus::test
{

/**
 * Draws the images of a case's triangles and checks them at random places of the triangles: every
 * certain image of the place must be shown by a polygon, and every polygon that shows the place
 * must show it in the direction from which its light arrives.
 */
RefractionTally CheckTriangles(const RefractionCase& test, CurvedMembraneSolver& geometry,
  const reference::SightOracle& oracle, const reference::SurfaceError& error);

} // namespace meniscus::test
