// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Common/ByteDigest.h"

#include "vtkType.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

class vtkDataArray;
class vtkObject;

namespace meniscus
{

/** An object and its modification time. Equal for the same object as long as it is not modified. */
struct ObjectVersion
{
  const vtkObject* Object = nullptr;
  vtkMTimeType Time = 0;

  ObjectVersion() = default;
  explicit ObjectVersion(vtkObject* object);
  /** The object's own time, without the times of the objects that it holds. */
  static ObjectVersion Own(vtkObject* object);
  bool operator==(const ObjectVersion& other) const
  {
    return this->Object == other.Object && this->Time == other.Time;
  }
};

/**
 * A digest of values, computed in parallel and independent of the number of threads. Values are
 * compared bit by bit.
 *
 * The digests of blocks (DigestBytes()) are coefficients of a polynomial (PolynomialSum; J. L.
 * Carter, M. N. Wegman, "Universal Classes of Hash Functions", 1979). Whatever the difference of
 * two contents is, they have the same digest at n / 2^61 of the places at which the polynomials are
 * evaluated, where n is the number of coefficients of a block or of all blocks, some 10^4. That is
 * 10^-14 at most. Values are not kept for an exact comparison: it would hold arrays in memory whose
 * owners may overwrite or free it.
 */
class ContentDigest
{
public:
  /** Adds the size, type and values of an array; for null, adds that there is none. */
  void Add(vtkDataArray* array);
  void Add(std::uint64_t word) { this->Sum.AddWord(word); }
  void AddBytes(const unsigned char* bytes, std::size_t count);
  /**
   * Adds the values computed by valueOf(i), 0 <= i < count.
   * @pre several threads may call valueOf at the same time.
   */
  template <typename Function>
  void AddValues(std::size_t count, Function&& valueOf);

  std::uint64_t GetValue() const { return this->Sum.GetValue(); }

private:
  /** The third 61 bits after the point of pi. */
  static constexpr std::uint64_t PlaceOfAll = 0x0252049c1114cf98u;

  /** Adds digest(first, last) of each block of [0, count). */
  void AddBlocks(std::size_t count,
    const std::function<std::uint64_t(std::size_t first, std::size_t last)>& digest);

  PolynomialSum Sum{ PlaceOfAll };
};

/**
 * Detects changes of values: by modification times, which cost nothing, and, where one of these has
 * moved, by the values' digest. An edit in place is detected whichever of the watched objects
 * received Modified(), and an object that was modified without a change of values counts as
 * unchanged.
 */
class ContentWatch
{
public:
  /**
   * @param times versions of all objects that may receive Modified() after an edit.
   * @param digest computes the digest of the values.
   * @return true if the values differ from the values of the previous call, and at the first call.
   */
  bool HasChanged(std::vector<ObjectVersion> times, const std::function<std::uint64_t()>& digest);
  /** Makes the next values count as changed. */
  void Forget();

private:
  std::vector<ObjectVersion> Times;
  std::uint64_t Digest = 0;
  bool IsKnown = false;
};

//------------------------------------------------------------------------------
template <typename Function>
void ContentDigest::AddValues(std::size_t count, Function&& valueOf)
{
  this->AddBlocks(count,
    [&valueOf](std::size_t first, std::size_t last)
    {
      using Value = decltype(valueOf(first));
      std::vector<Value> values;
      values.reserve(last - first);
      for (std::size_t i = first; i < last; ++i)
      {
        values.push_back(valueOf(i));
      }
      return DigestBytes(
        reinterpret_cast<const unsigned char*>(values.data()), values.size() * sizeof(Value));
    });
}

}
