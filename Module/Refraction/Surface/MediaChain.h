// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

namespace meniscus
{

/** Indices of refraction on both sides of a surface: where its normals point to, and the other. */
struct InterfaceMedia
{
  double Exterior;
  double Interior;

  /** True if the indices differ, so that rays change their direction. */
  bool IsRefracting() const { return this->Exterior != this->Interior; }
  bool operator==(const InterfaceMedia& other) const
  {
    return this->Exterior == other.Exterior && this->Interior == other.Interior;
  }
};

/** Passage of rays through an interface, from one of its sides to the other. */
struct InterfacePassage
{
  double Before;
  double Behind;
  bool FromFront; ///< true: from the exterior to the interior, against the normals
};

enum class MediaFault
{
  None,
  BadIndex, ///< an index of refraction is not positive and finite
  NoMatch   ///< no side of an interface has the medium behind the interface before it
};

/**
 * Sides from which rays can pass interfaces in the order of the list, so that the medium behind
 * each is the medium before the next one. The first interface determines all others, except where
 * both sides of an interface have the same index; such an interface is passed from the front. So
 * there are at most two ways.
 */
struct MediaChain
{
  using Way = std::vector<InterfacePassage>;

  explicit MediaChain(const std::vector<InterfaceMedia>& list);

  MediaFault Fault = MediaFault::None;
  std::size_t FaultAt = 0; ///< number of the interface with the fault, counted from 0
  std::vector<Way> Ways;   ///< the first one begins at the front of the first interface if it can
};

}
