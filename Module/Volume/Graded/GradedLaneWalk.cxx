// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Walk of many rays, one per lane. Steps that lanes cannot take are steps of the ray alone.
#include "Volume/Graded/GradedRayWalk.h"

#include "Volume/Graded/GradedLanes.h"
#include "Volume/Graded/GradedRayPath.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <utility>

namespace meniscus
{

class GradedRayWalk::LaneWalk
{
public:
  LaneWalk(const GradedRayWalk& walk, const std::vector<GradedRay>& rays,
    GradedRayStatistics& statistics, GradedRayResult* results, const EntryFaces* faces,
    const GradedWatch* watch)
    : Walk(walk)
    , Rays(rays)
    , Faces(faces)
    , Watch(watch)
    , Statistics(statistics)
    , Results(results)
  {
  }

  void Run(InstructionSet set)
  {
    GradedLanes& lanes = this->Lanes;
    lanes.Table = &this->Walk.Medium.Table->GetRow(0);
    lanes.Watched = this->Watch ? this->Watch->Cells->data() : nullptr;
    lanes.Impassable = &GetImpassableRow();
    std::fill_n(lanes.Rows, GradedLanes::Size, lanes.Table);
    while (lanes.Count < GradedLanes::Size && this->BeginNext(lanes.Count))
    {
      ++lanes.Count;
    }
    while (lanes.Count > 0)
    {
      this->StopLanes();
      StepLanes(lanes, set);
      ++this->Round;
      // The last lane takes the place of one that ends: it has had its turn.
      for (int i = lanes.WaitingCount - 1; i >= 0; --i)
      {
        const int lane = lanes.Waiting[i];
        const std::int32_t exit = lanes.Exit[lane];
        if (!(exit >= 0 ? this->Leave(lane, exit) : this->GoOn(lane)) && !this->BeginNext(lane))
        {
          this->MoveLane(--lanes.Count, lane);
        }
      }
    }
  }

private:
  /** Row of a cell that lanes cannot pass, which watched cells have. */
  static const GradedCellRow& GetImpassableRow()
  {
    static const GradedCellRow none = []
    {
      GradedCellRow row{};
      std::fill_n(
        row.Values + GradedCellRow::Gradients, 9, std::numeric_limits<double>::quiet_NaN());
      return row;
    }();
    return none;
  }

  bool IsWatched(std::int64_t cell) const
  {
    return this->Watch && (*this->Watch->Cells)[static_cast<std::size_t>(cell)] != 0;
  }

  /** Lets the lanes stay that have taken the largest number of steps. */
  void StopLanes()
  {
    if (this->Round < this->FirstLastRound)
    {
      return;
    }
    this->FirstLastRound = std::numeric_limits<std::int64_t>::max();
    for (int lane = 0; lane < this->Lanes.Count; ++lane)
    {
      const std::int64_t last = this->LastRounds[lane];
      if (this->Round >= last)
      {
        this->Lanes.Rows[lane] = &GetImpassableRow();
      }
      else
      {
        this->FirstLastRound = std::min(this->FirstLastRound, last);
      }
    }
  }

  /** Begins with the next ray that meets the mesh. Returns false if there is none. */
  bool BeginNext(int lane)
  {
    while (this->Next < this->Rays.size())
    {
      GradedRayResult& result = this->Results[this->Next];
      const GradedRay& ray = this->Rays[this->Next];
      result = GradedRayResult();
      const std::size_t number = this->Next++;
      if (!this->Watch && this->Faces && this->Faces->GetFirst(number) < 0 &&
        !this->Walk.MayBeInside(ray.Origin))
      {
        result.Entry = result.Exit = ray.Origin;
        result.Direction = glm::normalize(ray.Direction);
        continue;
      }
      Path& path = this->Paths[lane];
      path.Restart();
      path.SetFaces(this->Faces, number);
      path.Visitor = this->Watch ? this->Watch->Visitors[number] : nullptr;
      if (!this->Walk.Begin(ray, result, this->Statistics, path))
      {
        this->Walk.Finish(path);
        continue;
      }
      this->Lanes.ShortSteps[lane] = 0.0;
      if (this->Settle(lane))
      {
        return true;
      }
    }
    return false;
  }

  /** Takes the ray out of the mesh by the face to which the lane has moved it. */
  bool Leave(int lane, int face)
  {
    Path& path = this->Paths[lane];
    std::int32_t& link = this->Lanes.Links[lane];
    link = (link & ~3) | face;
    this->Take(lane, this->Round);
    if (this->Walk.LeaveMesh(face, path) && !this->Walk.EnterMesh(path))
    {
      this->Walk.Finish(path);
      return false;
    }
    return this->Settle(lane);
  }

