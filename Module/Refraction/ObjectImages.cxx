// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Refraction/ObjectImages.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace meniscus
{

//------------------------------------------------------------------------------
void ObjectImages::SetPoints(const double* points, std::size_t count, bool mayCross)
{
  this->Points = points;
  this->MayCross = mayCross;
  this->Chunks.assign((count + Chunk - 1) / Chunk, {});
  this->Wanted.clear();
  this->Counts.assign(count, 0);
  this->States.assign(count, ImageState::NotAsked);
  this->Images.clear();
}

//------------------------------------------------------------------------------
glm::dvec3 ObjectImages::GetPoint(std::int64_t id) const
{
  const double* p = this->Points + 3 * id;
  return { p[0], p[1], p[2] };
}

//------------------------------------------------------------------------------
void ObjectImages::SolvePoints(std::size_t begin, std::size_t end)
{
  std::vector<VirtualVertex> images;
  for (std::size_t i = begin; i < end; ++i)
  {
    if (!this->IsWanted(i) || this->States[i] != ImageState::NotAsked)
    {
      continue;
    }
    const glm::dvec3 point = this->GetPoint(static_cast<std::int64_t>(i));
    const glm::dvec3 local = point - this->Geometry.GetMembrane().GetOrigin();
    if (this->MayCross && this->Geometry.IsInReach(local) && !this->Geometry.IsBehindAll(local) &&
      this->Geometry.IsInFront(local))
    {
      images.assign(1, this->Geometry.PassThrough(local));
      images.front().position = point;
      images.front().sightPoint = point;
      this->States[i] = ImageState::Found;
    }
    else
    {
      this->States[i] = this->Geometry.FindImages(point, images);
    }
    this->Counts[i] = static_cast<std::uint32_t>(images.size());
    std::vector<VirtualVertex>& chunk = this->Chunks[i / Chunk];
    chunk.insert(chunk.end(), images.begin(), images.end());
  }
}

//------------------------------------------------------------------------------
void ObjectImages::FinishPoints()
{
  this->Nearest = std::numeric_limits<double>::max();
  this->Farthest = 0.0;
  this->InFront.assign(this->States.size(), false);
  this->First.assign(this->States.size() + 1, 0);
  this->Images.clear();
  for (std::size_t i = 0, inChunk = 0; i < this->States.size(); ++i)
  {
    inChunk = i % Chunk == 0 ? 0 : inChunk;
    const std::size_t count = this->IsWanted(i) ? this->Counts[i] : 0;
    this->First[i + 1] = this->First[i] + count;
    const VirtualVertex* images = this->Chunks[i / Chunk].data() + inChunk;
    inChunk += count;
    for (std::size_t k = 0; k < count; ++k)
    {
      ImagePoint image;
      image.vertex = images[k];
      image.source[0] = static_cast<std::int64_t>(i);
      this->Images.push_back(image);
      this->Nearest = std::min(this->Nearest, images[k].depth);
      this->Farthest = std::max(this->Farthest, images[k].depth);
    }
    this->InFront[i] = count == 1 && images[0].facet == CurvedPatches::NoFacet;
  }
  if (this->Wanted.empty())
  {
    this->Chunks.clear(); // nothing can be wanted later
  }
  this->Nearest = std::min(this->Nearest, this->Farthest);
}

//------------------------------------------------------------------------------
ObjectImages::Side ObjectImages::FindSide(const std::int64_t* ids, std::size_t count) const
{
  const auto inFront = static_cast<std::size_t>(std::count_if(ids, ids + count,
    [this](std::int64_t id) { return this->InFront[static_cast<std::size_t>(id)]; }));
  return inFront == 0 ? Side::Behind : (inFront == count ? Side::InFront : Side::Both);
}

//------------------------------------------------------------------------------
// Whether the image of the side's middle lies where the virtual side's is drawn, within the
// tolerance at the eye. An image of another branch does not.
bool ObjectImages::TestSide(std::int64_t from, std::int64_t to) const
{
  const auto image = [this](std::int64_t id) -> const VirtualVertex&
  { return this->Images[this->First[static_cast<std::size_t>(id)]].vertex; };
  const glm::dvec3 middle = 0.5 * (this->GetPoint(from) + this->GetPoint(to));
  const VirtualVertex exact = this->Geometry.SolveNear(middle, image(from));
  if (exact.state != ImageState::Found)
  {
    return false;
  }
  const glm::dvec3 eye = this->Geometry.GetMedia().eye + this->Geometry.GetMembrane().GetOrigin();
  const glm::dvec3 drawn = 0.5 * (image(from).position + image(to).position) - eye;
  const glm::dvec3 seen = exact.position - eye;
  const glm::dvec3 across = glm::cross(drawn, seen);
  const double squared = glm::dot(drawn, drawn) * glm::dot(seen, seen);
  return glm::dot(across, across) <= this->Tolerance * this->Tolerance * squared;
}

//------------------------------------------------------------------------------
// From the lower id to the higher one, so that both neighbours get one answer, cached or not.
bool ObjectImages::IsSideStraight(std::int64_t a, std::int64_t b, SideCache& sides) const
{
  const std::int64_t low = std::min(a, b);
  const std::int64_t high = std::max(a, b);
  const auto slot = static_cast<std::size_t>(low + 7 * (high - low)) % sides.entries.size();
  SideCache::Entry& entry = sides.entries[slot];
  if (entry.low != low || entry.high != high)
  {
    entry = { low, high, this->TestSide(low, high) };
  }
  return entry.isStraight;
}

//------------------------------------------------------------------------------
bool ObjectImages::IsSimple(
  const std::int64_t* ids, std::size_t count, bool isClosed, SideCache& sides) const
{
  const auto image = [this, ids](std::size_t i) -> const VirtualVertex&
  { return this->Images[this->First[static_cast<std::size_t>(ids[i])]].vertex; };
  glm::dvec3 middle(0.0);
  for (std::size_t i = 0; i < count; ++i)
  {
    if (this->GetNumberOfImages(static_cast<std::size_t>(ids[i])) != 1 ||
      image(i).orientation != image(0).orientation)
    {
      return false;
    }
    middle += this->GetPoint(ids[i]) / static_cast<double>(count);
  }
  for (std::size_t i = 0; i + 1 < count || (isClosed && i < count); ++i)
  {
    if (!this->IsSideStraight(ids[i], ids[(i + 1) % count], sides))
    {
      return false;
    }
  }
  // Between sight points in one facet the membrane holds no surprise; over several it may.
  const bool inOneFacet = std::all_of(ids, ids + count,
    [this, &image](std::int64_t id) {
      return this->Images[this->First[static_cast<std::size_t>(id)]].vertex.facet == image(0).facet;
    });
  std::vector<VirtualVertex> images;
  return inOneFacet ||
    (this->Geometry.FindImages(middle, images) == ImageState::Found && images.size() == 1);
}

//------------------------------------------------------------------------------
void ObjectImages::AddWhole(
  const std::int64_t* ids, std::size_t count, std::int64_t cell, ImageMesh& whole) const
{
  for (std::size_t i = 0; i < count; ++i)
  {
    whole.connectivity.push_back(
      static_cast<std::int64_t>(this->First[static_cast<std::size_t>(ids[i])]));
  }
  whole.EndCell(
    cell, this->Images[this->First[static_cast<std::size_t>(ids[0])]].vertex.orientation);
}

//------------------------------------------------------------------------------
CellReport ObjectImages::MapLines(const ObjectCells& cells, const std::int64_t* names,
  std::size_t begin, std::size_t end, ImageMesh& pieces, ImageMesh& whole) const
{
  const MembraneMapping mapping(this->Geometry, this->Tolerance, this->Nearest, this->Farthest);
  CellReport report;
  SideCache sides;
  for (std::size_t i = begin; i < end; ++i)
  {
    const std::int64_t* ids = cells.connectivity + cells.offsets[i];
    const auto count = static_cast<std::size_t>(cells.offsets[i + 1] - cells.offsets[i]);
    const std::int64_t cell = names[i];
    const Side side = this->FindSide(ids, count);
    if (side == Side::InFront || (side == Side::Behind && this->IsSimple(ids, count, false, sides)))
    {
      this->AddWhole(ids, count, cell, whole);
      ++report.whole;
      continue;
    }
    const std::size_t before = pieces.GetNumberOfCells();
    for (std::size_t k = 0; k + 1 < count; ++k)
    {
      mapping.MapLine({ { ids[k], ids[k + 1], ids[k] },
                        { this->GetPoint(ids[k]), this->GetPoint(ids[k + 1]), glm::dvec3(0.0) } },
        cell, side == Side::Both, pieces);
    }
    ++(pieces.GetNumberOfCells() > before ? report.mapped : report.without);
  }
  return report;
}

//------------------------------------------------------------------------------
CellReport ObjectImages::MapPolygons(const ObjectCells& cells, const std::int64_t* names,
  std::size_t begin, std::size_t end, const Triangulate& triangulate, ImageMesh& pieces,
  ImageMesh& whole) const
{
  const MembraneMapping mapping(this->Geometry, this->Tolerance, this->Nearest, this->Farthest);
  CellReport report;
  SideCache sides;
  std::vector<std::int64_t> triangles;
  for (std::size_t i = begin; i < end; ++i)
  {
    const std::int64_t* ids = cells.connectivity + cells.offsets[i];
    const auto count = static_cast<std::size_t>(cells.offsets[i + 1] - cells.offsets[i]);
    const std::int64_t cell = names[i];
    const Side side = this->FindSide(ids, count);
    if (side == Side::InFront || (side == Side::Behind && this->IsSimple(ids, count, true, sides)))
    {
      this->AddWhole(ids, count, cell, whole);
      ++report.whole;
      continue;
    }
    triangles = { 0, 1, 2 };
    if (count != 3)
    {
      triangulate(ids, count, triangles);
    }
    const std::size_t before = pieces.GetNumberOfCells();
    for (std::size_t k = 0; k + 2 < triangles.size(); k += 3)
    {
      const std::array<std::int64_t, 3> corner = { ids[triangles[k]], ids[triangles[k + 1]],
        ids[triangles[k + 2]] };
      mapping.MapTriangle(
        { corner,
          { this->GetPoint(corner[0]), this->GetPoint(corner[1]), this->GetPoint(corner[2]) } },
        cell, side == Side::Both, pieces);
    }
    ++(pieces.GetNumberOfCells() > before ? report.mapped : report.without);
  }
  return report;
}

}
