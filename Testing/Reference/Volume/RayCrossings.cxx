// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "RayCrossings.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace meniscus::reference
{

namespace
{

// Clips the ray against the four widened half-spaces of a cell.
bool Clip(const ReferenceMesh& mesh, std::int64_t id, const Ray& ray, const Vector3& origin,
  Crossing& crossing)
{
  const CellPlanes& planes = mesh.GetPlanes(static_cast<std::size_t>(id));
  double begin = ray.Begin;
  double end = ray.End;
  double offset[4];
  double slope[4];
  for (int i = 0; i < 4; ++i)
  {
    offset[i] = Dot(planes.Gradient[i], origin) + planes.Offset[i];
    slope[i] = Dot(planes.Gradient[i], ray.Direction);
    const double widened = offset[i] + planes.Slack[i];
    const double at = -widened / slope[i];
    if (slope[i] > 0.0 && at > begin)
    {
      begin = at;
      crossing.NearFace = i;
    }
    else if (slope[i] < 0.0 && at < end)
    {
      end = at;
      crossing.FarFace = i;
    }
    if ((slope[i] == 0.0 && widened < 0.0) || !(begin < end))
    {
      return false;
    }
  }
  const std::int64_t* ids = mesh.GetCell(static_cast<std::size_t>(id));
  RaySegment& segment = crossing.Segment;
  segment = RaySegment{ begin, end, 0.0, 0.0, id };
  double low = mesh.GetScalar(ids[0]);
  double high = low;
  for (int i = 0; i < 4; ++i)
  {
    const double scalar = mesh.GetScalar(ids[i]);
    low = std::min(low, scalar);
    high = std::max(high, scalar);
    segment.ScalarBegin += scalar * (offset[i] + begin * slope[i]);
    segment.ScalarEnd += scalar * (offset[i] + end * slope[i]);
  }
  // The widening extrapolates in very flat cells.
  segment.ScalarBegin = std::min(std::max(segment.ScalarBegin, low), high);
  segment.ScalarEnd = std::min(std::max(segment.ScalarEnd, low), high);
  crossing.Inverted =
    mesh.GetKind(static_cast<std::size_t>(id)) == ReferenceMesh::CellKind::Inverted;
  return true;
}

// True if two cells have a common edge: a ray in it is in both, without any real overlap.
bool ShareAnEdge(const ReferenceMesh& mesh, std::int64_t a, std::int64_t b)
{
  int shared = 0;
  for (int i = 0; i < 4; ++i)
  {
    const std::int64_t* ids = mesh.GetCell(static_cast<std::size_t>(b));
    shared += std::count(ids, ids + 4, mesh.GetCell(static_cast<std::size_t>(a))[i]) > 0;
  }
  return shared >= 2;
}

// Sorts crossings in the order in which paths across shared faces meet them.
class FaceOrder
{
public:
  FaceOrder(const ReferenceMesh& mesh, const std::vector<Crossing>& crossings)
    : Mesh(mesh)
    , Crossings(crossings)
    , Visited(crossings.size(), 0)
  {
    for (std::size_t i = 0; i < crossings.size(); ++i)
    {
      this->IndexOf.emplace_back(crossings[i].Segment.Cell, i);
    }
    std::sort(this->IndexOf.begin(), this->IndexOf.end());
  }

  std::vector<std::size_t> GetOrder()
  {
    const std::size_t count = this->Crossings.size();
    std::vector<char> follows(count, 0);
    for (std::size_t i = 0; i < count; ++i)
    {
      const std::size_t next = this->Successor(i);
      if (next < count)
      {
        follows[next] = 1;
      }
    }
    std::vector<std::size_t> starts;
    for (std::size_t i = 0; i < count; ++i)
    {
      if (!follows[i])
      {
        starts.push_back(i);
      }
    }
    std::stable_sort(starts.begin(), starts.end(),
      [this](std::size_t a, std::size_t b) { return this->EntryDepth(a) < this->EntryDepth(b); });
    std::vector<std::size_t> sorted;
    for (const std::size_t start : starts)
    {
      this->Append(start, sorted);
    }
    // The remaining crossings are closed paths: they have no entry, and each of their inverted
    // cells cancels the part that another one covers.
    return sorted;
  }

private:
  double EntryDepth(std::size_t i) const
  {
    const Crossing& crossing = this->Crossings[i];
    return crossing.Inverted ? crossing.Segment.End : crossing.Segment.Begin;
  }

  void Append(std::size_t i, std::vector<std::size_t>& sorted)
  {
    for (; i < this->Crossings.size() && !this->Visited[i]; i = this->Successor(i))
    {
      this->Visited[i] = 1;
      sorted.push_back(i);
    }
  }

  // A path leaves an inverted cell at its near end.
  std::size_t Successor(std::size_t i) const
  {
    const Crossing& crossing = this->Crossings[i];
    const int face = crossing.Inverted ? crossing.NearFace : crossing.FarFace;
    return this->Across(4 * crossing.Segment.Cell + face, MostFlatCells);
  }

  // The crossing behind a face, through flat cells, which are never crossed themselves.
  std::size_t Across(std::int64_t cellFace, int flatCells) const
  {
    const std::int64_t other = this->Mesh.GetNeighbor(cellFace);
    if (other < 0)
    {
      return this->Crossings.size();
    }
    const std::int64_t cell = other / 4;
    const auto found = std::lower_bound(
      this->IndexOf.begin(), this->IndexOf.end(), std::make_pair(cell, std::size_t(0)));
    if (found != this->IndexOf.end() && found->first == cell)
    {
      return found->second;
    }
    const bool flat =
      this->Mesh.GetKind(static_cast<std::size_t>(cell)) == ReferenceMesh::CellKind::Flat;
    for (int face = 0; flat && flatCells > 0 && face < 4; ++face)
    {
      const std::size_t behind = 4 * cell + face == other
        ? this->Crossings.size()
        : this->Across(4 * cell + face, flatCells - 1);
      if (behind < this->Crossings.size())
      {
        return behind;
      }
    }
    return this->Crossings.size();
  }

  static constexpr int MostFlatCells = 4;

  const ReferenceMesh& Mesh;
  const std::vector<Crossing>& Crossings;
  std::vector<char> Visited;
  std::vector<std::pair<std::int64_t, std::size_t>> IndexOf;
};

} // anonymous namespace

//------------------------------------------------------------------------------
void FindCrossings(const ReferenceMesh& mesh, const ReferenceCellTree& tree, const Ray& ray,
  const CellTest* canBeSeen, std::vector<Crossing>& crossings)
{
  static thread_local std::vector<std::int64_t> candidates;
  candidates.clear();
  tree.Candidates(ray, candidates);
  const Vector3 origin{ ray.Origin[0] - mesh.GetCenter()[0], ray.Origin[1] - mesh.GetCenter()[1],
    ray.Origin[2] - mesh.GetCenter()[2] };
  crossings.clear();
  Crossing crossing;
  for (const std::int64_t id : candidates)
  {
    if ((!canBeSeen || (*canBeSeen)(id)) && Clip(mesh, id, ray, origin, crossing))
    {
      crossings.push_back(crossing);
    }
  }
  std::sort(crossings.begin(), crossings.end(),
    [](const Crossing& crossingA, const Crossing& crossingB)
    {
      const RaySegment& a = crossingA.Segment;
      const RaySegment& b = crossingB.Segment;
      return a.Begin != b.Begin ? a.Begin < b.Begin : a.Cell < b.Cell;
    });
}

//------------------------------------------------------------------------------
bool NeedsOrder(
  const ReferenceMesh& mesh, const std::vector<Crossing>& crossings, double negligible)
{
  const RaySegment* furthest = nullptr;
  for (const Crossing& crossing : crossings)
  {
    const RaySegment& segment = crossing.Segment;
    if (crossing.Inverted)
    {
      return true;
    }
    if (furthest && std::min(furthest->End, segment.End) - segment.Begin > negligible &&
      !ShareAnEdge(mesh, furthest->Cell, segment.Cell))
    {
      return true;
    }
    furthest = furthest && furthest->End >= segment.End ? furthest : &segment;
  }
  return false;
}

//------------------------------------------------------------------------------
void FindOrderedCrossings(const ReferenceMesh& mesh, const ReferenceCellTree& tree, const Ray& ray,
  const CellTest* canBeSeen, std::vector<Crossing>& crossings)
{
  Ray whole = ray;
  whole.Begin = -std::numeric_limits<double>::max();
  whole.End = std::numeric_limits<double>::max();
  std::vector<Crossing> found;
  FindCrossings(mesh, tree, whole, canBeSeen, found);
  crossings.clear();
  for (const std::size_t i : FaceOrder(mesh, found).GetOrder())
  {
    crossings.push_back(found[i]);
  }
}

} // namespace meniscus::reference
