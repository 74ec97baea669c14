// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef ValuesOfParts_h
#define ValuesOfParts_h

#include "InputParts.h"
#include "Volume/ScalarNormalization.h"

#include <cstdint>
#include <vector>

namespace meniscus
{

/** The arrays of all parts as one, by numbers that run through them. */
class ValuesOfParts
{
public:
  /**
   * @param component  as in ScalarSelection, the first for Only. An array of one component yields
   *                   that one.
   */
  ValuesOfParts(const InputParts& input, int component);

  double operator()(std::int32_t number) const;

private:
  const InputParts& Input;
  int Component;
  std::vector<std::int64_t> Firsts;
};

/** The values of those numbers, as they are in the arrays. */
std::vector<double> GatherValues(
  const InputParts& input, int component, const std::vector<std::int32_t>& numbers);

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
