// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Entries/BoundaryRaster.h"

#include "Volume/Packet/Data/PacketRays.h"
#include "Volume/Packet/Kernels/PacketKernels.h"

#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace meniscus
{
namespace
{

constexpr double Margin = ProjectedFaces::Margin;

/**
 * Width of boxes whose rows are tested whole, in pixels: that is one packet of the widest
 * instruction set, and cheaper than to find the pixels that a face covers.
 */
constexpr int NarrowBox = 16;

/**
 * Selected rays that are tested together where a face may be entered by one of them. Half a packet
 * of the widest instruction set: their boxes are smaller, and neighbouring groups make one span.
 */
constexpr std::size_t RaysOfGroup = 8;

/**
 * A number rounded to float, downwards or upwards: by less than 2^-23 of it, twice as much as the
 * nearest float may be away.
 */
float RoundedDown(double value)
{
  return static_cast<float>(value - std::abs(value) * 1.1920928955078125e-07);
}
float RoundedUp(double value)
{
  return -RoundedDown(-value);
}

/** A range of pixels in a row. */
struct PixelSpan
{
  int First;
  int Last; // exclusive
};

/**
 * Part of a row of `count` pixels from `first` in which no edge is below -Margin, give or take a
 * little.
 * @param reciprocals 1 over the change of each edge per column; 0 if there is no change.
 */
PixelSpan SpanOf(
  const glm::dvec3 (&edges)[3], const double (&reciprocals)[3], const glm::dvec2& first, int count)
{
  double begin = 0.0;
  double end = count;
  for (int k = 0; k < 3; ++k)
  {
    const glm::dvec3& edge = edges[k];
    const double excess = edge[0] + first.x * edge[1] + first.y * edge[2] + Margin;
    if (edge[1] != 0.0)
    {
      const double root = -excess * reciprocals[k];
      begin = edge[1] > 0.0 ? std::max(begin, root - 1.0) : begin;
      end = edge[1] < 0.0 ? std::min(end, root + 2.0) : end;
    }
    else if (excess < 0.0)
    {
      return { 0, 0 };
    }
  }
  return begin < end ? PixelSpan{ static_cast<int>(begin), static_cast<int>(end) }
                     : PixelSpan{ 0, 0 };
}

}

//------------------------------------------------------------------------------
void BoundaryRaster::Build(const std::vector<PacketVertex>& vertices,
  const std::vector<BoundaryFace>& faces, const FixedPointRays& rays, const RangeLoop& loop,
  InstructionSet set, int pitch, const Refinement& refinement)
{
  this->Set = set;
  this->Pitch = pitch;
  this->Faces.Set(vertices, faces, rays);
  this->Columns = (rays.GetWidth() + pitch - 1) / pitch;
  this->Rows = (rays.GetHeight() + pitch - 1) / pitch;
  this->BoundFaces(refinement.Coarse, loop);
  const std::uint8_t* const wanted = refinement.Tiles ? refinement.Tiles->data() : nullptr;
  this->FacesOfTiles.Set(static_cast<std::size_t>(this->GetNumberOfTiles()),
    [this, pitch, wanted](const auto& visit)
    {
      for (std::size_t f = 0; f < this->Boxes.size(); ++f)
      {
        const PixelBox& box = this->Boxes[f];
        if (box.IsEmpty())
        {
          continue;
        }
        for (int row = box.Bottom / pitch; row <= (box.Top - 1) / pitch; ++row)
        {
          for (int column = box.Left / pitch; column <= (box.Right - 1) / pitch; ++column)
          {
            const auto tile = static_cast<std::size_t>(row * this->Columns + column);
            if (!wanted || wanted[tile] != 0)
            {
              visit(tile, static_cast<std::int32_t>(f));
            }
          }
        }
      }
    });
}

//------------------------------------------------------------------------------
/** Finds the pixels of each face, from those in a coarse image if that has the same places. */
void BoundaryRaster::BoundFaces(const BoundaryRaster* coarse, const RangeLoop& loop)
{
  const FixedPointRays& rays = this->GetRays();
  const std::size_t faces = this->Faces.GetNumberOfFaces();
  const bool isKnown =
    coarse && coarse->Extents.size() == faces && coarse->GetRays().PlacesAs(rays);
  const double across = isKnown ? rays.GetWidth() / coarse->GetRays().GetWidth() : 1;
  this->Boxes.resize(faces);
  this->Extents.resize(isKnown ? 0 : faces);
  ForEachItem(faces, loop,
    [&](std::size_t f)
    {
      if (isKnown)
      {
        const Extent& extent = coarse->Extents[f];
        this->Boxes[f] = this->Faces.PixelsIn(across * glm::dvec2(extent.Lower[0], extent.Lower[1]),
          across * glm::dvec2(extent.Upper[0], extent.Upper[1]));
        return;
      }
      const ProjectedFaces::Footprint seen =
        this->Faces.BoundPixels(this->Faces.Project(static_cast<std::int32_t>(f)));
      this->Boxes[f] = this->Faces.PixelsIn(seen);
      this->Extents[f] = { { RoundedDown(seen.Lower.x), RoundedDown(seen.Lower.y) },
        { RoundedUp(seen.Upper.x), RoundedUp(seen.Upper.y) } };
    });
}

//------------------------------------------------------------------------------
ProjectedFaces::PixelBox BoundaryRaster::BoxOfTile(int tile) const
{
  const int left = tile % this->Columns * this->Pitch;
  const int bottom = tile / this->Columns * this->Pitch;
  return { left, std::min(left + this->Pitch, this->GetRays().GetWidth()), bottom,
    std::min(bottom + this->Pitch, this->GetRays().GetHeight()) };
}

//------------------------------------------------------------------------------
double BoundaryRaster::NearestDepth(int tile) const
{
  double nearest = std::numeric_limits<double>::infinity();
  for (const std::int32_t face : this->FacesOfTiles[static_cast<std::size_t>(tile)])
  {
    nearest = std::min(nearest, this->Faces.GetNearestDepth(face));
  }
  return nearest;
}

//------------------------------------------------------------------------------
/** Sets the lines of the rays of a tile that are in the box. */
void BoundaryRaster::FillRays(const PixelBox& tile, const PixelBox& box, Workspace& workspace) const
{
  for (int row = box.Bottom; row < box.Top; ++row)
  {
    this->GetRays().FillRow(box.Left, row, box.Right - box.Left,
      LinesFrom((row - tile.Bottom) * TileSize + box.Left - tile.Left, workspace));
  }
}

//------------------------------------------------------------------------------
/** Adds a face and the pixels of the tile that it may cover; returns their box. */
ProjectedFaces::PixelBox BoundaryRaster::AddSpans(
  std::int32_t index, const PixelBox& tile, Workspace& workspace) const
{
  const PixelBox& box = this->Boxes[index];
  const PixelBox part{ std::max(box.Left, tile.Left), std::min(box.Right, tile.Right),
    std::max(box.Bottom, tile.Bottom), std::min(box.Top, tile.Top) };
  const int width = part.Right - part.Left;
  ProjectedFaces::Face face{};
  double reciprocals[3] = {};
  if (width > NarrowBox)
  {
    face = this->Faces.Project(index);
    for (int k = 0; k < 3; ++k)
    {
      reciprocals[k] = face.Edges[k][1] != 0.0 ? 1.0 / face.Edges[k][1] : 0.0;
    }
  }
  const auto number = static_cast<std::int32_t>(workspace.Faces.size());
  workspace.Faces.push_back(this->Faces.GetEntered(index));
  for (int row = part.Bottom; row < part.Top; ++row)
  {
    const PixelSpan span = width <= NarrowBox
      ? PixelSpan{ 0, width }
      : SpanOf(face.Edges, reciprocals, this->GetRays().FromCenter(part.Left, row), width);
    if (span.First < span.Last)
    {
      const int inRow = (row - tile.Bottom) * TileSize + part.Left - tile.Left;
      workspace.AddSpan(number, inRow + span.First, inRow + span.Last);
    }
  }
  return part;
}

//------------------------------------------------------------------------------
/** Lists the faces of a tile that may cover pixels of a part of it, from near to far. */
void BoundaryRaster::ListFaces(int tile, const PixelBox& part, Workspace& workspace) const
{
  workspace.Faces.clear();
  workspace.Spans.clear();
  workspace.SpannedRays = 0;
  // In a mesh whose cells share no faces, each pixel has many faces: taking them from near to far
  // leaves little to sort.
  workspace.Order.clear();
  for (const std::int32_t face : this->FacesOfTiles[static_cast<std::size_t>(tile)])
  {
    if (this->Boxes[static_cast<std::size_t>(face)].Overlaps(part))
    {
      workspace.Order.emplace_back(static_cast<float>(this->Faces.GetNearestDepth(face)), face);
    }
  }
  std::sort(workspace.Order.begin(), workspace.Order.end());
}

//------------------------------------------------------------------------------
void BoundaryRaster::CollectEntries(int tile, Workspace& workspace) const
{
  const PixelBox box = this->BoxOfTile(tile);
  this->ListFaces(tile, box, workspace);
  PixelBox covered;
  for (const auto& face : workspace.Order)
  {
    covered.Add(this->AddSpans(face.second, box, workspace));
  }
  this->PrepareLines(workspace);
  this->FillRays(box, covered, workspace);
  this->TestSpans(TileSize * TileSize, workspace);
}

//------------------------------------------------------------------------------
/** Finds the boxes of groups of rays; returns the box around all of them. */
ProjectedFaces::PixelBox BoundaryRaster::GroupRays(
  const PixelBox& tile, const std::vector<std::int16_t>& rays, Workspace& workspace)
{
  PixelBox all;
  workspace.Groups.clear();
  for (std::size_t first = 0; first < rays.size(); first += RaysOfGroup)
  {
    PixelBox group;
    for (std::size_t i = first; i < std::min(first + RaysOfGroup, rays.size()); ++i)
    {
      const int column = tile.Left + rays[i] % TileSize;
      const int row = tile.Bottom + rays[i] / TileSize;
      group.Add({ column, column + 1, row, row + 1 });
    }
    workspace.Groups.push_back(group);
    all.Add(group);
  }
  return all;
}

//------------------------------------------------------------------------------
/** Adds a face and the groups of rays that it may cover. */
void BoundaryRaster::AddGroups(std::int32_t index, std::size_t rays, Workspace& workspace) const
{
  const PixelBox& box = this->Boxes[static_cast<std::size_t>(index)];
  const auto number = static_cast<std::int32_t>(workspace.Faces.size());
  const std::size_t groups = workspace.Groups.size();
  for (std::size_t group = 0; group < groups; ++group)
  {
    const std::size_t first = group;
    while (group < groups && box.Overlaps(workspace.Groups[group]))
    {
      ++group;
    }
    if (group > first)
    {
      workspace.AddSpan(number, static_cast<std::int32_t>(first * RaysOfGroup),
        static_cast<std::int32_t>(std::min(group * RaysOfGroup, rays)));
    }
  }
  workspace.Faces.push_back(this->Faces.GetEntered(index));
}

//------------------------------------------------------------------------------
void BoundaryRaster::CollectEntries(
  int tile, const std::vector<std::int16_t>& rays, Workspace& workspace) const
{
  const PixelBox box = this->BoxOfTile(tile);
  this->ListFaces(tile, GroupRays(box, rays, workspace), workspace);
  for (const auto& face : workspace.Order)
  {
    this->AddGroups(face.second, rays.size(), workspace);
  }
  this->PrepareLines(workspace);
  if (!workspace.Spans.empty())
  {
    const auto pixelAt = [&](int i)
    {
      const int ray = rays[static_cast<std::size_t>(i)];
      return this->GetRays().FromCenter(box.Left + ray % TileSize, box.Bottom + ray / TileSize);
    };
    this->GetRays().FillRays(pixelAt, static_cast<int>(rays.size()), LinesFrom(0, workspace));
  }
  this->TestSpans(rays.size(), workspace);
}

//------------------------------------------------------------------------------
/** Makes room for lines. */
void BoundaryRaster::PrepareLines(Workspace& workspace) const
{
  workspace.Offsets.resize(2 * SizeOfRays);
  workspace.Slopes.resize(2 * SizeOfRays);
  workspace.Fractions.resize(2 * SizeOfRays);
  workspace.SlopeRests.resize(2 * SizeOfRays);
  if (!this->GetRays().AreFine())
  {
    std::fill(workspace.Fractions.begin(), workspace.Fractions.end(), 0.0f);
    std::fill(workspace.SlopeRests.begin(), workspace.SlopeRests.end(), 0.0f);
  }
}

//------------------------------------------------------------------------------
/** The lines from the given number on. */
FixedPointRays::RowOfRays BoundaryRaster::LinesFrom(int number, Workspace& workspace)
{
  FixedPointRays::RowOfRays lines;
  for (int axis = 0; axis < 2; ++axis)
  {
    const int first = axis * SizeOfRays + number;
    lines.Offset[axis] = workspace.Offsets.data() + first;
    lines.Slope[axis] = workspace.Slopes.data() + first;
    lines.Fraction[axis] = workspace.Fractions.data() + first;
    lines.SlopeRest[axis] = workspace.SlopeRests.data() + first;
  }
  return lines;
}

//------------------------------------------------------------------------------
/** Sets the lists of rays to the entries in the spans. */
void BoundaryRaster::TestSpans(std::size_t rays, Workspace& workspace) const
{
  workspace.Hits.resize(std::max(workspace.Hits.size(), workspace.SpannedRays));
  PacketSpanJob job;
  job.Vertices = this->Faces.GetVertices().data();
  job.Faces = workspace.Faces.data();
  job.Spans = workspace.Spans.data();
  job.NumberOfSpans = static_cast<std::int32_t>(workspace.Spans.size());
  const FixedPointRays::RowOfRays lines = LinesFrom(0, workspace);
  for (int axis = 0; axis < 2; ++axis)
  {
    job.Offsets[axis] = lines.Offset[axis];
    job.Slopes[axis] = lines.Slope[axis];
    job.Fractions[axis] = lines.Fraction[axis];
    job.SlopeRests[axis] = lines.SlopeRest[axis];
  }
  job.Pivot = this->GetRays().GetPivot();
  job.RaysAreFine = this->GetRays().AreFine();
  job.Hits = workspace.Hits.data();
  FindEntries(job, this->Set);
  workspace.Lists.Set(
    rays, job.Hits, static_cast<std::size_t>(job.NumberOfHits), workspace.Faces.data());
}

}
