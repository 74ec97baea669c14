// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Refraction/Tubes/BoxTree.h"
#include "Refraction/Tubes/RayTubeTree.h"
#include "Simd/InstructionSets.h"
#include "Volume/Refracted/RayBlock.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace meniscus
{

/** Boxes around the patches of up to 64 facets, as arrays. */
struct BoxLanes
{
  static constexpr int Size = 64;

  int Count = 0;
  std::int32_t Facet[Size];
  double Low[3][Size];
  double High[3][Size];
  /** Results of the latest ClipBoxes(), as TubeRange. */
  double From[Size];
  double To[Size];
  /** Bounds of all boxes. */
  AxisBox Whole;
  /** False if the tube of the latest ClipBoxes() passes Whole; From and To are not set then. */
  bool MayMeet = false;

  AxisBox GetBox(int i) const
  {
    return { { this->Low[0][i], this->Low[1][i], this->Low[2][i] },
      { this->High[0][i], this->High[1][i], this->High[2][i] } };
  }
};

/** Boxes around the patches of some facets. */
struct FacetBoxes
{
  /** Most facets of a list: 64 for each ray of a tile. Longer lists are not kept. */
  static constexpr int Size = 64 * 1024;

  int Count = 0;
  /** True if there was no room for a facet. */
  bool IsFull = false;
  /** The boxes, and lanes of earlier lists behind them. */
  std::vector<BoxLanes> Lanes;
  /** Beginnings of ranges and boxes: buffer of VisitBoxesNearFirst(). */
  std::vector<std::pair<double, int>> Order;

  int GetNumberOfLanes() const { return (this->Count + BoxLanes::Size - 1) / BoxLanes::Size; }
  BoxLanes& LanesOf(int box) { return this->Lanes[static_cast<std::size_t>(box / BoxLanes::Size)]; }

  void Clear()
  {
    this->Count = 0;
    this->IsFull = false;
  }
  void Add(std::int32_t facet, const AxisBox& box)
  {
    this->IsFull = this->IsFull || this->Count == Size;
    if (this->IsFull)
    {
      return;
    }
    const int at = this->Count % BoxLanes::Size;
    if (this->GetNumberOfLanes() == static_cast<int>(this->Lanes.size()) && at == 0)
    {
      this->Lanes.emplace_back();
    }
    BoxLanes& lanes = this->LanesOf(this->Count);
    lanes.Count = at + 1;
    lanes.Facet[at] = facet;
    lanes.Whole = at == 0 ? AxisBox() : lanes.Whole;
    lanes.Whole.Add(box);
    for (int axis = 0; axis < 3; ++axis)
    {
      lanes.Low[axis][at] = box.Low[axis];
      lanes.High[axis][at] = box.High[axis];
    }
    ++this->Count;
  }
};

/**
 * Computes the part of a tube for which a ray may be inside each box: TubeClip::Clip().
 * @pre GetInstructionSets() has the set
 */
void ClipBoxes(const TubeBounds& tube, InstructionSet set, FacetBoxes& boxes);

/** Calls `visit(facet, range)` for each facet whose box a ray of the tube may meet. */
template <typename Visitor>
void VisitBoxes(const TubeBounds& tube, InstructionSet set, FacetBoxes& boxes, Visitor&& visit)
{
  ClipBoxes(tube, set, boxes);
  for (int k = 0; k < boxes.GetNumberOfLanes(); ++k)
  {
    const BoxLanes& lanes = boxes.Lanes[static_cast<std::size_t>(k)];
    for (int i = 0; i < lanes.Count && lanes.MayMeet; ++i)
    {
      if (lanes.From[i] <= lanes.To[i])
      {
        visit(lanes.Facet[i], TubeRange{ lanes.From[i], lanes.To[i] });
      }
    }
  }
}

/**
 * Calls `visit(facet, range, box)` for the same facets in the order of the beginnings of their
 * ranges. `visit` returns the largest parameter of the tube that counts from then on.
 * @param request called with a facet that is visited a few calls later, unless it is beyond that
 *   parameter then.
 */
template <typename Request, typename Visitor>
void VisitBoxesNearFirst(const TubeBounds& tube, InstructionSet set, FacetBoxes& boxes,
  const Request& request, Visitor&& visit)
{
  constexpr std::size_t ahead = 4;
  ClipBoxes(tube, set, boxes);
  std::vector<std::pair<double, int>>& order = boxes.Order;
  order.clear();
  for (int k = 0; k < boxes.GetNumberOfLanes(); ++k)
  {
    const BoxLanes& lanes = boxes.Lanes[static_cast<std::size_t>(k)];
    for (int i = 0; i < lanes.Count && lanes.MayMeet; ++i)
    {
      if (lanes.From[i] <= lanes.To[i])
      {
        order.emplace_back(lanes.From[i], k * BoxLanes::Size + i);
      }
    }
  }
  std::sort(order.begin(), order.end());
  double most = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < order.size() && order[k].first <= most; ++k)
  {
    if (k + ahead < order.size())
    {
      const int later = order[k + ahead].second;
      request(boxes.LanesOf(later).Facet[later % BoxLanes::Size]);
    }
    const BoxLanes& lanes = boxes.LanesOf(order[k].second);
    const int i = order[k].second % BoxLanes::Size;
    most = visit(lanes.Facet[i], TubeRange{ lanes.From[i], lanes.To[i] }, lanes.GetBox(i));
  }
}

/** Bounds of groups of eight rays of a block, as arrays. */
struct GroupTubes
{
  static constexpr int GroupSize = 8;
  static constexpr int Size = RayBlock::Size / GroupSize;
  /** Sides of a box: the upper ones, and then the lower ones. */
  static constexpr int Sides = 6;

  /** @param first depth from which on the rays are bounded. CompleteRays() has to come before. */
  GroupTubes(double first, const RayBlock& rays);
  /** Rays that may meet a box: the groups from the first that may meet it to the last. */
  RayRange FindRays(const AxisBox& box, InstructionSet set);

  int Count;
  /** Ends of the ranges of the groups: each side of a box is a limit at (Plane - Place) * Inverse.
   */
  double Place[Sides][Size];
  double Inverse[Sides][Size];
  double AddedToLast[Sides][Size];
  double AddedToFirst[Sides][Size];
  /** Not 0 if a ray of the group may meet the latest box. */
  std::int64_t Meets[Size];
  int NumberOfRays;
};

/** Facets of some interfaces in a row that the rays of a bundle may meet. */
class BundleFacets
{
public:
  /** Forgets all facets. The next list belongs to interface `first`. */
  void Clear(std::size_t first = 0)
  {
    this->First = first;
    this->NumberOfKnown = 0;
  }
  /** Facets of interface `number`; null if they are not known, or too many. */
  FacetBoxes* Find(std::size_t number)
  {
    const std::size_t at = number - this->First;
    const bool isKnown =
      number >= this->First && at < this->NumberOfKnown && !this->Facets[at].IsFull;
    return isKnown ? &this->Facets[at] : nullptr;
  }
  /** Begins the list of the next interface. */
  FacetBoxes& Append()
  {
    this->Facets.resize(std::max(this->Facets.size(), this->NumberOfKnown + 1));
    FacetBoxes& added = this->Facets[this->NumberOfKnown++];
    added.Clear();
    return added;
  }

private:
  std::vector<FacetBoxes> Facets;
  std::size_t First = 0;
  std::size_t NumberOfKnown = 0;
};

}
