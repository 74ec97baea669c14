// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Volume_Refracted_FacetBoxes_h
#define meniscus_Volume_Refracted_FacetBoxes_h

#include "Refraction/Tubes/BoxTree.h"
#include "Refraction/Tubes/RayTubeTree.h"
#include "Simd/InstructionSets.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace meniscus
{

/** Boxes around the patches of some facets, as arrays. */
struct FacetBoxes
{
  /** Most facets of a list: two rays of a tile per facet. Longer lists are not kept. */
  static constexpr int Size = 512;

  int Count = 0;
  /** True if there was no room for a facet. */
  bool IsFull = false;
  std::int32_t Facet[Size];
  double Low[3][Size];
  double High[3][Size];
  /** Results of the latest ClipBoxes(), as TubeRange. */
  double From[Size];
  double To[Size];

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
    const int at = this->Count++;
    this->Facet[at] = facet;
    for (int axis = 0; axis < 3; ++axis)
    {
      this->Low[axis][at] = box.Low[axis];
      this->High[axis][at] = box.High[axis];
    }
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
  for (int i = 0; i < boxes.Count; ++i)
  {
    if (boxes.From[i] <= boxes.To[i])
    {
      visit(boxes.Facet[i], TubeRange{ boxes.From[i], boxes.To[i] });
    }
  }
}

/**
 * Calls `visit(facet, range)` for the same facets in the order of the beginnings of their ranges.
 * `visit` returns the largest parameter of the tube that counts from then on.
 */
template <typename Visitor>
void VisitBoxesNearFirst(
  const TubeBounds& tube, InstructionSet set, FacetBoxes& boxes, Visitor&& visit)
{
  std::pair<double, int> order[FacetBoxes::Size];
  ClipBoxes(tube, set, boxes);
  int count = 0;
  for (int i = 0; i < boxes.Count; ++i)
  {
    if (boxes.From[i] <= boxes.To[i])
    {
      order[count++] = { boxes.From[i], i };
    }
  }
  std::sort(order, order + count);
  double most = std::numeric_limits<double>::infinity();
  for (int k = 0; k < count && order[k].first <= most; ++k)
  {
    const int i = order[k].second;
    most = visit(boxes.Facet[i], TubeRange{ boxes.From[i], boxes.To[i] });
  }
}

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

#endif
