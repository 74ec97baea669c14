// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * The cornea of a schematic eye: R. Navarro, J. Santamaria, J. Bescos, Accommodation-dependent
 * model of the human eye with aspherics, J. Opt. Soc. Am. A 2, 1985. The axis is the y axis, with
 * the outside above. Lengths are in millimetres.
 */
#pragma once

#include "ExactStack.h"

namespace meniscus::test
{

/** A conic of revolution with its vertex at y = -Vertex. */
struct CorneaSurface
{
  double Radius;
  double Asphericity; ///< Q
  double Vertex;
  double Behind; ///< index of refraction
};

constexpr CorneaSurface Anterior{ 7.72, -0.26, 0.0, 1.376 };
constexpr CorneaSurface Posterior{ 6.50, 0.0, 0.55, 1.3374 };
constexpr double Pupil = 0.55 + 3.05; ///< behind the anterior vertex

/** Radius of the cornea's outline. */
constexpr double CorneaRadius = 5.5;

/** A mesh of 2 cells^2 facets over a disc. */
reference::MembraneMesh MakeCornea(const CorneaSurface& surface, int cells);

/** The surface as exact rays pass it from outside. */
reference::ExactSurface MakeExactCornea(const CorneaSurface& surface, double before);

}
