// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Rendering/Input/InputBlocks.h"

#include <cstddef>
#include <cstdint>
#include <vector>

class vtkDataObject;

namespace meniscus
{

/** A cell of an input. */
struct InputCell
{
  /** Number of its data set in InputBlocks::Parts. */
  std::size_t Part = 0;
  /** Flat index of the data set in a composite input; -1 for another input. */
  int Block = -1;
  /** Index in its data set; -1 if there is no such cell. */
  std::int64_t Cell = -1;
};

/** Numbering of the cells of an input with a running index over all parts. */
class InputCells
{
public:
  /** @param input the data object that the parts were collected from. */
  InputCells(vtkDataObject* input, const InputBlocks& parts);

  /** Cell with a running index; none if it is negative. */
  InputCell Find(std::int64_t index) const;

private:
  /** Running index of the first cell of each part. */
  std::vector<std::int64_t> Firsts;
  /** Flat index of each part. */
  std::vector<int> Blocks;
};

}
