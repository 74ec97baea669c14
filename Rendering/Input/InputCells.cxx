// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rendering/Input/InputCells.h"

#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataObject.h"
#include "vtkDataSet.h"
#include "vtkSmartPointer.h"

#include <algorithm>

namespace meniscus
{

//------------------------------------------------------------------------------
InputCells::InputCells(vtkDataObject* input, const InputBlocks& parts)
  : Blocks(parts.Parts.size(), -1)
{
  std::int64_t first = 0;
  for (const InputPart& part : parts.Parts)
  {
    this->Firsts.push_back(first);
    first += part.Grid->GetNumberOfCells();
  }
  auto* composite = vtkCompositeDataSet::SafeDownCast(input);
  if (!composite)
  {
    return;
  }
  // The parts are leaves in the order of the traversal; some leaves are left out.
  vtkSmartPointer<vtkCompositeDataIterator> leaf;
  leaf.TakeReference(composite->NewIterator());
  std::size_t part = 0;
  for (leaf->InitTraversal(); !leaf->IsDoneWithTraversal() && part < parts.Parts.size();
       leaf->GoToNextItem())
  {
    if (leaf->GetCurrentDataObject() == parts.Parts[part].Grid)
    {
      this->Blocks[part] = static_cast<int>(leaf->GetCurrentFlatIndex());
      ++part;
    }
  }
}

//------------------------------------------------------------------------------
InputCell InputCells::Find(std::int64_t index) const
{
  InputCell cell;
  if (index < 0 || this->Firsts.empty())
  {
    return cell;
  }
  const auto above = std::upper_bound(this->Firsts.begin(), this->Firsts.end(), index);
  cell.Part = static_cast<std::size_t>(above - this->Firsts.begin()) - 1;
  cell.Block = this->Blocks[cell.Part];
  cell.Cell = index - this->Firsts[cell.Part];
  return cell;
}

}
