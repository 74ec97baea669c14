// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rendering/Common/ContentWatch.h"

#include "Common/BlockLoop.h"
#include "Filters/Common/ThreadedLoop.h"

#include "vtkDataArray.h"

#include <utility>

namespace meniscus
{
namespace
{

/** True if the values are contiguous in memory, as whole bytes. */
bool HasBytes(vtkDataArray* array)
{
  return array->HasStandardMemoryLayout() && array->GetDataType() != VTK_BIT;
}

}

//------------------------------------------------------------------------------
ObjectVersion::ObjectVersion(vtkObject* object)
  : Object(object)
  , Time(object ? object->GetMTime() : 0)
{
}

//------------------------------------------------------------------------------
ObjectVersion ObjectVersion::Own(vtkObject* object)
{
  ObjectVersion version;
  version.Object = object;
  version.Time = object ? object->vtkObject::GetMTime() : 0;
  return version;
}

//------------------------------------------------------------------------------
void ContentDigest::AddBlocks(std::size_t count,
  const std::function<std::uint64_t(std::size_t first, std::size_t last)>& digest)
{
  std::vector<std::uint64_t> blocks(NumberOfBlocks(count));
  ForEachBlock(count, ThreadedLoop,
    [&](std::size_t block, std::size_t first, std::size_t last)
    { blocks[block] = digest(first, last); });
  this->Add(count);
  for (const std::uint64_t block : blocks)
  {
    this->Add(block);
  }
}

//------------------------------------------------------------------------------
void ContentDigest::AddBytes(const unsigned char* bytes, std::size_t count)
{
  this->AddBlocks(count,
    [bytes](std::size_t first, std::size_t last)
    { return DigestBytes(bytes + first, last - first); });
}

//------------------------------------------------------------------------------
void ContentDigest::Add(vtkDataArray* array)
{
  this->Add(array ? 1 : 0);
  if (!array)
  {
    return;
  }
  const auto components = static_cast<std::size_t>(array->GetNumberOfComponents());
  this->Add(static_cast<std::uint64_t>(array->GetDataType()));
  this->Add(components);
  const auto count = static_cast<std::size_t>(array->GetNumberOfValues());
  if (!HasBytes(array))
  {
    this->AddValues(count,
      [array, components](std::size_t i)
      {
        return array->GetComponent(
          static_cast<vtkIdType>(i / components), static_cast<int>(i % components));
      });
    return;
  }
  const auto size = static_cast<std::size_t>(array->GetDataTypeSize());
  const auto* bytes = static_cast<const unsigned char*>(array->GetVoidPointer(0));
  this->AddBlocks(count,
    [bytes, size](std::size_t first, std::size_t last)
    { return DigestBytes(bytes + first * size, (last - first) * size); });
}

//------------------------------------------------------------------------------
bool ContentWatch::HasChanged(
  std::vector<ObjectVersion> times, const std::function<std::uint64_t()>& digest)
{
  if (this->IsKnown && times == this->Times)
  {
    return false;
  }
  const std::uint64_t value = digest();
  const bool changed = !this->IsKnown || value != this->Digest;
  this->Times = std::move(times);
  this->Digest = value;
  this->IsKnown = true;
  return changed;
}

//------------------------------------------------------------------------------
void ContentWatch::Forget()
{
  this->IsKnown = false;
}

}
