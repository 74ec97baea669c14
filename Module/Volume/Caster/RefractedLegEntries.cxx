// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Caster/RefractedLegEntries.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace meniscus
{
namespace
{

constexpr int TileSize = RefractedRayTiles::TileSize;

/** Side length, in pixels, of a block of rays, which forms a bundle. */
constexpr int BlockSize = 8;
static_assert(BlockSize * BlockSize <= RayBundleEntries::LargestBundle, "a block is a bundle");

/**
 * Distance, in units of the frame, by which an entry may lie in front of the sight point if the leg
 * before reports that point outside of the mesh. Depths are rounded to 2^-24; along a ray that
 * leaves the boundary at an angle of 2^-12 this is 2^-12. A superfluous entry costs a few steps and
 * does not change the result.
 */
constexpr double StartMargin = 1.0 / 4096.0;

/** Larger than the relative rounding error of vertices by their grid. */
constexpr double BoxMargin = 1.0 + 1.0e-6;

constexpr double Infinity = std::numeric_limits<double>::infinity();

}

/** Part of a leg that is drawn, in steps behind the sight point. */
struct RefractedLegEntries::Part
{
  double Start;
  double End;
  /** True if it ends on the next interface. */
  bool ReachesInterface;
};

//------------------------------------------------------------------------------
RefractedLegEntries::RefractedLegEntries(const RefractedScene& scene, const TetrahedralMesh& mesh,
  const FixedPointRays& rays, const std::vector<RayClippingPlane>& clippingPlanes,
  const RayLegs& legs, const FrameOptics& optics, InstructionSet set)
  : Scene(scene)
  , Box(BoxOf(*scene.Tree, rays.GetFrame()))
  , Rays(rays)
  , ClippingPlanes(clippingPlanes)
  , Legs(legs)
{
  const glm::dmat3& edges = this->Box.HalfEdges;
  this->BallRadius =
    BoxMargin * glm::length(glm::abs(edges[0]) + glm::abs(edges[1]) + glm::abs(edges[2]));
  for (int k = 0; k < 3; ++k)
  {
    this->Areas[k] = glm::cross(edges[(k + 1) % 3], edges[(k + 2) % 3]);
    this->Extents[k] = BoxMargin * std::fabs(glm::dot(this->Areas[k], edges[k]));
  }
  this->Entries.reserve(RefractionFrames::Number);
  for (int index = 0; index < RefractionFrames::Number; ++index)
  {
    const RefractionFrame& frame = scene.Frames->Get(index);
    this->Entries.emplace_back(mesh, *scene.Tree, frame, set);
    const SurfaceLighting lighting =
      optics.Lighting ? frame.Turn(*optics.Lighting) : SurfaceLighting();
    FrameOptics turned = optics;
    turned.Lighting = optics.Lighting ? &lighting : nullptr;
    turned.GradientToFrame = frame.FromView * optics.GradientToFrame;
    this->Cast[static_cast<std::size_t>(index)].Set(frame.Rays, frame.Vertices, turned);
  }
}

//------------------------------------------------------------------------------
/**
 * True if the half-line may meet the box about the mesh. Tests the box's bounding sphere first,
 * then three separating axes, each perpendicular to the line and to an edge of the box.
 */
bool RefractedLegEntries::MayMeetMesh(const RayLeg& line) const
{
  const glm::dvec3& step = line.Step;
  const glm::dvec3 toCenter = this->Box.Center - line.Begin;
  const double along = glm::dot(toCenter, step);
  const double squared = glm::dot(step, step);
  const double excess = glm::dot(toCenter, toCenter) - this->BallRadius * this->BallRadius;
  if (excess > 0.0 && !(along > 0.0 && along * along >= excess * squared))
  {
    return false;
  }
  const glm::dmat3& edges = this->Box.HalfEdges;
  const glm::dvec3 across = glm::cross(toCenter, step);
  const double areas[3] = { std::fabs(glm::dot(step, this->Areas[0])),
    std::fabs(glm::dot(step, this->Areas[1])), std::fabs(glm::dot(step, this->Areas[2])) };
  for (int k = 0; k < 3; ++k)
  {
    // Along the cross product of step and edge k: the distance of the centre, and the extents of
    // the other two edges.
    const double distance = std::fabs(glm::dot(across, edges[k]));
    const double reach = areas[(k + 1) % 3] + areas[(k + 2) % 3];
    if (distance > reach * BoxMargin)
    {
      return false;
    }
  }
  return true;
}

//------------------------------------------------------------------------------
/** True if both ends of a leg lie beyond one side of the box about the mesh. */
bool RefractedLegEntries::IsBesideMesh(const RayLeg& line) const
{
  const glm::dvec3 toCenter = this->Box.Center - line.Begin;
  for (int k = 0; k < 3 && line.End < Infinity; ++k)
  {
    const glm::dvec3& normal = this->Areas[k];
    const double extent = this->Extents[k];
    const double begin = -glm::dot(normal, toCenter);
    const double end = begin + (line.End - line.Depth) * glm::dot(normal, line.Step);
    if (std::min(begin, end) > extent || std::max(begin, end) < -extent)
    {
      return true;
    }
  }
  return false;
}

//------------------------------------------------------------------------------
/** Computes the drawn part of a leg. Returns false if there is none. */
bool RefractedLegEntries::FindPart(
  const TileLeg& leg, std::int32_t pixel, const RayLeg& line, Part& part) const
{
  const RayFrame& frame = this->Rays.GetFrame();
  part.Start = std::max(0.0, frame.NearDepth - line.Depth);
  const double whole = line.End - line.Depth;
  part.End = whole;
  // A window depth of 1 means that nothing opaque is drawn there. The far plane bounds drawn
  // geometry, not refracted rays, so it is no limit.
  const int column = leg.Box.Left + pixel % TileSize;
  const int row = leg.Box.Bottom + pixel / TileSize;
  const float window =
    leg.OpaqueDepth ? leg.OpaqueDepth[std::int64_t{ row } * this->Rays.GetWidth() + column] : 1.0f;
  if (window < 1.0f)
  {
    part.End = std::min(part.End, frame.DepthAt(2.0 * window - 1.0) - line.Depth);
  }
  for (const RayClippingPlane& plane : this->ClippingPlanes)
  {
    ClipLine(plane, line.Begin, line.Step, part.Start, part.End);
  }
  part.ReachesInterface = whole < Infinity && part.End == whole;
  return part.Start < part.End;
}

//------------------------------------------------------------------------------
/** @param end place where the leg before ended: PacketResult::End. */
void RefractedLegEntries::AddLine(const RayLeg& leg, const Part& part, std::int32_t pixel,
  std::int32_t end, Workspace& workspace) const
{
  const int index = this->Scene.Frames->IndexOf(leg.Step);
  const RefractionFrame& frame = this->Scene.Frames->Get(index);
  Workspace::OfFrame& work = workspace.Frames[static_cast<std::size_t>(index)];
  const glm::dvec3 place = frame.FromView * leg.Begin;
  const glm::dvec3 step = frame.FromView * leg.Step;
  const double sight = place.z;
  const auto number = static_cast<std::int32_t>(work.Lines.size());

  RayBundleEntries::Line line;
  line.Of = FrameLine::Through(place, step);
  line.Ray = frame.Rays.RayAlong(line.Of.Origin, line.Of.Slope);
  line.Ray.StartDepth = frame.Rays.FromPivot(sight + part.Start * step.z);
  line.Ray.EndDepth = frame.Rays.FromPivot(sight + part.End * step.z);
  PacketEntry entry;
  line.EntersInside = end >= 0 && this->Scene.BeginsInside &&
    this->Entries[static_cast<std::size_t>(index)].FindEntryNear(end, line.Ray, sight, entry);
  if (line.EntersInside)
  {
    work.Hits.push_back({ number, entry });
  }
  const bool known = line.EntersInside || end == PacketResult::Outside;
  line.From = known ? sight - StartMargin : -frame.Extent;
  work.Lines.push_back(line);
  work.Origins.push_back({ pixel, part.ReachesInterface });
  work.Bundles[known ? 0 : 1].push_back(number);
}

//------------------------------------------------------------------------------
/**
 * Adds the line of a pixel, if it has one that may be seen. The end of a line that is not cast
 * because it misses the mesh is outside of the mesh; if the line is cut off, nothing is known.
 */
void RefractedLegEntries::CollectPixel(const TileLeg& leg, const PacketJob& job, std::int32_t pixel,
  JoinedRays& joined, Workspace& workspace) const
{
  RayLeg line;
  if (joined.IsHidden(pixel, job) || !this->Legs.Find(leg.Tile, pixel, leg.Number, line))
  {
    return;
  }
  const std::int32_t end = joined.GetEnd(pixel);
  joined.SetEnd(pixel, PacketResult::Outside);
  // A leg whose beginning is not known to be outside is walked from the boundary in front of it.
  if (!this->MayMeetMesh(line) || (end == PacketResult::Outside && this->IsBesideMesh(line)))
  {
    return;
  }
  Part part;
  if (this->FindPart(leg, pixel, line, part))
  {
    this->AddLine(line, part, pixel, end, workspace);
  }
  else
  {
    joined.SetEnd(pixel, PacketResult::Somewhere);
  }
}

//------------------------------------------------------------------------------
void RefractedLegEntries::CollectBlock(Workspace& workspace) const
{
  for (std::size_t index = 0; index < workspace.Frames.size(); ++index)
  {
    Workspace::OfFrame& work = workspace.Frames[index];
    for (std::vector<std::int32_t>& bundle : work.Bundles)
    {
      this->Entries[index].Collect(work.Lines, bundle, workspace.Faces, work.Hits);
      bundle.clear();
    }
  }
}

//------------------------------------------------------------------------------
void RefractedLegEntries::Collect(
  const TileLeg& leg, const PacketJob& job, JoinedRays& joined, Workspace& workspace) const
{
  for (Workspace::OfFrame& work : workspace.Frames)
  {
    work.Lines.clear();
    work.Origins.clear();
    work.Hits.clear();
    work.RetryLines.clear();
  }
  for (int block = 0; block < TileSize * TileSize; block += BlockSize * BlockSize)
  {
    const int corner = block / (TileSize * BlockSize) * TileSize * BlockSize +
      block % (TileSize * BlockSize) / BlockSize;
    for (int i = 0; i < BlockSize * BlockSize; ++i)
    {
      this->CollectPixel(
        leg, job, corner + i / BlockSize * TileSize + i % BlockSize, joined, workspace);
    }
    this->CollectBlock(workspace);
  }
}

//------------------------------------------------------------------------------
/** Collects the entries on the boundary of the lines that were taken back. */
void RefractedLegEntries::CollectAgain(int frame, Workspace& workspace) const
{
  Workspace::OfFrame& work = workspace.Frames[static_cast<std::size_t>(frame)];
  for (const std::int32_t number : work.RetryLines)
  {
    RayBundleEntries::Line& line = work.Lines[static_cast<std::size_t>(number)];
    line.EntersInside = false;
    line.From = -this->Scene.Frames->Get(frame).Extent;
    this->Entries[static_cast<std::size_t>(frame)].Collect(
      work.Lines, { number }, workspace.Faces, work.Hits);
  }
  work.RetryLines.clear();
}

//------------------------------------------------------------------------------
const LegBatch* RefractedLegEntries::NextBatch(int frame, Workspace& workspace) const
{
  this->CollectAgain(frame, workspace);
  Workspace::OfFrame& work = workspace.Frames[static_cast<std::size_t>(frame)];
  if (work.Hits.empty())
  {
    return nullptr;
  }
  std::sort(work.Hits.begin(), work.Hits.end(),
    [](const RayBundleEntries::Hit& a, const RayBundleEntries::Hit& b)
    {
      return std::tie(a.Line, a.Entry.Depth, a.Entry.CellFace) <
        std::tie(b.Line, b.Entry.Depth, b.Entry.CellFace);
    });
  LegBatch& batch = workspace.Batch;
  batch.Clear();
  workspace.Lines.clear();
  workspace.Entries.clear();
  for (const RayBundleEntries::Hit& hit : work.Hits)
  {
    if (workspace.Lines.empty() || hit.Line != workspace.Lines.back())
    {
      workspace.Lines.push_back(hit.Line);
      batch.Origins.push_back(work.Origins[static_cast<std::size_t>(hit.Line)]);
      batch.Rays.push_back(work.Lines[static_cast<std::size_t>(hit.Line)].Ray);
      batch.Rays.back().FirstEntry = static_cast<std::int32_t>(workspace.Entries.size());
    }
    workspace.Entries.push_back(hit.Entry);
    batch.Rays.back().EndEntry = static_cast<std::int32_t>(workspace.Entries.size());
  }
  batch.Entries = workspace.Entries.data();
  work.Hits.clear();
  return &batch;
}

//------------------------------------------------------------------------------
bool RefractedLegEntries::TakeBack(int frame, std::size_t ray, Workspace& workspace) const
{
  Workspace::OfFrame& work = workspace.Frames[static_cast<std::size_t>(frame)];
  const std::int32_t line = workspace.Lines[ray];
  if (!work.Lines[static_cast<std::size_t>(line)].EntersInside)
  {
    return false;
  }
  work.RetryLines.push_back(line);
  return true;
}

}
