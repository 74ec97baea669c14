// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// The content of an input for ContentWatch: which objects may be told of an edit, and the digest of
// the values.
#ifndef InputContent_h
#define InputContent_h

#include "ContentWatch.h"
#include "InputParts.h"

#include <cstdint>
#include <vector>

namespace meniscus
{

/**
 * Versions of the objects that may be told of an edit of the points or the cells: data sets, their
 * attributes, points, cells and the arrays below. Modifying another array than those does not
 * count.
 */
std::vector<ObjectVersion> MeshVersions(const InputParts& input);
/** Digest of the points, the cells and the flags of ghosts. */
std::uint64_t DigestMesh(const InputParts& input);

/** Versions of the objects that may be told of an edit of the scalars. */
std::vector<ObjectVersion> ScalarVersions(const InputParts& input);
/** Digest of all components of the scalars. */
std::uint64_t DigestScalars(const InputParts& input);

}

#endif
