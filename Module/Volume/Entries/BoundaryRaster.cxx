// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Entries/BoundaryRaster.h"

#include "Volume/Packet/Data/PacketRays.h"
#include "Volume/Packet/Kernels/PacketKernels.h"

#include <glm/vec3.hpp>

#include <algorithm>
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
  InstructionSet set, int pitch)
{
  this->Set = set;
  this->Pitch = pitch;
  this->Faces.Set(vertices, faces, rays);
  this->Columns = (rays.GetWidth() + pitch - 1) / pitch;
  this->Rows = (rays.GetHeight() + pitch - 1) / pitch;

  this->Boxes.resize(faces.size());
  loop(faces.size(),
    [this](std::size_t first, std::size_t last)
    {
      for (std::size_t f = first; f < last; ++f)
      {
        const auto index = static_cast<std::int32_t>(f);
        this->Boxes[f] = this->Faces.BoundPixels(this->Faces.Project(index)).Box;
      }
    });
  this->FacesOfTiles.Set(static_cast<std::size_t>(this->GetNumberOfTiles()),
    [this, pitch](const auto& visit)
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
            visit(
              static_cast<std::size_t>(row * this->Columns + column), static_cast<std::int32_t>(f));
          }
        }
      }
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
/** Sets the lines of the wanted rays of a tile that are in the box. */
void BoundaryRaster::FillRays(
  const PixelBox& tile, const TilePart& wanted, const PixelBox& box, Workspace& workspace) const
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
  for (int row = box.Bottom; row < box.Top; ++row)
  {
    const auto inTile = static_cast<std::size_t>(row - tile.Bottom);
    const int left = std::max(box.Left, tile.Left + wanted.First[inTile]);
    const int right = std::min(box.Right, tile.Left + wanted.End[inTile]);
    if (right <= left)
    {
      continue;
    }
    FixedPointRays::RowOfRays rays;
    for (int axis = 0; axis < 2; ++axis)
    {
      const int first = axis * SizeOfRays + (row - tile.Bottom) * TileSize + left - tile.Left;
      rays.Offset[axis] = workspace.Offsets.data() + first;
      rays.Slope[axis] = workspace.Slopes.data() + first;
      rays.Fraction[axis] = workspace.Fractions.data() + first;
      rays.SlopeRest[axis] = workspace.SlopeRests.data() + first;
    }
    this->GetRays().FillRow(left, row, right - left, rays);
  }
}

//------------------------------------------------------------------------------
/** Adds a face and the wanted pixels of the tile that it may cover; returns their box. */
ProjectedFaces::PixelBox BoundaryRaster::AddSpans(
  std::int32_t index, const PixelBox& tile, const TilePart& wanted, Workspace& workspace) const
{
  const PixelBox& box = this->Boxes[index];
  const int left = std::max(box.Left, tile.Left);
  const int right = std::min(box.Right, tile.Right);
  // Projected for the first row that is wide: often, none of a face's pixels is wanted.
  bool isProjected = false;
  ProjectedFaces::Face face{};
  double reciprocals[3] = {};
  const auto number = static_cast<std::int32_t>(workspace.Faces.size());
  PixelBox covered{ tile.Right, tile.Left, tile.Top, tile.Bottom };
  const int top = std::min(box.Top, tile.Top);
  for (int row = std::max(box.Bottom, tile.Bottom); row < top; ++row)
  {
    const auto inTile = static_cast<std::size_t>(row - tile.Bottom);
    const int first = std::max(left, tile.Left + wanted.First[inTile]);
    const int width = std::min(right, tile.Left + wanted.End[inTile]) - first;
    if (width <= 0)
    {
      continue;
    }
    covered = { std::min(covered.Left, first), std::max(covered.Right, first + width),
      std::min(covered.Bottom, row), row + 1 };
    if (width > NarrowBox && !isProjected)
    {
      isProjected = true;
      face = this->Faces.Project(index);
      for (int k = 0; k < 3; ++k)
      {
        reciprocals[k] = face.Edges[k][1] != 0.0 ? 1.0 / face.Edges[k][1] : 0.0;
      }
    }
    const PixelSpan span = width <= NarrowBox
      ? PixelSpan{ 0, width }
      : SpanOf(face.Edges, reciprocals, this->GetRays().FromCenter(first, row), width);
    if (span.First < span.Last)
    {
      const int inRow = (row - tile.Bottom) * TileSize + first - tile.Left;
      PacketSpan& added = workspace.Spans.emplace_back();
      added.Face = number;
      added.First = inRow + span.First;
      added.End = inRow + span.Last;
      workspace.SpannedPixels += static_cast<std::size_t>(span.Last - span.First);
    }
  }
  if (!covered.IsEmpty())
  {
    workspace.Faces.push_back(this->Faces.GetEntered(index));
  }
  return covered;
}

//------------------------------------------------------------------------------
void BoundaryRaster::CollectEntries(int tile, const TilePart& wanted, Workspace& workspace) const
{
  if (this->IsEmpty(tile))
  {
    workspace.Lists.Set(TileSize * TileSize, nullptr, 0, nullptr);
    return;
  }
  // In a mesh whose cells share no faces, each pixel has many faces: taking them from near to far
  // leaves little to sort.
  workspace.Order.clear();
  for (const std::int32_t face : this->FacesOfTiles[static_cast<std::size_t>(tile)])
  {
    workspace.Order.emplace_back(static_cast<float>(this->Faces.GetNearestDepth(face)), face);
  }
  std::sort(workspace.Order.begin(), workspace.Order.end());
  const PixelBox box = this->BoxOfTile(tile);
  workspace.Faces.clear();
  workspace.Spans.clear();
  workspace.SpannedPixels = 0;
  PixelBox covered{ box.Right, box.Left, box.Top, box.Bottom };
  for (const auto& face : workspace.Order)
  {
    const PixelBox part = this->AddSpans(face.second, box, wanted, workspace);
    covered = { std::min(covered.Left, part.Left), std::max(covered.Right, part.Right),
      std::min(covered.Bottom, part.Bottom), std::max(covered.Top, part.Top) };
  }
  this->FillRays(box, wanted, covered, workspace);
  workspace.Hits.resize(std::max(workspace.Hits.size(), workspace.SpannedPixels));
  PacketSpanJob job;
  job.Vertices = this->Faces.GetVertices().data();
  job.Faces = workspace.Faces.data();
  job.Spans = workspace.Spans.data();
  job.NumberOfSpans = static_cast<std::int32_t>(workspace.Spans.size());
  for (int axis = 0; axis < 2; ++axis)
  {
    job.Offsets[axis] = workspace.Offsets.data() + axis * SizeOfRays;
    job.Slopes[axis] = workspace.Slopes.data() + axis * SizeOfRays;
    job.Fractions[axis] = workspace.Fractions.data() + axis * SizeOfRays;
    job.SlopeRests[axis] = workspace.SlopeRests.data() + axis * SizeOfRays;
  }
  job.Pivot = this->GetRays().GetPivot();
  job.RaysAreFine = this->GetRays().AreFine();
  job.Hits = workspace.Hits.data();
  FindEntries(job, this->Set);
  workspace.Lists.Set(TileSize * TileSize, job.Hits, static_cast<std::size_t>(job.NumberOfHits),
    workspace.Faces.data());
}

}
