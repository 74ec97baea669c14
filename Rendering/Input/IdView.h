// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Rendering/Input/GridLayout.h"

#include "vtkAOSDataArrayTemplate.h"
#include "vtkDataArray.h"

#include <cstdint>
#include <vector>

namespace meniscus
{

/**
 * Integers of an array with one component: a view of the stored ones if they have 32 or 64 bits and
 * lie one after another, otherwise a copy. The array must outlive this object.
 */
class IdView
{
public:
  IdView() = default;
  /** @param ids null for none. */
  explicit IdView(vtkDataArray* ids)
    : Size(ids ? static_cast<std::int64_t>(ids->GetNumberOfTuples()) : 0)
  {
    // VTK's 64-bit integer and the standard's may be different types.
    static_assert(sizeof(vtkTypeInt64) == sizeof(std::int64_t), "both have 64 bits");
    if (auto* longs = vtkAOSDataArrayTemplate<vtkTypeInt64>::FastDownCast(ids))
    {
      this->Longs = reinterpret_cast<const std::int64_t*>(longs->GetPointer(0));
    }
    else if (auto* idTypes = vtkAOSDataArrayTemplate<vtkIdType>::FastDownCast(ids);
             idTypes && sizeof(vtkIdType) == sizeof(std::int64_t))
    {
      this->Longs = reinterpret_cast<const std::int64_t*>(idTypes->GetPointer(0));
    }
    else if (auto* ints = vtkAOSDataArrayTemplate<vtkTypeInt32>::FastDownCast(ids))
    {
      this->Ints = ints->GetPointer(0);
    }
    else if (ids)
    {
      this->Copies = CopyValues<std::int64_t>(ids);
    }
  }

  std::int64_t GetSize() const { return this->Size; }
  std::int64_t operator[](std::int64_t i) const
  {
    return this->Ints ? std::int64_t{ this->Ints[i] } : this->GetLongs()[i];
  }
  /** The integers, unless they have 32 bits. */
  const std::int64_t* GetLongs() const { return this->Longs ? this->Longs : this->Copies.data(); }
  /** The integers if they have 32 bits; otherwise null. */
  const std::int32_t* GetInts() const { return this->Ints; }

private:
  std::int64_t Size = 0;
  const std::int64_t* Longs = nullptr;
  const std::int32_t* Ints = nullptr;
  std::vector<std::int64_t> Copies;
};

}
