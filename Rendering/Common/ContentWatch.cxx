// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rendering/Common/ContentWatch.h"

#include "Common/BlockLoop.h"
#include "Filters/Common/ThreadedLoop.h"

#include "vtkDataArray.h"

#include <algorithm>
#include <cstring>
#include <utility>

namespace meniscus
{
namespace
{

/** Number of elements of the field, a prime. */
constexpr std::uint64_t FieldSize = (std::uint64_t{ 1 } << 61) - 1;
/** Bytes of a coefficient: seven, so that it is less than the size of the field. */
constexpr std::size_t CoefficientSize = 7;
/** Independent polynomials of a block, which a processor evaluates in parallel. */
constexpr std::size_t Chains = 4;

/**
 * Places at which the polynomials of chains, of a block's chains and of all blocks are evaluated:
 * the first, second and third 61 bits after the point of pi.
 */
constexpr std::uint64_t PlaceOfChains = 0x0487ed5110b4611au;
constexpr std::uint64_t PlaceOfBlocks = 0x0c4c6628b80dc1cdu;
constexpr std::uint64_t PlaceOfAll = 0x0252049c1114cf98u;

/** The element sum * place + coefficient. Sums stay below FieldSize + 8. */
std::uint64_t AddCoefficient(std::uint64_t sum, std::uint64_t place, std::uint64_t coefficient)
{
  const auto product = static_cast<unsigned __int128>(sum) * place;
  const std::uint64_t folded = (static_cast<std::uint64_t>(product) & FieldSize) +
    static_cast<std::uint64_t>(product >> 61) + coefficient;
  return (folded & FieldSize) + (folded >> 61);
}

/** The element as a number below FieldSize. */
std::uint64_t Reduced(std::uint64_t sum)
{
  return sum % FieldSize;
}

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
std::uint64_t ContentDigest::DigestBytes(const unsigned char* bytes, std::size_t size)
{
  constexpr std::uint64_t mask = (std::uint64_t{ 1 } << (8 * CoefficientSize)) - 1;
  std::uint64_t sums[Chains] = { 1, 1, 1, 1 };
  const auto add = [&sums](std::size_t chain, std::uint64_t coefficient)
  { sums[chain] = AddCoefficient(sums[chain], PlaceOfChains, coefficient); };
  std::size_t at = 0;
  // Whole words are read, of which the last byte is that of the next coefficient.
  for (; at + Chains * CoefficientSize < size; at += Chains * CoefficientSize)
  {
    for (std::size_t chain = 0; chain < Chains; ++chain)
    {
      std::uint64_t word = 0;
      std::memcpy(&word, bytes + at + chain * CoefficientSize, sizeof(word));
      add(chain, word & mask);
    }
  }
  for (; at < size; at += CoefficientSize)
  {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes + at, std::min(CoefficientSize, size - at));
    add(0, word);
  }
  std::uint64_t state = Reduced(size);
  for (const std::uint64_t sum : sums)
  {
    state = AddCoefficient(state, PlaceOfBlocks, Reduced(sum));
  }
  return Reduced(state);
}

//------------------------------------------------------------------------------
void ContentDigest::Add(std::uint64_t word)
{
  // Two coefficients: a word may exceed the field.
  this->State = AddCoefficient(this->State, PlaceOfAll, word >> 32);
  this->State = AddCoefficient(this->State, PlaceOfAll, word & 0xffffffffu);
}

//------------------------------------------------------------------------------
std::uint64_t ContentDigest::GetValue() const
{
  return Reduced(this->State);
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
