// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Rendering_Common_ContentWatch_h
#define meniscus_Rendering_Common_ContentWatch_h

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
 * A 64-bit digest of values, computed in parallel and independent of the number of threads. Every
 * step is invertible in the word that it adds, so contents that differ in a single word never have
 * the same digest; others do with a probability of 2^-64. Values are compared bit by bit.
 */
class ContentDigest
{
public:
  /** Adds the size, type and values of an array; for null, adds that there is none. */
  void Add(vtkDataArray* array);
  void Add(std::uint64_t word);
  /**
   * Adds the values computed by valueOf(i), 0 <= i < count.
   * @pre several threads may call valueOf at the same time.
   */
  template <typename Function>
  void AddValues(std::size_t count, Function&& valueOf);

  std::uint64_t GetValue() const { return this->State; }

private:
  /** Adds digest(first, last) of each block of [0, count). */
  void AddBlocks(std::size_t count,
    const std::function<std::uint64_t(std::size_t first, std::size_t last)>& digest);
  static std::uint64_t Step(std::uint64_t state, std::uint64_t word);
  static std::uint64_t DigestBytes(const unsigned char* bytes, std::size_t size);

  std::uint64_t State = 0;
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
   * @return true if the values differ from those of the previous call, and at the first call.
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
      std::uint64_t state = 0;
      for (std::size_t i = first; i < last; ++i)
      {
        state = Step(state, static_cast<std::uint64_t>(valueOf(i)));
      }
      return state;
    });
}

}

#endif
