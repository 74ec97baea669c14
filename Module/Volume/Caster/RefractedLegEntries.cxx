// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Caster/RefractedLegEntries.h"

#include <algorithm>
#include <limits>

namespace meniscus
{
namespace
{

constexpr int TileSize = RefractedRayTiles::TileSize;
static_assert(LegBlock::Size == LineBlock::Size, "lines of a square fill a block");
static_assert(LegBlock::Side == RefractedRayTiles::SquareSize, "legs of a square fill a block");

constexpr double Infinity = std::numeric_limits<double>::infinity();

}

//------------------------------------------------------------------------------
void RefractedLegEntries::Workspace::Group::Clear()
{
  this->NumberOfBlocks = 0;
  this->HasEntries = false;
  this->IsTaken = false;
  this->Origins.clear();
  this->EntriesInside.clear();
}

//------------------------------------------------------------------------------
/** Appends a block; its lines have to be set. */
LineBlock& RefractedLegEntries::Workspace::Group::AddBlock()
{
  if (this->NumberOfBlocks == this->Blocks.size())
  {
    this->Blocks.emplace_back();
  }
  LineBlock& block = this->Blocks[this->NumberOfBlocks++];
  block.Count = 0;
  this->Origins.resize(LineBlock::Size * this->NumberOfBlocks);
  return block;
}

//------------------------------------------------------------------------------
RefractedLegEntries::RefractedLegEntries(const RefractedScene& scene, const TetrahedralMesh& mesh,
  const FixedPointRays& rays, const std::vector<RayClippingPlane>& clippingPlanes,
  const RayLegs& legs, const FrameOptics& optics, InstructionSet set)
  : Scene(scene)
  , Box(BoxOf(*scene.Tree, rays.GetFrame()))
  , Rays(rays)
  , ClippingPlanes(clippingPlanes)
  , Legs(legs)
  , Set(set)
{
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
/** Computes the drawn parts of the legs of a square. */
void RefractedLegEntries::SetParts(const TileLeg& leg, LegBlock& legs) const
{
  const RayFrame& frame = this->Rays.GetFrame();
  double opaque[LegBlock::Size];
  std::fill_n(opaque, LegBlock::Size, Infinity);
  for (int i = 0; leg.OpaqueDepth && i < LegBlock::Size; ++i)
  {
    // A window depth of 1 means that nothing opaque is drawn there. The far plane bounds drawn
    // geometry, not refracted rays, so it is no limit. Rays outside of the image do not exist.
    const int column = leg.Box.Left + legs.Pixel[i] % TileSize;
    const int row = leg.Box.Bottom + legs.Pixel[i] / TileSize;
    const float window = legs.Exists[i] != 0
      ? leg.OpaqueDepth[std::int64_t{ row } * this->Rays.GetWidth() + column]
      : 1.0f;
    if (window < 1.0f)
    {
      opaque[i] = frame.DepthAt(2.0 * window - 1.0);
    }
  }
  for (int i = 0; i < LegBlock::Size; ++i)
  {
    legs.DrawnFrom[i] = std::max(0.0, frame.NearDepth - legs.Depth[i]);
    legs.DrawnTo[i] = std::min(legs.End[i], opaque[i]) - legs.Depth[i];
  }
  for (const RayClippingPlane& plane : this->ClippingPlanes)
  {
    for (int i = 0; i < LegBlock::Size; ++i)
    {
      const RayLeg line = legs.Get(i);
      ClipLine(plane, line.Begin, line.Step, legs.DrawnFrom[i], legs.DrawnTo[i]);
    }
  }
}

//------------------------------------------------------------------------------
/**
 * Keeps the legs of a square that may be seen. The end of a leg that is not cast because it misses
 * the mesh is outside of the mesh; if the leg is cut off, nothing is known.
 */
void RefractedLegEntries::SiftLegs(
  const TileLeg& leg, const PacketJob& job, JoinedRays& joined, Workspace& workspace) const
{
  LegBlock& legs = workspace.Legs;
  TestLegs(this->Box, this->Set, legs);
  this->SetParts(leg, legs);
  const int count = legs.Count;
  legs.Count = 0;
  for (int i = 0; i < count; ++i)
  {
    const std::int32_t pixel = legs.Pixel[i];
    if (legs.Exists[i] == 0 || joined.IsHidden(pixel, job))
    {
      continue;
    }
    const std::int32_t end = joined.GetEnd(pixel);
    joined.SetEnd(pixel, PacketResult::Outside);
    // A leg whose beginning is not known to be outside is walked from the boundary in front of it.
    if (legs.MayMeet[i] == 0 || (end == PacketResult::Outside && legs.IsBeside[i] != 0))
    {
      continue;
    }
    if (legs.DrawnFrom[i] < legs.DrawnTo[i])
    {
      const auto kept = static_cast<std::size_t>(legs.Count);
      workspace.Origins[kept] = { pixel,
        legs.End[i] < Infinity && legs.DrawnTo[i] == legs.End[i] - legs.Depth[i] };
      workspace.Ends[kept] = end;
      if (legs.Count != i)
      {
        legs.Copy(legs.Count, legs, i);
      }
      ++legs.Count;
    }
    else
    {
      joined.SetEnd(pixel, PacketResult::Somewhere);
    }
  }
}

//------------------------------------------------------------------------------
/**
 * Finds the face by which a leg enters the cell that contains its beginning. Returns false if the
 * cell is not known.
 * @param end place where the leg before ended: PacketResult::End.
 */
bool RefractedLegEntries::FindEntryInside(
  const LegBlock& legs, int ray, std::int32_t end, PacketEntry& entry) const
{
  if (end < 0 || !this->Scene.BeginsInside)
  {
    return false;
  }
  const auto index = static_cast<std::size_t>(legs.Frame[ray]);
  const RefractionFrame& frame = this->Scene.Frames->Get(static_cast<int>(index));
  const RayLeg leg = legs.Get(ray);
  const glm::dvec3 place = frame.FromView * leg.Begin;
  const FrameLine line = FrameLine::Through(place, frame.FromView * leg.Step);
  return this->Entries[index].FindEntryNear(
    end, frame.Rays.RayAlong(line.Origin, line.Slope), place.z, entry);
}

//------------------------------------------------------------------------------
/** Adds the legs of a square to the groups of their lines. */
void RefractedLegEntries::GroupLegs(Workspace& workspace) const
{
  LegBlock& legs = workspace.Legs;
  FindFrames(*this->Scene.Frames, this->Set, legs);
  unsigned int groups = 0; // a bit for each that has a leg
  for (int i = 0; i < legs.Count; ++i)
  {
    const auto ray = static_cast<std::size_t>(i);
    const std::int32_t end = workspace.Ends[ray];
    workspace.IsInside[ray] = this->FindEntryInside(legs, i, end, workspace.EntriesInside[ray]);
    const bool known = workspace.IsInside[ray] || end == PacketResult::Outside;
    workspace.Groups[ray] = static_cast<unsigned int>(legs.Frame[i]) * Workspace::NumberOfGroups +
      (known ? Workspace::Known : Workspace::Unknown);
    groups |= 1u << workspace.Groups[ray];
  }
  const bool isOneGroup = (groups & (groups - 1)) == 0;
  for (unsigned int number = 0; groups >> number != 0; ++number)
  {
    if ((groups >> number & 1u) != 0)
    {
      this->AddToGroup(number, isOneGroup ? legs : workspace.Chosen, workspace);
    }
  }
}

//------------------------------------------------------------------------------
/**
 * @param number frame and group, as in Workspace::Groups.
 * @param chosen the legs of the square, if all are in the group; otherwise gets those that are.
 */
void RefractedLegEntries::AddToGroup(
  unsigned int number, LegBlock& chosen, Workspace& workspace) const
{
  const auto frame = static_cast<std::size_t>(number / Workspace::NumberOfGroups);
  const unsigned int kind = number % Workspace::NumberOfGroups;
  Workspace::Group& group = workspace.Frames[frame][kind];
  const auto firstLine = static_cast<std::int32_t>(LineBlock::Size * group.NumberOfBlocks);
  LineBlock& lines = group.AddBlock();
  const int count = workspace.Legs.Count;
  chosen.Count = 0;
  for (int i = 0; i < count; ++i)
  {
    const auto ray = static_cast<std::size_t>(i);
    if (workspace.Groups[ray] == number)
    {
      const std::int32_t line = firstLine + chosen.Count;
      if (workspace.IsInside[ray])
      {
        group.EntriesInside.push_back({ line, workspace.EntriesInside[ray] });
      }
      group.Origins[static_cast<std::size_t>(line)] = workspace.Origins[ray];
      if (&chosen != &workspace.Legs)
      {
        chosen.Copy(chosen.Count, workspace.Legs, i);
      }
      ++chosen.Count;
    }
  }
  SetLines(this->Scene.Frames->Get(static_cast<int>(frame)), chosen, kind == Workspace::Known,
    this->Set, lines);
}

//------------------------------------------------------------------------------
void RefractedLegEntries::Collect(
  const TileLeg& leg, const PacketJob& job, JoinedRays& joined, Workspace& workspace) const
{
  if (!leg.IsListed)
  {
    this->FindLines(leg, job, joined, workspace);
  }
  for (auto& groups : workspace.Frames)
  {
    for (Workspace::Group& group : groups)
    {
      group.IsTaken = false;
    }
  }
  workspace.IsSelected.fill(leg.Selected == nullptr);
  for (std::size_t i = 0; leg.Selected && i < leg.Selected->size(); ++i)
  {
    workspace.IsSelected[static_cast<std::size_t>((*leg.Selected)[i])] = true;
  }
}

//------------------------------------------------------------------------------
void RefractedLegEntries::CountEntries(
  Workspace& workspace, InterpolatedRays::NumbersOfEntries& numbers) const
{
  for (std::size_t frame = 0; frame < workspace.Frames.size(); ++frame)
  {
    for (Workspace::Group& group : workspace.Frames[frame])
    {
      this->FindEntries(static_cast<int>(frame), group, workspace);
      for (std::size_t block = 0; block < group.NumberOfBlocks; ++block)
      {
        const std::size_t first = LineBlock::Size * block;
        const auto count = static_cast<std::size_t>(group.Blocks[block].Count);
        for (std::size_t line = first; line < first + count; ++line)
        {
          numbers[static_cast<std::size_t>(group.Origins[line].Pixel)] +=
            group.Entries.GetBegin(line + 1) - group.Entries.GetBegin(line);
        }
      }
    }
  }
}

//------------------------------------------------------------------------------
void RefractedLegEntries::FindLines(
  const TileLeg& leg, const PacketJob& job, JoinedRays& joined, Workspace& workspace) const
{
  for (auto& groups : workspace.Frames)
  {
    for (Workspace::Group& group : groups)
    {
      group.Clear();
    }
  }
  for (int square = 0; square < RefractedRayTiles::SquaresOfTile; ++square)
  {
    const int corner =
      RefractedRayTiles::RowOfSquare(square) * TileSize + RefractedRayTiles::ColumnOfSquare(square);
    if (!this->Legs.MayShow(leg.Number, leg.Tile, square))
    {
      // The ends of the legs are outside of the mesh.
      for (int i = 0; i < LegBlock::Size && this->Legs.HasLegs(leg.Number, leg.Tile, square); ++i)
      {
        joined.SetEnd(
          corner + LegBlock::RowOf(i) * TileSize + LegBlock::ColumnOf(i), PacketResult::Outside);
      }
      continue;
    }
    this->Legs.PrefetchSquare(leg.Number, leg.Tile, square + 1);
    FindLegs(this->Legs, leg.Tile, corner, leg.Number, this->Set, workspace.Legs);
    this->SiftLegs(leg, job, joined, workspace);
    if (workspace.Legs.Count > 0)
    {
      this->GroupLegs(workspace);
    }
  }
}

//------------------------------------------------------------------------------
/** Finds the entries of a group's lines, if that has not been done. */
void RefractedLegEntries::FindEntries(
  int frame, Workspace::Group& group, Workspace& workspace) const
{
  if (group.HasEntries || group.NumberOfBlocks == 0)
  {
    return;
  }
  group.HasEntries = true;
  RayBundleEntries::Workspace& found = workspace.Faces;
  this->Entries[static_cast<std::size_t>(frame)].Collect(
    group.Blocks.data(), group.NumberOfBlocks, found);
  for (const Workspace::Group::Inside& inside : group.EntriesInside)
  {
    found.Add(inside.Line, inside.Entry);
  }
  group.Entries.Set(LineBlock::Size * group.NumberOfBlocks, found.Hits.data(), found.NumberOfHits,
    found.Faces.data());
}

//------------------------------------------------------------------------------
/** Sets the batch of the workspace to the selected lines of a group that have entries. */
void RefractedLegEntries::SetBatch(int frame, Workspace::Group& group, Workspace& workspace) const
{
  this->FindEntries(frame, group, workspace);
  LegBatch& batch = workspace.Batch;
  batch.Clear();
  workspace.Lines.clear();
  for (std::size_t block = 0; block < group.NumberOfBlocks; ++block)
  {
    const LineBlock& lines = group.Blocks[block];
    for (int i = 0; i < lines.Count; ++i)
    {
      const std::size_t line = LineBlock::Size * block + static_cast<std::size_t>(i);
      const std::int32_t first = group.Entries.GetBegin(line);
      const std::int32_t end = group.Entries.GetBegin(line + 1);
      const LegBatch::Origin& origin = group.Origins[line];
      if (first < end && workspace.IsSelected[static_cast<std::size_t>(origin.Pixel)])
      {
        workspace.Lines.push_back(static_cast<std::int32_t>(line));
        batch.Origins.push_back(origin);
        batch.Rays.push_back(lines.GetRay(i));
        batch.Rays.back().FirstEntry = first;
        batch.Rays.back().EndEntry = end;
      }
    }
  }
  batch.Entries = group.Entries.GetEntries().data();
}

//------------------------------------------------------------------------------
const LegBatch* RefractedLegEntries::NextBatch(int frame, Workspace& workspace) const
{
  auto& groups = workspace.Frames[static_cast<std::size_t>(frame)];
  for (unsigned int kind = 0; kind < Workspace::NumberOfGroups; ++kind)
  {
    Workspace::Group& group = groups[kind];
    if (group.NumberOfBlocks > 0 && !group.IsTaken)
    {
      group.IsTaken = true;
      this->SetBatch(frame, group, workspace);
      workspace.BatchKind = kind;
      if (!workspace.Batch.Rays.empty())
      {
        return &workspace.Batch;
      }
    }
  }
  return nullptr;
}

//------------------------------------------------------------------------------
bool RefractedLegEntries::TakeBack(int frame, std::size_t ray, Workspace& workspace) const
{
  auto& groups = workspace.Frames[static_cast<std::size_t>(frame)];
  const Workspace::Group& group = groups[workspace.BatchKind];
  const std::int32_t line = workspace.Lines[ray];
  const bool enteredInside = std::any_of(group.EntriesInside.begin(), group.EntriesInside.end(),
    [line](const Workspace::Group::Inside& inside) { return inside.Line == line; });
  if (enteredInside)
  {
    Workspace::Group& again = groups[Workspace::Again];
    LineBlock& lines =
      again.NumberOfBlocks == 0 || again.Blocks[again.NumberOfBlocks - 1].Count == LineBlock::Size
      ? again.AddBlock()
      : again.Blocks[again.NumberOfBlocks - 1];
    const std::size_t added =
      LineBlock::Size * (again.NumberOfBlocks - 1) + static_cast<std::size_t>(lines.Count);
    again.Origins[added] = workspace.Batch.Origins[ray];
    lines.Add(group.Blocks[static_cast<std::size_t>(line / LineBlock::Size)],
      line % LineBlock::Size, -this->Scene.Frames->Get(frame).Extent);
  }
  return enteredInside;
}

}
