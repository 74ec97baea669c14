// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Caster/RefractedRayCaster.h"
#include "Simd/InstructionSets.h"
#include "Volume/Packet/Data/PacketJob.h"
#include "Volume/Packet/Kernels/KeptValues.h"
#include "Volume/Packet/Kernels/PacketKernels.h"

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

constexpr int TileSize = RefractedRayField::TileSize;
static_assert(TileSize == BoundaryRaster::TileSize, "the same tiles");

/** Side length, in pixels, of a block of rays, which forms a bundle. */
constexpr int BlockSize = 8;
static_assert(BlockSize * BlockSize <= RayBundleEntries::LargestBundle, "a block is a bundle");

/**
 * Distance, in units of the frame, by which an entry may lie in front of the sight point if the
 * straight ray reports that point outside of the mesh. Depths are rounded to 2^-24; along a ray
 * that leaves the boundary at an angle of 2^-12 this is 2^-12. A superfluous entry costs a few
 * steps and does not change the result.
 */
constexpr double StartMargin = 1.0 / 4096.0;

/** Larger than the relative rounding error of vertices by their grid. */
constexpr double BoxMargin = 1.0 + 1.0e-6;

constexpr double Infinity = std::numeric_limits<double>::infinity();

}

/** Part of the refracted ray that is drawn. */
struct RefractedRayCaster::Part
{
  glm::dvec3 SightPoint;
  glm::dvec3 Step;
  /** Bounds of the part in steps behind the sight point. */
  double Start;
  double End;
};

//------------------------------------------------------------------------------
void StraightPart::Clear(BlendMode mode, std::int32_t end)
{
  constexpr std::size_t pixels = RefractedRayField::RaysOfTile;
  float empty[4];
  ClearValues(mode, empty);
  this->Values.assign(pixels, { empty[0], empty[1], empty[2], empty[3] });
  this->Ends.assign(pixels, end);
  this->Steps.assign(pixels, 0);
}

//------------------------------------------------------------------------------
RefractedRayCaster::RefractedRayCaster(const RefractedScene& scene, const TetrahedralMesh& mesh,
  const FixedPointRays& view, const std::vector<RayClippingPlane>& clippingPlanes,
  const RefractedOptics& optics, InstructionSet set)
  : Scene(scene)
  , Box(scene.Sight->GetView().Mesh)
  , View(view)
  , ClippingPlanes(clippingPlanes)
  , Lit(optics.Lighting != nullptr)
  , Set(set)
{
  const glm::dmat3& edges = this->Box.HalfEdges;
  this->BallRadius =
    BoxMargin * glm::length(glm::abs(edges[0]) + glm::abs(edges[1]) + glm::abs(edges[2]));
  this->Entries.reserve(RefractionFrames::Number);
  for (int index = 0; index < RefractionFrames::Number; ++index)
  {
    const RefractionFrame& frame = scene.Frames->Get(index);
    this->Entries.emplace_back(mesh, *scene.Tree, frame, set);
    Optics& turned = this->OpticsOf[static_cast<std::size_t>(index)];
    turned.Lighting = this->Lit ? frame.Turn(*optics.Lighting) : SurfaceLighting();
    turned.GradientToFrame = frame.FromView * optics.GradientToFrame;
    turned.Medium.Pack(this->Lit ? &turned.Lighting : nullptr, turned.GradientToFrame,
      optics.GradientMagnitude, optics.GradientOpacity);
  }
}

//------------------------------------------------------------------------------
/**
 * True if the half-line may meet the box about the mesh. Tests the box's bounding sphere first,
 * then three separating axes, each perpendicular to the line and to an edge of the box.
 */
bool RefractedRayCaster::MayMeetMesh(const glm::dvec3& sightPoint, const glm::dvec3& step) const
{
  const glm::dvec3 toCenter = this->Box.Center - sightPoint;
  const double along = glm::dot(toCenter, step);
  const double squared = glm::dot(step, step);
  const double excess = glm::dot(toCenter, toCenter) - this->BallRadius * this->BallRadius;
  if (excess > 0.0 && !(along > 0.0 && along * along >= excess * squared))
  {
    return false;
  }
  const glm::dmat3& edges = this->Box.HalfEdges;
  const glm::dvec3 across = glm::cross(toCenter, step);
  const glm::dvec3 areas[3] = { glm::cross(edges[1], edges[2]), glm::cross(edges[2], edges[0]),
    glm::cross(edges[0], edges[1]) };
  for (int k = 0; k < 3; ++k)
  {
    // Along the cross product of step and edge k: the distance of the centre, and the extents of
    // the other two edges.
    const double distance = std::fabs(glm::dot(across, edges[k]));
    const double reach =
      std::fabs(glm::dot(step, areas[(k + 1) % 3])) + std::fabs(glm::dot(step, areas[(k + 2) % 3]));
    if (distance > reach * BoxMargin)
    {
      return false;
    }
  }
  return true;
}

