// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef ValuesOfParts_h
#define ValuesOfParts_h

#include "InputParts.h"

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

}

#endif