  /**
   * Takes a step of the ray alone, and those through watched cells that follow. Returns false if
   * the ray has ended.
   */
  bool GoOn(int lane)
  {
    this->Take(lane, this->Round - 1);
    Path& path = this->Paths[lane];
    double& shortSteps = this->Lanes.ShortSteps[lane];
    // The search of a zigzag begins anew, and is not to be interrupted.
    const bool isSearching = shortSteps >= GradedLanes::MostShortSteps;
    do
    {
      if (!this->Walk.Advance(path))
      {
        this->Walk.Finish(path);
        return false;
      }
    } while ((isSearching && path.IsShort) || this->IsWatched(path.Cell));
    shortSteps = path.IsShort ? shortSteps + 1.0 : 0.0;
    return this->Settle(lane);
  }

  /** Gives the path to the lane, after steps that lanes know nothing of. */
  bool Settle(int lane)
  {
    Path& path = this->Paths[lane];
    while (path.Place.Entry < 0 || path.Constraints > 0)
    {
      if (!this->Walk.Advance(path))
      {
        this->Walk.Finish(path);
        return false;
      }
    }
    GradedLanes& lanes = this->Lanes;
    const glm::dvec3 place = this->Walk.PlaceOf(path);
    for (int axis = 0; axis < 3; ++axis)
    {
      lanes.Place[axis][lane] = place[axis];
      lanes.Momentum[axis][lane] = path.Momentum[axis];
      lanes.Weights[axis][lane] = path.Place.Weights[axis + (axis >= path.Place.Entry ? 1 : 0)];
    }
    lanes.Links[lane] = static_cast<std::int32_t>(4 * path.Cell + path.Place.Entry);
    lanes.OpticalPath[lane] = 0.0;
    lanes.Rows[lane] = this->IsWatched(path.Cell) ? lanes.Impassable : lanes.Table + path.Cell;
    Fetch(*lanes.Rows[lane]);
    this->LastRounds[lane] = this->Round + this->Walk.MaximumNumberOfSteps - path.Steps;
    this->FirstLastRound = std::min(this->FirstLastRound, this->LastRounds[lane]);
    return true;
  }

  /** Gives the lane's steps before a round to its path. */
  void Take(int lane, std::int64_t round)
  {
    Path& path = this->Paths[lane];
    const GradedLanes& lanes = this->Lanes;
    const std::int64_t steps =
      this->Walk.MaximumNumberOfSteps - path.Steps - (this->LastRounds[lane] - round);
    if (steps == 0)
    {
      return;
    }
    path.ForgetZigzag();
    path.Cell = lanes.Links[lane] / 4;
    path.Place.Entry = lanes.Links[lane] % 4;
    path.Place.Weights.fill(0.0);
    for (int axis = 0; axis < 3; ++axis)
    {
      path.Momentum[axis] = lanes.Momentum[axis][lane];
      path.Place.Weights[axis + (axis >= path.Place.Entry ? 1 : 0)] = lanes.Weights[axis][lane];
    }
    path.Result->OpticalPath += lanes.OpticalPath[lane];
    path.Steps += steps;
    this->Statistics.LaneSteps += steps;
  }

  void MoveLane(int from, int to)
  {
    if (from == to)
    {
      return;
    }
    GradedLanes& lanes = this->Lanes;
    for (int axis = 0; axis < 3; ++axis)
    {
      lanes.Place[axis][to] = lanes.Place[axis][from];
      lanes.Momentum[axis][to] = lanes.Momentum[axis][from];
      lanes.Weights[axis][to] = lanes.Weights[axis][from];
    }
    for (double* const values : { lanes.OpticalPath, lanes.ShortSteps })
    {
      values[to] = values[from];
    }
    lanes.Links[to] = lanes.Links[from];
    lanes.Rows[to] = lanes.Rows[from];
    std::swap(this->Paths[to], this->Paths[from]);
    this->LastRounds[to] = this->LastRounds[from];
  }

  const GradedRayWalk& Walk;
  const std::vector<GradedRay>& Rays;
  const EntryFaces* Faces;
  const GradedWatch* Watch;
  GradedRayStatistics& Statistics;
  GradedRayResult* Results;
  std::size_t Next = 0;

  GradedLanes Lanes{};
  Path Paths[GradedLanes::Size];
  /** Number of rounds of steps up to now. */
  std::int64_t Round = 0;
  /** Rounds after which the lanes have taken the largest number of steps, and the first of them. */
  std::int64_t LastRounds[GradedLanes::Size] = {};
  std::int64_t FirstLastRound = std::numeric_limits<std::int64_t>::max();
};

//------------------------------------------------------------------------------
void GradedRayWalk::WalkAll(const std::vector<GradedRay>& rays, GradedRayStatistics& statistics,
  GradedRayResult* results, InstructionSet set, const EntryFaces* faces,
  const GradedWatch* watch) const
{
  if (this->Medium.Table && !this->Medium.IsStraight)
  {
    LaneWalk(*this, rays, statistics, results, faces, watch).Run(set);
    return;
  }
  for (std::size_t i = 0; i < rays.size(); ++i)
  {
    Path path;
    path.SetFaces(faces, i);
    path.Visitor = watch ? watch->Visitors[i] : nullptr;
    results[i] = this->WalkToEnd(rays[i], statistics, path);
  }
}

}