//------------------------------------------------------------------------------
/** Computes the drawn part of a refracted ray. Returns false if there is none. */
bool RefractedRayCaster::FindPart(const BoundaryRaster::PixelBox& box, std::int32_t pixel,
  const RefractedRay& refracted, const float* opaqueDepth, Part& part) const
{
  const int column = box.Left + pixel % TileSize;
  const int row = box.Bottom + pixel / TileSize;
  const RayFrame& frame = this->View.GetFrame();
  const glm::dvec2 place = this->View.FromCenter(column, row);
  const glm::dvec2 across =
    frame.Origin.At(place.x, place.y) + refracted.Depth * frame.Slope.At(place.x, place.y);
  part.SightPoint = glm::dvec3(across, refracted.Depth);
  part.Step = refracted.Step;
  if (!this->MayMeetMesh(part.SightPoint, part.Step))
  {
    return false;
  }
  part.Start = std::max(0.0, frame.NearDepth - refracted.Depth);
  part.End = Infinity;
  // A window depth of 1 means that nothing opaque is drawn there. The far plane bounds drawn
  // geometry, not refracted rays, so it is no limit.
  const float window =
    opaqueDepth ? opaqueDepth[std::int64_t{ row } * this->View.GetWidth() + column] : 1.0f;
  if (window < 1.0f)
  {
    part.End = frame.DepthAt(2.0 * window - 1.0) - refracted.Depth;
  }
  for (const RayClippingPlane& plane : this->ClippingPlanes)
  {
    ClipLine(plane, part.SightPoint, part.Step, part.Start, part.End);
  }
  return part.Start < part.End;
}

//------------------------------------------------------------------------------
/** @param end place where the straight ray ended: PacketResult::End. */
void RefractedRayCaster::AddLine(
  const Part& part, std::int32_t pixel, std::int32_t end, Workspace& workspace) const
{
  const int index = this->Scene.Frames->IndexOf(part.Step);
  const RefractionFrame& frame = this->Scene.Frames->Get(index);
  Workspace::OfFrame& work = workspace.Frames[static_cast<std::size_t>(index)];
  const glm::dvec3 place = frame.FromView * part.SightPoint;
  const glm::dvec3 step = frame.FromView * part.Step;
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
  work.Pixels.push_back(pixel);
  work.Bundles[known ? 0 : 1].push_back(number);
}

//------------------------------------------------------------------------------
void RefractedRayCaster::CollectBlock(Workspace& workspace) const
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
RayStatistics RefractedRayCaster::Cast(PacketJob job, const BoundaryRaster::PixelBox& box,
  const RefractedRay* rays, const float* opaqueDepth, Workspace& workspace, float* image) const
{
  StraightPart& straight = workspace.Straight;
  for (Workspace::OfFrame& work : workspace.Frames)
  {
    work.Lines.clear();
    work.Pixels.clear();
    work.Hits.clear();
    work.RetryLines.clear();
  }
  const bool hides = GetBlendModel(job.Blending).HidesBehind();
  for (int block = 0; block < TileSize * TileSize; block += BlockSize * BlockSize)
  {
    const int corner = block / (TileSize * BlockSize) * TileSize * BlockSize +
      block % (TileSize * BlockSize) / BlockSize;
    for (int i = 0; i < BlockSize * BlockSize; ++i)
    {
      const int pixel = corner + i / BlockSize * TileSize + i % BlockSize;
      const bool hidden = hides &&
        !(straight.Values[static_cast<std::size_t>(pixel)][3] > job.TerminationTransmittance);
      Part part;
      if (rays[pixel].GoesOn() && !hidden && this->Scene.Part != MembranePart::InFront &&
        this->FindPart(box, pixel, rays[pixel], opaqueDepth, part))
      {
        this->AddLine(part, pixel, straight.Ends[static_cast<std::size_t>(pixel)], workspace);
      }
    }
    this->CollectBlock(workspace);
  }
  RayStatistics sums;
  for (int index = 0; index < RefractionFrames::Number; ++index)
  {
    this->CastFrame(job, index, workspace, sums);
    if (!workspace.Frames[static_cast<std::size_t>(index)].RetryLines.empty())
    {
      this->CastAgain(job, index, workspace, sums);
    }
  }
  this->Finish(job, box, straight, image, sums);
  return sums;
}

