// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Refraction/Surface/MediaChain.h"
#include "Refraction/Surface/RefractingSurface.h"

#include <memory>

namespace meniscus
{

/** A surface, which several interfaces may share, between two media. */
struct Interface
{
  std::shared_ptr<const RefractingSurface> Surface;
  InterfaceMedia Media;

  bool operator==(const Interface& other) const
  {
    return this->Surface == other.Surface && this->Media == other.Media;
  }
};

}
