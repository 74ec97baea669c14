// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "VolumeCase.h"

namespace meniscus::test
{

glm::dvec3 PointBy(const glm::dmat4& map, const glm::dvec3& p);

/**
 * Maps a whole scene by a similarity: mesh, camera, membrane, unit distance. The membrane's exact
 * surface, which only the conditioning of a scene uses, is not mapped.
 */
void MapScene(VolumeCase& test, const glm::dmat4& map);

} // namespace meniscus::test