//------------------------------------------------------------------------------
void RefractedRayCaster::CastFrame(
  const PacketJob& base, int frame, Workspace& workspace, RayStatistics& sums) const
{
  Workspace::OfFrame& work = workspace.Frames[static_cast<std::size_t>(frame)];
  std::sort(work.Hits.begin(), work.Hits.end(),
    [](const RayBundleEntries::Hit& a, const RayBundleEntries::Hit& b)
    {
      return std::tie(a.Line, a.Entry.Depth, a.Entry.CellFace) <
        std::tie(b.Line, b.Entry.Depth, b.Entry.CellFace);
    });
  workspace.Rays.clear();
  workspace.Lines.clear();
  workspace.Entries.clear();
  for (const RayBundleEntries::Hit& hit : work.Hits)
  {
    if (workspace.Lines.empty() || hit.Line != workspace.Lines.back())
    {
      workspace.Lines.push_back(hit.Line);
      workspace.Rays.push_back(work.Lines[static_cast<std::size_t>(hit.Line)].Ray);
      workspace.Rays.back().FirstEntry = static_cast<std::int32_t>(workspace.Entries.size());
    }
    workspace.Entries.push_back(hit.Entry);
    workspace.Rays.back().EndEntry = static_cast<std::int32_t>(workspace.Entries.size());
  }
  if (workspace.Rays.empty())
  {
    return;
  }
  const RefractionFrame& turned = this->Scene.Frames->Get(frame);
  PacketJob job = base;
  const Optics& optics = this->OpticsOf[static_cast<std::size_t>(frame)];
  job.GradientToFrame = &optics.GradientToFrame;
  job.Lighting = this->Lit ? &optics.Lighting : nullptr;
  job.Medium = base.Medium ? optics.Medium.Get() : nullptr;
  job.Vertices = turned.Vertices.data();
  job.GridUnit = turned.Rays.GetGridUnit();
  job.Pivot = turned.Rays.GetPivot();
  job.Rays = workspace.Rays.data();
  job.NumberOfRays = static_cast<std::int32_t>(workspace.Rays.size());
  job.Entries = workspace.Entries.data();
  workspace.Results.resize(workspace.Rays.size());
  job.Results = workspace.Results.data();
  CastPackets(job, this->Set);
  this->Join(job, work, workspace, sums);
}

//------------------------------------------------------------------------------
/** Casts again, from the boundary, the rays whose walk from the inside did not reach it. */
void RefractedRayCaster::CastAgain(
  const PacketJob& job, int frame, Workspace& workspace, RayStatistics& sums) const
{
  Workspace::OfFrame& work = workspace.Frames[static_cast<std::size_t>(frame)];
  work.Hits.clear();
  for (const std::int32_t number : work.RetryLines)
  {
    RayBundleEntries::Line& line = work.Lines[static_cast<std::size_t>(number)];
    line.EntersInside = false;
    line.From = -this->Scene.Frames->Get(frame).Extent;
    this->Entries[static_cast<std::size_t>(frame)].Collect(
      work.Lines, { number }, workspace.Faces, work.Hits);
  }
  work.RetryLines.clear();
  this->CastFrame(job, frame, workspace, sums);
}

//------------------------------------------------------------------------------
void RefractedRayCaster::Join(
  const PacketJob& job, Workspace::OfFrame& work, Workspace& workspace, RayStatistics& sums) const
{
  for (std::size_t i = 0; i < workspace.Results.size(); ++i)
  {
    const PacketResult& result = workspace.Results[i];
    const auto line = static_cast<std::size_t>(workspace.Lines[i]);
    const auto pixel = static_cast<std::size_t>(work.Pixels[line]);
    workspace.Straight.Steps[pixel] += result.Steps;
    if (result.Lost != 0 && work.Lines[line].EntersInside)
    {
      work.RetryLines.push_back(workspace.Lines[i]);
      continue;
    }
    float values[4];
    std::copy_n(workspace.Straight.Values[pixel].data(), 4, values);
    JoinValues(job.Blending, result.Color, values);
    std::copy_n(values, 4, workspace.Straight.Values[pixel].data());
    sums.Lost += result.Lost;
  }
}

//------------------------------------------------------------------------------
void RefractedRayCaster::Finish(const PacketJob& job, const BoundaryRaster::PixelBox& box,
  const StraightPart& values, float* image, RayStatistics& sums) const
{
  for (int row = box.Bottom; row < box.Top; ++row)
  {
    for (int column = box.Left; column < box.Right; ++column)
    {
      const auto pixel =
        static_cast<std::size_t>((row - box.Bottom) * TileSize + column - box.Left);
      const std::int32_t steps = values.Steps[pixel];
      if (steps == 0)
      {
        continue;
      }
      sums.Steps += steps;
      ++sums.Rays;
      float kept[4];
      float color[4];
      std::copy_n(values.Values[pixel].data(), 4, kept);
      FinishValues(job, kept, color);
      std::copy_n(color, 4, image + 4 * (std::int64_t{ row } * this->View.GetWidth() + column));
    }
  }
}

}
