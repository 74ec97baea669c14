// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Refraction/Surface/MediaChain.h"

#include <algorithm>
#include <cmath>

namespace meniscus
{
namespace
{

bool IsIndex(double index)
{
  return index > 0.0 && std::isfinite(index);
}

// Extends `way` by the interfaces behind the first one. Returns how many of the list are passed.
std::size_t Extend(const std::vector<InterfaceMedia>& list, MediaChain::Way& way)
{
  for (std::size_t i = way.size(); i < list.size(); ++i)
  {
    const double before = way.back().Behind;
    if (list[i].Exterior == before)
    {
      way.push_back({ before, list[i].Interior, true });
    }
    else if (list[i].Interior == before)
    {
      way.push_back({ before, list[i].Exterior, false });
    }
    else
    {
      return i;
    }
  }
  return list.size();
}

}

//------------------------------------------------------------------------------
MediaChain::MediaChain(const std::vector<InterfaceMedia>& list)
{
  const auto bad = std::find_if(list.begin(), list.end(),
    [](const InterfaceMedia& media)
    { return !IsIndex(media.Exterior) || !IsIndex(media.Interior); });
  if (bad != list.end())
  {
    this->Fault = MediaFault::BadIndex;
    this->FaultAt = static_cast<std::size_t>(bad - list.begin());
    return;
  }
  if (list.empty())
  {
    return;
  }
  Way fromFront{ { list[0].Exterior, list[0].Interior, true } };
  Way fromBack{ { list[0].Interior, list[0].Exterior, false } };
  const std::size_t passedFromFront = Extend(list, fromFront);
  const std::size_t passedFromBack = Extend(list, fromBack);
  if (passedFromFront == list.size())
  {
    this->Ways.push_back(fromFront);
  }
  if (passedFromBack == list.size() && list[0].Exterior != list[0].Interior)
  {
    this->Ways.push_back(fromBack);
  }
  if (this->Ways.empty())
  {
    this->Fault = MediaFault::NoMatch;
    this->FaultAt = std::max(passedFromFront, passedFromBack);
  }
}

}
