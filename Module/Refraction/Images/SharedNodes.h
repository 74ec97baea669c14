// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Part of the division of patches that is the same for all primitives: the rays at the membrane's
 * vertices, and whether a patch is divided at all. Each is computed when it is asked for first, by
 * any thread. The values do not depend on the thread.
 */
#pragma once

#include "Refraction/Surface/CurveCrossings.h"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace meniscus
{

class SharedNodes
{
public:
  SharedNodes(std::size_t vertices, std::size_t facets)
    : Rays(new RefractedPoint[vertices]) // not initialised: most may never be asked for
    , RayStates(vertices)
    , FacetStates(facets)
  {
  }

  /** Ray at a vertex; `compute()` returns it if it is not known. */
  template <typename Compute>
  RefractedPoint GetRay(std::int32_t vertex, const Compute& compute)
  {
    const auto i = static_cast<std::size_t>(vertex);
    std::atomic<State>& state = this->RayStates[i];
    if (state.load(std::memory_order_acquire) == State::Known)
    {
      return this->Rays[i];
    }
    const RefractedPoint ray = compute();
    State expected = State::Unknown;
    if (state.compare_exchange_strong(expected, State::InWork, std::memory_order_relaxed))
    {
      this->Rays[i] = ray;
      state.store(State::Known, std::memory_order_release);
    }
    return ray;
  }

  /** True if a patch is divided; `compute()` returns it if it is not known. */
  template <typename Compute>
  bool IsDivided(std::int32_t facet, const Compute& compute)
  {
    std::atomic<State>& state = this->FacetStates[static_cast<std::size_t>(facet)];
    State known = state.load(std::memory_order_relaxed);
    if (known == State::Unknown)
    {
      known = compute() ? State::Divided : State::Whole;
      state.store(known, std::memory_order_relaxed);
    }
    return known == State::Divided;
  }

private:
  enum class State : unsigned char
  {
    Unknown, ///< the initial value of the lists
    InWork,  ///< a thread is storing it
    Known,
    Whole,
    Divided
  };

  std::unique_ptr<RefractedPoint[]> Rays; ///< by vertex
  std::vector<std::atomic<State>> RayStates;
  std::vector<std::atomic<State>> FacetStates;
};

}
