// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rendering/Backends/Native/TilesToCast.h"

#include "Filters/Common/ThreadedLoop.h"
#include "vtkType.h"

#include <algorithm>
#include <chrono>
#include <cstddef>

namespace meniscus
{
namespace
{

/** Time that the tiles between two questions to the application should take, in seconds. */
constexpr double PartTime = 0.05;
/** Parts of an image before the time of a tile is known. */
constexpr std::size_t FirstParts = 16;

double GetSeconds()
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}

//------------------------------------------------------------------------------
void TilesToCast::Begin(int numberOfTiles, bool goesOn, const std::function<bool(int)>& isKept)
{
  const auto count = static_cast<std::size_t>(numberOfTiles);
  if (!goesOn || this->Done.size() != count)
  {
    this->Done.assign(count, 0);
  }
  this->Remaining.clear();
  for (int tile = 0; tile < numberOfTiles; ++tile)
  {
    std::uint8_t& done = this->Done[static_cast<std::size_t>(tile)];
    done = done != 0 && isKept(tile) ? 1 : 0;
    if (done == 0)
    {
      this->Remaining.push_back(tile);
    }
  }
}

//------------------------------------------------------------------------------
bool TilesToCast::Cast(RayCastTarget& target, const std::function<void(int)>& cast)
{
  const std::size_t count = this->Remaining.size();
  std::size_t part = target.MayStop() ? this->Done.size() / FirstParts + 1 : count;
  for (std::size_t first = 0; first < count;)
  {
    const double start = GetSeconds();
    const std::size_t last = std::min(first + part, count);
    // Tiles differ in cost: small grains let threads share it.
    ThreadedFor(static_cast<vtkIdType>(first), static_cast<vtkIdType>(last), 1,
      [&](vtkIdType begin, vtkIdType end)
      {
        for (vtkIdType i = begin; i < end; ++i)
        {
          const int tile = this->Remaining[static_cast<std::size_t>(i)];
          cast(tile);
          this->Done[static_cast<std::size_t>(tile)] = 1;
        }
      });
    first = last;
    if (first < count && !target.GoOn())
    {
      return false;
    }
    const double perTile = (GetSeconds() - start) / static_cast<double>(part);
    part = static_cast<std::size_t>(
      std::clamp(PartTime / std::max(perTile, 1.0e-9), 1.0, static_cast<double>(count)));
  }
  return true;
}

}
