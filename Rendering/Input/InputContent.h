// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Content of an input for ContentWatch: the objects that may receive Modified() after an edit, and
// the digest of the values.
#pragma once

#include "Rendering/Common/ContentWatch.h"
#include "Rendering/Input/InputBlocks.h"

#include <cstdint>
#include <vector>

namespace meniscus
{

/**
 * Versions of the objects that may receive Modified() after an edit of the cells: data sets, their
 * attributes, cells and their arrays. Modifications of other arrays are ignored.
 */
std::vector<ObjectVersion> CellVersions(const InputBlocks& input);
/** Digest of the cells, the ghost flags and the number of points. */
std::uint64_t DigestCells(const InputBlocks& input);

/** Versions of the objects that may receive Modified() after an edit of the points. */
std::vector<ObjectVersion> PointVersions(const InputBlocks& input);
/** Digest of the positions of the points. */
std::uint64_t DigestPoints(const InputBlocks& input);

/** The digests of the cells and the points, each computed once for the versions of the objects. */
class InputDigests
{
public:
  std::uint64_t OfCells(const InputBlocks& input);
  std::uint64_t OfPoints(const InputBlocks& input);

private:
  struct KnownDigest
  {
    std::vector<ObjectVersion> Versions;
    std::uint64_t Value = 0;
  };
  KnownDigest Cells;
  KnownDigest Points;
};

/** Versions of the objects that may receive Modified() after an edit of the scalars. */
std::vector<ObjectVersion> ScalarVersions(const InputBlocks& input);
/** Digest of all components of the scalars. */
std::uint64_t DigestScalars(const InputBlocks& input);

}
