// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "MembraneScene.h"

class vtkTetrahedraRayCastMapper;

namespace meniscus::test
{

/** Several membranes, in the order of the rays. */
using MembraneStack = std::vector<MembraneCase>;

/** A membrane with these indices. */
MembraneCase Between(MembraneCase membrane, double exterior, double interior);

/** A sphere with exact normals, which point outwards. */
MembraneCase MakeBallCase(const reference::Vector3& center, double radius, int resolution);

/** Gives a mapper the surfaces and the indices of a list. */
void SetStack(vtkTetrahedraRayCastMapper* mapper, const MembraneStack& stack);

/**
 * The parts of a ray, each in one medium. A ray that misses a further interface ends at the last
 * one that it met.
 * @param endsOpaque as for Refract().
 */
std::vector<reference::Ray> FindParts(
  const MembraneStack& stack, reference::Ray ray, bool endsOpaque);

/** Colour of all parts, one behind the other; premultiplied. */
std::array<double, 4> ComposeParts(const std::vector<reference::Ray>& parts, const TraceRay& trace);

} // namespace meniscus::test
