// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Rendering_Input_ConcatenatedArray_h
#define meniscus_Rendering_Input_ConcatenatedArray_h

#include "Rendering/Input/InputBlocks.h"
#include "Volume/Optics/ScalarNormalization.h"

#include <cstdint>
#include <vector>

namespace meniscus
{

/** The arrays of all parts as one, by numbers that run through them. */
class ConcatenatedArray
{
public:
  /**
   * @param component  as in ScalarSelection, the first for Only. An array of one component yields
   *                   that one.
   */
  ConcatenatedArray(const InputBlocks& input, int component);

  double operator()(std::int32_t number) const;

private:
  const InputBlocks& Input;
  int Component;
  std::vector<std::int64_t> Firsts;
};

/** The values of those numbers, as they are in the arrays. */
std::vector<double> GatherValues(
  const InputBlocks& input, int component, const std::vector<std::int32_t>& numbers);

/** The finite ones among some values. */
struct FiniteValues
{
  ScalarDistribution Distribution;
  std::int64_t NotFinite = 0;

  FiniteValues() = default;
  explicit FiniteValues(const std::vector<double>& values);
};

}

#endif
