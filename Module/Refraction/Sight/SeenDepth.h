// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace meniscus
{

/**
 * Meaning of the distance at which a point is seen. A length in a medium of the index n counts, in
 * lengths in the eye's medium of the index n1:
 */
enum class SeenDepth
{
  Apparent = 0, ///< n1 / n times: the virtual points of Eq. 2.4, flatter in a denser medium
  Optical = 1,  ///< n / n1 times: the time of light, as a laser scanner measures it
  Geometric = 2 ///< once: the length of the path
};

/** Share of a length in a medium in the distance at which a point is seen, times a constant. */
inline double GetSeenLength(SeenDepth depth, double length, double index)
{
  return depth == SeenDepth::Apparent ? length / index
                                      : (depth == SeenDepth::Optical ? length * index : length);
}

/** The length in a medium that has a share: the inverse of GetSeenLength(). */
inline double GetTrueLength(SeenDepth depth, double seen, double index)
{
  return depth == SeenDepth::Apparent ? seen * index
                                      : (depth == SeenDepth::Optical ? seen / index : seen);
}

}
